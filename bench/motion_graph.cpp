// What the motion graph costs by the length of its captures: O(frames^2), with its constant.
//
// The capture is a boxer's bounce, jabs and steps drawn by a seed; as many clips of three seconds
// as minutes need. BM counters: pairs of coarse frames, and nanoseconds per pair.
#include <benchmark/benchmark.h>

#include "../tests/motion/synthetic.h"
#include "base/random.h"
#include "motion/motion_graph.h"

namespace ringcraft {
namespace {

// Three seconds of one fighter who shifts about, from a seed.
Clip shifting(const Skeleton& skeleton, std::uint64_t seed) {
  Random random(seed);
  const float sway = random.uniform(0.5f, 3), bounce = random.uniform(1, 4);
  const float reach = random.uniform(0, 0.3f), turn = random.uniform(-0.4f, 0.4f);
  return test::clip_of(
      skeleton, 3 * kTicksPerSecond,
      [=](float t) {
        test::Stance stance;
        stance.hips.x += 0.03f * std::sin(2 * kPi * sway * t);
        stance.hips.y += 0.02f * std::sin(2 * kPi * bounce * t);
        stance.chest_yaw = turn * std::sin(2 * kPi * sway * t);
        stance.left_hand.z += reach * test::bump(t, 0.2f, 0.5f);
        stance.right_hand.z += reach * test::bump(t, 0.6f, 0.8f);
        return stance;
      },
      test::both, test::in_place);
}

void graph_of_minutes(benchmark::State& state) {
  const Skeleton skeleton = canonical_skeleton();
  GraphSettings settings;
  settings.threads = static_cast<int>(state.range(1));
  std::vector<Clip> clips;
  for (std::uint64_t i = 0; i < 20 * static_cast<std::uint64_t>(state.range(0)); ++i) {
    clips.push_back(shifting(skeleton, i));
  }
  std::vector<GraphSource> sources;
  for (const Clip& clip : clips) {
    sources.push_back({"", &clip, {{0, clip.length(), true, true}}, settings.striking, true});
  }
  std::uint64_t pairs = 0;
  std::size_t transitions = 0;
  for (auto _ : state) {
    const MotionGraph graph = build_motion_graph(skeleton, sources, settings);
    pairs += graph.pairs;
    transitions = graph.transitions.size();
  }
  state.counters["pairs"] = static_cast<double>(pairs) / static_cast<double>(state.iterations());
  state.counters["s/pair"] = benchmark::Counter(
      static_cast<double>(pairs), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["transitions"] = static_cast<double>(transitions);
}
BENCHMARK(graph_of_minutes)
    ->ArgNames({"minutes", "threads"})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Args({4, 1})
    ->Args({8, 1})
    ->Args({10, 2})
    ->Iterations(1)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace ringcraft
