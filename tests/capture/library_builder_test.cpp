#include "capture/library_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "capture/bvh.h"
#include "capture/cut.h"
#include "capture/retarget.h"
#include "capture/small_files.h"

namespace ringcraft {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kBoxing = "/usr/share/assimp/models/BVH/Boxing_Toes.bvh";

class Manifest : public ::testing::Test {
 protected:
  Result<std::vector<Action>> collect(const std::string& text,
                                      std::vector<std::string>* notes = nullptr) {
    std::ofstream(folder_.path() / "library.toml") << text;
    return collect_actions(folder_.path() / "library.toml", notes);
  }
  static std::string boxing(const std::string& action) {
    return "name = \"test\"\n[[capture]]\npath = \"" + kBoxing.string() +
           "\"\nmirror = true\nguard_at = 3.05\n[[capture.action]]\n" + action;
  }

  TemporaryFolder folder_;
};

TEST_F(Manifest, AnAbsentCaptureIsAnErrorThatNamesThePackage) {
  const auto actions = collect(
      "name = \"test\"\n[[capture]]\npath = \"not_here.bvh\"\npackage = "
      "\"assimp-testmodels\"\nguard_at = 0\n"
      "[[capture.action]]\nname = \"a\"\nkind = \"idle\"\nbegin = 0\nend = 1\n");
  ASSERT_FALSE(actions);
  EXPECT_THAT(actions.error().what, HasSubstr("not_here.bvh"));
  EXPECT_EQ(actions.error().remedy, "apt-get install assimp-testmodels");
  EXPECT_THAT(actions.error().place, HasSubstr("line 3"));
}

TEST_F(Manifest, AnOptionalCaptureThatIsAbsentIsPassedOverAndNoted) {
  std::vector<std::string> notes;
  const auto actions = collect(
      "name = \"test\"\n[[capture]]\npath = \"not_here.bvh\"\noptional = true\nguard_at = 0\n"
      "[[capture.action]]\nname = \"a\"\nkind = \"idle\"\nbegin = 0\nend = 1\n",
      &notes);
  EXPECT_FALSE(actions);  // nothing is left
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("passed over"));
}

TEST_F(Manifest, AnUnknownKeyNamesTheLine) {
  const auto actions = collect("name = \"test\"\nsheetz = []\n");
  ASSERT_FALSE(actions);
  EXPECT_THAT(to_string(actions.error()), HasSubstr("line 2"));
  EXPECT_THAT(to_string(actions.error()), HasSubstr("sheets"));
}

TEST_F(Manifest, ASheetPatternThatMatchesNothingIsAnError) {
  const auto actions = collect("name = \"test\"\nsheets = [\"none/*.toml\"]\n");
  ASSERT_FALSE(actions);
  EXPECT_THAT(actions.error().what, HasSubstr("none/*.toml"));
}

TEST_F(Manifest, WhereASheetSaysThatAnActionLeadsIsHeldAgainstThePoses) {
  for (const char* sheet : {"guard.toml", "falls.toml"}) {
    std::filesystem::copy(assets_folder() / "kickboxing" / "sheets" / sheet, folder_.path());
  }
  const auto built = [&](const std::string& leads_to) {
    std::ofstream(folder_.path() / "library.toml")
        << "name = \"test\"\nsheets = [\"guard.toml\", \"falls.toml\", \"mine.toml\"]\n";
    std::ofstream(folder_.path() / "mine.toml")
        << "poses = \"guard.toml\"\n[[action]]\nname = \"sway\"\nkind = \"defense\"\nlength = 0.5\n"
           "leads_to = "
        << leads_to << "\n";
    return build_library(folder_.path() / "library.toml");
  };
  const auto sound =
      built("[\"idle_*\", \"attack\"]");  // a kind that there is none of may be named
  ASSERT_TRUE(sound) << to_string(sound.error());
  const ActionId sway = sound->find("sway");
  ASSERT_TRUE(sway.valid());
  EXPECT_EQ(sound->machine().edge(sway, sway), nullptr);
  EXPECT_FALSE(sound->machine().edges(sway).empty());
  const auto unknown = built("[\"idle_*\", \"jabb\"]");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(to_string(unknown.error()),
              HasSubstr("mine.toml: line 6: sway leads to 'jabb', and no action"));
  const auto alone = built("[\"attak\"]");  // it was dropped, since nothing leads on from it
  ASSERT_FALSE(alone);
  EXPECT_THAT(to_string(alone.error()), HasSubstr("mine.toml: line 6: sway leads to 'attak'"));
  const auto far = built("[\"idle_*\", \"get_up_*\"]");
  ASSERT_FALSE(far);
  EXPECT_THAT(to_string(far.error()), HasSubstr("cm from where it ends"));
}

