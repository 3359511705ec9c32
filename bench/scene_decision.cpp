// Decisions of the default duel on the default library, taken again with every impulse step known:
// what the search itself costs.
//   ringcraft_scene_bench --benchmark_repetitions=5
// `nodes` and `values` (a sum over the best lines) say whether two builds searched the same trees.
#include <benchmark/benchmark.h>

#include <memory>
#include <optional>

#include "base/file.h"
#include "capture/library_builder.h"
#include "planner/impact_store.h"
#include "scene/moments.h"

namespace ringcraft {
namespace {

// Made once, whatever the number of repetitions.
struct Decisions {
  std::optional<MotionLibrary> library;
  std::vector<Moment> moments;
  std::unique_ptr<Planner> planner;
  std::string error;

  Decisions() {
    auto built = build_library(assets_folder() / "kickboxing" / "library.toml");
    const auto scene = read_scene("duel", {"duration_s=6"});
    if (!built || !scene) {
      error = built ? scene.error().what : built.error().what;
      return;
    }
    library = std::move(*built);
    const auto store = std::make_shared<ImpactStore>();
    FightOptions options;
    options.impacts = store;
    moments = moments_of(*library, *scene, options);
    std::vector<Contender> contenders;
    for (const SceneFighter& one : scene->fighters) {
      contenders.push_back({make_body(one.body), one.style});
    }
    planner = std::make_unique<Planner>(*library, contenders, scene->planner, scene->seed, store);
  }
};

void decisions_known(benchmark::State& bench) {
  static const Decisions all;
  if (!all.planner) return bench.SkipWithError(all.error.c_str());
  std::uint64_t nodes = 0;
  Tick horizons = 0;
  std::int64_t values = 0;
  const auto decide = [&] {
    nodes = 0, values = 0, horizons = 0;
    for (const Moment& one : all.moments) {
      const Plan plan = all.planner->plan(one.state, one.fighter);
      nodes += plan.record.nodes;
      horizons += plan.record.horizon;
      values += plan.record.lines.empty() ? 0 : plan.record.lines.front().score;
    }
  };
  decide();  // looks at trees other than the bout's own: nothing was noted as used
  for (auto _ : bench) decide();
  bench.counters["decisions"] = static_cast<double>(all.moments.size());
  bench.counters["horizon"] = seconds(horizons) / static_cast<double>(all.moments.size());
  bench.counters["nodes"] = static_cast<double>(nodes);
  bench.counters["values"] = static_cast<double>(values);
  bench.counters["us/node"] = benchmark::Counter(
      static_cast<double>(nodes) * 1e-6,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(decisions_known)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ringcraft
