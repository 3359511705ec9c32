// Segmentation against what was seen by eye on real captures (../shared/mocap/README.md and
// docs/sources.md, C0), and against the technique sheets, whose strikes are known exactly.

#include "capture/segment.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/temporary_folder.h"
#include "capture/library_builder.h"
#include "capture/segment_truth.h"
#include "capture/sheet.h"

namespace ringcraft {
namespace {

using namespace testing;

Segmentation segmented(const char* file) {
  const std::filesystem::path path = mocap_folder() / file;
  return segment(canonical_skeleton(), canonical_clip_of(path), path.stem().string());
}

#define SKIP_WITHOUT_CAPTURES() \
  if (!std::filesystem::exists(mocap_folder())) GTEST_SKIP() << "skipped: no captures"

void expect_found(const char* file, const std::vector<Seen>& eye, const std::vector<Seen>& rule) {
  const Segmentation result = segmented(file);
  const Score score = score_of(result.blows, eye, rule);
  std::string list;
  for (const FoundBlow& blow : result.blows) list += blow.evidence + "\n";
  EXPECT_GE(score.precision, 0.9) << file << "\n" << list;
  EXPECT_GE(score.recall, 0.9) << file << "\n" << list;
  EXPECT_GE(score.kind, 0.8) << file << "\n" << list;
}

TEST(Segmentation, FindsTheStrikesOfABoxerSeenByEye) {
  SKIP_WITHOUT_CAPTURES();
  expect_found("cmu/13_17.amc", kEye13_17, kRule13_17);
}

TEST(Segmentation, FindsTheStrikesOfASouthpawSeenByEye) {
  SKIP_WITHOUT_CAPTURES();
  expect_found("debian/Boxing_Toes.bvh", kEyeBoxing, kRuleBoxing);
}

TEST(Segmentation, FindsStraightsAndBlocksOfAKata) {
  SKIP_WITHOUT_CAPTURES();
  expect_found("cmu/135_06.amc", kEye135_06, kRule135_06);
}

TEST(Segmentation, FindsEveryKickWithItsSideAndKind) {
  SKIP_WITHOUT_CAPTURES();
  for (const KickTake& kick : kKicks) {
    const Segmentation result = segmented(kick.file);
    ASSERT_EQ(result.blows.size(), 1u) << kick.file;
    EXPECT_EQ(result.blows[0].strike.joint, kick.foot) << kick.file;
    EXPECT_EQ(result.blows[0].strike.kind, kick.kind) << kick.file;
    EXPECT_EQ(result.blows[0].spins, kick.spins) << kick.file;
  }
}

TEST(Segmentation, WalksRunsJumpsRollsAndHandshakesHoldNoStrike) {
  SKIP_WITHOUT_CAPTURES();
  for (const char* file : kPeaceful) {
    const Segmentation result = segmented(file);
    for (const FoundBlow& blow : result.blows) ADD_FAILURE() << file << ": " << blow.evidence;
  }
}

TEST(Segmentation, FindsTheKnockdownAndTheGetUp) {
  SKIP_WITHOUT_CAPTURES();
  const Segmentation result = segmented("debian/Boxing_Toes.bvh");
  int falls = 0, rises = 0;
  for (const FoundAction& segment : result.segments) {
    const ActionCut& cut = segment.cut;
    if (cut.ends_lying != Lying::none) {
      ++falls;
      EXPECT_EQ(cut.ends_lying, Lying::seat);
      EXPECT_NEAR(cut.begin, 23.0, 0.3);
      EXPECT_NEAR(cut.end, 24.2, 0.3);
    }
    if (cut.starts_lying != Lying::none) {
      ++rises;
      EXPECT_EQ(cut.starts_lying, Lying::seat);
      EXPECT_NEAR(cut.begin, 28.0, 0.3);
      EXPECT_NEAR(cut.end, 30.0, 0.3);
    }
  }
  EXPECT_EQ(falls, 1);
  EXPECT_EQ(rises, 1);
}

TEST(Segmentation, KnowsWhichFootIsAheadAndWhereTheOpponentStands) {
  SKIP_WITHOUT_CAPTURES();
  const Segmentation orthodox = segmented("cmu/13_17.amc");
  EXPECT_FALSE(orthodox.southpaw);
  EXPECT_NEAR(degrees(orthodox.guard_yaw), -55, 15);  // docs/sources.md, C1
  const Segmentation southpaw = segmented("debian/Boxing_Toes.bvh");
  EXPECT_TRUE(southpaw.southpaw);
  EXPECT_NEAR(degrees(southpaw.guard_yaw), 60, 15);
}

TEST(Segmentation, TheMirroredCaptureGivesTheMirroredBlows) {
  SKIP_WITHOUT_CAPTURES();
  const Skeleton skeleton = canonical_skeleton();
  const Clip clip = canonical_clip_of(mocap_folder() / "debian/Boxing_Toes.bvh");
  const Segmentation a = segment(skeleton, clip, "take");
  const Segmentation b = segment(skeleton, mirrored(clip), "take");
  ASSERT_EQ(a.blows.size(), b.blows.size());
  for (std::size_t i = 0; i < a.blows.size(); ++i) {
    EXPECT_EQ(mirrored(a.blows[i].strike.joint), b.blows[i].strike.joint);
    EXPECT_EQ(a.blows[i].strike.kind, b.blows[i].strike.kind);
    EXPECT_NEAR(a.blows[i].strike.at, b.blows[i].strike.at, 0.02);
  }
  EXPECT_NE(a.southpaw, b.southpaw);
}

TEST(Segmentation, ALongIdleWithHangingHandsHidesNoStagger) {
  SKIP_WITHOUT_CAPTURES();
  const Clip clip = canonical_clip_of(mocap_folder() / "debian/Boxing_Toes.bvh");
  Clip idle = clip;
  const auto waits = static_cast<std::size_t>(20 * kTicksPerSecond);
  idle.frames.insert(idle.frames.end(), waits, clip.frames.back());
  idle.root.insert(idle.root.end(), waits, clip.root.back());
  idle.contacts.insert(idle.contacts.end(), waits, clip.contacts.back());
  const auto recoveries = [](const Clip& capture) {
    const auto found = segment(canonical_skeleton(), capture, "take").segments;
    return std::count_if(found.begin(), found.end(), [](const FoundAction& action) {
      return action.cut.response && action.cut.response->kind == ResponseKind::recovery_steps;
    });
  };
  EXPECT_GE(recoveries(clip), 6);
  EXPECT_GE(recoveries(idle), 6);
}

TEST(Segmentation, AListedCutTakesThePlaceOfWhatIsFoundInItsTime) {
  const auto at = [](const char* name, double begin, double end) {
    FoundAction action;
    action.cut.name = name;
    action.cut.begin = begin;
    action.cut.end = end;
    return action;
  };
  const std::vector<FoundAction> found = {at("before", 0, 1), at("same", 1.1, 1.9),
                                          at("longer", 0.5, 3), at("touches", 1.9, 2.9)};
  std::vector<std::string> kept;
  for (const FoundAction& action : not_listed(found, {at("listed", 1, 2).cut}))
    kept.push_back(action.cut.name);
  EXPECT_THAT(kept, ::testing::ElementsAre("before", "touches"));
}

TEST(Segmentation, CapturesInFormatsThatAreNotReadAreNamed) {
  const TemporaryFolder scratch;
  std::filesystem::create_directory(scratch.path() / "takes");
  for (const char* name : {"takes/a.FBX", "b.c3d", "notes.txt"})
    std::ofstream(scratch.path() / name) << "motion";
  std::vector<std::string> notes;
  const auto actions = collect_folder_actions(scratch.path(), &notes);
  ASSERT_TRUE(actions) << to_string(actions.error());
  EXPECT_TRUE(actions->empty());
  EXPECT_THAT(notes, ::testing::UnorderedElementsAre(
                         ::testing::HasSubstr("a.FBX: captures in .fbx are not read; export it"),
                         ::testing::HasSubstr("b.c3d: captures in .c3d are not read; export it")));
}

TEST(Segmentation, AManifestFindsActionsAndListedOnesOverrideThem) {
  SKIP_WITHOUT_CAPTURES();
  const std::filesystem::path capture = mocap_folder() / "debian/Boxing_Toes.bvh";
  const TemporaryFolder scratch;
  const std::filesystem::path manifest = scratch.path() / "segment_manifest.toml";
  ASSERT_TRUE(write_file(manifest, "name = \"found\"\n[[capture]]\npath = \"" + capture.string() +
                                       "\"\nsegment = true\n[[capture.action]]\nname = "
                                       "\"my_cross\"\nkind = \"attack\"\nbegin = 8.82\nend = "
                                       "9.74\nstrike = [{kind = \"straight\", joint = "
                                       "\"rightHand\", zone = \"head\", at = 9.19}]\n"));
  std::vector<std::string> notes;
  const auto actions = collect_actions(manifest, &notes);
  ASSERT_TRUE(actions) << to_string(actions.error());
  const auto crosses = [&](double at) {
    return std::count_if(actions->begin(), actions->end(), [&](const Action& action) {
      const bool mine = action.name == "my_cross";
      return mine ||
             (action.source.find("Boxing_Toes") != std::string::npos &&
              action.strikes.size() == 1 && action.name.find("cross_right") != std::string::npos &&
              action.source.find(fmt::format(" {:.0f}.", at)) != std::string::npos);
    });
  };
  EXPECT_EQ(crosses(9), 1);  // mine, and none that was found there
  EXPECT_GT(actions->size(), 20u);
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("southpaw, mirrored")));
}

