#include "physics/braking.h"

#include <algorithm>
#include <cmath>

#include "motion/decay.h"

namespace ringcraft {
namespace {

constexpr float kSetsIn = .03f;        // s after the blow: the legs are stiff already
constexpr float kFull = .10f;          // s
constexpr float kDeceleration = 6.0f;  // m/s2: of a foot that is planted to stop
constexpr float kSpinBrake = 60;       // rad/s2
constexpr float kOnFloor = .03f;       // m: a sole that is higher brakes nothing

Vec3 over_ground(Vec3 v) {
  return {v.x, 0, v.z};
}

}  // namespace

Braking::Braking(const BodyModel& body, const ImpactFrame& frame) : body_(body) {
  const Vec3 now = center_of_mass(body, world_pose(body.skeleton, frame.pose())),
             before = center_of_mass(body, world_pose(body.skeleton, frame.before()));
  const Vec3 own = over_ground(now - before) / kTickSeconds;
  const Vec3 way = normalized_or(over_ground(frame.blow().impulse), Vec3{});
  left_ = own - way * std::max(0.0f, glm::dot(own, way));
}

void Braking::brake(Ragdoll& ragdoll, float seconds) {
  const float speed = glm::length(left_);
  if (speed <= 0) return;
  const WorldPose world = world_pose(body_.skeleton, ragdoll.pose());
  const float sole =
      std::min(sole_height(body_, world, Side::left), sole_height(body_, world, Side::right));
  if (sole > kOnFloor) return;
  const float most = kDeceleration * glm::smoothstep(kSetsIn, kFull, seconds) * kRagdollStep;
  const Vec3 off = left_ * std::min(1.0f, most / speed);
  left_ -= off;
  ragdoll.quicken(-off);
}

void Braking::brake_spin(Ragdoll& ragdoll, float seconds) {
  const float spin = ragdoll.yaw_rate(), beyond = std::abs(spin) - kFastestTurn;
  if (beyond <= 0) return;
  const float most = kSpinBrake * glm::smoothstep(kSetsIn, kFull, seconds) * kRagdollStep;
  ragdoll.turn_faster(std::copysign(std::min(beyond, most), -spin));
}

}  // namespace ringcraft
