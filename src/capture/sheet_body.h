#pragma once
// From the targets of one moment (pelvis, chest, hands, feet) to a pose of the whole body.

#include "motion/ik.h"
#include "motion/pose.h"

namespace ringcraft {

struct ArmTarget {
  Vec3 wrist{};    // m
  Vec3 pole{};     // direction of the elbow off the line shoulder-wrist
  float palm = 0;  // rad: fist about the forearm, palm down is positive
  float lag = 0;   // rad: fist behind the forearm about the elbow's axis, as it bends
};

struct FootTarget {
  Vec3 ball{};        // m: toe joint; its height counts
  float yaw = 0;      // rad
  float heel = 0;     // rad of heel lift
  float freedom = 0;  // 0 the foot is set by ball, yaw and heel; 1 by ankle and point
  Vec3 ankle{};       // m
  float point = 0;    // rad: toes away from the shin
  Vec3 knee_pole{};   // direction of the knee; zero: between foot and pelvis
};

struct BodyTargets {
  Vec3 pelvis{};  // m
  Quat pelvis_rotation, chest_rotation, head_rotation;
  std::array<ArmTarget, 2> arms;  // left, right
  std::array<FootTarget, 2> feet;
};

// Hips, spine, neck and head only: what the hands hang from.
Pose torso_pose(const Skeleton& skeleton, const BodyTargets& targets);

// The whole body.
Pose body_pose(const Skeleton& skeleton, const BodyTargets& targets);

// Where the ankle is for these targets, m.
Vec3 ankle_of(const Skeleton& skeleton, const FootTarget& foot);

// How far the pelvis must sink so that both set feet are in reach of legs straightened to `share`
// of their length, m; 0 where they are.
float missing_reach(const Skeleton& skeleton, const BodyTargets& targets, float share);

// A rotation leaning by (forward, left) rad after a turn by yaw.
Quat leaning(float forward, float left, float yaw);

}  // namespace ringcraft
