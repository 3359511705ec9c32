#include "cli/served_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "base/file.h"
#include "cli/page_address.h"

namespace ringcraft {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Kind = Served::Kind;

// A folder of results beside something that is none of anybody's business; made anew in each test.
class ServedFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    base_ = fs::path(::testing::TempDir()) /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(base_);
    fs::create_directories(base_ / "out" / "a <b> & c%");
    fs::create_directories(base_ / "outside");
    write("outside/secret.txt", "secret");
    write("out/a <b> & c%/fight.html", "<p>a fight");
    write("out/a <b> & c%/report.json",
          R"({"scene": "<script>", "seed": 7, "duration_s": 30.0, "library": []})");
    write("out/numbers.csv", "0123456789");
    write("out/.hidden", "hidden");
  }
  void TearDown() override { fs::remove_all(base_); }

  void write(const std::string& name, const std::string& bytes) {
    ASSERT_TRUE(write_file(base_ / name, bytes));
  }
  ServedFolder served() { return ServedFolder::open(base_ / "out").value(); }
  Kind kind(const std::string& target) { return served().find(target).kind; }

  fs::path base_;
};

TEST_F(ServedFolderTest, AFileWithItsTypeAndBytes) {
  const Served found = served().find("/numbers.csv?x=1#y");
  ASSERT_EQ(found.kind, Kind::file);
  EXPECT_EQ(found.type, "text/csv; charset=utf-8");
  ASSERT_EQ(found.file.size(), 10u);
  char bytes[4];
  ASSERT_EQ(found.file.read(8, bytes, sizeof bytes), 2u);
  EXPECT_EQ(std::string(bytes, 2), "89");
  EXPECT_EQ(found.file.read(10, bytes, sizeof bytes), 0u);
}

TEST_F(ServedFolderTest, EncodedNamesAreDecodedOnce) {
  EXPECT_EQ(kind("/a%20%3Cb%3E%20&%20c%25/fight.html"), Kind::file);
  EXPECT_EQ(kind("/numbers%252Ecsv"), Kind::nothing);
}

TEST_F(ServedFolderTest, NothingClimbsOut) {
  for (const char* target : {"/../outside/secret.txt",
                             "/%2e%2e/outside/secret.txt",
                             "/.%2E/outside/secret.txt",
                             "/a%20%3Cb%3E%20&%20c%25/../../outside/secret.txt",
                             "/..%2foutside%2fsecret.txt",
                             "//etc/passwd",
                             "/%2Fetc/passwd",
                             "/..\\outside\\secret.txt",
                             "/..%5coutside",
                             "/.",
                             "/.hidden",
                             "/%00",
                             "/numbers.csv%00.html",
                             "/%",
                             "/%4",
                             "/%zz",
                             "",
                             "numbers.csv",
                             "http://127.0.0.1/numbers.csv",
                             "*"}) {
    EXPECT_EQ(kind(target), Kind::refused) << target;
  }
}

TEST_F(ServedFolderTest, LinksThatLeadOutAreRefused) {
  fs::create_symlink(base_ / "outside" / "secret.txt", base_ / "out" / "link.txt");
  fs::create_directory_symlink(base_ / "outside", base_ / "out" / "way");
  fs::create_symlink("numbers.csv", base_ / "out" / "inside.csv");
  fs::create_symlink("self.txt", base_ / "out" / "self.txt");
  EXPECT_EQ(kind("/link.txt"), Kind::refused);
  EXPECT_EQ(kind("/way/secret.txt"), Kind::refused);
  EXPECT_EQ(kind("/way/"), Kind::refused);
  EXPECT_EQ(kind("/inside.csv"), Kind::file);
  EXPECT_EQ(kind("/self.txt"), Kind::nothing);
}

