#include "motion/registration.h"

#include <algorithm>
#include <array>
#include <limits>

#include "motion/motion_graph.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSmooth = 0.03f;   // s: sigma of the curve's smoothing
constexpr float kSlowest = 0.2f;   // ticks of the other clip for one of the reference, at least
constexpr Tick kCoarse = 4;        // ticks between frames that are compared for the distance
constexpr Tick kNearestPhase = 3;  // ticks between two moments that hold the curve
constexpr float kUnreached = std::numeric_limits<float>::max();

// How a cell was reached: by both clips, or by one alone for the first or second time in a row.
// There is no third: the other runs at a third of its pace at least (the slope limit of Kovar and
// Gleicher).
enum Way : std::size_t { both, rows_once, rows_twice, columns_once, columns_twice, kWays };

struct Cell {
  std::array<float, kWays> cost;
  std::array<std::uint8_t, kWays> from;
};

std::pair<float, std::uint8_t> cheapest(const Cell& cell, std::initializer_list<std::size_t> ways) {
  std::pair<float, std::uint8_t> best{kUnreached, 0};
  for (const std::size_t way : ways)
    if (cell.cost[way] < best.first) best = {cell.cost[way], static_cast<std::uint8_t>(way)};
  return best;
}

// Cheapest path through rows [first, last] x columns [low, high] of a map, as pairs; straight
// where no path keeps the slope limit.
std::vector<std::pair<Tick, Tick>> warped(const DistanceMap& map, std::pair<Tick, Tick> begin,
                                          std::pair<Tick, Tick> end) {
  const auto rows = static_cast<std::size_t>(end.first - begin.first) + 1;
  const auto columns = static_cast<std::size_t>(end.second - begin.second) + 1;
  std::vector<Cell> cells(rows * columns);
  const auto cell = [&](std::size_t r, std::size_t c) -> Cell& { return cells[r * columns + c]; };
  const auto distance = [&](std::size_t r, std::size_t c) {
    return map.distance[(static_cast<std::size_t>(begin.first) + r) * map.columns +
                        static_cast<std::size_t>(begin.second) + c];
  };
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      Cell& here = cell(r, c);
      here.cost.fill(kUnreached);
      here.from.fill(0);
      if (r == 0 && c == 0) {
        here.cost[both] = distance(0, 0);
        continue;
      }
      const auto reach = [&](std::size_t way, const Cell& before,
                             std::initializer_list<std::size_t> ways, float times) {
        const auto [cost, from] = cheapest(before, ways);
        if (cost == kUnreached) return;
        here.cost[way] = cost + times * distance(r, c);
        here.from[way] = from;
      };
      // A step of both counts twice, so that paths of all shapes have one length.
      if (r > 0 && c > 0)
        reach(both, cell(r - 1, c - 1), {both, rows_once, rows_twice, columns_once, columns_twice},
              2);
      if (r > 0) {
        reach(rows_once, cell(r - 1, c), {both}, 1);
        reach(rows_twice, cell(r - 1, c), {rows_once}, 1);
      }
      if (c > 0) {
        reach(columns_once, cell(r, c - 1), {both}, 1);
        reach(columns_twice, cell(r, c - 1), {columns_once}, 1);
      }
    }
  }
  std::vector<std::pair<Tick, Tick>> path;
  std::size_t r = rows - 1, c = columns - 1;
  auto [cost, way] =
      cheapest(cell(r, c), {both, rows_once, rows_twice, columns_once, columns_twice});
  if (cost == kUnreached) {
    for (std::size_t i = 0; i < rows; ++i)
      path.emplace_back(
          begin.first + static_cast<Tick>(i),
          begin.second + static_cast<Tick>(i * (columns - 1) / std::max<std::size_t>(1, rows - 1)));
    return path;
  }
  while (true) {
    path.emplace_back(begin.first + static_cast<Tick>(r), begin.second + static_cast<Tick>(c));
    if (r == 0 && c == 0) break;
    const std::uint8_t before = cell(r, c).from[way];
    if (way == both || way == rows_once || way == rows_twice) --r;
    if (way == both || way == columns_once || way == columns_twice) --c;
    way = before;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

struct WarpPath {
  std::vector<std::pair<Tick, Tick>> cells;
  float distance = 0;  // mean over the cells, m
};

// From corner to corner of the map, over the anchors.
WarpPath warp_path(const DistanceMap& map, Anchors anchors) {
  anchors.emplace_back(static_cast<Tick>(map.rows) - 1, static_cast<Tick>(map.columns) - 1);
  WarpPath path;
  std::pair<Tick, Tick> begin{0, 0};
  double along = 0;
  for (const auto& end : anchors) {
    for (const auto& cell : warped(map, begin, end)) {
      along += static_cast<double>(map.distance[static_cast<std::size_t>(cell.first) * map.columns +
                                                static_cast<std::size_t>(cell.second)]);
      path.cells.push_back(cell);
    }
    begin = end;
  }
  path.distance = static_cast<float>(along / static_cast<double>(path.cells.size()));
  return path;
}

// Smoothing moves the anchors: what it moved them by is taken back, smoothly from one to the next.
void pin(std::vector<float>& curve, const Anchors& anchors) {
  Anchors all = {{0, 0}};
  all.insert(all.end(), anchors.begin(), anchors.end());
  all.emplace_back(static_cast<Tick>(curve.size()) - 1, static_cast<Tick>(curve.back()));
  const std::vector<float> before = curve;
  const auto off = [&](std::size_t k) {
    return static_cast<float>(all[k].second) - before[static_cast<std::size_t>(all[k].first)];
  };
  for (std::size_t k = 1; k < all.size(); ++k) {
    for (Tick t = all[k - 1].first; t <= all[k].first; ++t) {
      const float share = static_cast<float>(t - all[k - 1].first) /
                          static_cast<float>(all[k].first - all[k - 1].first);
      curve[static_cast<std::size_t>(t)] =
          before[static_cast<std::size_t>(t)] +
          glm::mix(off(k - 1), off(k), glm::smoothstep(0.0f, 1.0f, share));
    }
  }
}

// Strictly rising, the ends as they are.
void make_rising(std::vector<float>& curve) {
  const float last = curve.back();
  for (std::size_t i = 1; i < curve.size(); ++i)
    curve[i] = std::max(curve[i], curve[i - 1] + kSlowest);
  curve.back() = last;
  for (std::size_t i = curve.size() - 1; i-- > 1;)
    curve[i] = std::min(curve[i], curve[i + 1] - kSlowest);
}

// Where no other moment is nearer than `least`.
void add_phase(Anchors& anchors, Tick a, Tick b, Tick end_a, Tick end_b, Tick least) {
  const std::pair<Tick, Tick> before =
      anchors.empty() ? std::pair<Tick, Tick>{0, 0} : anchors.back();
  const auto apart = [least](Tick from, Tick to) { return to - from >= least; };
  if (apart(before.first, a) && apart(before.second, b) && apart(a, end_a) && apart(b, end_b))
    anchors.emplace_back(a, b);
}

bool same_blow(const Strike& a, const Strike& b) {
  return a.kind == b.kind && a.joint == b.joint;
}

struct ContactChange {
  Tick tick;
  FootContacts to;
};

std::vector<ContactChange> contact_changes(const Clip& clip) {
  std::vector<ContactChange> changes;
  for (Tick t = 1; t <= clip.length(); ++t) {
    if (clip.contacts_at(t) == clip.contacts_at(t - 1)) continue;
    changes.push_back({t, clip.contacts_at(t)});
  }
  return changes;
}

}  // namespace

