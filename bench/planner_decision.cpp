// Cost of one decision by horizon, with a warm memo (the impulse steps of these states are known)
// and with a cold one; and of the pieces: expanding a node, testing penetration, testing a contact.
#include <benchmark/benchmark.h>

#include "../tests/fight/synthetic_library.h"
#include "base/random.h"
#include "planner/duel.h"
#include "planner/plan.h"

namespace ringcraft {
namespace {

const MotionLibrary& library() {
  static const MotionLibrary kLibrary = synthetic::library();
  return kLibrary;
}

FightState state_of(std::uint64_t seed) {
  Random random(seed);
  FightState state;
  const ActionId idle = library().find("idle");
  for (int i = 0; i < 2; ++i) {
    FighterState fighter;
    fighter.launch.action = idle;
    fighter.launch.end = i == 0 ? 0 : random.below(30);
    fighter.launch.start = fighter.launch.end - library().action(idle).length();
    fighter.launch.placement = {random.uniform(-0.2f, 0.2f), i == 0 ? -0.5f : 0.5f,
                                (i == 0 ? 0 : kPi) + random.uniform(-0.4f, 0.4f)};
    fighter.opponent = FighterId(1 - i);
    state.fighters.push_back(fighter);
  }
  return state;
}

std::vector<Contender> contenders(double horizon) {
  Style style;
  style.horizon_s = horizon;
  return {{make_body({}), style}, {make_body({}), style}};
}

void decide(benchmark::State& bench, bool warm) {
  constexpr std::uint64_t kStates = 4;
  const double horizon = static_cast<double>(bench.range(0)) / 100;
  auto planner = std::make_unique<Planner>(library(), contenders(horizon), PlanSettings{}, 1);
  if (warm) {
    for (std::uint64_t seed = 0; seed < kStates; ++seed) {
      planner->plan(state_of(seed), FighterId(0));
    }
  }
  std::uint64_t seed = 0, nodes = 0;
  for (auto _ : bench) {
    if (!warm) {
      bench.PauseTiming();
      planner = std::make_unique<Planner>(library(), contenders(horizon), PlanSettings{}, 1);
      bench.ResumeTiming();
    }
    nodes += planner->plan(state_of(seed++ % kStates), FighterId(0)).record.nodes;
  }
  bench.counters["nodes"] =
      benchmark::Counter(static_cast<double>(nodes), benchmark::Counter::kAvgIterations);
  bench.counters["nodes/s"] =
      benchmark::Counter(static_cast<double>(nodes), benchmark::Counter::kIsRate);
}

void decision_warm(benchmark::State& bench) {
  decide(bench, true);
}
void decision_cold(benchmark::State& bench) {
  decide(bench, false);
}
BENCHMARK(decision_warm)->Arg(100)->Arg(150)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(decision_cold)->Arg(100)->Arg(150)->Iterations(4)->Unit(benchmark::kMillisecond);

Launch launch(const char* name, Placement placement) {
  Launch launch;
  launch.action = library().find(name);
  launch.end = library().action(launch.action).length();
  launch.placement = placement;
  return launch;
}

void penetration(benchmark::State& bench) {
  const MotionTables tables(library(), make_body({}));
  const InFlight a(tables, launch("idle", {}));
  const InFlight b(tables, launch("step_left", {0, static_cast<float>(bench.range(0)) / 100, kPi}));
  Tick tick = 0;
  for (auto _ : bench) benchmark::DoNotOptimize(penetration_at(a, b, tick++ % 30, 0.03f));
}
BENCHMARK(penetration)->Arg(60)->Arg(95)->Arg(150);

void contact(benchmark::State& bench) {
  const MotionTables tables(library(), make_body({}));
  const InFlight a(tables, launch("cross", {}));
  const InFlight b(tables, launch("idle", {0, static_cast<float>(bench.range(0)) / 100, kPi}));
  const StrikeTable& strike = a.table->strikes[0];
  Tick tick = strike.strike.active_begin;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(contact_at(a, strike, b, tick));
    if (++tick >= strike.strike.active_end) tick = strike.strike.active_begin;
  }
}
BENCHMARK(contact)->Arg(95)->Arg(250);

}  // namespace
}  // namespace ringcraft
