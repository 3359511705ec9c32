#pragma once
// Vectors and axes. The one place that sets up GLM: include this, never <glm/...> directly.
//
// Metres, radians; right-handed, +Y up, +Z forward, +X to the left of somebody who looks along +Z.
// Quaternion constructors take w first; memory is x, y, z, w.
#ifndef GLM_FORCE_CTOR_INIT
#define GLM_FORCE_CTOR_INIT  // default values are zero and identity, not garbage
#endif
#ifndef GLM_ENABLE_EXPERIMENTAL
#define GLM_ENABLE_EXPERIMENTAL
#endif
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/norm.hpp>
#include <glm/gtx/quaternion.hpp>

namespace ringcraft {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Quat = glm::quat;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kGravity = 9.81f;  // m/s2
inline const Vec3 kLeft{1, 0, 0};
inline const Vec3 kUp{0, 1, 0};
inline const Vec3 kForward{0, 0, 1};

inline constexpr float radians(float degrees) {
  return degrees * (kPi / 180.0f);
}
inline constexpr float degrees(float radians) {
  return radians * (180.0f / kPi);
}

// The angle in (-pi, pi] that points the same way.
float wrapped_angle(float radians);

// Rotation by `yaw` about +Y; a positive yaw turns +Z toward +X, that is to the own left.
Quat yaw_rotation(float yaw);

// Yaw of a direction on the ground: 0 along +Z, positive toward +X. Zero for a vertical direction.
float yaw_of(Vec3 direction);

// Yaw of the rotation's +Z axis on the ground. Means little for a body that lies down.
float heading_of(Quat rotation);

// Unit vector along v, or `fallback` when v is shorter than 1e-6.
Vec3 normalized_or(Vec3 v, Vec3 fallback);

// Shortest rotation that turns direction `from` into direction `to` (need not be unit vectors).
Quat rotation_between(Vec3 from, Vec3 to);

// Rotation vector (axis times angle, shortest way) and back.
Vec3 rotation_vector(Quat rotation);
Quat from_rotation_vector(Vec3 v);

// q or -q, whichever lies in the hemisphere of `reference`.
Quat in_hemisphere_of(Quat q, Quat reference);

}  // namespace ringcraft
