#include "base/vec.h"

#include <cmath>

namespace ringcraft {

float wrapped_angle(float radians) {
  float wrapped = std::fmod(radians + kPi, 2 * kPi);
  if (wrapped <= 0) wrapped += 2 * kPi;
  return wrapped - kPi;
}

Quat yaw_rotation(float yaw) {
  return {std::cos(yaw * 0.5f), 0, std::sin(yaw * 0.5f), 0};
}

float yaw_of(Vec3 direction) {
  if (std::abs(direction.x) < 1e-9f && std::abs(direction.z) < 1e-9f) return 0;
  return std::atan2(direction.x, direction.z);
}

float heading_of(Quat rotation) {
  return yaw_of(rotation * kForward);
}

Vec3 normalized_or(Vec3 v, Vec3 fallback) {
  const float length = glm::length(v);
  return length > 1e-6f ? v / length : fallback;
}

Quat rotation_between(Vec3 from, Vec3 to) {
  const Vec3 a = normalized_or(from, kForward);
  const Vec3 b = normalized_or(to, kForward);
  const float cosine = glm::dot(a, b);
  if (cosine < -0.999999f) {  // opposite: any axis across `a` will do
    const Vec3 across = std::abs(a.y) < 0.9f ? glm::cross(a, kUp) : glm::cross(a, kLeft);
    return glm::angleAxis(kPi, glm::normalize(across));
  }
  const Vec3 axis = glm::cross(a, b);
  return glm::normalize(Quat(1 + cosine, axis.x, axis.y, axis.z));
}

Vec3 rotation_vector(Quat rotation) {
  if (rotation.w < 0) rotation = -rotation;
  const Vec3 axis{rotation.x, rotation.y, rotation.z};
  const float sine = glm::length(axis);
  if (sine < 1e-7f) return axis * 2.0f;
  return axis * (2 * std::atan2(sine, rotation.w) / sine);
}

Quat from_rotation_vector(Vec3 v) {
  const float angle = glm::length(v);
  if (angle < 1e-7f) return glm::normalize(Quat(1, v.x * 0.5f, v.y * 0.5f, v.z * 0.5f));
  return glm::angleAxis(angle, v / angle);
}

Quat in_hemisphere_of(Quat q, Quat reference) {
  return glm::dot(q, reference) < 0 ? -q : q;
}

}  // namespace ringcraft
