// What lies between strikes and falls. The body comes back to its guard again and again; from one
// such moment to the next it has stood, stepped, turned, slipped, ducked or swayed.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_pieces.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr Tick kAside = 12;     // ticks kept from strikes
constexpr float kNear = 0.17f;  // m rms from the guard at which a piece may begin and end
constexpr Tick kMinimum = 8;    // ticks around over which a moment is the nearest one
constexpr Tick kShortest = 36;  // ticks of a piece
constexpr Tick kLongest = 156;
constexpr float kStep = 0.09f;  // H the hips go in a step
constexpr float kTurn = radians(30);
constexpr float kSlip = 0.085f;      // H the head leaves the line to one side
constexpr float kDuck = 0.10f;       // H it sinks
constexpr float kSway = 0.085f;      // H it goes back
constexpr float kHighGuard = 0.20f;  // H from both wrists to the head
constexpr std::size_t kOfEach = 4;   // pieces kept of one name, those nearest to the guard

struct Piece {
  Tick begin = 0, end = 0;
  Vec3 way{};                      // H: hips over the ground, in the facing at the begin
  float turn = 0;                  // rad
  Vec3 head_least{}, head_most{};  // H: the head off the line between its ends, the same axes
  float hands = 0;                 // H: mean distance of the farther wrist to the head
};

// Moments of a free stretch at which the body is nearest to its guard.
std::vector<Tick> rests_in(const Found& found, Tick first, Tick last) {
  const std::vector<float>& distance = found.guard.distance;
  std::vector<Tick> rests;
  for (Tick t = first; t <= last; ++t) {
    bool nearest = distance[at(t)] <= kNear;
    for (Tick k = std::max(first, t - kMinimum); k <= std::min(last, t + kMinimum) && nearest; ++k)
      nearest = k < t ? distance[at(k)] > distance[at(t)] : distance[at(k)] >= distance[at(t)];
    if (nearest) rests.push_back(t);
  }
  return rests;
}

Piece piece_of(const Found& found, const std::vector<Vec3>& ground, Tick begin, Tick end) {
  const Measures& m = found.measures;
  Piece p;
  p.begin = begin;
  p.end = end;
  const float facing = found.guard.facing[at(begin)];
  const auto seen = [&](Vec3 v) { return seen_along(v, facing, Side::left) / m.height; };
  p.way = seen(ground[at(end)] - ground[at(begin)]);
  p.turn = wrapped_angle(found.guard.facing[at(end)] - facing);
  const auto feet = [&](Tick t) {
    return 0.5f * (m.at(Joint::left_foot, t) + m.at(Joint::right_foot, t));
  };
  const Vec3 from = m.at(Joint::head, begin) - feet(begin);
  const Vec3 to = m.at(Joint::head, end) - feet(end);
  for (Tick t = begin; t <= end; ++t) {
    const float share = static_cast<float>(t - begin) / static_cast<float>(end - begin);
    const Vec3 off = seen(m.at(Joint::head, t) - feet(t) - glm::mix(from, to, share));
    p.head_least = glm::min(p.head_least, off);
    p.head_most = glm::max(p.head_most, off);
    float farther = 0;
    for (const Side side : kSides)
      farther = std::max(farther, glm::distance(m.at(arm(side).end, t), m.at(Joint::head, t)));
    p.hands += farther / m.height / static_cast<float>(end - begin + 1);
  }
  return p;
}

void defend(const Piece& p, DefenseKind kind, FoundAction& segment) {
  segment.cut.kind = Kind::defense;
  const Tick quarter = (p.end - p.begin) / 5;
  segment.cut.defense = Defense{kind, p.begin + quarter, p.end - quarter};
}

const char* direction_of(Vec3 way) {
  if (std::abs(way.z) >= std::abs(way.x)) return way.z > 0 ? "forward" : "back";
  return way.x > 0 ? "left" : "right";
}

