#include "physics/joint_cones.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

Cone cone_of(Part part) {
  const auto flexed = [](float angle) { return glm::angleAxis(radians(angle), kLeft); };
  const auto cone = [](Quat middle, Vec3 axis, Vec3 across, float f, float s, float t) {
    return Cone{middle, axis, across, radians(f), radians(s), radians(t)};
  };
  switch (part) {
    case Part::abdomen:
      return cone(flexed(22), kUp, kLeft, 51, 33, 23);
    case Part::chest:
      return cone(flexed(8), kUp, kLeft, 23, 21, 21);
    case Part::neck:
      return cone(flexed(-3), kUp, kLeft, 35, 26, 40);
    case Part::head:
      return cone(flexed(-2), kUp, kLeft, 28, 18, 38);
    case Part::left_upper_arm:
      return cone(rotation_between(kLeft, {.55f, -.35f, .75f}), kLeft, kUp, 117, 117, 120);
    case Part::right_upper_arm:
      return cone(rotation_between(-kLeft, {-.55f, -.35f, .75f}), -kLeft, kUp, 117, 117, 120);
    case Part::left_hand:
      return cone(glm::angleAxis(radians(-10), kForward), kLeft, kUp, 45, 80, 90);
    case Part::right_hand:
      return cone(glm::angleAxis(radians(10), kForward), -kLeft, kUp, 45, 80, 90);
    case Part::left_thigh:
      return cone(glm::angleAxis(radians(14), kForward) * flexed(-48), -kUp, kLeft, 79, 66, 55);
    case Part::right_thigh:
      return cone(glm::angleAxis(radians(-14), kForward) * flexed(-48), -kUp, kLeft, 79, 66, 55);
    case Part::left_foot:
    case Part::right_foot:
      return cone(flexed(12), -kUp, kLeft, 48, 35, 35);
    default:
      return {};
  }
}

Cone widened(Cone cone, Quat relative) {
  const Quat off = glm::conjugate(cone.middle) * relative;
  const float along = glm::dot(Vec3{off.x, off.y, off.z}, cone.axis);
  const float n = std::max(std::sqrt(along * along + off.w * off.w), 1e-6f);
  const Quat twist(off.w / n, cone.axis * (along / n));
  const Vec3 swing = rotation_vector(off * glm::conjugate(twist));
  const float f = glm::dot(swing, cone.across),
              s = glm::dot(swing, glm::cross(cone.axis, cone.across));
  const float reach =
      std::sqrt(f * f / (cone.flexion * cone.flexion) + s * s / (cone.side * cone.side));
  const float grow =
      std::max(1.0f, reach * (1 + kWidening / std::max(glm::length(swing), kWidening)));
  cone.flexion = std::min(cone.flexion * grow, radians(175));
  cone.side = std::min(cone.side * grow, radians(175));
  const float turned = std::abs(wrapped_angle(2 * std::atan2(along, off.w)));
  cone.twist = std::max(cone.twist, std::min(turned + kWidening, radians(178)));
  return cone;
}

}  // namespace ringcraft
