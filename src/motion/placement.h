#pragma once
// A placement: where a root stands on the ground and which way it faces.

#include "base/vec.h"

namespace ringcraft {

struct Placement {
  float x = 0, z = 0;  // m
  float yaw = 0;       // rad, 0 faces +Z, positive to the own left

  bool operator==(const Placement&) const = default;
  Vec3 position() const { return {x, 0, z}; }
  Vec3 forward() const { return yaw_rotation(yaw) * kForward; }
};

// `inner` given relative to `outer`, expressed where `outer` is expressed.
Placement operator*(const Placement& outer, const Placement& inner);
Placement inverse(const Placement& placement);
Vec3 operator*(const Placement& placement, Vec3 point);

// What a file may say: no fight goes as far as that from where an action starts.
inline constexpr float kFarthestPlaced = 1000;  // m
inline constexpr int kMostTurns = 1000;         // of the body about its vertical
bool in_bounds(const Placement& placement);     // false where a number is not finite

// Bearing of `point` off the way `from` faces, rad in (-pi, pi]; positive to the own left.
float bearing(const Placement& from, Vec3 point);

Placement mirrored(const Placement& placement);  // across the plane x = 0
Placement mix(const Placement& a, const Placement& b, float share);

}  // namespace ringcraft
