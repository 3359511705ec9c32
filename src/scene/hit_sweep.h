#pragma once
// A sweep of hits on one posed body: the map of what it absorbs, what it steps from and what fells
// it.

#include <atomic>
#include <functional>

#include "scene/single_hit.h"

namespace ringcraft {

enum class SweepAxis : std::uint8_t { impulse, direction, tone };
std::string_view name_of(SweepAxis axis);
std::string_view unit_of(SweepAxis axis);  // "N s", "deg", ""

struct SweepRange {
  SweepAxis axis = SweepAxis::impulse;
  std::vector<double> values;  // ascending
};

inline constexpr std::size_t kMostSweepPoints = 20'000;

// "impulse=0:200:5" (N s), "direction=0:360:15" (deg in which the body is pushed: 0 fore, 90 to its
// own left; a turn is not repeated) or "tone=0.2:1:0.2"; a single value stands for itself. A usage
// error else.
Result<SweepRange> sweep_range(const std::string& text);

struct SweepPoint {
  double impulse = 0, direction = 0, tone = 1;  // N s, deg, 0 .. 1
  bool done = false;                            // not where the sweep was interrupted
  ImpactOutcome outcome;                        // its direction is a world yaw
};

struct HitSweep {
  std::vector<SweepRange> ranges;  // in the order given; the last one runs fastest
  std::vector<SweepPoint> points;
  float facing = 0;  // rad: world yaw of the body's own fore
  bool interrupted = false;
  std::string title, what;  // whose body; which pose and part, and what no range varies
};

struct SweepOptions {
  int threads = 1;  // never changes the result
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(std::size_t, std::size_t)> progress;  // done, all; from any thread
};

// Every point of the ranges. What no range varies is as in the query; its impulse is taken as size,
// direction over the ground and steepness, which no range varies. What would not interrupt the body
// (physics/response.h) is absorbed. A usage error where an axis stands twice or the points are too
// many.
Result<HitSweep> sweep_hits(const MotionLibrary& library, const HitQuery& query,
                            std::vector<SweepRange> ranges, const SweepOptions& options = {});

std::string sweep_csv(const HitSweep& sweep);
// The same as JSON text.
std::string sweep_json(const HitSweep& sweep);

}  // namespace ringcraft