TEST(Segmentation, AFolderGivesOrthodoxActionsWithDistinctNamesAndSaysWhatItPassedOver) {
  SKIP_WITHOUT_CAPTURES();
  const TemporaryFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  std::filesystem::create_directories(folder / "deeper");
  const auto copy = [&](const char* from, const char* to) {
    std::filesystem::copy_file(mocap_folder() / from, folder / to);
  };
  copy("debian/Boxing_Toes.bvh", "Boxing_Toes.bvh");
  copy("debian/Boxing_Toes.bvh", "the same.bvh");
  copy("mass/mass_kick.bvh", "deeper/mass_kick.bvh");
  ASSERT_TRUE(write_file(folder / "broken.bvh", "HIERARCHY\nROOT"));
  std::vector<std::string> notes;
  const auto actions = collect_folder_actions(folder, &notes);
  ASSERT_TRUE(actions) << to_string(actions.error());
  std::vector<std::string> names;
  for (const Action& action : *actions) {
    names.push_back(action.name);
    EXPECT_TRUE(faults(action.clip).empty()) << action.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_THAT(names, ::testing::Contains("boxing_toes_hook_left_1"));
  EXPECT_THAT(names, ::testing::Contains("boxing_toes_hook_right_1"));  // mirrored
  EXPECT_THAT(names, ::testing::Contains("mass_kick_roundhouse_right_1"));
  EXPECT_THAT(notes, ::testing::Contains(::testing::AllOf(::testing::HasSubstr("passed over"),
                                                          ::testing::HasSubstr("broken.bvh"))));
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("the same motion as")));
  EXPECT_FALSE(collect_folder_actions(folder / "nowhere", nullptr));
}

