#include "physics/limits.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

// Joint ranges, measured from the T-pose (docs/sources.md, V3; where that is silent, the AMA
// Guides' ranges).
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
constexpr Range kAny{-720, 720};

// How far beyond the range, below zero inside it.
float beyond(float radians_value, Range range) {
  return std::max(radians(range.low) - radians_value, radians_value - radians(range.high));
}

// An excess that comes near to the most that may be, braked evenly from `free` on.
float eased_excess(float excess, float free, float most) {
  const float room = most - free, over = excess - free;
  return over >= 2 * room ? most : excess - over * over / (4 * room);
}

// The value brought back so that it is at most eased_excess beyond its range.
float brought_back(float value, Range range, float free, float most) {
  const float excess = beyond(value, range);
  if (excess <= std::min(free, most)) return value;
  const float eased = eased_excess(excess, free, most);
  const bool above = value - radians(range.high) >= excess;
  return above ? radians(range.high) + eased : radians(range.low) - eased;
}

// What a joint may do, as the left side's turn from `middle`: a swing across the limb's axis, each
// component in its range or all of it inside a cone, and a twist about it.
struct Ranges {
  Quat middle;
  Vec3 axis{};  // a unit coordinate axis
  Range x = kAny, y = kAny, z = kAny, twist = kAny;
  float cone = 0;         // degrees; 0 is none
  bool wide_end = false;  // toward the far end of the cone the twist means less and less
};

Range twist_range(const Ranges& ranges, float swing) {
  if (!ranges.wide_end) return ranges.twist;
  const float more = 3 * std::max(0.0f, degrees(swing) - ranges.cone);
  return {ranges.twist.low - more, ranges.twist.high + more};
}

float excess_of(const Ranges& ranges, Quat q) {
  const Split s = split(glm::conjugate(ranges.middle) * q, ranges.axis);
  const float swing = glm::length(s.swing);
  const float all =
      std::max({beyond(s.swing.x, ranges.x), beyond(s.swing.y, ranges.y),
                beyond(s.swing.z, ranges.z), beyond(s.twist, twist_range(ranges, swing))});
  return ranges.cone > 0 ? std::max(all, swing - radians(ranges.cone)) : all;
}

// The nearest turn within the ranges, component by component. A twist beyond half a turn is counted
// on from `before`: it stays on that side.
Quat brought_back(const Ranges& ranges, Quat q, Quat before, float free, float most) {
  const Quat unturned = glm::conjugate(ranges.middle);
  const Split s = split(unturned * q, ranges.axis);
  Vec3 swing = s.swing;
  if (ranges.cone > 0) {
    const float far = glm::length(swing);
    const float kept = brought_back(far, {-ranges.cone, ranges.cone}, free, most);
    swing *= kept < far ? kept / far : 1.0f;
  }
  swing = {brought_back(swing.x, ranges.x, free, most), brought_back(swing.y, ranges.y, free, most),
           brought_back(swing.z, ranges.z, free, most)};
  const float from = split(unturned * before, ranges.axis).twist;
  const float twist = brought_back(from + wrapped_angle(s.twist - from),
                                   twist_range(ranges, glm::length(swing)), free, most);
  return ranges.middle * from_rotation_vector(swing) * glm::angleAxis(twist, ranges.axis);
}

// Left and right are measured alike: the right side is mirrored across x = 0 first.
Quat as_left(Quat q, bool left) {
  return left ? q : Quat(q.w, q.x, -q.y, -q.z);
}

const Quat kNoTurn(1, 0, 0, 0);

// Thoracolumbar spine: lumbar 75/30/35 (V3) and the thorax's 30/15/20; 45 of axial rotation.
Ranges trunk_ranges() {
  return {.middle = kNoTurn, .axis = kUp, .x = {-45, 105}, .z = {-55, 55}, .twist = {-45, 45}};
}

Ranges neck_ranges() {
  return {.middle = kNoTurn, .axis = kUp, .x = {-70, 60}, .z = {-45, 45}, .twist = {-80, 80}};
}

// The humerus stays within 117 degrees of the direction half-way between its extremes (forward, out
// and down): flexion 180 lies 110 off it, extension 60 lies 114. Rotation is counted from the
// scapular plane; away from it the same humeral rotation reads up to 30 degrees more (Codman).
Ranges shoulder_ranges() {
  return {.middle = rotation_between(kLeft, Vec3{.55f, -.35f, .75f}),
          .axis = kLeft,
          .twist = {-120, 120},
          .cone = 117,
          .wide_end = true};
}

// Flexion turns the forearm from +x to +z: about -y on the left. Fifteen degrees of hyperextension
// and carrying angle are within what markers show of a straight arm.
Ranges elbow_ranges() {
  return {.middle = kNoTurn, .axis = kLeft, .y = {-150, 10}, .z = {-20, 20}, .twist = {-90, 90}};
}

