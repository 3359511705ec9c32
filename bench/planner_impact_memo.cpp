// Impulse steps as the tree asks for them: many blows on the same posed bodies, each by itself and
// through a memo that keeps what a body does without the blow. The ratio is that of one run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "../tests/fight/synthetic_library.h"
#include "base/random.h"
#include "planner/impact_memo.h"

namespace ringcraft {
namespace {

std::vector<LandedBlow> blows_on(const MotionTables& tables, std::size_t count) {
  const MotionLibrary& library = tables.library();
  Random random(7);
  std::vector<ActionId> attacks;
  for (const ActionId id : library.launchable()) {
    if (library.action(id).attacks()) attacks.push_back(id);
  }
  const ActionId struck = library.find("idle");
  std::vector<LandedBlow> blows;
  blows.reserve(count);
  while (blows.size() < count) {
    LandedBlow blow;
    const ActionId attack =
        attacks[static_cast<std::size_t>(random.below(static_cast<int>(attacks.size())))];
    const Strike& strike = library.action(attack).strikes.front();
    blow.attack = {&tables.at(attack), strike.active_begin};
    blow.kind = strike.kind;
    blow.struck = {&tables.at(struck), 6 * random.below(3)};
    constexpr std::array<Part, 3> kStruck{Part::head, Part::chest, Part::abdomen};
    blow.contact.striker = *part_of(strike.joint);
    blow.contact.struck = kStruck[static_cast<std::size_t>(random.below(3))];
    const Vec3 line = yaw_rotation(random.uniform(-kPi, kPi)) * kForward;
    blow.contact.normal = -line;
    blow.contact.velocity = line * random.uniform(6, 16);
    blow.attacker_yaw = yaw_of(line);
    blows.push_back(blow);
  }
  return blows;
}

void impulse_steps_of_a_tree(benchmark::State& bench) {
  using Clock = std::chrono::steady_clock;
  const MotionLibrary library = synthetic::library();
  const MotionTables tables(library, make_body({}));
  const std::vector<LandedBlow> blows = blows_on(tables, 60);
  std::vector<double> ratios;
  for (auto _ : bench) {
    const auto begin = Clock::now();
    ImpactMemo memo({&tables});
    std::vector<LandedBlow> distinct;  // the memo answers the others by itself
    for (const LandedBlow& blow : blows) {
      const auto known = memo.counts().entries;
      memo.answer(blow);
      if (memo.counts().entries > known) distinct.push_back(blow);
    }
    const auto middle = Clock::now();
    for (const LandedBlow& blow : distinct) benchmark::DoNotOptimize(memo.recomputed(blow));
    const auto end = Clock::now();
    const std::chrono::duration<double> kept = middle - begin, each = end - middle;
    ratios.push_back(each / kept);
  }
  std::sort(ratios.begin(), ratios.end());
  bench.counters["each_over_kept"] = ratios[ratios.size() / 2];
}
BENCHMARK(impulse_steps_of_a_tree)->Unit(benchmark::kMillisecond)->Iterations(9);

}  // namespace
}  // namespace ringcraft
