#pragma once
// The canonical skeleton: bone names of VRM 1.0, T-pose facing +Z, identity rest rotations.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/vec.h"

namespace ringcraft {

// Parents stand before their children.
enum class Joint : std::uint8_t {
  hips,
  spine,
  chest,
  upper_chest,
  neck,
  head,
  left_shoulder,
  left_upper_arm,
  left_lower_arm,
  left_hand,
  right_shoulder,
  right_upper_arm,
  right_lower_arm,
  right_hand,
  left_upper_leg,
  left_lower_leg,
  left_foot,
  left_toes,
  right_upper_leg,
  right_lower_leg,
  right_foot,
  right_toes,
};

inline constexpr std::size_t kJointCount = 22;

constexpr std::size_t index(Joint joint) {
  return static_cast<std::size_t>(joint);
}
constexpr Joint joint_at(std::size_t i) {
  return static_cast<Joint>(i);
}

enum class Side : std::uint8_t { left, right };
constexpr Side other(Side side) {
  return side == Side::left ? Side::right : Side::left;
}

// Parent of each joint; the hips have none (-1).
inline constexpr std::array<int, kJointCount> kParent = {-1, 0,  1,  2,  3, 4,  //
                                                         3,  6,  7,  8,         //
                                                         3,  10, 11, 12,        //
                                                         0,  14, 15, 16,        //
                                                         0,  18, 19, 20};

// VRM 1.0 bone name ("leftUpperArm"), and back.
std::string_view vrm_name(Joint joint);
std::optional<Joint> joint_from_vrm_name(std::string_view name);

// The same joint of the other side; itself on the midline.
Joint mirrored(Joint joint);

// A limb's joints from root to tip. Arm: upper arm, lower arm, hand. Leg: upper leg, lower leg,
// foot.
struct Limb {
  Joint root, middle, end;
};
constexpr Limb arm(Side side) {
  return side == Side::left
             ? Limb{Joint::left_upper_arm, Joint::left_lower_arm, Joint::left_hand}
             : Limb{Joint::right_upper_arm, Joint::right_lower_arm, Joint::right_hand};
}
constexpr Limb leg(Side side) {
  return side == Side::left
             ? Limb{Joint::left_upper_leg, Joint::left_lower_leg, Joint::left_foot}
             : Limb{Joint::right_upper_leg, Joint::right_lower_leg, Joint::right_foot};
}
constexpr Joint toes(Side side) {
  return side == Side::left ? Joint::left_toes : Joint::right_toes;
}

// The joint at the tip of what a joint moves: of a lower arm its hand, of a lower leg its foot,
// of any other joint itself.
constexpr Joint tip_of(Joint joint) {
  for (const Side side : {Side::left, Side::right}) {
    if (joint == arm(side).middle) return arm(side).end;
    if (joint == leg(side).middle) return leg(side).end;
  }
  return joint;
}

// Joint offsets from the parent in the rest pose, metres. The hips' offset is their rest position.
struct Skeleton {
  float height = 0;  // standing height, m
  std::array<Vec3, kJointCount> offset{};

  // Length of the bone from `joint` to its parent, m.
  float bone(Joint joint) const { return glm::length(offset[index(joint)]); }
  // Upper leg plus lower leg, m.
  float leg_length() const { return bone(Joint::left_lower_leg) + bone(Joint::left_foot); }
  // Upper arm plus lower arm, m.
  float arm_length() const { return bone(Joint::left_lower_arm) + bone(Joint::left_hand); }
  // Height of the ankle above the ground when the foot stands flat, m.
  float ankle_height() const;
  // Height of the toe joint (ball of the foot) above the ground when the foot stands flat, m.
  float toe_height() const;
};

// Adult proportions (segment lengths as fractions of height after de Leva 1996 and Winter 2009).
// Every library is stored for kCanonicalHeight; other bodies scale it uniformly.
inline constexpr float kCanonicalHeight = 1.75f;
Skeleton canonical_skeleton(float height = kCanonicalHeight);

}  // namespace ringcraft
