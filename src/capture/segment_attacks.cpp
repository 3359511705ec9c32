// Strikes, combinations and blocks, cut where the body is nearest to its guard.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_pieces.h"

namespace ringcraft {
namespace {

constexpr Tick kBodyBefore =
    14;                         // ticks the body starts before the hand (calibration: 0 to 0.11 s)
constexpr Tick kEarliest = 60;  // ticks before the hand leaves in which an action may begin
constexpr Tick kSettles = 18;   // ticks after the hand is back at which an action wants to end
constexpr Tick kLatest = 84;    // ticks after the hand is back by which it ends
constexpr Tick kInside = 8;     // ticks a strike's peak lies inside its action at least
constexpr Tick kAfterReach = 10;    // ticks after full reach before which nothing ends
constexpr float kTogether = 0.45f;  // s from one full reach to the next hand's leaving
constexpr float kParted = 0.17f;    // m rms from the guard at which a combination can be parted
constexpr float kStrange = 0.25f;   // m rms from the guard at which a pose says nothing of facing
constexpr float kHaste = 0.06f;     // m rms that a second away from the wanted moment costs

struct Span {
  Tick begin = 0, end = 0;
};

std::string name_of_strike(const Found& found, const FoundBlow& blow) {
  const Joint joint = blow.strike.joint;
  const bool left = joint == Joint::left_hand || joint == Joint::left_foot;
  const bool lead = left != found.guard.southpaw;
  const char* side = left ? "left" : "right";
  const bool high = blow.strike.zone == TargetZone::head;
  std::string what(name_of(blow.strike.kind));
  if (blow.strike.kind == StrikeKind::straight && found.guard.fights)
    what = lead ? "jab" : "cross";
  else if (blow.strike.kind == StrikeKind::hook && !high)
    what = "body_hook";
  else if (blow.spins)
    what = "spin_kick";
  return fmt::format("{}_{}", what, side);
}

bool runs_on(const FoundBlow& a, const FoundBlow& b) {
  return b.begin - a.reach <= static_cast<double>(kTogether);
}

// Where blows first..last of the list can be cut out; the neighbours keep theirs to themselves.
Span span_of(const Found& found, std::size_t first, std::size_t last) {
  const Measures& m = found.measures;
  const FoundBlow& head = found.blows[first];
  const FoundBlow& tail = found.blows[last];
  const Tick leaves = std::min(ticks(head.begin), ticks(head.strike.at) - kInside);
  Tick earliest = leaves - kEarliest;
  if (first > 0) earliest = std::max(earliest, ticks(found.blows[first - 1].reach) + kAfterReach);
  Tick latest = ticks(tail.end) + kLatest;
  if (last + 1 < found.blows.size()) latest = std::min(latest, ticks(found.blows[last + 1].begin));
  for (const Descent& d : found.descents) {
    if (d.begin > ticks(tail.reach)) latest = std::min(latest, d.begin);
    if (d.up >= 0 && d.up < leaves) earliest = std::max(earliest, d.up);
  }
  const Tick after = ticks(tail.reach) + kAfterReach;
  Span span;
  span.begin = nearest_to_guard(found, m.clamped(std::min(earliest, leaves)), m.clamped(leaves),
                                leaves - kBodyBefore);
  span.end = nearest_to_guard(found, m.clamped(after), m.clamped(std::max(after, latest)),
                              ticks(tail.end) + kSettles);
  return span;
}

// Where the body faces at the ends of a cut that do not look like its guard: at the beginning the
// way the first strike goes (blocks: the way the fighter looks), from there as the gaze turns.
void face_opponent(const Found& found, const FoundBlow& first, Span span, ActionCut& cut) {
  const Measures& m = found.measures;
  const std::vector<float>& distance = found.guard.distance;
  const auto tick = [](Tick t) { return static_cast<std::size_t>(t); };
  const bool strange = distance[tick(span.begin)] > kStrange || distance[tick(span.end)] > kStrange;
  if (found.guard.fights && !strange) return;
  const Tick reach = ticks(first.reach);
  const Vec3 way = m.at(first.strike.joint, reach) - m.at(Joint::hips, reach);
  cut.facing_begin = first.blocks ? m.gaze[tick(reach)] : yaw_of(way);
  cut.facing_end = *cut.facing_begin;
  if (first.strike.kind == StrikeKind::roundhouse)
    *cut.facing_end += m.gaze[tick(span.end)] - m.gaze[tick(span.begin)];
}

FoundAction segment_of(const Found& found, std::size_t first, std::size_t last, Span span) {
  FoundAction segment;
  ActionCut& cut = segment.cut;
  cut.kind = first == last ? Kind::attack : Kind::combination;
  cut.begin = seconds(span.begin);
  cut.end = seconds(span.end);
  for (std::size_t i = first; i <= last; ++i) {
    const FoundBlow& blow = found.blows[i];
    cut.strikes.push_back(blow.strike);
    cut.name += (i == first ? "" : "_") + name_of_strike(found, blow);
    segment.evidence += (i == first ? "" : "; then ") + blow.evidence;
  }
  face_opponent(found, found.blows[first], span, cut);
  segment.evidence += fmt::format("; begins {:.2f} m and ends {:.2f} m from the guard",
                                  found.guard.distance[static_cast<std::size_t>(span.begin)],
                                  found.guard.distance[static_cast<std::size_t>(span.end)]);
  return segment;
}

bool cuttable(const Found& found, std::size_t first, std::size_t last, Span span) {
  return ticks(found.blows[first].strike.at) - span.begin >= kInside &&
         span.end - ticks(found.blows[last].strike.at) >= kInside;
}

// Strikes chain_first..chain_last follow each other: whole, in pairs and one by one, where the body
// comes near enough to its guard between them.
void add_chain(const Found& found, std::size_t chain_first, std::size_t chain_last,
               std::vector<FoundAction>& out) {
  for (std::size_t first = chain_first; first <= chain_last; ++first) {
    for (std::size_t last = first; last <= chain_last; ++last) {
      const std::size_t count = last - first + 1;
      const bool whole = first == chain_first && last == chain_last;
      if (count > kMostStrikes || (count > 2 && !whole)) continue;
      const Span span = span_of(found, first, last);
      if (!cuttable(found, first, last, span)) continue;
      const auto near = [&](Tick t) {
        return found.guard.distance[static_cast<std::size_t>(t)] <= kParted;
      };
      const bool parts =
          (first == chain_first || near(span.begin)) && (last == chain_last || near(span.end));
      if (parts) out.push_back(segment_of(found, first, last, span));
    }
  }
}

}  // namespace

Tick nearest_to_guard(const Found& found, Tick first, Tick last, Tick wanted) {
  Tick best = first;
  float least = 1e9f;
  for (Tick t = first; t <= last; ++t) {
    const float cost = found.guard.distance[static_cast<std::size_t>(t)] +
                       kHaste * std::abs(static_cast<float>(t - wanted)) * kTickSeconds;
    if (cost < least) {
      least = cost;
      best = t;
    }
  }
  return best;
}

std::vector<FoundAction> attack_segments(const Found& found) {
  std::vector<FoundAction> out;
  const std::vector<FoundBlow>& blows = found.blows;
  for (std::size_t i = 0; i < blows.size();) {
    if (blows[i].blocks) {
      ++i;
      continue;
    }
    std::size_t last = i;
    while (last + 1 < blows.size() && !blows[last + 1].blocks &&
           runs_on(blows[last], blows[last + 1]))
      ++last;
    add_chain(found, i, last, out);
    i = last + 1;
  }
  return out;
}

std::vector<FoundAction> block_segments(const Found& found) {
  std::vector<FoundAction> out;
  for (std::size_t i = 0; i < found.blows.size(); ++i) {
    const FoundBlow& blow = found.blows[i];
    if (!blow.blocks) continue;
    const Span span = span_of(found, i, i);
    FoundAction segment;
    const bool left = blow.strike.joint == Joint::left_hand;
    segment.cut.kind = Kind::defense;
    segment.cut.name =
        fmt::format("{}_block_{}", blow.strike.zone == TargetZone::head ? "rising" : "low",
                    left ? "left" : "right");
    segment.cut.begin = seconds(span.begin);
    segment.cut.end = seconds(span.end);
    segment.cut.defense = Defense{DefenseKind::parry, ticks(blow.strike.at) - kInside,
                                  ticks(blow.reach) + kAfterReach};
    face_opponent(found, blow, span, segment.cut);
    segment.evidence = blow.evidence;
    out.push_back(std::move(segment));
  }
  return out;
}

}  // namespace ringcraft
