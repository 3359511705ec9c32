#include "motion/pose.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

Quat random_rotation(Random& random) {
  return glm::normalize(Quat(random.normal(), random.normal(), random.normal(), random.normal()));
}

Pose random_pose(Random& random) {
  Pose pose;
  pose.hips = {random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1)};
  for (Quat& q : pose.rotation) q = random_rotation(random);
  return pose;
}

TEST(Pose, TheRestPoseIsATPoseOnTheGroundThatFacesForward) {
  const Skeleton skeleton = canonical_skeleton();
  const WorldPose world = world_pose(skeleton, rest_pose(skeleton));
  EXPECT_NEAR(world.position[index(Joint::left_toes)].y, skeleton.toe_height(), 1e-5f);
  EXPECT_NEAR(world.position[index(Joint::left_foot)].y, skeleton.ankle_height(), 1e-5f);
  EXPECT_GT(world.position[index(Joint::left_toes)].z, world.position[index(Joint::left_foot)].z);
  EXPECT_GT(world.position[index(Joint::left_hand)].x, 0.5f);
  EXPECT_NEAR(world.position[index(Joint::left_hand)].y,
              world.position[index(Joint::left_upper_arm)].y, 1e-5f);
}

TEST(Pose, BonesKeepTheirLengthsInEveryPose) {
  const Skeleton skeleton = canonical_skeleton(1.9f);
  Random random(3);
  for (int n = 0; n < 50; ++n) {
    const WorldPose world = world_pose(skeleton, random_pose(random));
    for (std::size_t i = 1; i < kJointCount; ++i) {
      EXPECT_NEAR(
          glm::distance(world.position[i], world.position[static_cast<std::size_t>(kParent[i])]),
          skeleton.bone(joint_at(i)), 1e-5f);
    }
  }
}

TEST(Pose, MirroringReflectsEveryJointInTheWorldAndTwiceIsNothing) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(4);
  for (int n = 0; n < 50; ++n) {
    const Pose pose = random_pose(random);
    const WorldPose world = world_pose(skeleton, pose);
    const WorldPose other = world_pose(skeleton, mirrored(pose));
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const Vec3 p = world.position[i];
      EXPECT_POINT_NEAR(other.position[index(mirrored(joint_at(i)))], Vec3(-p.x, p.y, p.z), 1e-3f);
    }
    EXPECT_POSE_NEAR(skeleton, mirrored(mirrored(pose)), pose, 0);
  }
}

TEST(Pose, PlacingMovesEveryJointByThePlacement) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(5);
  for (int n = 0; n < 50; ++n) {
    const Pose pose = random_pose(random);
    const Placement placement{random.uniform(-3, 3), random.uniform(-3, 3),
                              random.uniform(-kPi, kPi)};
    const WorldPose world = world_pose(skeleton, pose);
    const WorldPose moved = world_pose(skeleton, placed(pose, placement));
    for (std::size_t i = 0; i < kJointCount; ++i) {
      EXPECT_POINT_NEAR(moved.position[i], placement * world.position[i], 1e-3f);
    }
  }
}

TEST(Pose, AScaledPoseOnAScaledBodyScalesEveryJoint) {
  const float factor = 1.1f;
  const Skeleton skeleton = canonical_skeleton(), tall = canonical_skeleton(1.75f * factor);
  const Pose pose = test::posed(skeleton, {});
  const WorldPose world = world_pose(skeleton, pose);
  const WorldPose scaled_world = world_pose(tall, scaled(pose, factor));
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_POINT_NEAR(scaled_world.position[i], factor * world.position[i], 1e-3f);
  }
}

TEST(Pose, MixingStartsAtTheFirstEndsAtTheSecondAndForgetsTheHemisphere) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(6);
  const Pose a = random_pose(random), b = random_pose(random);
  EXPECT_POSE_NEAR(skeleton, mix(a, b, 0), a, 1e-3f);
  EXPECT_POSE_NEAR(skeleton, mix(a, b, 1), b, 1e-3f);
  Pose turned = b;
  for (Quat& q : turned.rotation) q = -q;
  EXPECT_POSE_NEAR(skeleton, mix(a, turned, 0.3f), mix(a, b, 0.3f), 1e-3f);
}

TEST(Pose, TheLargestJointDistanceIsThatOfTheWorstJoint) {
  const Skeleton skeleton = canonical_skeleton();
  Pose pose = rest_pose(skeleton);
  const WorldPose before = world_pose(skeleton, pose);
  EXPECT_EQ(largest_joint_distance(before, before), 0);
  pose.rotation[index(Joint::left_lower_arm)] = glm::angleAxis(kPi / 2, kUp);
  EXPECT_NEAR(largest_joint_distance(before, world_pose(skeleton, pose)),
              std::sqrt(2.0f) * skeleton.bone(Joint::left_hand), 1e-4f);
}

}  // namespace
}  // namespace ringcraft
