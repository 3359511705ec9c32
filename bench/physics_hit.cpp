// What a hit and a penetration test cost.
#include <benchmark/benchmark.h>

#include "motion/ik.h"
#include "physics/impact.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

Pose guard(const Skeleton& skeleton) {
  Pose pose = rest_pose(skeleton);
  pose.hips += Vec3{0, -.06f, .02f};
  for (const Side side : {Side::left, Side::right}) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    const Vec3 ankle{.13f * out, skeleton.ankle_height(), .20f * out};
    solve_limb(skeleton, leg(side), {ankle, kForward}, pose);
    set_world_rotation(skeleton, leg(side).end, Quat(), pose);
    solve_limb(skeleton, arm(side), {{.09f * out, 1.45f, .30f}, {.5f * out, -1, 0}}, pose);
  }
  return pose;
}

struct Scene {
  BodyModel body = make_body({});
  Pose pose = guard(body.skeleton);
  std::vector<Pose> standing = std::vector<Pose>(kImpulseStepTicks + 1, pose);
  ImpactInput input;
  Scene() {
    input.pose = input.pose_before = pose;
    input.continued = standing;
    input.contacts = {true, true};
    const Capsule c = capsules(body, world_pose(body.skeleton, pose))[index(Part::chest)];
    input.blow = {Part::chest, (c.a + c.b) * .5f, {0, 0, -40}, 3, 8, false};
  }
};

void impulse_step_of_100_ms(benchmark::State& state) {
  const Scene scene;
  for (auto _ : state) benchmark::DoNotOptimize(impulse_step(scene.body, scene.input));
}
BENCHMARK(impulse_step_of_100_ms)->Unit(benchmark::kMicrosecond);

void shown_absorb_of_150_ms(benchmark::State& state) {
  const Scene scene;
  const ImpactOutcome outcome;
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate_response(scene.body, scene.input, outcome, {}, 18));
  }
}
BENCHMARK(shown_absorb_of_150_ms)->Unit(benchmark::kMicrosecond);

void shown_fall_of_2_s(benchmark::State& state) {
  Scene scene;
  scene.input.blow.impulse = {0, 0, -170};
  const ImpactOutcome outcome = impulse_step(scene.body, scene.input);
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate_response(scene.body, scene.input, outcome, {}, 240));
  }
}
BENCHMARK(shown_fall_of_2_s)->Unit(benchmark::kMillisecond);

void effective_mass_of_a_fist(benchmark::State& state) {
  const Scene scene;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        effective_mass(scene.body, scene.pose, Part::right_hand, {0, 1.45f, .4f}, kForward, .25f));
  }
}
BENCHMARK(effective_mass_of_a_fist)->Unit(benchmark::kMicrosecond);

void penetration_of_two_bodies(benchmark::State& state) {
  const Scene scene;
  const BodyCapsules a = capsules(scene.body, world_pose(scene.body.skeleton, scene.pose));
  const Pose there = placed(scene.pose, {0, static_cast<float>(state.range(0)) / 100, kPi});
  const BodyCapsules b = capsules(scene.body, world_pose(scene.body.skeleton, there));
  for (auto _ : state) benchmark::DoNotOptimize(deepest_penetration(a, b));
}
BENCHMARK(penetration_of_two_bodies)->Arg(40)->Arg(80)->Arg(160);

void capsules_of_a_pose(benchmark::State& state) {
  const Scene scene;
  for (auto _ : state) {
    benchmark::DoNotOptimize(capsules(scene.body, world_pose(scene.body.skeleton, scene.pose)));
  }
}
BENCHMARK(capsules_of_a_pose);

}  // namespace
}  // namespace ringcraft
