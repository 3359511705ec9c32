// The penetration check against Bullet's own collision world and against the plain loop over all
// pairs, on the same capsules in one run. Argument: centimetres between the roots. `pairs/s` counts
// pairs of frames.
#include <benchmark/benchmark.h>
#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "../tests/fight/synthetic_library.h"
#include "physics/penetration.h"
#include "planner/motion_tables.h"

namespace ringcraft {
namespace {

constexpr float kLeast = 0.03f;  // m: shallower is not asked for, as in the tree

struct Frames {
  MotionLibrary library = synthetic::library();
  MotionTables tables{library, make_body({})};
  std::vector<std::pair<InFlight, InFlight>> launches;  // one a frame
  std::vector<Tick> ticks;
  std::vector<std::pair<BodyCapsules, BodyCapsules>> world;

  // Every seventh tick of idles, steps and guards before each other.
  explicit Frames(float distance) {
    for (const char* first : {"idle", "step_left", "guard_high", "step_back"}) {
      for (const char* second : {"idle", "step_left", "slip_left", "guard_high"}) {
        if (!library.find(first).valid() || !library.find(second).valid()) continue;
        for (Tick tick = 0; tick < 30; tick += 7) add(first, second, distance, tick);
      }
    }
  }
  void add(const char* first, const char* second, float distance, Tick tick) {
    const auto launch = [&](const char* name, const Placement& at) {
      Launch one;
      one.action = library.find(name);
      one.end = library.action(one.action).length();
      one.placement = at;
      return InFlight(tables, one);
    };
    const InFlight a = launch(first, {}), b = launch(second, {0, distance, kPi});
    std::pair<BodyCapsules, BodyCapsules> both{a.table->capsules_at(tick),
                                               b.table->capsules_at(tick)};
    const Frame at = b.frame_at(tick);
    for (Capsule& c : both.second) c.a = at.to_outer(c.a), c.b = at.to_outer(c.b);
    launches.emplace_back(a, b);
    ticks.push_back(tick);
    world.push_back(both);
  }
};

const Frames& frames_at(std::int64_t centimetres) {
  static std::vector<std::pair<std::int64_t, std::unique_ptr<Frames>>> all;
  for (const auto& [at, frames] : all) {
    if (at == centimetres) return *frames;
  }
  all.emplace_back(centimetres, std::make_unique<Frames>(static_cast<float>(centimetres) / 100.0f));
  return *all.back().second;
}

void count(benchmark::State& bench) {
  bench.counters["pairs/s"] =
      benchmark::Counter(static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}

// As the tree asks: from the motion tables.
void penetration_check(benchmark::State& bench) {
  const Frames& frames = frames_at(bench.range(0));
  std::size_t i = 0;
  for (auto _ : bench) {
    const auto& [a, b] = frames.launches[i];
    benchmark::DoNotOptimize(penetration_at(a, b, frames.ticks[i], kLeast));
    i = (i + 1) % frames.launches.size();
  }
  count(bench);
}

// The same of capsules that nobody has seen before: spheres are made on the way.
void penetration_of_capsules(benchmark::State& bench) {
  const Frames& frames = frames_at(bench.range(0));
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(deepest_penetration(frames.world[i].first, frames.world[i].second));
    i = (i + 1) % frames.world.size();
  }
  count(bench);
}

void plain_loop(benchmark::State& bench) {
  const Frames& frames = frames_at(bench.range(0));
  std::size_t i = 0;
  for (auto _ : bench) {
    float deepest = 0;
    for (const Capsule& a : frames.world[i].first) {
      for (const Capsule& b : frames.world[i].second) {
        deepest =
            std::max(deepest, a.radius + b.radius - segment_distance(a.a, a.b, b.a, b.b).distance);
      }
    }
    benchmark::DoNotOptimize(deepest);
    i = (i + 1) % frames.world.size();
  }
  count(bench);
}

// Bullet's collision world: one object a capsule, pairs of one body filtered out, moved every
// frame.
class BulletBodies {
 public:
  explicit BulletBodies(const Frames& frames)
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &configuration_) {
    for (int side = 0; side < 2; ++side) {
      const BodyCapsules& body =
          side == 0 ? frames.world.front().first : frames.world.front().second;
      for (const Capsule& c : body) {
        shapes_.push_back(std::make_unique<btCapsuleShape>(c.radius, glm::distance(c.a, c.b)));
        objects_.push_back(std::make_unique<btCollisionObject>());
        objects_.back()->setCollisionShape(shapes_.back().get());
        world_.addCollisionObject(objects_.back().get(), side == 0 ? 1 : 2, side == 0 ? 2 : 1);
      }
    }
  }
  BulletBodies(const BulletBodies&) = delete;
  BulletBodies& operator=(const BulletBodies&) = delete;
  ~BulletBodies() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  float deepest(const std::pair<BodyCapsules, BodyCapsules>& frame) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const Capsule& c = i < kPartCount ? frame.first[i] : frame.second[i - kPartCount];
      const Vec3 middle = (c.a + c.b) * 0.5f;
      const Quat turn = rotation_between(kUp, normalized_or(c.b - c.a, kUp));
      objects_[i]->setWorldTransform(btTransform(btQuaternion(turn.x, turn.y, turn.z, turn.w),
                                                 btVector3(middle.x, middle.y, middle.z)));
    }
    world_.performDiscreteCollisionDetection();
    float deepest = 0;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        deepest = std::max(deepest, -manifold.getContactPoint(k).getDistance());
      }
    }
    return deepest;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
  std::vector<std::unique_ptr<btCapsuleShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

void bullet_world(benchmark::State& bench) {
  const Frames& frames = frames_at(bench.range(0));
  BulletBodies bodies(frames);
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(bodies.deepest(frames.world[i]));
    i = (i + 1) % frames.world.size();
  }
  count(bench);
}

BENCHMARK(penetration_check)->Arg(60)->Arg(80)->Arg(100);
BENCHMARK(penetration_of_capsules)->Arg(60)->Arg(80)->Arg(100);
BENCHMARK(plain_loop)->Arg(60)->Arg(80)->Arg(100);
BENCHMARK(bullet_world)->Arg(60)->Arg(80)->Arg(100);

}  // namespace
}  // namespace ringcraft
