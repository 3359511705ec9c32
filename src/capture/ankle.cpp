#include "capture/ankle.h"

#include <cmath>

namespace ringcraft {

namespace {

// Ankle ranges, rad, and how long before its end a range begins to resist.
constexpr float kPlantar = radians(60), kDorsal = radians(35), kSideways = radians(35);
constexpr float kAnkleEase = radians(6);

// Nearer to zero where `angle` comes close to `limit`, which it never passes.
float held_within(float angle, float limit) {
  const float free = limit - kAnkleEase, over = std::abs(angle) - free;
  if (over <= 0) return angle;
  return std::copysign(free + kAnkleEase * (1 - std::exp(-over / kAnkleEase)), angle);
}

}  // namespace

Quat ankle_within_range(Quat ankle) {
  const float bend = wrapped_angle(2 * std::atan2(ankle.x, ankle.w));
  Vec3 swing = rotation_vector(ankle * glm::angleAxis(-bend, kLeft));
  swing.y = held_within(swing.y, kSideways);
  swing.z = held_within(swing.z, kSideways);
  const float kept = held_within(bend, bend < 0 ? kDorsal : kPlantar);
  return glm::normalize(from_rotation_vector(swing) * glm::angleAxis(kept, kLeft));
}

}  // namespace ringcraft
