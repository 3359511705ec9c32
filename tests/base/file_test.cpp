#include "base/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "base/temporary_folder.h"

namespace ringcraft {
namespace {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path()), {}));
  }
  const fs::path& path() const { return folder_.path(); }
  TemporaryFolder folder_;
};

TEST_F(FileTest, ReadsBackTheBytesThatWereWritten) {
  std::string bytes("a\0b\r\n\xff", 6);
  ASSERT_TRUE(write_file(path() / "x.bin", bytes));
  const auto read = read_file(path() / "x.bin");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, bytes);
  ASSERT_TRUE(write_file(path() / "x.bin", ""));
  EXPECT_EQ(read_file(path() / "x.bin").value(), "");
}

TEST_F(FileTest, AFolderIsLockedForOneAtATime) {
  {
    const auto mine = lock_folder(path());
    ASSERT_TRUE(mine);
    const auto other = lock_folder(path());
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().kind, ErrorKind::input);
    EXPECT_NE(other.error().what.find("another ringcraft"), std::string::npos);
  }
  EXPECT_TRUE(lock_folder(path()));
  EXPECT_EQ(entries(), 0u);  // nothing is left behind
  EXPECT_FALSE(lock_folder(path() / "none"));
}

TEST_F(FileTest, WhatIsNotARegularFileIsAnInputError) {
  for (const fs::path& wrong :
       {path() / "none", path(), path() / "none" / "x", fs::path("/dev/null")}) {
    const auto read = read_file(wrong);
    ASSERT_FALSE(read) << wrong;
    EXPECT_EQ(read.error().kind, ErrorKind::input);
    EXPECT_EQ(read.error().file, wrong.string());
    EXPECT_FALSE(read.error().remedy.empty());
  }
}

TEST_F(FileTest, AFileBeyondTheLimitIsRefusedUnread) {
  { ASSERT_TRUE(write_file(path() / "large", "x")); }
  fs::resize_file(path() / "large", kLargestInput + 1);  // sparse
  const auto read = read_file(path() / "large");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("256 MiB"), std::string::npos);
}

TEST_F(FileTest, AWrittenFileLeavesNothingBesideIt) {
  ASSERT_TRUE(write_file(path() / "x", "one"));
  ASSERT_TRUE(write_file(path() / "x", "two"));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, AFailedWriteLeavesNoPartAndKeepsWhatWasThere) {
  fs::create_directories(path() / "folder" /
                         "inner");  // a folder that is not empty cannot be replaced
  const auto written = write_file(path() / "folder", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::input);
  EXPECT_EQ(entries(), 1u);
  EXPECT_TRUE(fs::is_directory(path() / "folder" / "inner"));
  EXPECT_FALSE(write_file(path() / "none" / "x", "x"));
}

TEST_F(FileTest, AnInputMayNotBeWrittenOverByAResult) {
  const fs::path input = path() / "in.json";
  ASSERT_TRUE(write_file(input, "mine"));
  fs::create_hard_link(input, path() / "linked.json");
  for (const char* name : {"in.json", "linked.json"}) {
    const auto may = may_write(path(), {"first.json", name}, {path() / "gone.json", input});
    ASSERT_FALSE(may) << name;
    EXPECT_EQ(may.error().file, input.string());
  }
  EXPECT_TRUE(may_write(path(), {"first.json"}, {input}));
  EXPECT_TRUE(may_write(path() / "made", {"in.json"}, {input}));
}

// A device without room: the write is reported, not lost.
TEST_F(FileTest, AFullDeviceIsReported) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  fs::create_symlink("/dev/full", path() / ("x.part" + std::to_string(::getpid())));
  EXPECT_FALSE(write_file(path() / "x", "bytes"));
  EXPECT_FALSE(fs::exists(path() / "x"));
}

// Old and new results are never mixed in one folder.
TEST_F(FileTest, WhereOneOfSeveralFilesCannotBeWrittenAllStayAsTheyWere) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  ASSERT_TRUE(write_files(path(), {{"a", "old"}, {"b", "old"}, {"c", "old"}}));
  fs::create_symlink("/dev/full", path() / ("c.part" + std::to_string(::getpid())));
  EXPECT_FALSE(write_files(path(), {{"a", "new"}, {"b", "new"}, {"c", "new"}}));
  fs::create_directory(path() / "d");
  EXPECT_FALSE(write_files(path(), {{"a", "new"}, {"d", "new"}}));
  for (const char* name : {"a", "b", "c"}) EXPECT_EQ(read_file(path() / name).value(), "old");
  EXPECT_EQ(entries(), 4u);
  ASSERT_TRUE(write_files(path(), {{"a", "new"}, {"c", "new"}}));
  EXPECT_EQ(read_file(path() / "c").value(), "new");
}

TEST_F(FileTest, AnOutputFolderIsMadeWithItsParentsAndLeftEmpty) {
  const fs::path out = path() / "a" / "b";
  ASSERT_TRUE(make_output_folder(out));
  ASSERT_TRUE(make_output_folder(out));
  EXPECT_TRUE(fs::is_empty(out));
}

TEST_F(FileTest, AnOutputFolderThatCannotBeIsAnInputError) {
  ASSERT_TRUE(write_file(path() / "file", "x"));
  for (const fs::path& wrong :
       {path() / "file", path() / "file" / "inner", fs::path("/proc/ringcraft")}) {
    const auto made = make_output_folder(wrong);
    ASSERT_FALSE(made) << wrong;
    EXPECT_EQ(made.error().kind, ErrorKind::input);
    EXPECT_EQ(made.error().file, wrong.string());
    EXPECT_NE(made.error().remedy.find("--out"), std::string::npos);
  }
}

TEST_F(FileTest, AnOutputFolderWithoutPermissionIsAnInputError) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_FALSE(make_output_folder(path()));
  EXPECT_FALSE(make_output_folder(path() / "inner"));
}

TEST_F(FileTest, TheEnvironmentNamesTheAssets) {
  ::setenv("RINGCRAFT_ASSETS", path().c_str(), 1);
  EXPECT_EQ(assets_folder(), path());
  ::unsetenv("RINGCRAFT_ASSETS");
  EXPECT_TRUE(fs::exists(assets_folder() / "schemas"));
}

}  // namespace
}  // namespace ringcraft
