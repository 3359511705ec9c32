#include "motion/decay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ticks.h"
#include "motion/joint_turns.h"

namespace ringcraft {
namespace {

constexpr float kSquareRootOf2 = std::numbers::sqrt2_v<float>;

constexpr float kReach = .71f;  // m: what turns with the hips reaches so far

// The rotation vector of q that lies nearest to `reference`: a turn of a little more than half a
// circle does not become one the other way.
Vec3 rotation_vector_near(Quat q, Vec3 reference) {
  const Vec3 v = rotation_vector(q);
  const float angle = glm::length(v);
  if (angle < 1e-4f) return v;
  const Vec3 around = v * (1 - 2 * kPi / angle);
  return glm::distance2(around, reference) < glm::distance2(v, reference) ? around : v;
}

// Of the way to go, at a share 0 .. 1 of the time.
constexpr float kMoving = 4;  // acceleration, in ways / T^2
float left_of_way(float s) {
  return s < .5f ? 1 - kMoving / 2 * s * s : kMoving / 2 * (1 - s) * (1 - s);
}

// The way, in v0 T, that is gone with a speed v0 that is taken off, until it is gone back.
constexpr float kStopping = 1 + kSquareRootOf2;  // acceleration, in v0 / T
float way_of_speed(float u) {
  return u < 1 / kSquareRootOf2 ? u - kStopping / 2 * u * u : kStopping / 2 * (1 - u) * (1 - u);
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

float seconds_to_move(float distance, float acceleration) {
  return std::sqrt(kMoving * distance / acceleration);
}

float seconds_to_stop(float speed, float acceleration) {
  return kStopping * speed / acceleration;
}

Decay::Decay(Vec3 value, Vec3 velocity, float seconds) : Decay(value, velocity, seconds, seconds) {}

Decay::Decay(Vec3 value, Vec3 velocity, float seconds, float velocity_seconds)
    : start_(value),
      velocity_(velocity),
      seconds_(seconds),
      velocity_seconds_(std::min(velocity_seconds, seconds)) {}

Vec3 Decay::value() const {
  if (done()) return {};
  return start_ * left_of_way(age_ / seconds_) +
         velocity_ * velocity_seconds_ * way_of_speed(std::min(1.0f, age_ / velocity_seconds_));
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
  return std::max(kLeast, seconds_to_stop(glm::length(velocity), 12));
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
  if (!rolls.done()) return from_rotation_vector(rolls.value()) * clip;
  if (yaw.done() && lean.done()) return clip;
  const YawAndLean own(clip);
  return yaw_rotation(own.yaw + yaw.value().y) * from_rotation_vector(own.lean + lean.value());
}

void BodyTurn::step(float dt) {
  yaw.step(dt);
  lean.step(dt);
  rolls.step(dt);
}

BodyTurn body_turn(const Pose& before, const Pose& shown, const Pose& now, const Pose& after,
                   float seconds, std::optional<float> longest) {
  const Quat hips = shown.rotation[0];
  const Quat carried = glm::normalize(hips * glm::inverse(before.rotation[0]) * hips);
  const YawAndLean was(hips), is(carried), clip(now.rotation[0]), next(after.rotation[0]);
  const float yaw_velocity =
      (wrapped_angle(is.yaw - was.yaw) - wrapped_angle(next.yaw - clip.yaw)) / kTickSeconds;
  const Vec3 lean_velocity = (is.lean - was.lean - (next.lean - clip.lean)) / kTickSeconds;
  const float on = yaw_velocity * kSpinCarries;
  const auto stops = [&](Vec3 velocity) {
    return longest ? stopping_seconds(velocity * kReach) : seconds;
  };
  const float off = wrapped_angle(is.yaw - clip.yaw + on) - on;
  // On a way d in T s it goes by 2 d / T half-way.
  const float turns =
      std::max(seconds, std::min(longest.value_or(0), 2 * std::abs(off) / kFastestTurn));
  return {{kUp * off, kUp * yaw_velocity, turns, stops(kUp * yaw_velocity)},
          {is.lean - clip.lean, lean_velocity, seconds, stops(lean_velocity)},
          {}};
}

BodyTurn lying_turn(const Pose& before, const Pose& shown, const Pose& now, const Pose& after,
                    float seconds) {
  return {{},
          {},
          rotation_decay(before.rotation[0], shown.rotation[0], now.rotation[0], after.rotation[0],
                         seconds, kReach)};
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