// Name, kind and defense by what the piece does most.
FoundAction labelled(const Found& found, const Piece& p) {
  FoundAction s;
  s.cut.begin = seconds(p.begin);
  s.cut.end = seconds(p.end);
  s.cut.kind = Kind::transition;
  const float travelled = std::hypot(p.way.x, p.way.z);
  const bool stays = travelled < 2 * kStep && std::abs(p.turn) < kTurn;
  const float aside = std::max(p.head_most.x, -p.head_least.x);
  if (stays && found.guard.fights && -p.head_least.y >= kDuck) {
    s.cut.name = "duck";
    defend(p, DefenseKind::duck, s);
  } else if (stays && found.guard.fights && aside >= kSlip) {
    s.cut.name = p.head_most.x > -p.head_least.x ? "slip_left" : "slip_right";
    defend(p, DefenseKind::slip, s);
  } else if (stays && found.guard.fights && -p.head_least.z >= kSway) {
    s.cut.name = "sway_back";
    defend(p, DefenseKind::sway, s);
  } else if (std::abs(p.turn) >= kTurn) {
    s.cut.name = p.turn > 0 ? "turn_left" : "turn_right";
  } else if (travelled >= kStep) {
    s.cut.name = fmt::format("step_{}", direction_of(p.way));
  } else if (found.guard.fights && p.hands <= kHighGuard) {
    s.cut.name = "high_guard";
    defend(p, DefenseKind::guard, s);
  } else {
    s.cut.name = found.guard.fights ? "guard" : "stand";
    s.cut.kind = Kind::idle;
  }
  s.evidence = fmt::format(
      "hips go {:+.2f} H ahead {:+.2f} H to the left, turn {:+.0f} degrees; head {:+.2f} to "
      "{:+.2f} "
      "H to the left, {:+.2f} up, {:+.2f} ahead of its line; farther wrist {:.2f} H from the head; "
      "begins {:.2f} m and ends {:.2f} m from the guard",
      p.way.z, p.way.x, degrees(p.turn), p.head_least.x, p.head_most.x, p.head_least.y,
      p.head_least.z, p.hands, found.guard.distance[at(p.begin)], found.guard.distance[at(p.end)]);
  return s;
}

struct Candidate {
  FoundAction segment;
  float distance = 0;  // m: the farther of its ends from the guard
};

// Of each name the few that begin and end nearest to the guard.
std::vector<FoundAction> nearest_of_each(std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     if (a.segment.cut.name != b.segment.cut.name)
                       return a.segment.cut.name < b.segment.cut.name;
                     return a.distance < b.distance;
                   });
  std::vector<FoundAction> out;
  std::string name;
  std::size_t same = 0;
  for (Candidate& candidate : candidates) {
    same = candidate.segment.cut.name == name ? same + 1 : 0;
    name = candidate.segment.cut.name;
    if (same < kOfEach) out.push_back(std::move(candidate.segment));
  }
  return out;
}

}  // namespace

std::vector<bool> free_ticks(const Measures& m, const std::vector<FoundBlow>& blows,
                             const std::vector<Descent>& falls) {
  std::vector<bool> free(m.world.size(), true);
  const auto take = [&](Tick first, Tick last) {
    for (Tick t = m.clamped(first); t <= m.clamped(last); ++t) free[at(t)] = false;
  };
  for (const FoundBlow& blow : blows)
    take(ticks(blow.begin) - kAside, ticks(blow.end) + kAside / 2);
  for (const Descent& d : falls) take(d.begin - kAside, d.up < 0 ? m.last : d.up);
  return free;
}

std::vector<FoundAction> quiet_segments(const Found& found) {
  const Measures& m = found.measures;
  std::vector<bool> free = free_ticks(m, found.blows, found.descents);
  for (const Stretch& s : found.staggers)
    std::fill(free.begin() + s.first, free.begin() + s.last + 1, false);
  std::vector<Vec3> ground;
  ground.reserve(m.world.size());
  for (Tick t = 0; t <= m.last; ++t) {
    const Vec3 hips = m.at(Joint::hips, t);
    ground.emplace_back(hips.x, 0, hips.z);
  }
  ground = smoothed(ground, 0.16f);
  std::vector<Candidate> candidates;
  for (Tick first = 0; first <= m.last; ++first) {
    if (!free[at(first)]) continue;
    Tick last = first;
    while (last < m.last && free[at(last + 1)]) ++last;
    const std::vector<Tick> rests = rests_in(found, first, last);
    for (std::size_t i = 0; i < rests.size();) {
      std::size_t next = i + 1;
      while (next < rests.size() && rests[next] - rests[i] < kShortest) ++next;
      if (next < rests.size() && rests[next] - rests[i] <= kLongest) {
        const Piece piece = piece_of(found, ground, rests[i], rests[next]);
        candidates.push_back(
            {labelled(found, piece),
             std::max(found.guard.distance[at(piece.begin)], found.guard.distance[at(piece.end)])});
      }
      i = next;
    }
    first = last;
  }
  return nearest_of_each(std::move(candidates));
}

}  // namespace ringcraft
