#include "physics/braking.h"

#include <algorithm>

namespace ringcraft {
namespace {

constexpr float kSetsIn = .03f;        // s after the blow: the legs are stiff already
constexpr float kFull = .10f;          // s
constexpr float kDeceleration = 6.0f;  // m/s2: of a foot that is planted to stop
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

}  // namespace ringcraft