// What is wrong is the name, not the file that it would be.
TEST_F(Manifest, WhatIsNamedWronglyIsSaidWithTheLineThatNamesIt) {
  std::ofstream(folder_.path() / "a.bvh") << testing::small_bvh();
  const auto wrong = [&](const std::string& line) {
    const auto actions =
        collect("name = \"test\"\n[[capture]]\npath = \"a.bvh\"\nsegment = true\n" + line + "\n");
    EXPECT_FALSE(actions) << line;
    return actions ? "" : to_string(actions.error());
  };
  EXPECT_THAT(wrong("profile = \"nope\""), HasSubstr("library.toml: line 5: no skeleton profile is "
                                                     "called 'nope'; known names: bandai_namco, "));
  EXPECT_THAT(wrong("profile = \"../vrm\""), HasSubstr("library.toml: line 5: "));
  EXPECT_THAT(wrong("clip = \"walk\""), HasSubstr("library.toml: line 5: clip goes with glTF"));
  EXPECT_THAT(wrong("frame_rate = 60"),
              HasSubstr("library.toml: line 5: frame_rate goes with .amc"));
  EXPECT_THAT(wrong("skeleton = \"a.asf\""), HasSubstr("library.toml: line 5: skeleton goes with"));
  std::ofstream(folder_.path() / "a.amc") << testing::small_amc();
  const auto lost = collect(
      "name = \"test\"\n[[capture]]\npath = \"a.amc\"\nskeleton = \"none.asf\"\n"
      "segment = true\n");
  ASSERT_FALSE(lost);
  EXPECT_THAT(to_string(lost.error()), HasSubstr("library.toml: line 4: the skeleton "));
  std::ofstream(folder_.path() / "mine.toml")
      << "poses = \"gard.toml\"\n[[action]]\nname = \"sway\"\n"
         "kind = \"defense\"\nlength = 0.5\n";
  const auto poses = collect("name = \"test\"\nsheets = [\"mine.toml\"]\n");
  ASSERT_FALSE(poses);
  EXPECT_THAT(to_string(poses.error()), HasSubstr("mine.toml: line 1: the sheet "));
}

TEST_F(Manifest, CutsThatCannotBeMadeAreErrors) {
  if (!std::filesystem::exists(kBoxing)) GTEST_SKIP() << "no captures";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"name = \"a\"\nkind = \"idle\"\nbegin = 5\nend = 5\n", "shorter than"},
      {"name = \"a\"\nkind = \"idle\"\nbegin = 6\nend = 5\n", "shorter than"},
      {"name = \"a\"\nkind = \"idle\"\nbegin = 30\nend = 31\n", "the capture at 30.68"},
      {"name = \"a\"\nkind = \"attack\"\nbegin = 3\nend = 4\nstrike = [{ kind = \"straight\", "
       "joint = "
       "\"leftHand\", zone = \"head\", at = 7.0 }]\n",
       "not inside"},
      {"name = \"a\"\nkind = \"attack\"\nbegin = 20\nend = 21\nstrike = [{ kind = \"straight\", "
       "joint = \"leftHand\", zone = \"head\", at = 0 }]\n",
       "not inside"},
      {"name = \"a\"\nkind = \"attack\"\nbegin = 3\nend = 4\n", "strikes nothing"},
      {"name = \"a\"\nkind = \"attack\"\nbegin = 3\nend = 4\nstrike = [{ kind = \"straight\", "
       "joint = \"leftHand\", zone = \"head\", at = 3.4 }]\nresponse = { kind = \"absorb\" }\n",
       "only an action of kind 'response'"},
      {"name = \"a\"\nkind = \"idle\"\nbegin = 3\nend = 4\nstarts_lying = \"seat\"\n",
       "only a get-up starts lying"},
      {"name = \"a\"\nkind = \"response\"\nbegin = 3\nend = 4\nresponse = { kind = \"absorb\", "
       "steps = 3 }\n",
       "steps do not fit"},
      {"name = \"a\"\nkind = \"combination\"\nbegin = 3\nend = 4\nstrike = []\n",
       "strikes nothing"},
      {"name = \"a\"\nkind = \"idle\"\nbegin = 3\nend = 4\n[[capture.action]]\nname = \"a\"\nkind "
       "= "
       "\"idle\"\nbegin = 5\nend = 6\n",
       "second action"}};
  for (const auto& [text, what] : bad) {
    const auto actions = collect(boxing(text));
    ASSERT_FALSE(actions) << text;
    EXPECT_THAT(actions.error().what, HasSubstr(what));
    EXPECT_THAT(actions.error().place, HasSubstr("line"));
  }
}