TEST_F(ServedFolderTest, OnlyRegularFilesAreOpened) {
  ASSERT_EQ(::mkfifo((base_ / "out" / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(kind("/pipe"), Kind::nothing);
  EXPECT_EQ(kind("/numbers.csv/"), Kind::nothing);
}

TEST_F(ServedFolderTest, AFolderIsListedUnderItsSlash) {
  const Served moved = served().find("/a%20%3Cb%3E%20&%20c%25");
  EXPECT_EQ(moved.kind, Kind::moved);
  EXPECT_EQ(moved.text, "/a%20%3Cb%3E%20%26%20c%25/");
  const Served page = served().find(moved.text);
  EXPECT_EQ(page.kind, Kind::page);
  EXPECT_THAT(page.text, HasSubstr("href=\"/a%20%3Cb%3E%20%26%20c%25/fight.html\""));
}

TEST_F(ServedFolderTest, TheIndexNamesResultsAndEscapesWhatTheySay) {
  fs::create_directory_symlink(base_ / "outside", base_ / "out" / "way");
  write("outside/hit.html", "no");
  const std::string page = served().index_page();
  EXPECT_THAT(page, HasSubstr("Fights"));
  EXPECT_THAT(page, HasSubstr("a &lt;b&gt; &amp; c%"));
  EXPECT_THAT(page, HasSubstr("scene &lt;script&gt;, seed 7, 30.0 s"));
  EXPECT_THAT(page, Not(HasSubstr("<script>")));
  EXPECT_THAT(page, Not(HasSubstr("Hits")));
}

TEST_F(ServedFolderTest, TheIndexFollowsNoLinks) {
  write("outside/hit.html", "<p>a hit");
  write("outside/study.json", R"({"title": "secret"})");
  fs::create_symlink(base_ / "outside" / "hit.html", base_ / "out" / "hit.html");
  write("out/study.html", "<p>a study");
  fs::create_symlink(base_ / "outside" / "study.json", base_ / "out" / "study.json");
  EXPECT_EQ(kind("/hit.html"), Kind::refused);
  const std::string page = served().index_page();
  EXPECT_THAT(page, HasSubstr("study.html"));
  EXPECT_THAT(page, Not(HasSubstr("hit.html")));
  EXPECT_THAT(page, Not(HasSubstr("secret")));
}

TEST_F(ServedFolderTest, WhatIsRefusedIsNotListed) {
  for (const std::string name : {"two\nlines", "back\\slash", "del\x7f", ".hidden"}) {
    fs::create_directories(base_ / "out" / "mine" / name);
    write("out/mine/" + name + "/fight.html", "<p>a fight");
    ASSERT_EQ(kind("/mine/" + percent_encoded(name) + "/fight.html"), Kind::refused) << name;
  }
  write("out/mine/good.csv", "");
  EXPECT_THAT(served().index_page(), AllOf(HasSubstr("a%20%3Cb"), Not(HasSubstr("mine"))));
  const std::string page = served().find("/mine/").text;
  EXPECT_THAT(page, AllOf(HasSubstr("good.csv"), Not(HasSubstr("two")), Not(HasSubstr("slash")),
                          Not(HasSubstr("del")), Not(HasSubstr("hidden"))));
}

TEST_F(ServedFolderTest, TheIndexSaysNothingOfAReportThatIsNestedDeeply) {
  const std::string deep = std::string(400'000, '[') + std::string(400'000, ']');
  write("out/a <b> & c%/report.json", R"({"scene": )" + deep + R"(, "seed": {"a": 7}})");
  EXPECT_THAT(served().index_page(), Not(HasSubstr("[")));
  EXPECT_THAT(served().index_page(), HasSubstr("fight.html"));
}

TEST_F(ServedFolderTest, AMissingFolderAndAFileAreErrors) {
  EXPECT_FALSE(ServedFolder::open(base_ / "nothing"));
  EXPECT_FALSE(ServedFolder::open(base_ / "out" / "numbers.csv"));
}

TEST(RangeTest, PartsOfAFile) {
  using Answer = RangeAnswer::Kind;
  const auto part = [](std::string_view header) {
    const RangeAnswer answer = range_answer(header, 10);
    EXPECT_EQ(answer.kind, Answer::part) << header;
    return std::pair(answer.range.first, answer.range.last);
  };
  EXPECT_EQ(part("bytes=0-0"), std::pair(0ul, 0ul));
  EXPECT_EQ(part("bytes=2-5"), std::pair(2ul, 5ul));
  EXPECT_EQ(part("bytes=2-"), std::pair(2ul, 9ul));
  EXPECT_EQ(part("bytes=2-99"), std::pair(2ul, 9ul));
  EXPECT_EQ(part("bytes=-3"), std::pair(7ul, 9ul));
  EXPECT_EQ(part("bytes=-99"), std::pair(0ul, 9ul));
  for (const char* header : {"bytes=10-", "bytes=10-12", "bytes=-0"})
    EXPECT_EQ(range_answer(header, 10).kind, Answer::outside) << header;
  EXPECT_EQ(range_answer("bytes=0-", 0).kind, Answer::outside);
  for (const char* header : {"", "bytes=", "bytes=-", "bytes=5-2", "bytes=a-b", "bytes=0-1,3-4",
                             "lines=0-1", "bytes=0-18446744073709551616", "bytes=+1-2"})
    EXPECT_EQ(range_answer(header, 10).kind, Answer::whole) << header;
}

TEST(PageAddressTest, AnAddressIsWholeAndEncoded) {
  EXPECT_EQ(file_address("/a b/#ü.html"), "file:///a%20b/%23%C3%BC.html");
  EXPECT_THAT(file_address("x.html"), HasSubstr("file:///"));
  EXPECT_TRUE(is_page("x.html"));
  EXPECT_FALSE(is_page("duel.toml"));
  EXPECT_FALSE(is_page("duel"));
}

}  // namespace
}  // namespace ringcraft
