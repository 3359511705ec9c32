#include "scene/study_cost.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>

#include <fmt/format.h>

#include "base/quantile.h"
#include "planner/impact_store.h"
#include "planner/plan.h"
#include "scene/moments.h"
#include "scene/study_slowed.h"

namespace ringcraft {
namespace {

constexpr float kSlowerByRound = 0.08f;  // of the speed

struct Found {
  std::vector<double> ms, nodes, leaves;
};

// The same moments at every horizon, the longest first: what it has met is known to the others.
// Each decision is made twice and the second timed.
std::vector<Found> found_of(const MotionLibrary& library, const SceneFile& scene,
                            const std::vector<Moment>& moments, std::vector<double> horizons_s,
                            const StudyRun& run) {
  PlanSettings settings = scene.planner;
  settings.threads = 1;
  settings.node_limit = 0;
  std::vector<Contender> contenders;
  contenders.reserve(scene.fighters.size());
  for (const SceneFighter& one : scene.fighters) {
    contenders.push_back({make_body(one.body), one.style});
  }
  const auto store = std::make_shared<ImpactStore>();
  std::vector<Found> found(horizons_s.size());
  for (std::size_t h = horizons_s.size(); h-- > 0;) {
    for (Contender& one : contenders) one.style.horizon_s = horizons_s[h];
    run.say(fmt::format("{} actions, {} s", library.launchable().size(), horizons_s[h]));
    Planner planner(library, contenders, settings, scene.seed, store);
    PlanLimits until_told;  // a decision may take minutes
    until_told.stop = run.interrupted;
    for (const Moment& moment : moments) {
      planner.plan(moment.state, moment.fighter, until_told);
      const std::clock_t begin = std::clock();
      const Plan plan = planner.plan(moment.state, moment.fighter, until_told);
      if (run.stopped()) return found;
      found[h].ms.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      found[h].nodes.push_back(static_cast<double>(plan.record.nodes));
      found[h].leaves.push_back(static_cast<double>(plan.record.leaves));
      planner.note_launch(moment.fighter, moment.launched);
    }
  }
  return found;
}

}  // namespace

MotionLibrary resized_library(const MotionLibrary& library, int choices) {
  std::map<Kind, std::vector<ActionId>> by_kind;
  for (const ActionId id : library.launchable()) by_kind[library.action(id).kind].push_back(id);
  const auto all = static_cast<double>(library.launchable().size());
  std::vector<std::uint8_t> wanted(library.actions().size(), 1);
  for (const ActionId id : library.launchable()) wanted[id.at()] = 0;
  std::vector<Action> more;
  for (const auto& [kind, ids] : by_kind) {
    const auto had = static_cast<int>(ids.size());
    const int want =
        std::max(1, static_cast<int>(std::lround(choices * static_cast<double>(had) / all)));
    for (int i = 0; i < want; ++i) {
      const int round = i / had;
      // Spread over what there is.
      const int which = want < had ? i * had / want : i % had;
      const ActionId id = ids[static_cast<std::size_t>(which)];
      if (round == 0) {
        wanted[id.at()] = 1;
        continue;
      }
      const float speed = 1 - kSlowerByRound * static_cast<float>(round);
      more.push_back(slowed(library.action(id), 1 / speed));
      more.back().name += fmt::format("_at_{:.2f}", speed);
    }
  }
  std::vector<Action> actions;
  actions.reserve(library.actions().size() + more.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] != 0) actions.push_back(library.actions()[i]);
  }
  for (Action& one : more) actions.push_back(std::move(one));
  return MotionLibrary(fmt::format("{} of {}", library.name(), choices), std::move(actions));
}

Study cost_study(const MotionLibrary& library, const SceneFile& scene, const CostStudy& cost,
                 const StudyRun& run) {
  Study study;
  study.name = "cost";
  study.title = fmt::format("What a decision costs: {}", scene.name);
  study.table.columns = {"choices",   "horizon_s", "decisions",
                         "nodes_p50", "nodes_p99", "leaves_p50"};
  study.timing.columns = {"choices", "horizon_s", "ms_p50", "ms_p99", "us_a_node"};
  StudyChart nodes{"Nodes of a decision, median", "looked ahead, s", "nodes, log10", {}, {}};
  StudyChart time{"Processor time of a decision, median; one thread, impulse steps known",
                  "looked ahead, s",
                  "ms, log10",
                  {},
                  {}};
  time.bar = std::log10(1000.0 / 60);
  for (const int choices : cost.choices) {
    if (run.stopped()) break;
    run.say(fmt::format("{} actions to choose from", choices));
    const MotionLibrary sized = resized_library(library, choices);
    FightOptions options;
    options.threads = run.threads;
    options.interrupted = run.interrupted;
    std::vector<Moment> moments = moments_of(sized, scene, options);
    if (moments.size() > cost.decisions) moments.resize(cost.decisions);
    const std::vector<Found> found = found_of(sized, scene, moments, cost.horizons_s, run);
    const auto there = static_cast<std::int64_t>(sized.launchable().size());
    const std::string label = fmt::format("{} actions", there);
    StudySeries of_nodes{label, {}}, of_time{label, {}};
    for (std::size_t h = 0; h < found.size() && !run.stopped(); ++h) {
      const Found& one = found[h];
      const double ms = quantile(one.ms, 0.5), count = quantile(one.nodes, 0.5);
      study.table.rows.push_back({there, cost.horizons_s[h],
                                  static_cast<std::int64_t>(one.nodes.size()), count,
                                  quantile(one.nodes, 0.99), quantile(one.leaves, 0.5)});
      study.timing.rows.push_back(
          {there, cost.horizons_s[h], ms, quantile(one.ms, 0.99), 1e3 * ms / std::max(1.0, count)});
      of_nodes.points.push_back({cost.horizons_s[h], std::log10(std::max(1.0, count)), {}, {}});
      of_time.points.push_back({cost.horizons_s[h], std::log10(std::max(1e-3, ms)), {}, {}});
    }
    nodes.series.push_back(std::move(of_nodes));
    time.series.push_back(std::move(of_time));
  }
  study.charts = {std::move(nodes)};
  study.timing_charts = {std::move(time)};
  study.interrupted = run.stopped();
  study.said = {fmt::format(
      "The first {} decisions of a bout on each library, without a node limit. Libraries of other "
      "sizes keep each kind's share; more actions than there are come from the same ones played "
      "slower outside of their blows.",
      cost.decisions)};
  return study;
}

}  // namespace ringcraft