TEST_F(Manifest, ADefenseThatDoesNotLieWithinItsActionIsAnErrorAtItsLine) {
  if (!std::filesystem::exists(kBoxing)) GTEST_SKIP() << "no captures";
  const auto collected = [&](const std::string& window) {
    return collect(
        boxing("name = \"a\"\nkind = \"defense\"\nbegin = 3.12\nend = 3.8\n"
               "defense = { kind = \"slip\", " +
               window + " }\n"));
  };
  const auto sound = collected("begin = 3.12, end = 3.8");
  EXPECT_TRUE(sound) << to_string(sound.error());
  for (const char* window : {"begin = 70, end = 1", "begin = 70, end = 80", "begin = 3, end = 3.5",
                             "begin = 3.3, end = 3.9", "begin = 3.4, end = 3.4"}) {
    const auto actions = collected(window);
    ASSERT_FALSE(actions) << window;
    EXPECT_THAT(actions.error().what, HasSubstr("over which a protects")) << window;
    EXPECT_EQ(actions.error().place, "line 11, /capture/0/action/0/defense") << window;
  }
}

TEST_F(Manifest, MoreActionsThanALibraryHoldsAreRefusedBeforeTheWork) {
  std::filesystem::copy(assets_folder() / "kickboxing" / "sheets" / "guard.toml", folder_.path());
  for (int i = 0; i < 11; ++i) {
    std::ofstream sheet(folder_.path() / fmt::format("many_{}.toml", i));
    sheet << "poses = \"guard.toml\"\n";
    for (int j = 0; j < 190; ++j) {
      sheet << fmt::format("[[action]]\nname = \"a_{}_{}\"\nkind = \"idle\"\nlength = 0.1\n", i, j);
    }
  }
  std::ofstream(folder_.path() / "library.toml") << "name = \"test\"\nsheets = [\"many_*.toml\"]\n";
  const auto built = build_library(folder_.path() / "library.toml");
  ASSERT_FALSE(built);
  EXPECT_THAT(to_string(built.error()),
              HasSubstr("library.toml: 2090 actions, more than the 2048 of a library"));
}

TEST_F(Manifest, AGuardBehindTheCapturesEndIsAnError) {
  if (!std::filesystem::exists(kBoxing)) GTEST_SKIP() << "no captures";
  std::string text = boxing("name = \"a\"\nkind = \"idle\"\nbegin = 3\nend = 4\n");
  text.replace(text.find("3.05"), 4, "31.0");
  const auto actions = collect(text);
  ASSERT_FALSE(actions);
  EXPECT_THAT(actions.error().what, HasSubstr("30.68"));
  EXPECT_THAT(actions.error().place, HasSubstr("line 5"));
}

class Kickboxing : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::filesystem::exists(kBoxing)) return;
    auto actions = collect_actions(assets_folder() / "kickboxing" / "library.toml");
    ASSERT_TRUE(actions) << to_string(actions.error());
    actions_ = new std::vector<Action>(std::move(*actions));
  }
  static void TearDownTestSuite() {
    delete actions_;
    actions_ = nullptr;
  }
  void SetUp() override {
    if (actions_ == nullptr) GTEST_SKIP() << "no captures: apt-get install assimp-testmodels";
  }
  static bool captured(const Action& action) {
    return action.source.find(".bvh") != std::string::npos;
  }
  Vec3 from_hips(const Action& action, Joint joint, Tick tick) const {
    const WorldPose world = world_pose(skeleton_, action.clip.at(tick));
    return world.position[index(joint)] - world.position[0];
  }

  static inline std::vector<Action>* actions_ = nullptr;
  Skeleton skeleton_ = canonical_skeleton();
};

TEST_F(Kickboxing, EveryClipKeepsTheRulesAndHasItsSource) {
  for (const Action& action : *actions_) {
    EXPECT_TRUE(faults(action.clip).empty()) << action.name;
    EXPECT_FALSE(action.source.empty()) << action.name;
  }
}

