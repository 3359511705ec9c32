#include "scene/landed.h"

#include <algorithm>

#include "base/ticks.h"
#include "physics/impact.h"

namespace ringcraft {
namespace {

constexpr Tick kPresses = 18;  // 0.15 s: then the limb goes on, as fast as one that comes free

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

Vec3 LandedLimb::held_back(Vec3 end) const {
  return holds() ? -std::max(0.0f, glm::dot(end, line_) - most_) * line_ : Vec3{};
}

void LandedLimb::let_go_behind(Vec3 end) {
  constexpr float kBack = .01f;  // m
  if (holds() && glm::dot(end, line_) < most_ - kBack) *this = {};
}

}  // namespace ringcraft
