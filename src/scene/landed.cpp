#include "scene/landed.h"

#include <algorithm>

#include "base/ticks.h"
#include "physics/impact.h"

namespace ringcraft {
namespace {

constexpr Tick kPresses = 18;     // 0.15 s: then the limb goes on, in
constexpr Tick kGoesOn = 30;      // 0.25 s
constexpr float kGradual = .25f;  // m
constexpr float kBack = .01f;     // m behind the plane: a limb that is on its way back
constexpr float kFades = .1f;     // s in which what is left of the offset goes

}  // namespace

LandedLimb::LandedLimb(const BodyModel& body, const Limb& limb, const Pose& before,
                       const Pose& after, const Contact& contact)
    : line_(line_of_blow(contact)), age_(0) {
  const std::size_t end = index(limb.end);
  most_ = glm::dot(line_, glm::mix(world_pose(body.skeleton, before).position[end],
                                   world_pose(body.skeleton, after).position[end], contact.share));
}

void LandedLimb::step() {
  left_.step(kTickSeconds);
  if (!holds()) return;
  ++age_;
}

// Where the clip is p beyond the plane and has been k, the limb is -(p - k)^2 / 4k beyond it for p
// between k and -k: a parabola from rest at the plane to the clip's own way behind it.
Vec3 LandedLimb::hold_back(Vec3 end) {
  if (!holds()) return left_.value();
  const float past = glm::dot(end, line_) - most_;
  const bool sets_out = past_ < -kBack && past > past_;
  past_ = past;
  deepest_ = std::clamp(past, deepest_, kGradual);
  const float to_go = std::clamp(deepest_ - past, 0.0f, 2 * deepest_);
  const float shown = deepest_ > 0 ? -to_go * to_go / (4 * deepest_) : 0.0f;
  const float gone = std::clamp(static_cast<float>(age_ - kPresses) / kGoesOn, 0.0f, 1.0f);
  offset_ = std::min(0.0f, shown - past) * (1 - glm::smoothstep(0.0f, 1.0f, gone)) * line_;
  const Vec3 offset = offset_;
  if (sets_out || gone >= 1 || past < -std::max(kBack, deepest_)) let_go();
  return offset;
}

void LandedLimb::let_go() {
  if (!holds()) return;
  const Vec3 offset = offset_;
  *this = {};
  left_ = Decay(offset, Vec3{}, kFades);
}

}  // namespace ringcraft
