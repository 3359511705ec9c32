#include "physics/flung_limbs.h"

#include "motion/ik.h"
#include "motion/joint_turns.h"

namespace ringcraft {
namespace {

constexpr float kFlungSpin = 60;   // rad/s: as fast as limbs are shown
constexpr float kCaughtSpin = 7;   // rad/s: as fast as they turn when they have been caught
constexpr float kCaughtBend = 5;   // rad/s: and bend
constexpr float kFlung = .03f;     // s: until then struck limbs fly as they do
constexpr float kCaughtBy = .10f;  // s: by then they are caught

// The limb turns by no more than `turns` and bends by no more than `bends`, rad.
void slow_limb(Side side, const Limb& limb, float turns, float bends, const Pose& last,
               Pose& pose) {
  for (const Joint joint : {limb.root, limb.middle}) {
    const float most = joint == limb.root ? turns : bends;
    Quat& now = pose.rotation[index(joint)];
    const Quat was = last.rotation[index(joint)];
    const float turn = glm::length(rotation_vector(now * glm::conjugate(was)));
    if (turn <= most) continue;
    now = joint == limb.root
              ? mix_root(side, limb, was, now, most / turn)
              : glm::normalize(glm::slerp(was, in_hemisphere_of(now, was), most / turn));
  }
}

}  // namespace

FlungLimbs::FlungLimbs(const ImpactFrame& frame) : stood_(frame.contacts()), last_(frame.pose()) {}

void FlungLimbs::slow(float seconds, Pose& pose) {
  const float caught = glm::smoothstep(kFlung, kCaughtBy, seconds);
  const float turns = glm::mix(kFlungSpin, kCaughtSpin, caught) * kTickSeconds;
  const float bends = glm::mix(kFlungSpin, kCaughtBend, caught) * kTickSeconds;
  for (const Side side : {Side::left, Side::right}) {
    slow_limb(side, arm(side), turns, bends, last_, pose);
    if (!stood_.of(side)) slow_limb(side, leg(side), turns, bends, last_, pose);
  }
  last_ = pose;
}

}  // namespace ringcraft
