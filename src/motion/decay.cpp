#include "motion/decay.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"
#include "motion/joint_turns.h"

namespace ringcraft {
namespace {

// The rotation vector of q that lies nearest to `reference`: a turn of a little more than half a
// circle does not become one the other way.
Vec3 rotation_vector_near(Quat q, Vec3 reference) {
  const Vec3 v = rotation_vector(q);
  const float angle = glm::length(v);
  if (angle < 1e-4f) return v;
  const Vec3 around = v * (1 - 2 * kPi / angle);
  return glm::distance2(around, reference) < glm::distance2(v, reference) ? around : v;
}

// A rotation as yaw * lean.
struct YawAndLean {
  float yaw = 0;
  Vec3 lean{};
  explicit YawAndLean(Quat q) {
    if (std::abs(q.w) + std::abs(q.y) > 1e-4f) yaw = wrapped_angle(2 * std::atan2(q.y, q.w));
    lean = rotation_vector(glm::normalize(yaw_rotation(-yaw) * q));
  }
};

}  // namespace

Decay::Decay(Vec3 value, Vec3 velocity, float seconds) : Decay(value, velocity, seconds, seconds) {}

Decay::Decay(Vec3 value, Vec3 velocity, float seconds, float velocity_seconds)
    : start_(value),
      velocity_(velocity),
      seconds_(seconds),
      velocity_seconds_(std::min(velocity_seconds, seconds)) {}

Vec3 Decay::value() const {
  // x(s) = x0 (1 - 10 s^3 + 15 s^4 - 6 s^5),  s = t / T, and
  // v0 Tv (u - 6 u^3 + 8 u^4 - 3 u^5),  u = t / Tv
  if (done()) return {};
  const float s = age_ / seconds_, s3 = s * s * s;
  const float u = std::min(1.0f, age_ / velocity_seconds_), u3 = u * u * u;
  return start_ * (1 - s3 * (10 - s * (15 - 6 * s))) +
         velocity_ * velocity_seconds_ * (u - u3 * (6 - u * (8 - 3 * u)));
}

float lever_of(const Skeleton& skeleton, Joint joint) {
  switch (joint) {
    case Joint::left_upper_arm:
    case Joint::right_upper_arm:
      return .32f * skeleton.height;
    case Joint::left_lower_arm:
    case Joint::right_lower_arm:
      return .17f * skeleton.height;
    case Joint::left_hand:
    case Joint::right_hand:
    case Joint::left_toes:
    case Joint::right_toes:
      return .06f * skeleton.height;
    case Joint::neck:
    case Joint::head:
      return .14f * skeleton.height;
    case Joint::left_lower_leg:
    case Joint::right_lower_leg:
      return .28f * skeleton.height;
    case Joint::left_foot:
    case Joint::right_foot:
      return .11f * skeleton.height;
    case Joint::left_upper_leg:
    case Joint::right_upper_leg:
      return .5f * skeleton.height;
    default:  // the trunk carries all of it
      return .4f * skeleton.height;
  }
}

float stopping_seconds(Vec3 velocity) {
  constexpr float kLeast = .10f;
  // A quintic takes 3.9 v / T.
  return std::max(kLeast, 3.9f * glm::length(velocity) / 20);
}

// The velocity is that of the rotation vector itself, not the difference of angular velocities:
// these differ where the offset is large.
Decay rotation_decay(Quat before, Quat shown, Quat now, Quat after, float seconds, float lever,
                     Vec3 with) {
  const Quat spin = shown * glm::inverse(before);
  const Quat carried = glm::normalize(spin * shown);
  const Quat carried_on = glm::normalize(spin * carried);
  const Vec3 value = rotation_vector_near(carried * glm::inverse(now), with);
  const Vec3 next = rotation_vector_near(carried_on * glm::inverse(after), value);
  const Vec3 velocity = (next - value) / kTickSeconds;
  return {value, velocity, seconds, lever > 0 ? stopping_seconds(velocity * lever) : seconds};
}

Quat BodyTurn::of(Quat clip) const {
  if (yaw.done() && lean.done()) return clip;
  const YawAndLean own(clip);
  return yaw_rotation(own.yaw + yaw.value().y) * from_rotation_vector(own.lean + lean.value());
}

void BodyTurn::step(float dt) {
  yaw.step(dt);
  lean.step(dt);
}

BodyTurn body_turn(Quat before, Quat shown, Quat now, Quat after, float seconds,
                   std::optional<float> longest) {
  constexpr float kCarries = .15f;  // s: a spin goes on so far at least
  constexpr float kReach = .71f;    // m: what turns with the hips reaches so far
  const Quat carried = glm::normalize(shown * glm::inverse(before) * shown);
  const YawAndLean was(shown), is(carried), clip(now), next(after);
  const float yaw_velocity =
      (wrapped_angle(is.yaw - was.yaw) - wrapped_angle(next.yaw - clip.yaw)) / kTickSeconds;
  const Vec3 lean_velocity = (is.lean - was.lean - (next.lean - clip.lean)) / kTickSeconds;
  const float on = yaw_velocity * kCarries;
  const auto stops = [&](Vec3 velocity) {
    return longest ? stopping_seconds(velocity * kReach) : seconds;
  };
  const float off = wrapped_angle(is.yaw - clip.yaw + on) - on;
  // A quintic over T s goes by d with at most 1.875 d / T.
  const float turns =
      std::max(seconds, std::min(longest.value_or(0), 1.875f * std::abs(off) / kFastestTurn));
  return {{kUp * off, kUp * yaw_velocity, turns, stops(kUp * yaw_velocity)},
          {is.lean - clip.lean, lean_velocity, seconds, stops(lean_velocity)}};
}

Decay root_decay(const Skeleton& skeleton, Side side, const Limb& limb, const Pose& before,
                 const Pose& shown, const Pose& now, const Pose& after, float seconds,
                 float lever) {
  const BallJoint joint = ball_joint(limb);
  const auto turns = [&](const Pose& pose) { return root_turns(skeleton, side, limb, pose); };
  constexpr float kFastest = 20 * kTickSeconds;  // rad a tick: no joint turns faster
  const auto moved = [&](const Pose& a, const Pose& b) {
    const Vec3 change = turns(b) - turns(a);
    const float turn = glm::dot(change, joint.along);  // about the limb, it may pass half a turn
    return glm::clamp(change + joint.along * (wrapped_angle(turn) - turn), Vec3(-kFastest),
                      Vec3(kFastest));
  };
  const Vec3 going = moved(before, shown), clip_going = moved(now, after);
  const Vec3 velocity = (going - clip_going) / kTickSeconds;
  return {turns(shown) + going - turns(now), velocity, seconds, stopping_seconds(velocity * lever)};
}

}  // namespace ringcraft
