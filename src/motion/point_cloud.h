#pragma once
// Point clouds of two moments of motion, and the floor placement that lays one on the other
// (Kovar, Gleicher, Pighin 2002, eq. 2-4).
//
// A cloud holds every joint where it is and, by its velocity over four ticks, where it will be
// 0.1 s later: a window to the first order, which also exists at the ends of a clip.

#include <array>
#include <cstddef>
#include <span>

#include "motion/clip.h"

namespace ringcraft {

inline constexpr std::size_t kCloudPoints = 2 * kJointCount;

// Positions in m; feet and hips weigh more, what is foreseen half.
struct Cloud {
  std::array<Vec3, kCloudPoints> position{};
};
const std::array<float, kCloudPoints>& cloud_weights();

// How one moment lies on another.
struct Alignment {
  Placement placement;  // of what comes second, relative to what comes first
  float distance = 0;   // root mean square of the aligned joint distances, m
};

// The clip at `tick`, seen from its root there.
Cloud cloud_at(const Skeleton& skeleton, const Clip& clip, Tick tick);

// Best placement of `second` on `first`.
Alignment align(const Cloud& first, const Cloud& second);
// The same for any points; all three have one length.
Alignment align(std::span<const Vec3> first, std::span<const Vec3> second,
                std::span<const float> weight);

}  // namespace ringcraft