Registration registered(const Skeleton& skeleton, const Clip& reference, const Clip& other,
                        const Anchors& anchors) {
  const DistanceMap map = distance_map(skeleton, reference, other, 1);
  const WarpPath path = warp_path(map, anchors);
  std::vector<float> sum(map.rows, 0.0f), hits(map.rows, 0.0f);
  for (const auto& [row, column] : path.cells) {
    sum[static_cast<std::size_t>(row)] += static_cast<float>(column);
    hits[static_cast<std::size_t>(row)] += 1;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= hits[i];
  sum.front() = 0;
  sum.back() = static_cast<float>(other.length());
  Registration result{smoothed(sum, kSmooth), path.distance};
  pin(result.tick, anchors);
  make_rising(result.tick);
  return result;
}

float registration_distance(const Skeleton& skeleton, const Clip& reference, const Clip& other,
                            const Anchors& anchors) {
  Anchors coarse;
  for (const auto& [a, b] : anchors)
    add_phase(coarse, a / kCoarse, b / kCoarse, reference.length() / kCoarse,
              other.length() / kCoarse, 1);
  return warp_path(distance_map(skeleton, reference, other, kCoarse), coarse).distance;
}

std::optional<Anchors> shared_phases(const Action& reference, const Action& other) {
  Anchors anchors;
  const Tick end = reference.length(), other_end = other.length();
  const auto add = [&](Tick a, Tick b) { add_phase(anchors, a, b, end, other_end, kNearestPhase); };
  if (reference.kind != other.kind || reference.strikes.size() != other.strikes.size() ||
      reference.defense.has_value() != other.defense.has_value())
    return std::nullopt;
  for (std::size_t i = 0; i < reference.strikes.size(); ++i) {
    const Strike &a = reference.strikes[i], &b = other.strikes[i];
    if (!same_blow(a, b)) return std::nullopt;
    add(a.active_begin, b.active_begin);
    add(a.active_end - 1, b.active_end - 1);
  }
  if (reference.defense) {
    if (reference.defense->kind != other.defense->kind) return std::nullopt;
    add(reference.defense->begin, other.defense->begin);
    add(reference.defense->end, other.defense->end);
  }
  if (reference.kind != Kind::transition) return anchors;
  if (reference.clip.contacts_at(0) != other.clip.contacts_at(0)) return std::nullopt;
  const auto a = contact_changes(reference.clip), b = contact_changes(other.clip);
  if (a.size() != b.size()) return std::nullopt;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].to != b[i].to) return std::nullopt;
    add(a[i].tick, b[i].tick);
  }
  return anchors;
}

}  // namespace ringcraft
