#include "motion/ik.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/pose_near.h"

namespace ringcraft {
namespace {

const std::array<Limb, 4> kLimbs = {arm(Side::left), arm(Side::right), leg(Side::left),
                                    leg(Side::right)};

struct Solved {
  Vec3 root{}, middle{}, end{};
};

Solved solved(const Skeleton& skeleton, const Limb& limb, const LimbTarget& target, Pose& pose) {
  solve_limb(skeleton, limb, target, pose);
  const WorldPose world = world_pose(skeleton, pose);
  return {world.position[index(limb.root)], world.position[index(limb.middle)],
          world.position[index(limb.end)]};
}

float length_of(const Skeleton& skeleton, const Limb& limb) {
  return skeleton.bone(limb.middle) + skeleton.bone(limb.end);
}

// Flexion of the middle joint, rad.
float flexion(const Skeleton& skeleton, const Limb& limb, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 upper = world.position[index(limb.middle)] - world.position[index(limb.root)];
  const Vec3 lower = world.position[index(limb.end)] - world.position[index(limb.middle)];
  return std::acos(std::clamp(glm::dot(glm::normalize(upper), glm::normalize(lower)), -1.0f, 1.0f));
}

TEST(Ik, ReachesEveryTargetWithinReachWhateverTheBodyDoes) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(11);
  for (int n = 0; n < 400; ++n) {
    const Limb limb = kLimbs[static_cast<std::size_t>(n % 4)];
    Pose pose = rest_pose(skeleton);
    for (Quat& q : pose.rotation) {
      q = from_rotation_vector(0.5f * Vec3(random.normal(), random.normal(), random.normal()));
    }
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    const Vec3 way =
        glm::normalize(Vec3(random.normal(), random.normal(), random.normal()) + Vec3(1e-3f));
    LimbTarget target;
    target.position = root + way * (length_of(skeleton, limb) * random.uniform(0.3f, 0.98f));
    target.pole = {random.normal(), random.normal(), random.normal()};
    const Solved at = solved(skeleton, limb, target, pose);
    EXPECT_POINT_NEAR(at.end, target.position, 0.01f) << "case " << n;
    // The middle joint lies on the pole's side of the line.
    const Vec3 side = target.pole - way * glm::dot(target.pole, way);
    EXPECT_GE(glm::dot(glm::normalize(at.middle - at.root), glm::normalize(side)), -1e-4f);
  }
}

TEST(Ik, TheEndJointKeepsItsWorldRotationAndOthersStay) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    Pose pose = rest_pose(skeleton);
    pose.rotation[0] = yaw_rotation(0.7f);
    pose.rotation[index(limb.end)] = glm::angleAxis(0.4f, glm::normalize(Vec3(1, 2, 3)));
    const WorldPose before = world_pose(skeleton, pose);
    LimbTarget target;
    target.position = before.position[index(limb.root)] + Vec3(0.1f, -0.2f, 0.2f);
    target.pole = {0, -0.3f, 1};
    solve_limb(skeleton, limb, target, pose);
    const WorldPose after = world_pose(skeleton, pose);
    const Quat change =
        after.rotation[index(limb.end)] * glm::inverse(before.rotation[index(limb.end)]);
    EXPECT_NEAR(glm::length(rotation_vector(change)), 0, 1e-3f);
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const Joint joint = joint_at(i);
      if (joint == limb.root || joint == limb.middle || joint == limb.end) continue;
      EXPECT_EQ(pose.rotation[i], (i == 0 ? yaw_rotation(0.7f) : Quat()));
    }
  }
}

TEST(Ik, KneesBendBackwardsAndElbowsForwardsAboutTheHingeOnly) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(12);
  for (int n = 0; n < 200; ++n) {
    const Limb limb = kLimbs[static_cast<std::size_t>(n % 4)];
    Pose pose = rest_pose(skeleton);
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    const Vec3 way = glm::normalize(Vec3(random.normal(), random.normal(), random.normal()));
    LimbTarget target;
    target.position = root + way * (length_of(skeleton, limb) * random.uniform(0.4f, 0.95f));
    target.pole = {random.normal(), random.normal(), random.normal()};
    solve_limb(skeleton, limb, target, pose);
    const Vec3 turn = rotation_vector(pose.rotation[index(limb.middle)]);
    EXPECT_NEAR(glm::length(glm::cross(turn, hinge_axis(limb))), 0, 1e-4f);
    EXPECT_GT(glm::dot(turn, hinge_axis(limb)), 0.1f);
  }
}

