// Blows of the hands. A wrist's peak of speed is a blow by where it goes, not by how fast it is: a
// straight opens the arm along the gaze, most of it after the peak; a hook or an uppercut carries a
// bent arm ahead; a sweeping block opens it outward from across the body; a rising block lifts the
// forearm before the head. The gaze is the frame because a fighter looks at whom he hits while his
// hips and shoulders turn through a right angle (calibration: head yaw within 30 degrees of the
// opponent, pelvis -72 to +5 in one cross).

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_measure.h"

namespace ringcraft {
namespace {

constexpr Tick kPeakAround = 10;      // ticks: two peaks of one hand lie farther apart
constexpr Tick kWayOut = 48;          // ticks before the peak in which the way out begins
constexpr Tick kToReach = 22;         // ticks after it within which the arm is at full reach
constexpr Tick kPastReach = 5;        // ticks after the reach in which the arm still opens
constexpr Tick kOpensFrom = 36;       // ticks before the peak in which the arm is most bent
constexpr float kBegins = 0.25f;      // share of the peak speed at which a hand leaves
constexpr Tick kLongestReturn = 72;   // ticks
constexpr float kHeadBelow = 0.005f;  // H under the own shoulder that is still a blow to the head
constexpr float kChin = 0.78f;        // H: an uppercut or hook that rises past it goes to the head
constexpr Tick kOneStroke = 36;       // ticks
constexpr float kCloses = 0.10f;      // extension by which an arm closes between two blows
constexpr float kRisesBent =
    0.90f;  // extension of a rising block at most: the forearm lies before the head
constexpr float kUpright = radians(35);
constexpr float kSwings = 0.30f;      // along_arm under which a hand swings round its shoulder
constexpr float kSwingsBent = 0.92f;  // extension up to which such a swing is a bent-arm blow
constexpr float kSwingsUp = 0.60f;    // share of its velocity upward in an uppercut
constexpr float kSwingsIn = 0.50f;    // and inward in a hook
constexpr float kSweepsIn = 0.60f;    // share of the velocity inward of a hand that crosses over
constexpr float kCrossAhead = 0.47f;  // and ahead, which a blow has then at least
constexpr float kSteepDown = -0.75f;  // share of the velocity: a hand that drops does not strike
constexpr float kBentDown = -0.20f;

struct Stroke {
  Side side = Side::left;
  Tick peak = 0, start = 0, reach = 0;
  float speed = 0;
  Vec3 way{};         // direction of the velocity at the peak: outward, up, ahead
  Vec3 from{}, to{};  // wrist from the upper chest at start and reach, m, the same axes
  float least = 0, at_peak = 0, most = 0;  // extension before, at and after the peak
  float along_arm = 0;      // share of the velocity at the peak along the line from the shoulder
  float turned = 0;         // rad the gaze turns from start to reach
  float highest = 0;        // m: the wrist's top until shortly after the reach
  float over_shoulder = 0;  // m: the wrist over the own shoulder at the reach
};

Joint wrist_of(Side side) {
  return arm(side).end;
}

Stroke stroke_of(const Measures& m, Side side, Tick peak) {
  const Measures::LimbTracks& hand = m.hand[index(side)];
  const float gaze = m.gaze[at(peak)];
  const auto placed_at = [&](Tick t) {
    return seen_along(m.at(wrist_of(side), t) - m.at(Joint::upper_chest, t), gaze, side);
  };
  Stroke s;
  s.side = side;
  s.peak = peak;
  s.speed = hand.speed[at(peak)];
  s.way = normalized_or(
      seen_along(hand.from_hips[at(peak + 1)] - hand.from_hips[at(peak - 1)], gaze, side), kUp);
  s.along_arm =
      glm::dot(normalized_or(hand.from_hips[at(peak + 1)] - hand.from_hips[at(peak - 1)], kUp),
               normalized_or(m.at(wrist_of(side), peak) - m.at(arm(side).root, peak), -kUp));
  s.start = s.reach = peak;
  for (Tick t = peak; t >= m.clamped(peak - kWayOut); --t)
    if (placed_at(t).z < placed_at(s.start).z) s.start = t;
  for (Tick t = peak; t <= m.clamped(peak + kToReach); ++t)
    if (placed_at(t).z > placed_at(s.reach).z) s.reach = t;
  s.from = placed_at(s.start);
  s.to = placed_at(s.reach);
  s.at_peak = s.least = s.most = hand.extension[at(peak)];
  for (Tick t = m.clamped(peak - kOpensFrom); t <= peak; ++t)
    s.least = std::min(s.least, hand.extension[at(t)]);
  for (Tick t = peak; t <= m.clamped(peak + kToReach); ++t) {
    // What opens on the way back, as a runner's arm does, is no way out.
    if (t <= s.reach + kPastReach) s.most = std::max(s.most, hand.extension[at(t)]);
    s.highest = std::max(s.highest, m.at(wrist_of(side), t).y);
  }
  s.turned = std::abs(m.gaze[at(s.reach)] - m.gaze[at(s.start)]);
  s.over_shoulder = m.at(wrist_of(side), s.reach).y - m.at(arm(side).root, s.reach).y;
  return s;
}

bool able_to_strike(const Measures& m, const Stroke& s, const SegmentSettings& set) {
  return m.at(Joint::hips, s.peak).y > set.standing * m.usual_hips &&
         m.trunk[at(s.peak)] > kUpright;
}

bool opens(const Stroke& s, const SegmentSettings& set) {
  return s.most - s.least >= set.arm_opens && s.most - s.at_peak >= set.arm_opens_late &&
         s.most >= set.arm_open;
}

bool sweeps_out(const Measures& m, const Stroke& s, const SegmentSettings& set) {
  return s.speed >= set.block_speed && s.from.x < -set.across * m.height && s.way.x > 0.4f &&
         opens(s, set);
}

bool rises(const Measures& m, const Stroke& s, const SegmentSettings& set) {
  return s.speed >= set.block_speed && s.way.y >= set.rises && s.most >= set.bent_least &&
         s.most <= kRisesBent &&
         s.highest > m.at(arm(s.side).root, m.clamped(s.peak + kPeakAround)).y &&
         s.highest >= kChin * m.height;
}

// A hand that sweeps in more than it goes ahead parries.
bool crosses_over(const Stroke& s) {
  return s.way.x <= -kSweepsIn && s.way.z < kCrossAhead;
}

bool is_straight(const Stroke& s, const SegmentSettings& set) {
  return s.speed >= set.straight_speed && opens(s, set) && s.way.z >= set.goes_ahead &&
         !crosses_over(s) && s.way.y > kSteepDown;
}

bool is_bent(const Measures& m, const Stroke& s, const SegmentSettings& set) {
  return s.speed >= set.bent_speed && s.way.z >= set.bent_ahead && !crosses_over(s) &&
         s.way.y >= kBentDown && s.most >= set.bent_least &&
         s.to.z - s.from.z >= set.bent_gain * m.height && s.turned <= set.gaze_turn &&
         m.hips_speed[at(s.peak)] <= set.travelling;
}

// The hand leaves: the last moment before the peak at which it was slow.
Tick begin_of(const Measures& m, const Stroke& s) {
  const std::vector<float>& speed = m.hand[index(s.side)].speed;
  Tick t = s.peak;
  while (t > m.clamped(s.peak - kWayOut) && speed[at(t)] > kBegins * s.speed) --t;
  return t;
}

// The hand is back at half of its reach, or rests there.
Tick end_of(const Measures& m, const Stroke& s) {
  const float gaze = m.gaze[at(s.peak)];
  const float half = 0.5f * (s.from.z + s.to.z);
  Tick t = s.reach;
  while (t < m.clamped(s.reach + kLongestReturn)) {
    const Vec3 now =
        seen_along(m.at(wrist_of(s.side), t) - m.at(Joint::upper_chest, t), gaze, s.side);
    if (now.z < half) break;
    ++t;
  }
  return t;
}

FoundBlow blow_of(const Measures& m, const Stroke& s, StrikeKind kind, bool blocks,
                  const char* what) {
  FoundBlow blow;
  blow.blocks = blocks;
  blow.strike.kind = kind;
  blow.strike.joint = wrist_of(s.side);
  blow.strike.at = seconds(s.peak);
  const bool high = kind == StrikeKind::straight ? s.over_shoulder > -kHeadBelow * m.height
                                                 : s.highest >= kChin * m.height;
  blow.strike.zone = high ? TargetZone::head : TargetZone::body;
  blow.begin = seconds(begin_of(m, s));
  blow.reach = seconds(s.reach);
  blow.end = seconds(end_of(m, s));
  blow.evidence = fmt::format(
      "{} hand {:.1f} m/s at {:.2f} s, {}: arm {:.2f} -> {:.2f} of its length, {:.2f} at the peak, "
      "goes {:+.2f} ahead {:+.2f} out {:+.2f} up, {:.2f} H ahead at {:.2f} H height",
      word(s.side), s.speed, seconds(s.peak), what, s.least, s.most, s.at_peak, s.way.z, s.way.x,
      s.way.y, (s.to.z - s.from.z) / m.height, m.at(wrist_of(s.side), s.reach).y / m.height);
  return blow;
}

std::optional<FoundBlow> classified(const Measures& m, const Stroke& s,
                                    const SegmentSettings& set) {
  if (!able_to_strike(m, s, set)) return std::nullopt;
  if (sweeps_out(m, s, set))
    return blow_of(m, s, StrikeKind::hook, true, "sweeps out from across the body");
  if (rises(m, s, set)) return blow_of(m, s, StrikeKind::uppercut, true, "rises before the head");
  const bool swings = s.along_arm < kSwings && s.most <= kSwingsBent;
  if (is_straight(s, set)) {
    if (swings && s.way.y >= kSwingsUp && s.highest >= kChin * m.height)
      return blow_of(m, s, StrikeKind::uppercut, false, "rises to the chin, opening");
    if (swings && s.way.x <= -kSwingsIn)
      return blow_of(m, s, StrikeKind::hook, false, "swings in, opening");
    return blow_of(m, s, StrikeKind::straight, false, "opens along the gaze");
  }
  if (!is_bent(m, s, set)) return std::nullopt;
  const bool up = s.way.y > 0.7f && s.highest >= kChin * m.height;
  return blow_of(m, s, up ? StrikeKind::uppercut : StrikeKind::hook, false,
                 up ? "rises to the chin, bent" : "goes ahead, bent");
}

// Two peaks of one hand without the arm closing between them are one blow, the faster.
void keep_faster_of_one_stroke(const Measures& m, Side side, std::vector<Stroke>& strokes) {
  const std::vector<float>& extension = m.hand[index(side)].extension;
  const auto one_stroke = [&](const Stroke& a, const Stroke& b) {
    if (b.peak - a.peak > kOneStroke) return false;
    const auto first = extension.begin() + a.peak;
    const auto last = extension.begin() + b.peak + 1;
    const float least = *std::min_element(first, last);
    return least > std::min(extension[at(a.peak)], extension[at(b.peak)]) - kCloses;
  };
  std::vector<Stroke> kept;
  for (const Stroke& stroke : strokes) {
    if (kept.empty() || !one_stroke(kept.back(), stroke))
      kept.push_back(stroke);
    else if (stroke.speed > kept.back().speed)
      kept.back() = stroke;
  }
  strokes = std::move(kept);
}

}  // namespace

std::vector<FoundBlow> hand_blows(const Measures& measures, const SegmentSettings& settings) {
  std::vector<FoundBlow> blows;
  const float least =
      std::min({settings.straight_speed, settings.bent_speed, settings.block_speed});
  for (const Side side : kSides) {
    std::vector<Stroke> strokes;
    for (const Tick peak :
         swings_of(measures.hand[index(side)].speed, least, kPeakAround, settings)) {
      const Stroke stroke = stroke_of(measures, side, peak);
      if (classified(measures, stroke, settings)) strokes.push_back(stroke);
    }
    keep_faster_of_one_stroke(measures, side, strokes);
    for (const Stroke& stroke : strokes) blows.push_back(*classified(measures, stroke, settings));
  }
  std::stable_sort(blows.begin(), blows.end(), [](const FoundBlow& a, const FoundBlow& b) {
    return a.strike.at < b.strike.at;
  });
  return blows;
}

}  // namespace ringcraft
