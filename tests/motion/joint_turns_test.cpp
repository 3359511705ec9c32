#include "motion/joint_turns.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/ik.h"
#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

TEST(JointTurns, ReachAndFlexionTellTheSame) {
  for (const Limb& limb : {leg(Side::left), arm(Side::right)}) {
    const float length = kSkeleton.bone(limb.middle) + kSkeleton.bone(limb.end);
    EXPECT_NEAR(reach_of(kSkeleton, limb, 0), length, 1e-5f);
    for (float bent = .1f; bent < 2.6f; bent += .1f) {
      EXPECT_NEAR(flexion_for(kSkeleton, limb, reach_of(kSkeleton, limb, bent)), bent, 1e-3f);
    }
    EXPECT_EQ(flexion_for(kSkeleton, limb, 2 * length), 0);
  }
}

TEST(JointTurns, ARootIsSetAsItWasTold) {
  Random random(5);
  for (int n = 0; n < 50; ++n) {
    for (const Side side : {Side::left, Side::right}) {
      for (const Limb& limb : {arm(side), leg(side)}) {
        Pose pose = rest_pose(kSkeleton);
        pose.rotation[index(limb.root)] = from_rotation_vector(
            {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
        pose.rotation[index(limb.middle)] = glm::angleAxis(random.uniform(0, 2), hinge_axis(limb));
        Pose again = pose;
        again.rotation[index(limb.root)] = Quat();
        set_root_turns(kSkeleton, side, limb, root_turns(kSkeleton, side, limb, pose), again);
        EXPECT_POSE_NEAR(kSkeleton, again, pose, 1e-4f);
      }
    }
  }
}

// The last millimetres in which a leg that stands gets straight: the thigh turns by far more than
// the line from hip to ankle.
TEST(JointTurns, OfALegAreThoseOfItsLine) {
  const Limb limb = leg(Side::left);
  const auto standing = [&](float flexion) {
    Pose pose = rest_pose(kSkeleton);
    const Vec3 ankle = world_pose(kSkeleton, pose).position[index(limb.end)];
    pose.hips.y -= kSkeleton.leg_length() - reach_of(kSkeleton, limb, flexion);
    move_limb_end(kSkeleton, limb, ankle, 1, pose);
    return pose;
  };
  const Pose bent = standing(radians(30)), straight = standing(radians(4));
  const float line = glm::distance(root_turns(kSkeleton, Side::left, limb, bent),
                                   root_turns(kSkeleton, Side::left, limb, straight));
  const Quat thigh =
      bent.rotation[index(limb.root)] * glm::conjugate(straight.rotation[index(limb.root)]);
  EXPECT_GT(degrees(glm::length(rotation_vector(thigh))), 10);
  EXPECT_LT(degrees(line), 1);
}

}  // namespace
}  // namespace ringcraft