TEST(Segmentation, AnythingShortOrStillIsNoAction) {
  const Skeleton skeleton = canonical_skeleton();
  Clip still;
  for (int i = 0; i < 8; ++i) {
    still.frames.push_back(rest_pose(skeleton));
    still.root.emplace_back();
    still.contacts.push_back({true, true});
  }
  EXPECT_TRUE(segment(skeleton, still, "short").segments.empty());
  while (still.frames.size() < 400) {
    still.frames.push_back(rest_pose(skeleton));
    still.root.emplace_back();
    still.contacts.push_back({true, true});
  }
  EXPECT_TRUE(segment(skeleton, still, "still").blows.empty());
}

TEST(Segmentation, AHandThatIsElsewhereAtOnceStrikesNobody) {
  const auto actions = compile_sheet_file(assets_folder() / "kickboxing/sheets/punches.toml");
  ASSERT_TRUE(actions) << to_string(actions.error());
  const auto jab = std::find_if(actions->begin(), actions->end(),
                                [](const Action& action) { return action.name == "jab"; });
  ASSERT_NE(jab, actions->end());
  EXPECT_EQ(segment(canonical_skeleton(), jab->clip, "jab").blows.size(), 1u);
  Clip spliced;
  for (const Tick tick : {0, jab->strikes.front().active_end})
    for (int i = 0; i < 60; ++i) {
      spliced.frames.push_back(jab->clip.at(tick));
      spliced.root.emplace_back();
      spliced.contacts.push_back({true, true});
    }
  EXPECT_TRUE(segment(canonical_skeleton(), spliced, "spliced").blows.empty());
}

// The sheets' punches and kicks are authored: their strikes are known without an eye.
TEST(Segmentation, FindsTheStrikesOfTheTechniqueSheets) {
  const Skeleton skeleton = canonical_skeleton();
  int wanted = 0, found = 0;
  std::string missed;
  for (const char* sheet : {"punches.toml", "kicks.toml"}) {
    const auto actions = compile_sheet_file(assets_folder() / "kickboxing/sheets" / sheet);
    ASSERT_TRUE(actions) << to_string(actions.error());
    for (const Action& action : *actions) {
      const Segmentation result = segment(skeleton, action.clip, action.name);
      for (const Strike& strike : action.strikes) {
        ++wanted;
        const bool hit =
            std::any_of(result.blows.begin(), result.blows.end(), [&](const FoundBlow& blow) {
              return blow.strike.joint == strike.joint &&
                     ticks(blow.strike.at) >= strike.active_begin - 12 &&
                     ticks(blow.strike.at) <= strike.active_end + 12;
            });
        found += hit ? 1 : 0;
        if (!hit) missed += action.name + " ";
      }
    }
  }
  EXPECT_GE(found, wanted * 3 / 4) << "missed of " << wanted << ": " << missed;
}

}  // namespace
}  // namespace ringcraft
