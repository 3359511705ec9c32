#include "capture/library_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "capture/library_builder.h"
#include "capture/library_responses.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using test::action_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class LibraryFile : public testing::Test {
 protected:
  TemporaryFolder folder_;
  Skeleton skeleton_ = canonical_skeleton();
};

TEST_F(LibraryFile, IsLoadedWhereverALibraryIsNamed) {
  LibraryBuildSettings settings;
  const MotionLibrary built = connected_library(
      "two",
      {action_of("idle", Kind::idle, test::idle_clip(skeleton_)),
       action_of("step", Kind::transition, test::step_clip(skeleton_, {0, 0, 0.2f}))},
      {"a note"}, settings);
  EXPECT_FALSE(built.graph().transitions.empty());
  const std::filesystem::path file = folder_.path() / "two.ringlib";
  ASSERT_TRUE(write_library(built, file));
  const auto loaded = load_library(file);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->hash(), built.hash());
  EXPECT_EQ(loaded->graph().transitions.size(), built.graph().transitions.size());
  EXPECT_THAT(loaded->notes(), ElementsAre("a note"));
}

TEST_F(LibraryFile, IsNotReplacedByOneThatCouldNotBeRead) {
  const auto library_with = [&](Defense defense) {
    Action idle = action_of("idle", Kind::idle, test::idle_clip(skeleton_));
    idle.defense = defense;
    return connected_library("one", {std::move(idle)}, {}, {});
  };
  const std::filesystem::path file = folder_.path() / "one.ringlib";
  ASSERT_TRUE(write_library(library_with({DefenseKind::slip, 2, 4}), file));
  const auto before = read_file(file);
  ASSERT_TRUE(before);
  const auto written = write_library(library_with({DefenseKind::slip, 4, 2}), file);
  ASSERT_FALSE(written);
  EXPECT_THAT(to_string(written.error()), HasSubstr("action idle: a defense outside of it"));
  EXPECT_EQ(read_file(file).value_or(""), *before);
}

TEST_F(LibraryFile, IsKnownByItsFirstBytesNotByItsName) {
  std::ofstream(folder_.path() / "text.ringlib") << "name = \"kickboxing\"\n";
  const auto text = load_library(folder_.path() / "text.ringlib");
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().what, HasSubstr("not a motion library file"));
  std::ofstream(folder_.path() / "damaged", std::ios::binary) << "ringlib\nxyz";
  const auto damaged = load_library(folder_.path() / "damaged");
  ASSERT_FALSE(damaged);
  EXPECT_THAT(damaged.error().what, HasSubstr("cut off"));
}

TEST_F(LibraryFile, AFolderOfCapturesIsToldHowToBecomeALibrary) {
  const auto folder = load_library(folder_.path());
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().remedy, HasSubstr("ringcraft library build"));
  const auto built = build_library(folder_.path());
  ASSERT_FALSE(built);
  EXPECT_THAT(built.error().what, HasSubstr("no action was found"));
}

TEST_F(LibraryFile, WhatCapturesLackIsTakenFromAnotherLibraryAndSaid) {
  const auto response = [&](const char* name, ResponseKind kind, float degrees) {
    Action action = action_of(name, Kind::response, test::idle_clip(skeleton_));
    action.response =
        Response{kind, kind == ResponseKind::recovery_steps ? 1 : 0, radians(degrees)};
    return action;
  };
  std::vector<Action> own = {response("own_step_back", ResponseKind::recovery_steps, 170)};
  std::vector<std::string> notes;
  add_missing_responses(own,
                        {response("back", ResponseKind::recovery_steps, 180),
                         response("fore", ResponseKind::recovery_steps, 0),
                         response("own_step_back", ResponseKind::absorb, 0),
                         action_of("idle", Kind::idle, test::idle_clip(skeleton_))},
                        "other", notes);
  std::vector<std::string> names;
  for (const Action& action : own) names.push_back(action.name);
  EXPECT_THAT(names, ElementsAre("own_step_back", "fore", "other_own_step_back", "idle"));
  EXPECT_THAT(notes, SizeIs(3));
  EXPECT_THAT(notes[0], HasSubstr("fore: not in the captures, taken from other"));
}

}  // namespace
}  // namespace ringcraft
