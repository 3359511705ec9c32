#include "motion/clip.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Clip, SyntheticClipsHaveNoFaults) {
  EXPECT_THAT(faults(test::idle_clip(kSkeleton)), IsEmpty());
  EXPECT_THAT(faults(test::jab_clip(kSkeleton)), IsEmpty());
  EXPECT_THAT(faults(test::step_clip(kSkeleton, {0, 0, 0.3f})), IsEmpty());
  EXPECT_THAT(faults(test::kick_clip(kSkeleton)), IsEmpty());
}

TEST(Clip, EveryBrokenRuleIsFoundByItsNumber) {
  const Clip good = test::jab_clip(kSkeleton);
  const float nan = std::numeric_limits<float>::quiet_NaN();

  Clip clip = good;
  clip.frames.resize(1), clip.root.resize(1), clip.contacts.resize(1);
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 1")));
  clip = good;
  clip.contacts.pop_back();
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 2")));
  clip = good;
  clip.root[0].x = 0.1f;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 3")));
  clip = good;
  clip.root[7].yaw = nan;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 4: frame 7")));
  clip = good;
  clip.frames[7].hips.y = nan;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 4: frame 7")));
  clip = good;
  clip.root[7].x = 3e38f;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 4: frame 7: root farther than 1000 m")));
  clip = good;
  clip.root[7].yaw = -3e38f;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 4: frame 7: root farther than 1000 m")));
  clip = good;
  clip.frames[7].hips.y = 1e30f;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 4: frame 7: hips farther than 1000 m")));
  clip = good;
  clip.frames.back().rotation[index(Joint::head)] *= 1.1f;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 5")));
  clip = good;
  Quat& flipped = clip.frames.back().rotation[index(Joint::head)];
  flipped = -flipped;
  EXPECT_THAT(faults(clip), ElementsAre(StartsWith("rule 5")));
  unroll_rotations(clip);
  EXPECT_THAT(faults(clip), IsEmpty());
}

TEST(Clip, TicksOutsideAnswerWithTheEnds) {
  const Clip clip = test::step_clip(kSkeleton, {0, 0, 0.3f}, 40);
  EXPECT_EQ(clip.length(), 40);
  EXPECT_POSE_NEAR(kSkeleton, clip.at(-5), clip.frames.front(), 0);
  EXPECT_POSE_NEAR(kSkeleton, clip.at(1000), clip.frames.back(), 0);
  EXPECT_EQ(clip.root_at(1000), clip.root.back());
  EXPECT_EQ(clip.contacts_at(-1), clip.contacts.front());
}

TEST(Clip, MirroringMirrorsFramesRootAndContactsAndTwiceIsNothing) {
  const Clip clip = test::step_clip(kSkeleton, {0.2f, 0, 0.3f});
  const Clip other = mirrored(clip), again = mirrored(other);
  EXPECT_THAT(faults(other), IsEmpty());
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    EXPECT_POSE_NEAR(kSkeleton, other.frames[i], mirrored(clip.frames[i]), 0);
    EXPECT_POSE_NEAR(kSkeleton, again.frames[i], clip.frames[i], 0);
    EXPECT_EQ(again.root[i], clip.root[i]);
    EXPECT_EQ(other.root[i].x, -clip.root[i].x);
    EXPECT_EQ(other.contacts[i].left, clip.contacts[i].right);
    EXPECT_EQ(other.contacts[i].right, clip.contacts[i].left);
  }
}

TEST(Clip, APieceCutOutPlaysTheSameMotionWhereItsRootStood) {
  Clip clip = test::step_clip(kSkeleton, {0.2f, 0, 0.3f});
  for (std::size_t i = 0; i < clip.root.size(); ++i)
    clip.root[i].yaw = 0.01f * static_cast<float>(i);
  const Clip piece = cut(clip, 20, 50);
  ASSERT_EQ(piece.length(), 30);
  EXPECT_THAT(faults(piece), IsEmpty());
  EXPECT_EQ(piece.root[0], Placement());
  for (Tick tick = 0; tick <= 30; ++tick) {
    EXPECT_POSE_NEAR(kSkeleton, placed(piece.at(tick), clip.root_at(20)), clip.at(20 + tick),
                     1e-3f);
    const Placement root = clip.root_at(20) * piece.root_at(tick);
    EXPECT_NEAR(root.x, clip.root_at(20 + tick).x, 1e-5f);
    EXPECT_NEAR(root.z, clip.root_at(20 + tick).z, 1e-5f);
    EXPECT_NEAR(root.yaw, clip.root_at(20 + tick).yaw, 1e-5f);
    EXPECT_EQ(piece.contacts_at(tick), clip.contacts_at(20 + tick));
  }
}

TEST(Clip, CuttingBeyondTheEndsStopsAtThem) {
  const Clip clip = test::jab_clip(kSkeleton, 40);
  EXPECT_EQ(cut(clip, -10, 100).length(), 40);
  EXPECT_EQ(cut(clip, 30, 20).length(), 0);
}

}  // namespace
}  // namespace ringcraft
