#include "scene/study_penetration.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "base/quantile.h"
#include "io/quality.h"
#include "scene/moments.h"

namespace ringcraft {
namespace {

constexpr float kDeep = 0.03f;  // m: deeper for more than two frames is seen

struct Planned {
  std::vector<double> points;        // value of the best line, one a moment
  std::vector<std::string> actions;  // its first action
  std::vector<double> ms;
};

// What one bout was worth.
struct Fought {
  std::uint64_t decisions = 0, nodes = 0, pruned = 0;
  double p99_m = 0, max_m = 0, mean_m = 0;
  std::int64_t deep_run = 0;  // ticks: longest time on end deeper than kDeep
  bool interrupted = false;
};

std::vector<Moment> some_of(std::vector<Moment> all, std::size_t wanted) {
  if (all.size() <= wanted) return all;
  std::vector<Moment> some;
  some.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) some.push_back(all[i * all.size() / wanted]);
  return some;
}

Planned plans_of(const MotionLibrary& library, const SceneFile& scene,
                 const std::vector<Moment>& moments) {
  std::vector<Contender> contenders;
  for (const SceneFighter& one : scene.fighters) {
    contenders.push_back({make_body(one.body), one.style});
    contenders.back().style.temperature = 0;  // what is compared is the value of the best line
  }
  Planner planner(library, contenders, scene.planner, scene.seed);
  Planned planned;
  for (const bool timed : {false, true}) {  // the second time the memo holds every impulse step
    for (const Moment& one : moments) {
      const auto begin = std::chrono::steady_clock::now();
      const Plan plan = planner.plan(one.state, one.fighter);
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - begin;
      if (timed) {
        planned.ms.push_back(took.count());
        continue;
      }
      const bool any = !plan.record.lines.empty();
      planned.points.push_back(any ? plan.record.lines.front().score / 1000.0 : 0);
      planned.actions.push_back(any ? plan.record.lines.front().actions.front() : std::string());
    }
  }
  return planned;
}

Fought fought(const MotionLibrary& library, const SceneFile& scene, const FightOptions& options) {
  const FightRecord record = simulate_fight(library, scene, options);
  Fought found;
  found.interrupted = record.interrupted;
  for (const Event& event : record.timeline.events) {
    if (event.type != EventType::decision) continue;
    ++found.decisions;
    found.nodes += event.decision.nodes;
    found.pruned += event.decision.pruned_penetration;
  }
  const FightQuality quality = quality_of(record.timeline, record.bodies, library);
  found.p99_m = quality.penetration_p99_m;
  found.max_m = quality.penetration_max_m;
  std::int64_t run = 0;
  for (const float depth : penetration_by_tick(record.timeline, record.bodies, library)) {
    run = depth > kDeep ? run + 1 : 0;
    found.deep_run = std::max(found.deep_run, run);
  }
  return found;
}

struct Setting {
  double threshold_m = 0;  // 0: no pruning
  Tick every = 0;
};

// Sums and counts of one setting against the unpruned plans.
struct Loss {
  double mean = 0, p95 = 0, same = 0;
};

Loss loss_of(const Planned& pruned, const Planned& whole) {
  std::vector<double> lost;
  std::size_t same = 0;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    lost.push_back(whole.points[i] - pruned.points[i]);
    same += whole.actions[i] == pruned.actions[i] ? 1u : 0u;
  }
  Loss loss;
  for (const double one : lost) loss.mean += one / static_cast<double>(lost.size());
  loss.p95 = quantile(lost, 0.95);
  loss.same = lost.empty() ? 0 : static_cast<double>(same) / static_cast<double>(lost.size());
  return loss;
}

StudyChart chart_of(const std::string& title, const std::string& y) {
  return {title, "threshold, m", y, {}, {}, true, {}, true};
}

}  // namespace

