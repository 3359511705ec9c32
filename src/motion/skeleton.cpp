#include "motion/skeleton.h"

namespace ringcraft {

namespace {

constexpr std::array<std::string_view, kJointCount> kVrmNames = {
    "hips",          "spine",         "chest",         "upperChest",    "neck",
    "head",          "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",
    "rightShoulder", "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",
    "leftLowerLeg",  "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg",
    "rightFoot",     "rightToes"};

}  // namespace

std::string_view vrm_name(Joint joint) {
  return kVrmNames[index(joint)];
}

std::optional<Joint> joint_from_vrm_name(std::string_view name) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (kVrmNames[i] == name) return joint_at(i);
  }
  return std::nullopt;
}

Joint mirrored(Joint joint) {
  const std::size_t i = index(joint);
  if (i < index(Joint::left_shoulder)) return joint;
  const bool arm = i < index(Joint::left_upper_leg);
  const std::size_t first_left = index(arm ? Joint::left_shoulder : Joint::left_upper_leg);
  const std::size_t place = i - first_left;
  return joint_at(first_left + (place < 4 ? place + 4 : place - 4));
}

float Skeleton::ankle_height() const {
  return offset[index(Joint::hips)].y + offset[index(Joint::left_upper_leg)].y +
         offset[index(Joint::left_lower_leg)].y + offset[index(Joint::left_foot)].y;
}

float Skeleton::toe_height() const {
  return ankle_height() + offset[index(Joint::left_toes)].y;
}

Skeleton canonical_skeleton(float height) {
  // Fractions of height. Legs: de Leva 1996 (thigh 0.2425, shank 0.2493, ankle 0.039), which puts
  // the mid-hips at 0.531. Arms: 0.1618 and 0.1545. The neck base stands at 0.82, the skull's base
  // at 0.87.
  Skeleton skeleton;
  skeleton.height = height;
  const auto set = [&](Joint joint, Vec3 fraction) {
    skeleton.offset[index(joint)] = fraction * height;
  };
  set(Joint::hips, {0, 0.5308f, 0});
  set(Joint::spine, {0, 0.060f, 0});
  set(Joint::chest, {0, 0.070f, 0});
  set(Joint::upper_chest, {0, 0.075f, 0});
  set(Joint::neck, {0, 0.084f, 0});
  set(Joint::head, {0, 0.050f, 0.004f});
  for (const Side side : {Side::left, Side::right}) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    const Limb arm_joints = arm(side);
    set(side == Side::left ? Joint::left_shoulder : Joint::right_shoulder,
        {out * 0.018f, 0.066f, 0});
    set(arm_joints.root, {out * 0.092f, 0.010f, 0});
    set(arm_joints.middle, {out * 0.1618f, 0, 0});
    set(arm_joints.end, {out * 0.1545f, 0, 0});
    const Limb leg_joints = leg(side);
    set(leg_joints.root, {out * 0.053f, 0, 0});
    set(leg_joints.middle, {0, -0.2425f, 0});
    set(leg_joints.end, {0, -0.2493f, 0});
    set(toes(side), {0, -0.027f, 0.078f});
  }
  return skeleton;
}

}  // namespace ringcraft
