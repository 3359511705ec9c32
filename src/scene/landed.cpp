#include "scene/landed.h"

#include <algorithm>

#include "base/ticks.h"
#include "physics/impact.h"

namespace ringcraft {
namespace {

constexpr Tick kPresses = 18;  // 0.15 s: then the limb goes on, as fast as one that comes free
constexpr float kSoft = .25f;  // m

}  // namespace

LandedLimb::LandedLimb(const BodyModel& body, const Limb& limb, const Pose& before,
                       const Pose& after, const Contact& contact)
    : line_(line_of_blow(contact)), age_(0) {
  const std::size_t end = index(limb.end);
  most_ = glm::dot(line_, glm::mix(world_pose(body.skeleton, before).position[end],
                                   world_pose(body.skeleton, after).position[end], contact.share));
}

void LandedLimb::step() {
  if (!holds()) return;
  if (++age_ > kPresses) most_ += kComingFree * kTickSeconds;
}

// Where the clip is p beyond the plane and has been k, the limb is -(p - k)^2 / 4k beyond it for p
// between k and -k: a parabola from rest at the plane to the clip's own way behind it.
Vec3 LandedLimb::hold_back(Vec3 end) {
  constexpr float kBack = .01f;  // m
  if (!holds()) return {};
  const float past = glm::dot(end, line_) - most_;
  deepest_ = std::clamp(past, deepest_, kSoft);
  if (past < -std::max(kBack, deepest_)) {
    *this = {};
    return {};
  }
  const float to_go = deepest_ - past;
  if (to_go <= 0) return -past * line_;
  if (deepest_ <= 0) return {};
  return (-to_go * to_go / (4 * deepest_) - past) * line_;
}

}  // namespace ringcraft
