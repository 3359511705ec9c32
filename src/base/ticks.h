#pragma once
// Time inside the simulation: an integer tick of 1/120 s.

#include <cmath>
#include <cstdint>

namespace ringcraft {

using Tick = std::int32_t;

inline constexpr Tick kTicksPerSecond = 120;
inline constexpr float kTickSeconds = 1.0f / 120.0f;

inline constexpr double seconds(Tick ticks) {
  return static_cast<double>(ticks) / kTicksPerSecond;
}

// Nearest tick.
inline Tick ticks(double seconds) {
  return static_cast<Tick>(std::lround(seconds * kTicksPerSecond));
}

}  // namespace ringcraft
