#include "scene/bench.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fight/synthetic_library.h"

namespace ringcraft {
namespace {

SceneFile short_scene() {
  SceneFile scene;
  scene.name = "short";
  scene.duration = ticks(1.5);
  for (int i = 0; i < 2; ++i) {
    SceneFighter fighter;
    fighter.team = i;
    fighter.style.horizon_s = 0.6;
    fighter.placement = {0, i == 0 ? -0.6f : 0.6f, i == 0 ? 0 : kPi};
    scene.fighters.push_back(fighter);
  }
  return scene;
}

TEST(BenchTest, TheSignatureIsTheSameInEveryRoundAndForAnyThreads) {
  const MotionLibrary library = synthetic::library();
  const SceneFile scene = short_scene();
  const Bench one = run_bench(library, scene, 2, {1, nullptr, {}});
  const Bench two = run_bench(library, scene, 1, {2, nullptr, {}});
  EXPECT_FALSE(one.differs);
  EXPECT_EQ(one.rounds, 2);
  EXPECT_GT(one.signature.nodes, 0u);
  EXPECT_EQ(one.signature, two.signature);
  EXPECT_EQ(one.decision_ms.size(), 2 * one.signature.decisions);
}

TEST(BenchTest, ClockFiguresStandApart) {
  const MotionLibrary library = synthetic::library();
  const SceneFile scene = short_scene();
  const Bench bench = run_bench(library, scene, 1, {1, nullptr, {}});
  const nlohmann::json timing = bench_timing_json(bench, 1);
  for (const char* key : {"decisions_per_s", "nodes_per_s", "penetration_frame_pairs_per_s",
                          "realtime_factor", "wall_s"})
    EXPECT_GT(timing.at(key).get<double>(), 0) << key;
  Bench slower = bench;
  slower.wall_s *= 2;
  slower.decision_ms.assign(slower.decision_ms.size(), 99);
  slower.frame_pairs_per_s /= 2;
  EXPECT_EQ(bench_json(bench, scene, library), bench_json(slower, scene, library));
}

TEST(BenchTest, AnotherFightHasAnotherSignature) {
  const MotionLibrary library = synthetic::library();
  SceneFile scene = short_scene();
  const Bench first = run_bench(library, scene, 1, {1, nullptr, {}});
  scene.fighters[0].style.horizon_s = 0.9;
  const Bench second = run_bench(library, scene, 1, {1, nullptr, {}});
  EXPECT_NE(first.signature, second.signature);
}

TEST(BenchTest, AnInterruptedRoundIsNotCounted) {
  const MotionLibrary library = synthetic::library();
  const std::atomic<bool> interrupted = true;
  const Bench bench = run_bench(library, short_scene(), 3, {1, &interrupted, {}});
  EXPECT_TRUE(bench.interrupted);
  EXPECT_EQ(bench.rounds, 0);
  EXPECT_EQ(bench_timing_json(bench, 1).at("nodes_per_s").get<double>(), 0);
}

}  // namespace
}  // namespace ringcraft
