#pragma once
// Smoothing of tracks that hold one value a tick.

#include <vector>

#include "base/vec.h"

namespace ringcraft {

// Gaussian mean, `sigma` in seconds; each value counts by its weight. Where no weight is near, the
// values between are interpolated from the nearest that have some.
std::vector<float> smoothed(const std::vector<float>& values, const std::vector<float>& weights,
                            float sigma);
std::vector<float> smoothed(const std::vector<float>& values, float sigma);
std::vector<Vec3> smoothed(const std::vector<Vec3>& values, float sigma);

// Of all values within `around` ticks the one farthest from zero: smoothed afterwards, a track
// still gives each moment what it needs.
std::vector<float> widened(const std::vector<float>& needs, std::size_t around);

// Angles in radians without jumps of a full turn.
std::vector<float> unwrapped(std::vector<float> angles);

// Runs of `value` shorter than `ticks` between two others are turned over.
void close_short_runs(std::vector<bool>& flags, bool value, std::size_t ticks);

}  // namespace ringcraft
