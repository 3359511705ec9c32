// Joint ranges, measured from the T-pose (validation V3; where V3 is silent, the AMA Guides'
// ranges).
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/body.h"

namespace ringcraft {
namespace {

struct Split {
  Vec3 swing{};     // rotation vector across the axis, rad
  float twist = 0;  // rad about the axis, in (-pi, pi]
};

// q = swing * twist about `axis` (a unit coordinate axis).
Split split(Quat q, Vec3 axis) {
  const float along = q.x * axis.x + q.y * axis.y + q.z * axis.z;
  const float n = std::sqrt(along * along + q.w * q.w);
  const Quat twist = n > 1e-6f
                         ? Quat(q.w / n, axis.x * along / n, axis.y * along / n, axis.z * along / n)
                         : Quat(1, 0, 0, 0);
  Split s;
  s.twist = wrapped_angle(2 * std::atan2(along, q.w));
  s.swing = rotation_vector(q * glm::conjugate(twist));
  return s;
}

struct Range {
  float low, high;  // degrees
};

float beyond(float radians_value, Range range) {
  return std::max({radians(range.low) - radians_value, radians_value - radians(range.high), 0.0f});
}

// Left and right are measured alike: the right side is mirrored across x = 0 first.
Quat as_left(Quat q, bool left) {
  return left ? q : Quat(q.w, q.x, -q.y, -q.z);
}

// Thoracolumbar spine: lumbar 75/30/35 (V3) and the thorax's 30/15/20; 45 of axial rotation.
float trunk_excess(Quat q) {
  const Split s = split(q, kUp);
  return std::max(
      {beyond(s.swing.x, {-45, 105}), beyond(s.swing.z, {-55, 55}), beyond(s.twist, {-45, 45})});
}

float neck_excess(Quat q) {
  const Split s = split(q, kUp);
  return std::max(
      {beyond(s.swing.x, {-70, 60}), beyond(s.swing.z, {-45, 45}), beyond(s.twist, {-80, 80})});
}

// The humerus stays within 117 degrees of the direction half-way between its extremes (forward, out
// and down): flexion 180 lies 110 off it, extension 60 lies 114. Rotation is counted from the
// scapular plane; away from it the same humeral rotation reads up to 30 degrees more (Codman).
constexpr float kShoulderSwing = radians(117), kShoulderTwist = radians(120);

Quat shoulder_middle() {
  return rotation_between(kLeft, Vec3{.55f, -.35f, .75f});
}

// Toward the far end of the cone the twist means less and less.
float twist_range(float swing) {
  return kShoulderTwist + std::max(0.0f, swing - kShoulderSwing) * 3;
}

float shoulder_excess(Quat q) {
  const Split s = split(glm::conjugate(shoulder_middle()) * q, kLeft);
  const float swing = glm::length(s.swing);
  return std::max({swing - kShoulderSwing, std::abs(s.twist) - twist_range(swing), 0.0f});
}

// The nearest humeral turn at most `tolerance` beyond the range. A twist beyond half a turn is
// counted on from `before`: it stays on that side.
Quat nearest_shoulder(Quat q, Quat before, float tolerance) {
  const Quat unturned = glm::conjugate(shoulder_middle());
  const Split s = split(unturned * q, kLeft);
  const float swing = glm::length(s.swing);
  const float most = kShoulderSwing + tolerance;
  const float range = twist_range(std::min(swing, most)) + tolerance;
  const Vec3 kept = swing > most ? s.swing * (most / swing) : s.swing;
  const float from = split(unturned * before, kLeft).twist;
  const float twist = from + wrapped_angle(s.twist - from);
  return shoulder_middle() * from_rotation_vector(kept) *
         glm::angleAxis(std::clamp(twist, -range, range), kLeft);
}

// Flexion turns the forearm from +x to +z: about -y on the left. Fifteen degrees of hyperextension
// and carrying angle are within what markers show of a straight arm.
float elbow_excess(Quat q) {
  const Split s = split(q, kLeft);
  return std::max(
      {beyond(-s.swing.y, {-10, 150}), beyond(s.swing.z, {-20, 20}), beyond(s.twist, {-90, 90})});
}

// Palm down: flexion about -z, ulnar deviation about +y; forearm rotation may sit in the hand's
// joint.
float wrist_excess(Quat q) {
  const Split s = split(q, kLeft);
  return std::max(
      {beyond(-s.swing.z, {-70, 90}), beyond(s.swing.y, {-25, 65}), beyond(s.twist, {-90, 90})});
}

// Measured from 45 degrees of flexion and 7 of abduction. Flexion 130 and extension 30 lie 85 and
// 75 off it; a raised leg abducts farther than the 45 of a standing one because it rotates outward
// (the roundhouse's chamber): 75.
float hip_excess(Quat q) {
  static const Quat middle =
      glm::angleAxis(radians(7), kForward) * glm::angleAxis(radians(-45), kLeft);
  const Split s = split(glm::conjugate(middle) * q, kUp);
  return std::max(
      {beyond(-s.swing.x, {-75, 85}), beyond(s.swing.z, {-60, 75}), beyond(s.twist, {-60, 60})});
}

float knee_excess(Quat q) {
  const Split s = split(q, kUp);
  return std::max(
      {beyond(s.swing.x, {-10, 150}), beyond(s.swing.z, {-15, 15}), beyond(s.twist, {-40, 40})});
}

// Dorsiflexion is about -x; 35 under the body's weight (ragdoll.md section 1).
float ankle_excess(Quat q) {
  const Split s = split(q, kLeft);
  return std::max(
      {beyond(s.twist, {-35, 60}), beyond(s.swing.y, {-35, 35}), beyond(s.swing.z, {-35, 35})});
}

float toes_excess(Quat q) {
  const Split s = split(q, kLeft);
  return std::max(beyond(s.twist, {-90, 50}), glm::length(s.swing) - radians(25));
}

// One limit: the joint that is named, the joints whose turns add up to it, and how far a pose is
// beyond.
struct Limit {
  Joint joint;
  std::array<Joint, 3> chain;  // from the root on; the named joint moves, where `count` is 1 or 2
  int count;
  float (*excess)(Quat);
  Quat middle;  // well inside the range, as the left side's turn
  bool left;
};

Quat chained(const Limit& limit, const Pose& pose) {
  Quat q(1, 0, 0, 0);
  for (int i = 0; i < limit.count; ++i) {
    q = q * pose.rotation[index(limit.chain[static_cast<std::size_t>(i)])];
  }
  return q;
}

float excess_of(const Limit& limit, const Pose& pose) {
  return limit.excess(as_left(chained(limit, pose), limit.left));
}

std::vector<Limit> make_limits() {
  const Quat none(1, 0, 0, 0);
  std::vector<Limit> all;
  all.push_back({Joint::spine,
                 {Joint::spine, Joint::chest, Joint::upper_chest},
                 3,
                 trunk_excess,
                 none,
                 true});
  all.push_back({Joint::neck, {Joint::neck, Joint::head, Joint::head}, 2, neck_excess, none, true});
  for (const Side side : {Side::left, Side::right}) {
    const bool left = side == Side::left;
    const Limb a = arm(side), l = leg(side);
    const Joint clavicle = left ? Joint::left_shoulder : Joint::right_shoulder;
    const auto single = [&](Joint joint, float (*excess)(Quat), Quat middle) {
      all.push_back({joint, {joint, joint, joint}, 1, excess, middle, left});
    };
    all.push_back({a.root,
                   {clavicle, a.root, a.root},
                   2,
                   shoulder_excess,
                   rotation_between(kLeft, Vec3{.55f, -.35f, .75f}),
                   left});
    single(a.middle, elbow_excess, from_rotation_vector({0, -radians(60), 0}));
    single(a.end, wrist_excess, none);
    single(l.root, hip_excess, from_rotation_vector({-radians(45), 0, 0}));
    single(l.middle, knee_excess, from_rotation_vector({radians(60), 0, 0}));
    single(l.end, ankle_excess, none);
    single(toes(side), toes_excess, none);
  }
  return all;
}

const std::vector<Limit>& limits() {
  static const std::vector<Limit> all = make_limits();
  return all;
}

// The pose with one limit's joints a `share` of the way back to the middle of the range.
Pose eased(const Limit& limit, const Pose& pose, float share) {
  Pose out = pose;
  const auto toward = [&](Joint joint, Quat goal) {
    Quat& q = out.rotation[index(joint)];
    q = glm::normalize(glm::slerp(q, in_hemisphere_of(goal, q), share));
  };
  const Quat middle = as_left(limit.middle, limit.left);
  for (int i = 0; i < limit.count; ++i) toward(limit.chain[static_cast<std::size_t>(i)], middle);
  return out;
}

}  // namespace

std::vector<LimitViolation> limit_violations(const BodyModel&, const Pose& pose, float tolerance) {
  std::vector<LimitViolation> found;
  for (const Limit& limit : limits()) {
    const float excess = excess_of(limit, pose);
    if (excess > tolerance) found.push_back({limit.joint, excess});
  }
  return found;
}

Pose within_limits(const BodyModel& body, const Pose& pose, float tolerance) {
  return within_limits(body, pose, tolerance, rest_pose(body.skeleton));
}

Pose within_limits(const BodyModel&, const Pose& pose, float tolerance, const Pose& before) {
  Pose out = pose;
  for (const Limit& limit : limits()) {
    if (excess_of(limit, out) <= tolerance) continue;
    if (limit.excess == shoulder_excess) {
      const Quat clavicle = out.rotation[index(limit.chain[0])];
      const Quat near = nearest_shoulder(as_left(chained(limit, out), limit.left),
                                         as_left(chained(limit, before), limit.left), tolerance);
      out.rotation[index(limit.joint)] =
          glm::normalize(glm::conjugate(clavicle) * as_left(near, limit.left));
      continue;
    }
    float low = 0, high = 1;  // shares: beyond, within
    for (int i = 0; i < 12; ++i) {
      const float share = (low + high) / 2;
      (excess_of(limit, eased(limit, out, share)) > tolerance ? low : high) = share;
    }
    out = eased(limit, out, high);
  }
  return out;
}

}  // namespace ringcraft
