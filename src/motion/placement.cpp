#include "motion/placement.h"

#include <cmath>

namespace ringcraft {

Placement operator*(const Placement& outer, const Placement& inner) {
  const Vec3 position = outer * inner.position();
  return {position.x, position.z, wrapped_angle(outer.yaw + inner.yaw)};
}

Placement inverse(const Placement& placement) {
  const Vec3 back = yaw_rotation(-placement.yaw) * -placement.position();
  return {back.x, back.z, wrapped_angle(-placement.yaw)};
}

Vec3 operator*(const Placement& placement, Vec3 point) {
  return yaw_rotation(placement.yaw) * point + placement.position();
}

bool in_bounds(const Placement& placement) {
  return std::abs(placement.x) <= kFarthestPlaced && std::abs(placement.z) <= kFarthestPlaced &&
         std::abs(placement.yaw) <= 2 * kPi * static_cast<float>(kMostTurns);
}

float bearing(const Placement& from, Vec3 point) {
  return wrapped_angle(yaw_of(point - from.position()) - from.yaw);
}

Placement mirrored(const Placement& placement) {
  return {-placement.x, placement.z, -placement.yaw};
}

Placement mix(const Placement& a, const Placement& b, float share) {
  return {a.x + (b.x - a.x) * share, a.z + (b.z - a.z) * share,
          wrapped_angle(a.yaw + wrapped_angle(b.yaw - a.yaw) * share)};
}

}  // namespace ringcraft
