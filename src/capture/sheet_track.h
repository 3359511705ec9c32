#pragma once
// Curves through keys: smooth tracks over time, and strike paths with a measured speed profile.

#include <string_view>
#include <vector>

#include "base/vec.h"

namespace ringcraft {

// A C1 curve through values at times, without overshoot (Fritsch, Carlson 1980); constant outside.
class Track {
 public:
  // Times ascend; a value at the same time (within 1e-4 s) as the last one replaces it.
  void add(float t, Vec3 value);
  Vec3 at(float t) const;
  bool empty() const { return t_.empty(); }
  float last_time() const { return t_.back(); }

 private:
  std::vector<float> t_;
  std::vector<Vec3> v_;
  mutable std::vector<Vec3> slope_;
  void fit() const;
};

// Speed over peak speed at 0, 0.1 .. 1 of the limb's startup, as measured: near-linear rise, late
// peak, a brake harder than the push, still moving at full extension. Unknown names give nullptr.
const std::vector<float>* speed_profile(std::string_view name);

// The window of a strike on a path: between the two times the profile rules, not the keys' times.
struct ProfileWindow {
  float start = 0, contact = 0;  // s
  const std::vector<float>* profile = nullptr;
};

// A path through points whose speed follows measured profiles inside windows and the keys' times
// elsewhere. Keys inside a window shape the path only; a window starts and ends at a key.
class StrikePath {
 public:
  StrikePath(const std::vector<float>& times, const std::vector<Vec3>& points,
             const std::vector<ProfileWindow>& windows);
  Vec3 at(float t) const;

 private:
  Vec3 point(float arc) const;
  std::vector<float> arc_;  // arc length at dense samples
  std::vector<Vec3> dense_;
  Track arc_of_time_;
};

// Gaussian filter over ticks, zero phase; the ends keep their values.
void smooth(std::vector<Vec3>& values, float sigma_ticks);
void smooth(std::vector<Quat>& rotations, float sigma_ticks);

// Largest value within `reach` ticks, then smoothed: never below the input, without kinks.
void widen(std::vector<float>& values, int reach);

}  // namespace ringcraft