// Palm down: flexion about -z, ulnar deviation about +y; forearm rotation may sit in the hand's
// joint.
Ranges wrist_ranges() {
  return {.middle = kNoTurn, .axis = kLeft, .y = {-25, 65}, .z = {-90, 70}, .twist = {-90, 90}};
}

// Measured from 45 degrees of flexion and 7 of abduction. Flexion 130 and extension 30 lie 85 and
// 75 off it; a raised leg abducts farther than the 45 of a standing one because it rotates outward
// (the roundhouse's chamber): 75.
Ranges hip_ranges() {
  return {.middle = glm::angleAxis(radians(7), kForward) * glm::angleAxis(radians(-45), kLeft),
          .axis = kUp,
          .x = {-85, 75},
          .z = {-60, 75},
          .twist = {-60, 60}};
}

Ranges knee_ranges() {
  return {.middle = kNoTurn, .axis = kUp, .x = {-10, 150}, .z = {-15, 15}, .twist = {-40, 40}};
}

// Dorsiflexion is about -x; 35 under the body's weight (docs/sources.md, R1).
Ranges ankle_ranges() {
  return {.middle = kNoTurn, .axis = kLeft, .y = {-35, 35}, .z = {-35, 35}, .twist = {-35, 60}};
}

Ranges toes_ranges() {
  return {.middle = kNoTurn, .axis = kLeft, .twist = {-90, 50}, .cone = 25};
}

// One limit: the joint that is named and moves, and the joints whose turns add up to it.
struct Limit {
  Joint joint;
  std::array<Joint, 3> chain;  // from the root on
  int count;
  Ranges ranges;
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
  return excess_of(limit.ranges, as_left(chained(limit, pose), limit.left));
}

std::vector<Limit> make_limits() {
  std::vector<Limit> all;
  all.reserve(kLimitCount);
  all.push_back(
      {Joint::spine, {Joint::spine, Joint::chest, Joint::upper_chest}, 3, trunk_ranges(), true});
  all.push_back({Joint::neck, {Joint::neck, Joint::head, Joint::head}, 2, neck_ranges(), true});
  for (const Side side : {Side::left, Side::right}) {
    const bool left = side == Side::left;
    const Limb a = arm(side), l = leg(side);
    const Joint clavicle = left ? Joint::left_shoulder : Joint::right_shoulder;
    const auto single = [&](Joint joint, const Ranges& ranges) {
      all.push_back({joint, {joint, joint, joint}, 1, ranges, left});
    };
    all.push_back({a.root, {clavicle, a.root, a.root}, 2, shoulder_ranges(), left});
    single(a.middle, elbow_ranges());
    single(a.end, wrist_ranges());
    single(l.root, hip_ranges());
    single(l.middle, knee_ranges());
    single(l.end, ankle_ranges());
    single(toes(side), toes_ranges());
  }
  assert(all.size() == kLimitCount);
  return all;
}

const std::vector<Limit>& limits() {
  static const std::vector<Limit> all = make_limits();
  return all;
}

// The pose with one limit brought back by its named joint.
void bring_back(const Limit& limit, const Pose& before, float free, float most, Pose& pose) {
  const Quat is = chained(limit, pose);
  const Quat back = as_left(brought_back(limit.ranges, as_left(is, limit.left),
                                         as_left(chained(limit, before), limit.left), free, most),
                            limit.left);
  Quat above = kNoTurn, below = kNoTurn;  // of the joints that stay
  bool passed = false;
  for (int i = 0; i < limit.count; ++i) {
    const Joint joint = limit.chain[static_cast<std::size_t>(i)];
    const bool named = joint == limit.joint;
    Quat& turn = passed ? below : above;
    if (!named) turn = turn * pose.rotation[index(joint)];
    passed = passed || named;
  }
  pose.rotation[index(limit.joint)] =
      glm::normalize(glm::conjugate(above) * back * glm::conjugate(below));
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

Pose within_limits(const BodyModel& body, const Pose& pose, float tolerance, const Pose& before) {
  LimitExcesses free;
  free.fill(tolerance);
  return within_limits(body, pose, tolerance, before, free);
}

LimitExcesses limit_excesses(const Pose& pose) {
  LimitExcesses excesses;
  for (std::size_t i = 0; i < kLimitCount; ++i) excesses[i] = excess_of(limits()[i], pose);
  return excesses;
}

std::optional<Side> leg_of_limit(std::size_t limit) {
  const Joint joint = limits()[limit].joint;
  for (const Side side : {Side::left, Side::right}) {
    const Limb l = leg(side);
    if (joint == l.root || joint == l.middle || joint == l.end || joint == toes(side)) return side;
  }
  return {};
}

Pose within_limits(const BodyModel&, const Pose& pose, float most, const Pose& before,
                   const LimitExcesses& free) {
  Pose out = pose;
  for (std::size_t i = 0; i < kLimitCount; ++i) {
    if (excess_of(limits()[i], out) <= std::min(free[i], most)) continue;
    bring_back(limits()[i], before, free[i], most, out);
  }
  return out;
}

}  // namespace ringcraft