TEST_F(Kickboxing, CapturedStraightsReachTheOpponentWhileTheyAreActive) {
  int straights = 0;
  for (const Action& action : *actions_) {
    if (!captured(action)) continue;
    for (const Strike& strike : action.strikes) {
      if (strike.kind != StrikeKind::straight) continue;
      ++straights;
      ASSERT_LT(strike.active_begin, strike.active_end) << action.name;
      ASSERT_LE(strike.active_end, action.length() + 1) << action.name;
      Tick farthest = strike.active_begin;
      for (Tick t = strike.active_begin; t <= std::min(strike.active_end + 6, action.length()); ++t)
        if (from_hips(action, strike.joint, t).z > from_hips(action, strike.joint, farthest).z)
          farthest = t;
      const Vec3 reach = from_hips(action, strike.joint, farthest);
      EXPECT_GT(reach.z, 0.6f) << action.name;
      // What names an aim is led to it (StrikeFit.CapturedBlowsAreLedToTheirAims), wherever the
      // hips of the captured crouch are.
      if (strike.aim.empty()) {
        EXPECT_LT(std::abs(reach.x), 0.12f * reach.z) << action.name;
      }
      EXPECT_LT(farthest, strike.active_end) << action.name;
      EXPECT_LT(from_hips(action, strike.joint, 0).z, 0.75f * reach.z) << action.name;
    }
  }
  EXPECT_GE(straights, 10);
}

TEST_F(Kickboxing, TheFighterIsOrthodoxAndInGuardAtBothEnds) {
  for (const Action& action : *actions_) {
    if (!captured(action) || action.kind == Kind::response || action.kind == Kind::get_up) continue;
    for (const Tick t : {0, action.length()}) {
      const WorldPose world = world_pose(skeleton_, action.clip.at(t));
      const Placement back = inverse(action.clip.root_at(t));
      const Vec3 lead = back * world.position[index(Joint::left_foot)];
      const Vec3 rear = back * world.position[index(Joint::right_foot)];
      EXPECT_GT(lead.z, rear.z + 0.1f) << action.name << " at " << t;  // the left foot leads
      EXPECT_GT(world.position[index(Joint::right_hand)].y, 1.0f) << action.name << " at " << t;
      EXPECT_GT(world.position[index(Joint::left_hand)].y, 0.85f) << action.name << " at " << t;
      EXPECT_LT(std::hypot((back * world.position[0]).x, (back * world.position[0]).z), 0.15f)
          << action.name;
    }
  }
}

TEST_F(Kickboxing, TheRootTurnsLittleInABlowHoweverTheHipsSwing) {
  float hips_swing = 0;
  for (const Action& action : *actions_) {
    if (!captured(action) || action.strikes.empty()) continue;
    for (Tick t = 1; t <= action.length(); ++t) {
      EXPECT_LT(std::abs(action.clip.root_at(t).yaw), radians(25)) << action.name;
      const Placement& a = action.clip.root_at(t - 1);
      const Placement& b = action.clip.root_at(t);
      EXPECT_LT(std::hypot(b.x - a.x, b.z - a.z) / kTickSeconds, 1.0f) << action.name;
      EXPECT_LT(std::abs(b.yaw - a.yaw) / kTickSeconds, radians(90)) << action.name;
      const float turn =
          heading_of(action.clip.at(t).rotation[0]) - heading_of(action.clip.at(t - 1).rotation[0]);
      hips_swing = std::max(hips_swing, std::abs(wrapped_angle(turn)) / kTickSeconds);
    }
  }
  EXPECT_GT(hips_swing, radians(300));
}

TEST_F(Kickboxing, CapturedActionsBeginFacingTheOpponentOfTheGuard) {
  // Laid on each other, actions hardly turn: where one ends facing, the next begins.
  for (const Action& from : *actions_)
    for (const Action& to : *actions_) {
      if (!captured(from) || !captured(to) || from.kind == Kind::response ||
          to.kind == Kind::response)
        continue;
      if (from.kind == Kind::get_up || to.kind == Kind::get_up) continue;
      const Alignment fit = aligned(skeleton_, from.clip, to.clip);
      if (fit.distance >= 0.14f) continue;
      EXPECT_LT(std::abs(fit.placement.yaw), radians(15)) << from.name << " " << to.name;
    }
}

