#include "motion/variation.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

Action standing() {
  Action action;
  action.clip.frames = {rest_pose(canonical_skeleton()), rest_pose(canonical_skeleton())};
  return action;
}

Vec3 wrist(const Pose& pose, Side side) {
  return world_pose(canonical_skeleton(), pose).position[index(arm(side).end)];
}

// Arms bent, so that the hands can go anywhere.
Pose guard() {
  Pose pose = rest_pose(canonical_skeleton());
  pose.rotation[index(Joint::left_lower_arm)] = glm::angleAxis(-radians(90), kUp);
  pose.rotation[index(Joint::right_lower_arm)] = glm::angleAxis(radians(90), kUp);
  return pose;
}

TEST(Variation, OfOneSeedIsOneAndOfAnotherIsAnother) {
  const Skeleton skeleton = canonical_skeleton();
  const Pose one = Variation(1).of(skeleton, standing(), guard(), 30, 30);
  const Pose same = Variation(1).of(skeleton, standing(), guard(), 30, 30);
  const Pose other = Variation(2).of(skeleton, standing(), guard(), 30, 30);
  EXPECT_EQ(wrist(one, Side::left), wrist(same, Side::left));
  EXPECT_GT(glm::distance(wrist(one, Side::left), wrist(other, Side::left)), 0.002f);
  EXPECT_EQ(wrist(Variation().of(skeleton, standing(), guard(), 30, 30), Side::left),
            wrist(guard(), Side::left));
}

TEST(Variation, LeavesPelvisAndFeetAndKeepsTheHandsNear) {
  const Skeleton skeleton = canonical_skeleton();
  const WorldPose clip = world_pose(skeleton, guard());
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const Pose shown = Variation(seed).of(skeleton, standing(), guard(), 50, 400);
    const WorldPose world = world_pose(skeleton, shown);
    for (const Joint joint : {Joint::hips, Joint::left_foot, Joint::right_toes}) {
      EXPECT_EQ(world.position[index(joint)], clip.position[index(joint)]);
    }
    EXPECT_LT(glm::distance(wrist(shown, Side::right), wrist(guard(), Side::right)), 0.15f);
  }
}

TEST(Variation, AHandComesBackWhileItCanHit) {
  const Skeleton skeleton = canonical_skeleton();
  Action blow = standing();
  blow.strikes = {{StrikeKind::straight, Joint::left_hand, TargetZone::head, 40, 60}};
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const Pose shown = Variation(seed).of(skeleton, blow, guard(), 50, 50);
    EXPECT_LT(glm::distance(wrist(shown, Side::left), wrist(guard(), Side::left)), 0.035f);
  }
}

}  // namespace
}  // namespace ringcraft
