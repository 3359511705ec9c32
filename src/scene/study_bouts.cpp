#include "scene/study_bouts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>

#include <fmt/format.h>

#include "base/quantile.h"
#include "base/random.h"
#include "base/tasks.h"
#include "planner/impact_store.h"

namespace ringcraft {
namespace {

constexpr float kNearestStart = 1.6f, kFarthestStart = 3.0f;  // m
constexpr float kMostTurned = radians(29);

// The action that was chosen most, and its share; of equals the first by name.
std::pair<double, std::string> most_used(const SideTally& side) {
  const auto most =
      std::max_element(side.uses.begin(), side.uses.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == side.uses.end()) return {};
  return {static_cast<double>(most->second) / static_cast<double>(side.chosen), most->first};
}

// Whether a defense was chosen while the feint lasted.
bool took_in(const Segment& feint, const FighterTrack& other) {
  const auto& all = other.segments;
  return std::any_of(all.begin(), all.end(), [&](const Segment& segment) {
    return segment.kind == Kind::defense && segment.launch.start > feint.launch.start &&
           segment.launch.start < feint.launch.end;
  });
}

void count_segments(const Timeline& timeline, BoutTally& tally) {
  for (std::size_t i = 0; i < 2; ++i) {
    SideTally& own = tally.side[i];
    const std::vector<Segment>& segments = timeline.tracks[i].segments;
    for (const Segment& segment : segments) {
      const bool attack = segment.kind == Kind::attack || segment.kind == Kind::combination;
      own.attacks += attack ? 1 : 0;
      tally.side[1 - i].faced += attack ? 1 : 0;
      own.defenses += segment.kind == Kind::defense ? 1 : 0;
      own.steps += segment.kind == Kind::transition && !segment.feint ? 1 : 0;
      own.feints += segment.feint ? 1 : 0;
      own.taken_in += segment.feint && took_in(segment, timeline.tracks[1 - i]) ? 1 : 0;
      // Nobody chose the stance that the bout opens in.
      if (segment.launch.forced || &segment == &segments.front()) continue;
      ++own.chosen;
      ++own.uses[segment.name];
    }
    const auto [share, action] = most_used(own);
    if (share <= tally.most_used) continue;
    tally.most_used = share;
    tally.most_used_action = action;
  }
}

void count_distances(const Timeline& timeline, BoutTally& tally) {
  const auto &a = timeline.tracks[0].frames, &b = timeline.tracks[1].frames;
  for (std::size_t tick = 0; tick < std::min(a.size(), b.size()); ++tick) {
    const Vec3 apart = a[tick].hips - b[tick].hips;
    const double distance = std::hypot(static_cast<double>(apart.x), static_cast<double>(apart.z));
    tally.distance_sum += distance;
    tally.far_ticks += distance > static_cast<double>(kArmsLength) ? 1 : 0;
    ++tally.ticks;
  }
}

// Sums over a pairing.
struct Totals {
  std::array<SideTally, 2> side;
  std::size_t wins = 0, draws = 0, bouts = 0, without_contact = 0;
  double seconds = 0, quiet_most = 0, quiet_sum = 0, used_most = 0;
  double distance = 0, far = 0, ticks = 0;
  std::string used_most_action;
  std::vector<double> leads;  // of the first side in damage, points, one a bout
};

Totals totals_of(const PairingResult& result) {
  Totals sum;
  for (const BoutTally& bout : result.bouts) {
    for (std::size_t i = 0; i < 2; ++i) sum.side[i] += bout.side[i];
    ++sum.bouts;
    sum.wins += bout.winner == 0 ? 1u : 0u;
    sum.draws += bout.winner < 0 ? 1u : 0u;
    sum.without_contact += bout.contact ? 0u : 1u;
    sum.seconds += bout.seconds;
    sum.quiet_most = std::max(sum.quiet_most, bout.quiet_s);
    sum.quiet_sum += bout.quiet_s;
    if (bout.most_used > sum.used_most) sum.used_most_action = bout.most_used_action;
    sum.used_most = std::max(sum.used_most, bout.most_used);
    sum.leads.push_back(bout.side[0].damage - bout.side[1].damage);
    sum.distance += bout.distance_sum;
    sum.far += bout.far_ticks;
    sum.ticks += bout.ticks;
  }
  return sum;
}

double over(double value, double of) {
  return of > 0 ? value / of : 0;
}

std::vector<StudyCell> row_of(const std::string& name, const Totals& sum) {
  const Interval share = wilson(sum.wins, sum.bouts);
  const double minutes = sum.seconds / 60;
  std::vector<StudyCell> row{name,
                             static_cast<std::int64_t>(sum.bouts),
                             static_cast<std::int64_t>(sum.wins),
                             static_cast<std::int64_t>(sum.draws),
                             over(static_cast<double>(sum.wins), static_cast<double>(sum.bouts)),
                             share.low,
                             share.high,
                             over(static_cast<double>(sum.draws), static_cast<double>(sum.bouts))};
  const MeanInterval lead = mean_interval(sum.leads);
  row.emplace_back(lead.mean);
  row.push_back(cell_of(lead.low));
  row.push_back(cell_of(lead.high));
  for (const SideTally& side : sum.side) {
    row.emplace_back(over(static_cast<double>(side.hits), minutes));
    row.emplace_back(over(side.damage, minutes));
    row.emplace_back(over(static_cast<double>(side.hits), static_cast<double>(side.strikes)));
    row.emplace_back(over(static_cast<double>(side.knockdowns), minutes));
    row.emplace_back(over(static_cast<double>(side.steps), minutes));
    row.emplace_back(over(static_cast<double>(side.defenses), static_cast<double>(side.faced)));
    row.emplace_back(over(side.ahead_s, static_cast<double>(side.decisions)));
    row.emplace_back(over(static_cast<double>(side.feints), minutes));
    row.emplace_back(over(static_cast<double>(side.taken_in), static_cast<double>(side.feints)));
    const auto [share, action] = most_used(side);
    row.emplace_back(share);
    row.emplace_back(action);
  }
  row.emplace_back(over(sum.distance, sum.ticks));
  row.emplace_back(over(sum.far, sum.ticks));
  row.emplace_back(sum.quiet_most);
  row.emplace_back(over(sum.quiet_sum, static_cast<double>(sum.bouts)));
  row.emplace_back(sum.used_most);
  row.emplace_back(sum.used_most_action);
  row.emplace_back(static_cast<std::int64_t>(sum.without_contact));
  return row;
}

StudyChart chart_of(const std::string& title, const std::string& y,
                    const std::vector<std::string>& names) {
  return {title, "pairing", y, {}, names, false, {}, true};
}

}  // namespace

SideTally& SideTally::operator+=(const SideTally& o) {
  attacks += o.attacks, strikes += o.strikes, hits += o.hits, defenses += o.defenses;
  steps += o.steps, faced += o.faced, knockdowns += o.knockdowns, chosen += o.chosen;
  damage += o.damage;
  for (const auto& [action, count] : o.uses) uses[action] += count;
  decisions += o.decisions, ahead_s += o.ahead_s;
  feints += o.feints, taken_in += o.taken_in;
  return *this;
}

BoutTally tally_of(const FightRecord& record) {
  const Timeline& timeline = record.timeline;
  BoutTally tally;
  tally.seconds = seconds(timeline.end);
  std::array<bool, 2> out{};
  Tick last = 0;
  const auto quiet_until = [&](Tick tick) {
    tally.quiet_s = std::max(tally.quiet_s, seconds(tick - last));
    last = tick;
  };
  for (const Event& event : timeline.events) {
    const std::size_t who = event.who.at();
    if (event.type == EventType::strike) ++tally.side[who].strikes;
    if (event.type == EventType::decision) {
      ++tally.side[who].decisions;
      tally.side[who].ahead_s += seconds(event.decision.horizon);
    }
    if (event.type == EventType::knockdown) {
      ++tally.side[1 - who].knockdowns;
    }
    if (event.type != EventType::hit && event.type != EventType::block) continue;
    if (event.knockout) out[1 - who] = true;
    tally.contact = true;
    quiet_until(event.tick);
    if (event.fall) continue;  // no blow of who falls
    tally.side[who].hits += event.type == EventType::hit ? 1 : 0;
    tally.side[who].damage += static_cast<double>(event.damage);
  }
  if (!out[0] && !out[1]) quiet_until(timeline.end);
  const double lead = tally.side[0].damage - tally.side[1].damage;
  if (out[0] || out[1]) {
    tally.winner = out[0] && out[1] ? -1 : out[0] ? 1 : 0;
  } else {
    tally.winner = std::abs(lead) <= kDrawPoints ? -1 : lead > 0 ? 0 : 1;
  }
  count_segments(timeline, tally);
  count_distances(timeline, tally);
  return tally;
}

SceneFile bout_scene(const SceneFile& scene, const Pairing& pairing, const BoutSeries& series,
                     int i) {
  SceneFile bout = scene;
  bout.duration = ticks(series.duration_s);
  bout.ring = series.ring_m;
  bout.planner.ring_half_m = static_cast<double>(series.ring_m) / 2;
  bout.planner.threads = 1;
  bout.fighters.resize(2, scene.fighters.front());
  const bool mirror = pairing.side[0] == pairing.side[1];
  bout.seed = derived_seed(scene.seed, "bout", static_cast<std::uint64_t>(mirror ? i : i / 2));
  Random random(bout.seed, 7);
  const float apart = random.uniform(kNearestStart, kFarthestStart);
  for (std::size_t k = 0; k < 2; ++k) {
    SceneFighter& fighter = bout.fighters[k];
    fighter.team = static_cast<int>(k);
    fighter.style = pairing.side[i % 2 == 0 ? k : 1 - k];
    fighter.placement = {random.uniform(-0.3f, 0.3f), (k == 0 ? -0.5f : 0.5f) * apart,
                         (k == 0 ? 0 : kPi) + random.uniform(-kMostTurned, kMostTurned)};
  }
  return bout;
}

std::vector<PairingResult> run_pairings(const MotionLibrary& library, const SceneFile& scene,
                                        const std::vector<Pairing>& pairings,
                                        const BoutSeries& series, const StudyRun& run) {
  struct Slot {
    BoutTally tally;
    std::vector<double> ms;
    bool done = false;
  };
  const auto bouts = static_cast<std::size_t>(std::max(1, series.bouts));
  std::vector<Slot> slots(pairings.size() * bouts);
  const auto store = std::make_shared<ImpactStore>();
  std::mutex saying;
  std::size_t finished = 0;
  run_tasks(slots.size(), run.threads, [&](std::size_t task) {
    if (run.stopped()) return;
    const Pairing& pairing = pairings[task / bouts];
    const auto i = static_cast<int>(task % bouts);
    FightOptions options;
    options.interrupted = run.interrupted;
    options.impacts = store;
    const FightRecord record =
        simulate_fight(library, bout_scene(scene, pairing, series, i), options);
    if (record.interrupted) return;
    Slot& slot = slots[task];
    slot.tally = tally_of(record);
    if (i % 2 != 0) {  // the sides were swapped
      std::swap(slot.tally.side[0], slot.tally.side[1]);
      if (slot.tally.winner >= 0) slot.tally.winner = 1 - slot.tally.winner;
    }
    slot.ms = record.decision_ms;
    slot.done = true;
    const std::lock_guard lock(saying);
    run.say(fmt::format("{} bout {}: {} of {}", pairing.name, i + 1, ++finished, slots.size()));
  });
  std::vector<PairingResult> results;
  results.reserve(pairings.size());
  for (std::size_t p = 0; p < pairings.size(); ++p) {
    PairingResult result{pairings[p], {}, {}};
    for (std::size_t i = 0; i < bouts; ++i) {
      const Slot& slot = slots[p * bouts + i];
      if (!slot.done) continue;
      result.bouts.push_back(slot.tally);
      result.decision_ms.push_back(slot.ms);
    }
    if (!result.bouts.empty()) results.push_back(std::move(result));
  }
  return results;
}

std::optional<Pairing> horizon_pairing(const std::string& name, const Style& style) {
  const std::size_t v = name.find('v');
  if (v == std::string::npos) return std::nullopt;
  Pairing pairing{name, {style, style}};
  const std::string sides[] = {name.substr(0, v), name.substr(v + 1)};
  for (std::size_t i = 0; i < 2; ++i) {
    char* end = nullptr;
    const double horizon = std::strtod(sides[i].c_str(), &end);
    if (sides[i].empty() || *end != '\0' || !(horizon >= 0.1 && horizon <= 10)) return std::nullopt;
    pairing.side[i].horizon_s = horizon;
  }
  return pairing;
}

void fill_bouts(Study& study, const std::vector<PairingResult>& results) {
  study.table.columns = {"pairing",     "bouts",    "wins",     "draws",
                         "win_share",   "win_low",  "win_high", "draw_share",
                         "lead_points", "lead_low", "lead_high"};
  for (const char* side : {"a", "b"}) {
    for (const char* what :
         {"hits_per_min", "damage_per_min", "landed_share", "knockdowns_per_min", "steps_per_min",
          "defenses_per_attack_faced", "looked_ahead_s", "feints_per_min", "feints_answered_share",
          "most_used_share", "most_used_action"}) {
      study.table.columns.push_back(fmt::format("{}_{}", side, what));
    }
  }
  for (const char* name : {"distance_m", "beyond_reach_share", "longest_quiet_s", "mean_quiet_s",
                           "most_used_share", "most_used_action", "bouts_without_contact"}) {
    study.table.columns.emplace_back(name);
  }
  study.timing.columns = {"pairing",
                          "decisions",
                          "decision_ms_p50_first_bout",
                          "decision_ms_p50_last_bout",
                          "decision_ms_p50",
                          "decision_ms_p99"};
  std::vector<std::string> names;
  names.reserve(results.size());
  for (const PairingResult& result : results) names.push_back(result.pairing.name);
  study.charts = {
      chart_of("Wins of the first side, 95 % intervals", "share of bouts", names),
      chart_of("Lead of the first side, 95 % intervals", "points of damage a bout", names),
      chart_of("Hits", "per minute and side", names),
      chart_of("Defenses per attack faced", "defenses per attack", names),
      chart_of("Steps", "per minute and side", names)};
  for (std::size_t c = 0; c < 2; ++c) study.charts[c].series = {{"", {}}};
  for (std::size_t c = 2; c < study.charts.size(); ++c) {
    study.charts[c].series = {{"first", {}}, {"second", {}}};
  }
  for (std::size_t p = 0; p < results.size(); ++p) {
    const Totals sum = totals_of(results[p]);
    study.table.rows.push_back(row_of(names[p], sum));
    std::vector<double> all;
    for (const auto& one : results[p].decision_ms) all.insert(all.end(), one.begin(), one.end());
    const bool any = !results[p].decision_ms.empty();
    study.timing.rows.push_back({names[p], static_cast<std::int64_t>(all.size()),
                                 any ? quantile(results[p].decision_ms.front(), 0.5) : 0.0,
                                 any ? quantile(results[p].decision_ms.back(), 0.5) : 0.0,
                                 quantile(all, 0.5), quantile(all, 0.99)});
    const Interval share = wilson(sum.wins, sum.bouts);
    const auto x = static_cast<double>(p);
    study.charts[0].series[0].points.push_back(
        {x, static_cast<double>(sum.wins) / static_cast<double>(sum.bouts), share.low, share.high});
    const MeanInterval lead = mean_interval(sum.leads);
    study.charts[1].series[0].points.push_back({x, lead.mean, lead.low, lead.high});
    for (std::size_t i = 0; i < 2; ++i) {
      const SideTally& side = sum.side[i];
      const double values[] = {
          over(static_cast<double>(side.hits), sum.seconds / 60),
          over(static_cast<double>(side.defenses), static_cast<double>(side.faced)),
          over(static_cast<double>(side.steps), sum.seconds / 60)};
      for (std::size_t c = 0; c < 3; ++c) {
        study.charts[c + 2].series[i].points.push_back({x, values[c], {}, {}});
      }
    }
  }
}

}  // namespace ringcraft
