#include "scene/study_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "base/quantile.h"
#include "planner/impact_store.h"
#include "planner/search_cost.h"
#include "planner/tally.h"
#include "scene/moments.h"
#include "scene/study_slowed.h"

namespace ringcraft {
namespace {

constexpr std::uint64_t kWarmUpSeeds = 1'000;  // from the scene's own seed to those of the warm-up

// The moments of one bout: what was launched before a moment is part of what is decided there.
using BoutMoments = std::vector<Moment>;

std::vector<BoutMoments> bouts_of(const MotionLibrary& library, const SceneFile& scene,
                                  std::size_t wanted, const std::shared_ptr<ImpactStore>& store,
                                  const StudyRun& run) {
  FightOptions options;
  options.threads = run.threads;
  options.interrupted = run.interrupted;
  options.impacts = store;
  std::vector<BoutMoments> bouts;
  SceneFile one = scene;
  for (std::size_t found = 0; found < wanted && !run.stopped(); ++one.seed) {
    run.say(fmt::format("bout of seed {}", one.seed));
    BoutMoments moments = moments_of(library, one, options);
    if (moments.empty()) break;
    if (moments.size() > wanted - found) moments.resize(wanted - found);
    found += moments.size();
    bouts.push_back(std::move(moments));
  }
  return bouts;
}

Planner planner_of(const MotionLibrary& library, const SceneFile& scene,
                   const std::shared_ptr<ImpactStore>& store) {
  std::vector<Contender> contenders;
  contenders.reserve(scene.fighters.size());
  for (const SceneFighter& one : scene.fighters) {
    contenders.push_back({make_body(one.body), one.style});
  }
  PlanSettings settings = scene.planner;
  settings.threads = 1;
  return {library, contenders, settings, scene.seed, store};
}

// Walks the bouts again and does something at each moment, with the planner that decided there.
template <class What>
void again(const MotionLibrary& library, const SceneFile& scene,
           const std::vector<BoutMoments>& bouts, const std::shared_ptr<ImpactStore>& store,
           const StudyRun& run, const What& what) {
  SceneFile one = scene;
  for (const BoutMoments& moments : bouts) {
    Planner planner = planner_of(library, one, store);
    for (const Moment& moment : moments) {
      if (run.stopped()) return;
      what(planner, moment);
      planner.note_launch(moment.fighter, moment.launched);
    }
    ++one.seed;
  }
}

// Milliseconds and nodes of each decision, with those of the parts.
struct Timed {
  std::vector<double> ms, us_a_node, nodes;
  std::array<std::vector<double>, kCostParts> part_ms, part_us_a_node;
};

Timed timed(const MotionLibrary& library, const SceneFile& scene,
            const std::vector<BoutMoments>& bouts, const std::shared_ptr<ImpactStore>& store,
            bool parts, const StudyRun& run) {
  Timed found;
  again(library, scene, bouts, store, run, [&](Planner& planner, const Moment& moment) {
    SearchCost cost;
    planner.measure(parts ? &cost : nullptr);
    const auto began = std::chrono::steady_clock::now();
    const std::clock_t begin = std::clock();
    const Plan plan = planner.plan(moment.state, moment.fighter);
    const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - began;
    // A busy machine takes the processor away: parts are told by the wall's clock.
    const double had = wall.count() > 0 ? std::min(1.0, ms / wall.count()) : 1;
    planner.measure(nullptr);
    const auto nodes = static_cast<double>(std::max<std::uint64_t>(1, plan.record.nodes));
    found.ms.push_back(ms);
    found.nodes.push_back(nodes);
    found.us_a_node.push_back(1e3 * ms / nodes);
    for (std::size_t i = 0; i < kCostParts; ++i) {
      found.part_ms[i].push_back(had * 1e3 * cost.seconds[i]);
      found.part_us_a_node[i].push_back(had * 1e6 * cost.seconds[i] / nodes);
    }
  });
  return found;
}

void add_timing(StudyTable& table, const std::string& pass, const Timed& found, bool parts) {
  const auto row = [&](const std::string& part, const std::vector<double>& ms,
                       const std::vector<double>& us) {
    if (ms.empty()) return;  // interrupted before
    table.rows.push_back(
        {pass, part, quantile(ms, 0.5), quantile(ms, 0.99), quantile(us, 0.5), quantile(us, 0.99)});
  };
  row("decision", found.ms, found.us_a_node);
  if (!parts) return;
  for (std::size_t i = 0; i < kCostParts; ++i) {
    row(kCostPartNames[i], found.part_ms[i], found.part_us_a_node[i]);
  }
}

struct Variant {
  std::string name;
  SearchTrial trial;
};

std::vector<Variant> settings() {
  constexpr std::pair<const char*, bool SearchDevices::*> kDevices[] = {
      {"own order", &SearchDevices::own_order},
      {"table", &SearchDevices::table},
      {"killers", &SearchDevices::killers},
      {"history", &SearchDevices::history}};
  std::vector<Variant> all{{"all", {}}};
  all.reserve(16);
  for (const auto& [name, which] : kDevices) {
    Variant one{fmt::format("without {}", name), {}};
    one.trial.devices.*which = false;
    all.push_back(one);
  }
  all.push_back({"without deepening", {{}, false}});
  Variant none{"none", {{}, false}};
  for (const auto& [name, which] : kDevices) none.trial.devices.*which = false;
  all.push_back(none);
  none.name = "own order alone";
  none.trial.devices.own_order = true;
  all.push_back(none);
  return all;
}

// What one setting visited, a value for each moment.
struct Visited {
  std::vector<double> leaves, nodes, over_minimal, over_proof, effective;
  std::int64_t same_value = 0;
};

}  // namespace

Study search_study(const MotionLibrary& library, const SceneFile& scene, const SearchStudy& search,
                   const StudyRun& run) {
  Study study;
  study.name = "search";
  study.title = fmt::format("The search: {}", scene.name);
  const std::vector<BoutMoments> bouts =
      bouts_of(library, scene, search.decisions, std::make_shared<ImpactStore>(), run);

  study.timing.columns = {"pass", "part", "ms_p50", "ms_p99", "us_a_node_p50", "us_a_node_p99"};
  run.say("cold");
  add_timing(study.timing, "cold", timed(library, scene, bouts, nullptr, true, run), true);
  const auto store = std::make_shared<ImpactStore>();
  SceneFile other = scene;
  other.seed += kWarmUpSeeds;
  for (int i = 0; i < search.warm_up_bouts && !run.stopped(); ++i, ++other.seed) {
    run.say(fmt::format("warm-up {} of {}", i + 1, search.warm_up_bouts));
    FightOptions options;
    options.threads = run.threads;
    options.interrupted = run.interrupted;
    options.impacts = store;
    simulate_fight(library, other, options);
  }
  run.say("warm");
  add_timing(study.timing, "warm", timed(library, scene, bouts, store, true, run), true);
  add_timing(study.timing, "known", timed(library, scene, bouts, store, true, run), true);
  add_timing(study.timing, "known, no stopwatch", timed(library, scene, bouts, store, false, run),
             false);

  const std::vector<Variant> all = settings();
  std::vector<Visited> visited(all.size());
  std::vector<double> branching, depth, whole, minimal;
  run.say("devices");
  again(library, scene, bouts, store, run, [&](Planner& planner, const Moment& m) {
    const TreeShape shape = planner.shape(m.state, m.fighter, m.horizon, search.dives);
    if (shape.depth < 1) return;  // nothing to choose
    const double least = knuth_moore_leaves(shape.branching, shape.depth);
    branching.push_back(shape.branching);
    depth.push_back(shape.depth);
    whole.push_back(shape.leaves);
    minimal.push_back(least);
    std::int32_t value = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SearchTally tally = planner.tally(m.state, m.fighter, m.horizon, all[i].trial);
      if (i == 0) value = tally.value;
      Visited& one = visited[i];
      const auto leaves = static_cast<double>(std::max<std::uint64_t>(1, tally.counts.leaves));
      one.leaves.push_back(leaves);
      one.nodes.push_back(static_cast<double>(tally.counts.nodes));
      one.over_minimal.push_back(leaves / least);
      one.over_proof.push_back(leaves / shape.proof);
      one.effective.push_back(std::pow(leaves, 1 / shape.depth));
      one.same_value += tally.value == value ? 1 : 0;
    }
  });
  study.table.columns = {"devices",
                         "decisions",
                         "leaves_p50",
                         "nodes_p50",
                         "over_minimal_p50",
                         "over_proof_p50",
                         "effective_branching_p50",
                         "same_value"};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Visited& one = visited[i];
    if (one.leaves.empty()) continue;
    study.table.rows.push_back({all[i].name, static_cast<std::int64_t>(one.leaves.size()),
                                quantile(one.leaves, 0.5), quantile(one.nodes, 0.5),
                                quantile(one.over_minimal, 0.5), quantile(one.over_proof, 0.5),
                                quantile(one.effective, 0.5), one.same_value});
  }
  study.interrupted = run.stopped();
  study.said = {
      fmt::format("{} decisions of {} bouts, seeds from {} on; library {} ({} actions, mean "
                  "length {:.2f} s).",
                  branching.size(), bouts.size(), scene.seed, library.name(),
                  library.actions().size(), mean_choice_seconds(library))};
  if (branching.empty()) return study;
  study.said.front() += fmt::format(
      " Trees, medians: {:.2f} children a decision, {:.2f} decisions deep, {:.0f} leaves; minimal "
      "tree {:.0f} leaves ({} dives each).",
      quantile(branching, 0.5), quantile(depth, 0.5), quantile(whole, 0.5), quantile(minimal, 0.5),
      search.dives);
  return study;
}

}  // namespace ringcraft
