#include "physics/flung_limbs.h"

#include <algorithm>

#include "motion/decay.h"
#include "motion/ik.h"
#include "motion/joint_turns.h"

namespace ringcraft {
namespace {

constexpr float kFlungSpin = 60;   // rad/s: as fast as limbs are shown
constexpr float kCaughtSpin = 7;   // rad/s: as fast as they turn when they have been caught
constexpr float kCaughtBend = 5;   // rad/s: and bend
constexpr float kCaughtEnd = 5;    // m/s about the hips: as fast as their ends go then
constexpr float kCaughtArm = 10;   // rad/s: as fast as a forearm turns with the body then
constexpr float kFlung = .03f;     // s: until then struck limbs fly as they do
constexpr float kCaughtBy = .10f;  // s: by then they are caught

Quat between(Quat was, Quat now, float share) {
  return glm::normalize(glm::slerp(was, in_hemisphere_of(now, was), share));
}

// The share of its way that a joint may go where it turns by no more than `most`, rad.
float share_within(float most, Quat was, Quat now) {
  const float turn = glm::length(rotation_vector(now * glm::conjugate(was)));
  return turn > most ? most / turn : 1.0f;
}

// The limb `share` of its way on from where it was.
void go_on(Side side, const Limb& limb, float share, const Pose& last, Pose& pose) {
  Quat &root = pose.rotation[index(limb.root)], &middle = pose.rotation[index(limb.middle)];
  root = mix_root(side, limb, last.rotation[index(limb.root)], root, share);
  middle = between(last.rotation[index(limb.middle)], middle, share);
}

// The limb turns by no more than `turns` and bends by no more than `bends`, rad.
void slow_limb(Side side, const Limb& limb, float turns, float bends, const Pose& last,
               Pose& pose) {
  for (const Joint joint : {limb.root, limb.middle}) {
    Quat& now = pose.rotation[index(joint)];
    const Quat was = last.rotation[index(joint)];
    const float share = share_within(joint == limb.root ? turns : bends, was, now);
    if (share >= 1) continue;
    now = joint == limb.root ? mix_root(side, limb, was, now, share) : between(was, now, share);
  }
}

}  // namespace

FlungLimbs::FlungLimbs(const BodyModel& body, const ImpactFrame& frame)
    : body_(body), stood_(frame.contacts()), last_(frame.pose()) {}

// What the body's spin takes along already waits with what it does by itself: of both together a
// hand would come round faster than any arm could hold it.
void FlungLimbs::slow_end(Side side, const Limb& limb, float caught, Pose& pose) const {
  const WorldPose was = world_pose(body_.skeleton, last_);
  const auto out = [&](const WorldPose& world) {
    return world.position[index(limb.end)] - world.position[index(Joint::hips)];
  };
  // How fast the end goes, or an arm turns, against what is caught.
  const auto haste = [&](const Pose& p) {
    const WorldPose world = world_pose(body_.skeleton, p);
    const float goes = glm::distance(out(world), out(was)) / (kCaughtEnd * kTickSeconds);
    if (is_leg(limb)) return goes;
    const std::size_t lower = index(limb.middle);
    const Quat turn = world.rotation[lower] * glm::conjugate(was.rotation[lower]);
    return std::max(goes, glm::length(rotation_vector(turn)) / (kCaughtArm * kTickSeconds));
  };
  const float goes = haste(pose);
  if (goes <= 1) return;
  Pose waiting = pose;
  go_on(side, limb, 0, last_, waiting);
  const float taken_along = haste(waiting);
  if (taken_along >= goes) return;
  const float share = std::max(0.0f, 1 - taken_along) / (goes - taken_along);
  go_on(side, limb, glm::mix(1.0f, share, caught), last_, pose);
}

void FlungLimbs::slow_hips(float most, Pose& pose) const {
  Quat& now = pose.rotation[index(Joint::hips)];
  const Quat was = last_.rotation[index(Joint::hips)];
  const float share = share_within(most, was, now);
  if (share < 1) now = between(was, now, share);
}

void FlungLimbs::slow(float seconds, Pose& pose) {
  const float caught = glm::smoothstep(kFlung, kCaughtBy, seconds);
  const float turns = glm::mix(kFlungSpin, kCaughtSpin, caught) * kTickSeconds;
  const float bends = glm::mix(kFlungSpin, kCaughtBend, caught) * kTickSeconds;
  slow_hips(glm::mix(kFlungSpin, kFastestTurn, caught) * kTickSeconds, pose);
  for (const Side side : {Side::left, Side::right}) {
    slow_limb(side, arm(side), turns, bends, last_, pose);
    slow_end(side, arm(side), caught, pose);
    if (stood_.of(side)) continue;
    slow_limb(side, leg(side), turns, bends, last_, pose);
    slow_end(side, leg(side), caught, pose);
  }
  last_ = pose;
}

}  // namespace ringcraft
