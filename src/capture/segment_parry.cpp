// Parries: a hand that is no strike sweeps in across the body and comes back to the guard.

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "capture/segment_pieces.h"

namespace ringcraft {
namespace {

constexpr float kFast = 1.9f;     // m/s of the wrist relative to the hips
constexpr float kInward = 0.45f;  // share of the peak velocity toward the other side
constexpr float kRise = 0.5f;     // and upward at most
constexpr float kSweeps = 0.06f;  // H it goes inward
constexpr Tick kPeakAround = 12;  // ticks
constexpr Tick kWay = 24;         // ticks of the way before and after the peak
constexpr Tick kGuards = 12;      // ticks before and after the peak over which it protects
constexpr Tick kShortest = 20;    // ticks from the peak to either end
constexpr Tick kLongest = 48;
constexpr float kNear = 0.20f;   // m rms of both ends from the guard
constexpr Tick kBothHands = 36;  // ticks within which the other hand does the same: no parry

bool sweeps_in(const Measures& m, Side side, Tick peak) {
  const std::vector<Vec3>& hand = m.hand[index(side)].from_hips;
  const auto here = static_cast<std::size_t>(peak);
  const float gaze = m.gaze[here];
  const auto outward = [&](Tick t) {
    return seen_along(hand[static_cast<std::size_t>(m.clamped(t))], gaze, side).x;
  };
  const Vec3 way =
      normalized_or(seen_along(hand[here + 1] - hand[here - 1], gaze, side), Vec3(1, 0, 0));
  float before = outward(peak);
  float after = before;
  for (Tick k = 0; k <= kWay; ++k) {
    before = std::max(before, outward(peak - k));
    after = std::min(after, outward(peak + k));
  }
  return way.x <= -kInward && way.y <= kRise && before - after >= kSweeps * m.height;
}

}  // namespace

std::vector<FoundAction> parry_segments(const Found& found) {
  std::vector<FoundAction> out;
  const Measures& m = found.measures;
  if (!found.guard.fights) return out;
  std::vector<bool> free = free_ticks(m, found.blows, found.descents);
  for (const Stretch& s : found.staggers)
    std::fill(free.begin() + s.first, free.begin() + s.last + 1, false);
  std::array<std::vector<Tick>, 2> sweeps;
  for (const Side side : kSides)
    for (const Tick peak : peaks_of(m.hand[index(side)].speed, kFast, kPeakAround))
      if (free[static_cast<std::size_t>(peak)] && sweeps_in(m, side, peak))
        sweeps[index(side)].push_back(peak);
  for (const Side side : kSides) {
    for (const Tick peak : sweeps[index(side)]) {
      const std::vector<Tick>& others = sweeps[index(other(side))];
      if (std::any_of(others.begin(), others.end(),
                      [&](Tick t) { return std::abs(t - peak) <= kBothHands; }))
        continue;
      const Tick begin = nearest_to_guard(found, m.clamped(peak - kLongest),
                                          m.clamped(peak - kShortest), peak - kWay);
      const Tick end = nearest_to_guard(found, m.clamped(peak + kShortest),
                                        m.clamped(peak + kLongest), peak + kWay);
      const auto far = [&](Tick t) {
        return found.guard.distance[static_cast<std::size_t>(t)] > kNear;
      };
      if (peak - begin < kShortest || end - peak < kShortest || far(begin) || far(end)) continue;
      FoundAction parry;
      parry.cut.kind = Kind::defense;
      parry.cut.name = fmt::format("parry_{}", word(side));
      parry.cut.begin = seconds(begin);
      parry.cut.end = seconds(end);
      parry.cut.defense = Defense{DefenseKind::parry, peak - kGuards, peak + kGuards};
      parry.evidence =
          fmt::format("{} hand {:.1f} m/s at {:.2f} s sweeps in across the body", word(side),
                      m.hand[index(side)].speed[static_cast<std::size_t>(peak)], seconds(peak));
      out.push_back(std::move(parry));
    }
  }
  return out;
}

}  // namespace ringcraft