TEST_F(Kickboxing, MirroredTwiceIsTheSame) {
  for (const Action& action : *actions_) {
    const Action twice = mirrored(mirrored(action));
    EXPECT_EQ(twice.name, action.name);
    EXPECT_EQ(twice.clip.root, action.clip.root);
    EXPECT_EQ(twice.clip.contacts, action.clip.contacts);
    for (std::size_t i = 0; i < action.clip.frames.size(); ++i) {
      EXPECT_EQ(twice.clip.frames[i].hips, action.clip.frames[i].hips);
      EXPECT_EQ(twice.clip.frames[i].rotation, action.clip.frames[i].rotation);
    }
  }
}

TEST_F(Kickboxing, FallEndsWhereTheGetUpBegins) {
  bool falls = false;
  bool rises = false;
  for (const Action& action : *actions_) {
    if (!captured(action)) continue;
    if (action.ends_lying == Lying::seat) {
      falls = true;
      EXPECT_LT(action.clip.frames.back().hips.y, 0.25f);
      EXPECT_GT(action.clip.frames.front().hips.y, 0.8f);
      EXPECT_EQ(action.response->kind, ResponseKind::knockdown);
    }
    if (action.starts_lying == Lying::seat) {
      rises = true;
      EXPECT_LT(action.clip.frames.front().hips.y, 0.25f);
      EXPECT_GT(action.clip.frames.back().hips.y, 0.8f);
    }
  }
  EXPECT_TRUE(falls && rises);
}

TEST_F(Kickboxing, BlowsAreFastestWhenTheCaptureSaysTheyAre) {
  // Times of the peaks measured by forward kinematics on the file itself (right is left: southpaw).
  const std::vector<std::pair<double, Joint>> blows = {
      {3.40, Joint::right_hand}, {5.08, Joint::right_hand}, {5.40, Joint::right_hand},
      {5.72, Joint::left_hand},  {6.43, Joint::right_hand}, {7.29, Joint::right_hand},
      {9.19, Joint::left_hand},  {9.87, Joint::right_hand}, {12.41, Joint::right_hand},
      {14.11, Joint::right_hand}};
  const RawClip raw = *read_bvh(kBoxing);
  const auto profile = *read_profile(assets_folder() / "profiles" / "boxing_toes.toml");
  const Clip clip = *retarget(raw, profile, skeleton_);
  for (const auto& [time, joint] : blows) {
    const Tick peak = fastest_tick(skeleton_, clip, joint, ticks(time - 0.2), ticks(time + 0.15));
    EXPECT_NEAR(seconds(peak), time, 0.1) << time;
  }
}

TEST_F(Kickboxing, BuildsAStronglyConnectedLibraryThatIsTheSameEveryTime) {
  const auto first = build_library(assets_folder() / "kickboxing" / "library.toml");
  const auto second = build_library(assets_folder() / "kickboxing" / "library.toml");
  ASSERT_TRUE(first) << to_string(first.error());
  ASSERT_TRUE(second);
  EXPECT_EQ(first->hash(), second->hash());
  EXPECT_GE(first->launchable().size(), 15u);
  for (const ActionId from : first->launchable())
    for (const ActionId to : first->launchable())
      EXPECT_NE(first->machine().path(from, to), nullptr);
}

// How far a foot goes over the floor, lower than a finger is thick, before it stands or after it
// stood. A sweep is meant to.
TEST_F(Kickboxing, FeetOfKicksComeDownOnTheirPlace) {
  int kicks = 0;
  for (const Action& action : *actions_) {
    if (!action.attacks() || captured(action) || action.name == "leg_sweep") continue;
    const bool kick =
        std::any_of(action.strikes.begin(), action.strikes.end(), [](const Strike& s) {
          return s.joint == Joint::left_foot || s.joint == Joint::right_foot;
        });
    if (!kick) continue;
    ++kicks;
    for (const Joint toe : {Joint::left_toes, Joint::right_toes}) {
      float way = 0, longest = 0;
      Vec3 before{};
      for (Tick t = 0; t <= action.length(); ++t) {
        const Vec3 at = world_pose(skeleton_, action.clip.at(t)).position[index(toe)];
        const float moved = t == 0 ? 0 : glm::length(Vec3(at.x - before.x, 0, at.z - before.z));
        const bool brushes = at.y < skeleton_.toe_height() + 0.015f && moved > 0.3f * kTickSeconds;
        way = brushes ? way + moved : 0;
        longest = std::max(longest, way);
        before = at;
      }
      EXPECT_LT(longest, 0.09f) << action.name;
    }
  }
  EXPECT_GT(kicks, 8);
}

}  // namespace
}  // namespace ringcraft
