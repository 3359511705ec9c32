#include "motion/variation.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "motion/ik.h"

namespace ringcraft {

namespace {

constexpr float kHands = 0.013f;  // of height, standard deviation of what stays
constexpr float kYaw = radians(3.5f), kLean = radians(1.2f);
constexpr float kLook = radians(3), kNod = radians(2);
constexpr float kStriking = 0.25f;        // share of the offset left while a limb can hit
constexpr float kComesBack = 0.12f;       // s before and after, over which it fades
constexpr float kBreath = radians(0.7f);  // of the upper chest
constexpr float kShoulderBreath = radians(1.3f);
constexpr float kVariedReach = 0.985f;

// 1 far from every moment at which the hand can hit, less near them.
float freedom(const Action& action, Joint hand, Tick age) {
  float least = 1;
  for (const Strike& strike : action.strikes) {
    const bool elbow =
        strike.joint == Joint::left_lower_arm || strike.joint == Joint::right_lower_arm;
    const bool left = strike.joint == Joint::left_hand || strike.joint == Joint::left_lower_arm;
    const bool arm_strikes =
        elbow || strike.joint == Joint::left_hand || strike.joint == Joint::right_hand;
    if (!arm_strikes || left != (hand == Joint::left_hand)) continue;
    const Tick before = strike.active_begin - age, after = age - strike.active_end;
    const auto away = static_cast<float>(seconds(std::max({before, after, Tick{0}})));
    least = std::min(least,
                     kStriking + (1 - kStriking) * glm::smoothstep(0.0f, 1.0f, away / kComesBack));
  }
  return least;
}

// Turns a joint by a rotation given in the world.
void turn(const WorldPose& world, Joint joint, Quat rotation, Pose& pose) {
  const Quat parent = world.rotation[static_cast<std::size_t>(kParent[index(joint)])];
  Quat& local = pose.rotation[index(joint)];
  const Quat turned = glm::normalize(glm::inverse(parent) * rotation * parent * local);
  local = in_hemisphere_of(turned, local);
}

}  // namespace

float Variation::Drift::at(float seconds) const {
  return fixed + wave * std::sin(2 * kPi * hz * seconds + phase);
}

Variation::Variation(std::uint64_t seed) {
  Random random(derived_seed(seed, "variation"));
  const auto drift = [&](float size) {
    const float fixed = size * std::clamp(random.normal(), -2.0f, 2.0f);
    const float wave = size * random.uniform(0.4f, 0.9f);
    const float hz = random.uniform(0.5f, 1.3f);
    return Drift{fixed, wave, hz, random.uniform(0, 2 * kPi)};
  };
  for (Drift& hand : hands_) hand = drift(kHands);
  yaw_ = drift(kYaw);
  forward_ = drift(kLean);
  sideways_ = drift(kLean);
  look_ = drift(kLook);
  nod_ = drift(kNod);
  breath_hz_ = 0.55f;
  breath_phase_ = 0;
}

Pose Variation::of(const Skeleton& skeleton, const Action& action, Pose pose, Tick age,
                   Tick tick) const {
  const bool lies = action.starts_lying != Lying::none || action.ends_lying != Lying::none;
  if (breath_hz_ <= 0 || lies) return pose;
  const auto since = static_cast<float>(seconds(age));
  const float breath = std::sin(2 * kPi * breath_hz_ * static_cast<float>(seconds(tick)));
  const WorldPose clip = world_pose(skeleton, pose);
  const Quat heading = yaw_rotation(heading_of(clip.rotation[0]));
  const auto about = [&](Vec3 axis, float angle) { return glm::angleAxis(angle, heading * axis); };

  // A strike's own arm is led back to the clip below; its trunk turns less too.
  const float share =
      std::min(freedom(action, Joint::left_hand, age), freedom(action, Joint::right_hand, age));
  turn(clip, Joint::spine,
       about(kUp, yaw_.at(since) * share) * about(kLeft, forward_.at(since) * share) *
           about(kForward, sideways_.at(since) * share),
       pose);
  turn(clip, Joint::neck, about(kUp, (look_.at(since) - yaw_.at(since)) * share), pose);
  turn(clip, Joint::head, about(kLeft, nod_.at(since) * share), pose);
  turn(clip, Joint::upper_chest, about(kLeft, -kBreath * breath), pose);
  turn(clip, Joint::left_shoulder, about(kForward, kShoulderBreath * breath), pose);
  turn(clip, Joint::right_shoulder, about(kForward, -kShoulderBreath * breath), pose);
  for (const Side side : {Side::left, Side::right}) {
    const Limb limb = arm(side);
    const std::size_t first = side == Side::left ? 0 : 3;
    const Vec3 off(hands_[first].at(since), hands_[first + 1].at(since),
                   hands_[first + 2].at(since));
    const float own = freedom(action, limb.end, age);
    const Vec3 wrist = clip.position[index(limb.end)] + heading * off * (own * skeleton.height);
    move_limb_end(skeleton, limb, wrist, kVariedReach, pose);
  }
  return pose;
}

}  // namespace ringcraft
