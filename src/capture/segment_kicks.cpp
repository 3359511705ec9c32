// Kicks: a leg folds, opens and brings the foot up before the fighter. Which kick it is follows
// from the hips: turning through in a roundhouse, round about in a spin, side on in a side kick.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_measure.h"

namespace ringcraft {
namespace {

constexpr Tick kPeakAround = 14;   // ticks
constexpr Tick kChamber = 42;      // ticks before the peak in which the leg is most folded
constexpr Tick kToReach = 26;      // ticks after it within which the leg is at full reach
constexpr Tick kTurnOver = 72;     // ticks (0.6 s) up to just after the reach
constexpr Tick kSpinBefore = 120;  // ticks (1 s) before the reach
constexpr Tick kSpinAfter = 36;    // and after it, over which a spin turns
constexpr Tick kAfterReach = 10;   // ticks
constexpr Tick kLongestUp = 180;   // ticks a foot is up before and after
constexpr float kFloor = 0.10f;    // H: an ankle under it stands or shuffles
constexpr float kSupport = 0.17f;  // H: the other foot's height at most, but in a spin
constexpr float kSideOn = 0.50f;   // share of the reach that points out of the hip
constexpr float kTurnedAside = radians(50);  // the hips off the gaze in a side kick
constexpr float kRoundOpens =
    0.6f;                          // share of leg_opens that is enough where the hips turn through
constexpr float kThrusts = 0.80f;  // share of the velocity along the leg: side kicks push
constexpr float kHead = 0.80f;     // H
constexpr float kLegs = 0.44f;     // H

struct Swing {
  Side side = Side::left;
  Tick peak = 0, chamber = 0, reach = 0;
  float speed = 0;
  float folded = 0, open = 0;  // hip-ankle over leg length
  float height = 0;            // m: the ankle at full reach
  float ahead = 0;             // m past the hips along the gaze at full reach
  float out = 0;               // share of the reach over the ground that points out of the hip
  float aside = 0;             // rad of the hips off the gaze
  float thrust = 0;            // share of the peak velocity along the leg
  float turn = 0;              // rad the hips turn in 0.6 s, toward the other side positive
  float spin = 0;              // rad in 1.3 s
  float other_foot = 0;        // m: highest between chamber and reach
};

Swing swing_of(const Measures& m, Side side, Tick peak) {
  const Measures::LimbTracks& leg_tracks = m.foot[index(side)];
  const Joint foot = leg(side).end;
  Swing s;
  s.side = side;
  s.peak = s.chamber = s.reach = peak;
  s.speed = leg_tracks.speed[at(peak)];
  for (Tick t = m.clamped(peak - kChamber); t <= peak; ++t)
    if (leg_tracks.extension[at(t)] < leg_tracks.extension[at(s.chamber)]) s.chamber = t;
  for (Tick t = peak; t <= m.clamped(peak + kToReach); ++t) {
    const bool up = m.at(foot, t).y > kFloor * m.height;
    if (up && leg_tracks.extension[at(t)] > leg_tracks.extension[at(s.reach)]) s.reach = t;
  }
  s.folded = leg_tracks.extension[at(s.chamber)];
  s.open = leg_tracks.extension[at(s.reach)];
  s.height = m.at(foot, s.reach).y;
  const Vec3 way = m.at(foot, s.reach) - m.at(Joint::hips, s.reach);
  s.ahead = seen_along(way, m.gaze[at(peak)], side).z;
  const Vec3 velocity =
      normalized_or(leg_tracks.from_hips[at(peak + 1)] - leg_tracks.from_hips[at(peak - 1)], kUp);
  s.thrust = glm::dot(velocity, normalized_or(m.at(foot, peak) - m.at(leg(side).root, peak), -kUp));
  s.aside = std::abs(wrapped_angle(m.gaze[at(peak)] - m.pelvis_yaw[at(peak)]));
  const Vec3 own = seen_along(way, m.pelvis_yaw[at(s.reach)], side);
  s.out = own.x / std::max(0.01f, std::hypot(own.x, own.z));
  const Tick after = m.clamped(s.reach + kAfterReach);
  const float turn = m.pelvis_yaw[at(after)] - m.pelvis_yaw[at(m.clamped(after - kTurnOver))];
  s.turn = side == Side::right ? turn : -turn;
  const auto [least, most] =
      std::minmax_element(m.pelvis_yaw.begin() + m.clamped(s.reach - kSpinBefore),
                          m.pelvis_yaw.begin() + m.clamped(s.reach + kSpinAfter) + 1);
  s.spin = *most - *least;
  for (Tick t = s.chamber; t <= s.reach; ++t)
    s.other_foot = std::max(s.other_foot, m.at(leg(other(side)).end, t).y);
  return s;
}

bool is_kick(const Measures& m, const Swing& s, const SegmentSettings& set) {
  const bool spins = s.spin >= set.spin_turn;
  const float opens = set.leg_opens * (s.turn >= set.round_turn ? kRoundOpens : 1.0f);
  return s.folded <= set.leg_folds && s.open - s.folded >= opens &&
         s.height >= set.kick_height * m.height && s.ahead >= set.kick_ahead * m.height &&
         (spins || s.other_foot <= kSupport * m.height) &&
         m.at(Joint::hips, s.peak).y >= set.standing * m.usual_hips;
}

// From full reach back or on until the foot is near the floor.
Tick down_from(const Measures& m, const Swing& s, int step) {
  Tick t = s.reach;
  for (Tick k = 0; k < kLongestUp; ++k) {
    const Tick next = t + step;
    if (next < 0 || next > m.last || m.at(leg(s.side).end, t).y < kFloor * m.height) break;
    t = next;
  }
  return t;
}

FoundBlow blow_of(const Measures& m, const Swing& s, const SegmentSettings& set) {
  FoundBlow blow;
  blow.spins = s.spin >= set.spin_turn;
  StrikeKind kind = StrikeKind::front_kick;
  if (blow.spins || s.turn >= set.round_turn)
    kind = StrikeKind::roundhouse;
  else if (s.out >= kSideOn && s.thrust >= kThrusts && s.aside >= kTurnedAside)
    kind = StrikeKind::side_kick;
  blow.strike.kind = kind;
  blow.strike.joint = leg(s.side).end;
  blow.strike.at = seconds(s.peak);
  blow.strike.zone = s.height >= kHead * m.height   ? TargetZone::head
                     : s.height >= kLegs * m.height ? TargetZone::body
                                                    : TargetZone::leg;
  blow.begin = seconds(down_from(m, s, -1));
  blow.reach = seconds(s.reach);
  blow.end = seconds(down_from(m, s, +1));
  blow.evidence = fmt::format(
      "{} foot {:.1f} m/s at {:.2f} s: leg {:.2f} -> {:.2f} of its length, ankle at {:.2f} H, "
      "{:.2f} H ahead, {:.2f} of the reach out of the hip, {:+.2f} of the velocity along the leg; "
      "hips turn {:+.0f} degrees in 0.6 s, "
      "{:.0f} in 1.3 s",
      word(s.side), s.speed, blow.strike.at, s.folded, s.open, s.height / m.height,
      s.ahead / m.height, s.out, s.thrust, degrees(s.turn), degrees(s.spin));
  return blow;
}

}  // namespace

std::vector<FoundBlow> kicks(const Measures& measures, const SegmentSettings& settings) {
  std::vector<FoundBlow> blows;
  for (const Side side : kSides) {
    for (const Tick peak :
         swings_of(measures.foot[index(side)].speed, settings.kick_speed, kPeakAround, settings)) {
      const Swing swing = swing_of(measures, side, peak);
      if (!is_kick(measures, swing, settings)) continue;
      FoundBlow blow = blow_of(measures, swing, settings);
      // The way back of a kick is no second one.
      const bool again = !blows.empty() && blows.back().strike.joint == blow.strike.joint &&
                         blow.strike.at < blows.back().end;
      if (!again) blows.push_back(std::move(blow));
    }
  }
  std::stable_sort(blows.begin(), blows.end(), [](const FoundBlow& a, const FoundBlow& b) {
    return a.strike.at < b.strike.at;
  });
  return blows;
}

}  // namespace ringcraft
