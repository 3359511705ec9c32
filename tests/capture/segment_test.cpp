// Segmentation against what was seen by eye on real captures (../shared/mocap/README.md and
// calibration.md section 0), and against the technique sheets, whose strikes are known exactly.

#include "capture/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_NEAR(degrees(orthodox.guard_yaw), -55, 15);  // calibration.md section 1
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

}  // namespace
}  // namespace ringcraft