TEST(Ik, ACrouchPutsTheKneesForward) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Side side : {Side::left, Side::right}) {
    Pose pose = rest_pose(skeleton);
    const Vec3 ankle = world_pose(skeleton, pose).position[index(leg(side).end)];
    pose.hips.y -= 0.25f;
    const Solved at = solved(skeleton, leg(side), {ankle, kForward}, pose);
    EXPECT_POINT_NEAR(at.end, ankle, 0.01f);
    EXPECT_GT(at.middle.z, at.root.z + 0.2f);
    EXPECT_NEAR(at.middle.x, at.root.x, 1e-4f);
    // The knee's own rotation says the same as its position.
    EXPECT_GT(flexion(skeleton, leg(side), pose), 0.8f);
    EXPECT_GT(rotation_vector(pose.rotation[index(leg(side).middle)]).x, 0.8f);
  }
}

TEST(Ik, AGuardPutsTheElbowsDown) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Side side : {Side::left, Side::right}) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    Pose pose = rest_pose(skeleton);
    const Vec3 hand{out * 0.1f, 1.45f, 0.3f};
    const Solved at = solved(skeleton, arm(side), {hand, {out * 0.3f, -1, 0}}, pose);
    EXPECT_POINT_NEAR(at.end, hand, 0.01f);
    EXPECT_LT(at.middle.y, at.root.y - 0.1f);
    EXPECT_LT(at.middle.y, at.end.y);
  }
}

TEST(Ik, ATargetBehindReachIsApproachedAlongTheLine) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    Pose pose = rest_pose(skeleton);
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    const Vec3 way = glm::normalize(Vec3(0.3f, -0.5f, 1));
    const Solved at = solved(skeleton, limb, {root + way * 3.0f, {0.2f, -1, 0.2f}}, pose);
    EXPECT_NEAR(glm::dot(glm::normalize(at.end - at.root), way), 1, 1e-5f);
    EXPECT_GT(glm::distance(at.end, at.root), 0.99f * length_of(skeleton, limb));
    EXPECT_LE(glm::distance(at.end, at.root), length_of(skeleton, limb) + 1e-5f);
  }
}

TEST(Ik, NoJointPopsWhenATargetSweepsPastFullReach) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    const float length = length_of(skeleton, limb);
    const Vec3 root = world_pose(skeleton, rest_pose(skeleton)).position[index(limb.root)];
    const Vec3 way = glm::normalize(Vec3(0.1f, -0.4f, 1));
    float last = -1, fastest = 0;
    const float step = 0.0005f;  // m of target a sample
    for (float d = 0.7f * length; d < 1.4f * length; d += step) {
      Pose pose = rest_pose(skeleton);
      solve_limb(skeleton, limb, {root + way * d, {0.2f, -1, 0.2f}}, pose);
      const float now = flexion(skeleton, limb, pose);
      if (last >= 0) fastest = std::max(fastest, std::abs(now - last) / step);
      last = now;
    }
    // Without softening the rate grows without limit as the limb straightens; eased, it peaks where
    // easing begins: d(flexion)/d(reach) = 2 / sqrt(L^2 - d^2) for equal bones, 11.6 / L at 0.985.
    EXPECT_LT(fastest, 1.1f * 11.6f / length);
  }
}

TEST(Ik, ATargetInTheRootFoldsTheLimbNoFartherThanFleshAllows) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    Pose pose = rest_pose(skeleton);
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    solve_limb(skeleton, limb, {root, {0, 0, 1}}, pose);
    EXPECT_NEAR(flexion(skeleton, limb, pose), radians(155), 0.01f);
    for (const Quat& q : pose.rotation) EXPECT_NEAR(glm::length(q), 1, 1e-4f);
  }
}

