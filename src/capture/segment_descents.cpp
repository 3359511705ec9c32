// Falls, lying and rising, by the height of the hips.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_measure.h"

namespace ringcraft {
namespace {

constexpr float kDown = 0.72f;    // share of the usual height of the hips under which nobody stands
constexpr float kFloor = 0.20f;   // H: hips that come lower sit or lie
constexpr float kLeaves = 0.87f;  // share of the usual height at which a fall begins
constexpr float kStands = 0.95f;  // and at which a fighter stands again
constexpr float kOffFloor = 0.04f;  // H over the lowest place at which the hips leave the floor
constexpr float kLanded = 0.25f;    // m/s: hips that sink slower have landed
constexpr float kHandLow = 0.13f;   // H: a hand under it is on the floor
constexpr Tick kHandFirst = 60;     // ticks (0.5 s) before landing: a hand that feels for the floor
constexpr float kTrunkUp = radians(62);     // of a fighter who has risen: the trunk is last
constexpr Tick kTrunkAfter = 96;            // ticks it may take longer than the hips
constexpr float kSitting = radians(35);     // trunk elevation
constexpr float kUpsideDown = radians(30);  // of the trunk, head below the hips
constexpr Tick kRollOver = 120;             // ticks a roll is on the floor at most

float hips(const Measures& m, Tick t) {
  return m.at(Joint::hips, t).y;
}

Lying lying_at(const Measures& m, Tick t) {
  if (m.trunk[at(t)] > kSitting) return Lying::seat;
  const float chest = (m.world[at(t)].rotation[index(Joint::chest)] * kForward).y;  // +1: looks up
  if (chest > 0.5f) return Lying::back;
  if (chest < -0.5f) return Lying::front;
  return Lying::side;
}

// The stretch around `t` over which nobody stands.
void spread(const Measures& m, Tick t, Tick& first, Tick& last) {
  const float low = kDown * m.usual_hips;
  first = last = t;
  while (first > 0 && hips(m, first - 1) < low) --first;
  while (last < m.last && hips(m, last + 1) < low) ++last;
}

void find_fall(const Measures& m, Tick first, float lowest, Descent& d) {
  d.begin = first;
  while (d.begin > 0 && hips(m, d.begin) < kLeaves * m.usual_hips) --d.begin;
  Tick landed = first;
  while (landed < m.last && hips(m, landed) > lowest + kOffFloor * m.height) ++landed;
  d.down = landed;
  while (d.down < m.last && m.hips_climb[at(d.down)] < -kLanded) ++d.down;
  Tick hand = landed;
  for (Tick t = landed; t >= d.begin; --t)
    for (const Side side : kSides)
      if (m.at(arm(side).end, t).y < kHandLow * m.height) hand = t;
  d.controlled = landed - hand > kHandFirst;
  d.lying = lying_at(m, d.down);
  const float fastest =
      *std::min_element(m.hips_climb.begin() + d.begin, m.hips_climb.begin() + d.down + 1);
  d.evidence_down = fmt::format(
      "hips {:.2f} H at {:.2f} s, {:.2f} H at {:.2f} s, sinking {:.2f} m/s at most; a hand on the "
      "floor {:.2f} s before; trunk {:.0f} degrees up",
      hips(m, d.begin) / m.height, seconds(d.begin), hips(m, d.down) / m.height, seconds(d.down),
      -fastest, seconds(landed - hand), degrees(m.trunk[at(d.down)]));
}

void find_rise(const Measures& m, Tick last, float lowest, Descent& d) {
  if (last >= m.last) return;
  d.rise = last;
  while (d.rise > d.down && hips(m, d.rise) > lowest + kOffFloor * m.height) --d.rise;
  d.up = last;
  while (d.up < m.last && hips(m, d.up) < kStands * m.usual_hips) ++d.up;
  if (hips(m, d.up) < kLeaves * m.usual_hips) {
    d.rise = d.up = -1;
    return;
  }
  const Tick latest = m.clamped(d.up + kTrunkAfter);
  while (d.up < latest && m.trunk[at(d.up)] < kTrunkUp) ++d.up;
  const float fastest =
      *std::max_element(m.hips_climb.begin() + d.rise, m.hips_climb.begin() + d.up + 1);
  d.evidence_up = fmt::format(
      "hips {:.2f} H at {:.2f} s, {:.2f} H at {:.2f} s, rising {:.2f} m/s at most; trunk {:.0f} "
      "degrees up before",
      hips(m, d.rise) / m.height, seconds(d.rise), hips(m, d.up) / m.height, seconds(d.up), fastest,
      degrees(m.trunk[at(d.rise)]));
}

bool rolls_over(const Measures& m, Tick first, Tick last) {
  if (last - first > kRollOver || first == 0) return false;
  for (Tick t = first; t <= last; ++t)
    if (m.trunk[at(t)] < -kUpsideDown) return true;
  return false;
}

}  // namespace

std::vector<Descent> descents(const Measures& m) {
  std::vector<Descent> out;
  for (Tick t = 0; t <= m.last; ++t) {
    if (hips(m, t) >= kFloor * m.height) continue;
    Tick first = 0, last = 0;
    spread(m, t, first, last);
    float lowest = hips(m, t);
    for (Tick k = first; k <= last; ++k) lowest = std::min(lowest, hips(m, k));
    Descent d;
    d.starts_down = first == 0;
    d.rolls = rolls_over(m, first, last);
    if (!d.starts_down) find_fall(m, first, lowest, d);
    find_rise(m, last, lowest, d);
    d.rests = lying_at(m, d.rise >= 0 ? d.rise : last);
    if (d.starts_down) d.lying = lying_at(m, 0);
    d.left_lying = d.rise;
    while (d.left_lying > d.down && lying_at(m, d.left_lying) != d.lying) --d.left_lying;
    out.push_back(std::move(d));
    t = last;
  }
  return out;
}

}  // namespace ringcraft