Study penetration_study(const MotionLibrary& library, const SceneFile& scene,
                        const PenetrationSweep& sweep, const StudyRun& run) {
  FightOptions options;
  options.threads = run.threads;
  options.interrupted = run.interrupted;
  SceneFile with = scene;
  with.planner.threads = 1;
  with.planner.prune.penetration = false;
  run.say("no pruning");
  const std::vector<Moment> moments = some_of(moments_of(library, with, options), sweep.decisions);

  Study study;
  study.name = "penetration";
  study.title = fmt::format("Pruning by penetration: {}", scene.name);
  study.table.columns = {"threshold_m",
                         "every_ticks",
                         "nodes",
                         "pruned",
                         "pruned_share",
                         "penetration_p99_m",
                         "penetration_max_m",
                         "ticks_over_3_cm",
                         "value_lost_mean",
                         "value_lost_p95",
                         "same_action_share",
                         "decisions"};
  study.timing.columns = {"threshold_m", "every_ticks", "decision_ms_p50", "decision_ms_p99"};
  study.charts = {chart_of("Penetration in the committed fight, 99th percentile", "depth, m"),
                  chart_of("Value lost against the unpruned plan, mean", "points"),
                  chart_of("Branches pruned", "share of the nodes looked at"),
                  chart_of("Nodes a decision", "nodes")};
  study.charts[0].bar = 0.02;

  std::vector<Setting> settings{{}};
  for (const Tick every : sweep.every) {
    for (const double threshold : sweep.threshold_m) settings.push_back({threshold, every});
  }
  Planned whole;
  for (const Setting& setting : settings) {
    if (run.stopped()) break;
    with.planner.prune.penetration = setting.every > 0;
    with.planner.prune.penetration_m = setting.threshold_m;
    with.planner.prune.penetration_every = std::max<Tick>(1, setting.every);
    if (setting.every > 0) {
      run.say(fmt::format("{:.3f} m every {} ticks", setting.threshold_m, setting.every));
    }
    const Planned planned = plans_of(library, with, moments);
    if (setting.every == 0) whole = planned;
    const Fought result = fought(library, with, options);
    if (result.interrupted) break;
    const Loss loss = loss_of(planned, whole);
    const double looked = static_cast<double>(result.nodes + result.pruned);
    const double share = looked > 0 ? static_cast<double>(result.pruned) / looked : 0;
    const StudyCell threshold =
        setting.every > 0 ? StudyCell(setting.threshold_m) : StudyCell(std::string("off"));
    study.table.rows.push_back({threshold, std::int64_t{setting.every},
                                static_cast<std::int64_t>(result.nodes),
                                static_cast<std::int64_t>(result.pruned), share, result.p99_m,
                                result.max_m, result.deep_run, loss.mean, loss.p95, loss.same,
                                static_cast<std::int64_t>(result.decisions)});
    study.timing.rows.push_back({threshold, std::int64_t{setting.every}, quantile(planned.ms, 0.5),
                                 quantile(planned.ms, 0.99)});
    if (setting.every == 0) {
      for (StudyChart& chart : study.charts) chart.series.push_back({"no pruning", {}});
    } else if (setting.threshold_m == sweep.threshold_m.front()) {
      for (StudyChart& chart : study.charts) {
        chart.series.push_back({fmt::format("every {} ticks", setting.every), {}});
      }
    }
    const double a_decision = static_cast<double>(result.nodes) /
                              static_cast<double>(std::max<std::uint64_t>(1, result.decisions));
    const double values[] = {result.p99_m, loss.mean, share, a_decision};
    for (std::size_t i = 0; i < study.charts.size(); ++i) {
      std::vector<double> at{setting.threshold_m};
      if (setting.every == 0) at = sweep.threshold_m;  // drawn along the whole axis
      for (const double x : at) {
        study.charts[i].series.back().points.push_back({x, values[i], {}, {}});
      }
    }
  }
  study.interrupted = run.stopped();
  study.said = {
      fmt::format("{}: one bout of {:g} s a setting, seed {}. Depths are those of the shown "
                  "motion, intended contacts left out (io/quality.h).",
                  scene.name, seconds(scene.duration), scene.seed),
      fmt::format("Values: the best line in {} states of the bout without this pruning, planned "
                  "again under each setting; what the unpruned best line is worth more, in points "
                  "(negative: pruning the opponent's moves wins more than pruning the own costs).",
                  moments.size()),
      "ticks_over_3_cm: the longest time on end deeper than 3 cm, in ticks of 1/120 s."};
  return study;
}

}  // namespace ringcraft