TEST(Ik, MovingALimbsEndReachesTheTargetAndLeavesALimbThatIsThereAlone) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(14);
  for (int n = 0; n < 400; ++n) {
    const Limb limb = kLimbs[static_cast<std::size_t>(n % 4)];
    Pose pose = rest_pose(skeleton);
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    const Vec3 way = glm::normalize(Vec3(random.normal(), random.normal(), random.normal()));
    const float length = length_of(skeleton, limb);
    solve_limb(skeleton, limb,
               {root + way * (length * random.uniform(0.4f, 0.97f)),
                {random.normal(), random.normal(), random.normal()}},
               pose);
    // A captured joint is no perfect hinge.
    const Vec3 off_axis = 0.05f * Vec3(random.normal(), random.normal(), random.normal());
    pose.rotation[index(limb.middle)] =
        from_rotation_vector(off_axis) * pose.rotation[index(limb.middle)];
    const WorldPose world = world_pose(skeleton, pose);
    Pose same = pose;
    move_limb_end(skeleton, limb, world.position[index(limb.end)], 0.9995f, same);
    EXPECT_POSE_NEAR(skeleton, same, pose, 0.02f) << "case " << n;

    Vec3 target = world.position[index(limb.end)];
    target += 0.2f * length * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    if (glm::distance(target, root) > 0.97f * length) continue;
    if (glm::distance(target, root) < 0.3f * length) continue;
    move_limb_end(skeleton, limb, target, 0.98f, pose);
    const WorldPose moved = world_pose(skeleton, pose);
    EXPECT_POINT_NEAR(moved.position[index(limb.end)], target, 0.05f) << "case " << n;
    const Quat turned =
        moved.rotation[index(limb.end)] * glm::inverse(world.rotation[index(limb.end)]);
    EXPECT_NEAR(glm::length(rotation_vector(turned)), 0, 2e-3f);
  }
}

TEST(Ik, MovingALimbsEndSetsAJointRightThatBendsBackwards) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    Pose pose = rest_pose(skeleton);
    pose.rotation[index(limb.middle)] = glm::angleAxis(-0.3f, hinge_axis(limb));
    const Vec3 end = world_pose(skeleton, pose).position[index(limb.end)];
    move_limb_end(skeleton, limb, end, 0.9995f, pose);
    EXPECT_GT(glm::dot(rotation_vector(pose.rotation[index(limb.middle)]), hinge_axis(limb)), 0.2f);
    EXPECT_POINT_NEAR(world_pose(skeleton, pose).position[index(limb.end)], end, 0.02f);
  }
}

TEST(Ik, ThePresentPoleReproducesTheLimb) {
  const Skeleton skeleton = canonical_skeleton();
  for (const Limb& limb : kLimbs) {
    Pose pose = rest_pose(skeleton);
    const Vec3 root = world_pose(skeleton, pose).position[index(limb.root)];
    solve_limb(skeleton, limb, {root + Vec3(0.1f, -0.3f, 0.2f), {0.4f, 0.1f, 1}}, pose);
    const WorldPose world = world_pose(skeleton, pose);
    Pose again = pose;
    solve_limb(skeleton, limb,
               {world.position[index(limb.end)], present_pole(world, limb, kForward)}, again);
    EXPECT_POSE_NEAR(skeleton, again, pose, 0.01f);
  }
}

TEST(Ik, AStraightLimbHasThePoleOfTheFallback) {
  const Skeleton skeleton = canonical_skeleton();
  const WorldPose world = world_pose(skeleton, rest_pose(skeleton));
  EXPECT_POINT_NEAR(present_pole(world, leg(Side::left), kForward), kForward, 0.01f);
}

TEST(Ik, SettingAWorldRotationGivesThatWorldRotation) {
  const Skeleton skeleton = canonical_skeleton();
  Random random(13);
  Pose pose = rest_pose(skeleton);
  for (Quat& q : pose.rotation) {
    q = from_rotation_vector(Vec3(random.normal(), random.normal(), random.normal()));
  }
  for (const Joint joint : {Joint::hips, Joint::head, Joint::left_foot, Joint::right_hand}) {
    const Quat wanted = glm::normalize(Quat(0.3f, 0.5f, -0.2f, 0.7f));
    set_world_rotation(skeleton, joint, wanted, pose);
    const Quat now = world_pose(skeleton, pose).rotation[index(joint)];
    EXPECT_NEAR(glm::length(rotation_vector(now * glm::inverse(wanted))), 0, 1e-3f);
  }
}

}  // namespace
}  // namespace ringcraft
