#include "scene/stand_clear.h"

#include <algorithm>
#include <cmath>

#include "physics/penetration.h"
#include "planner/evaluation.h"

namespace ringcraft {

namespace {

constexpr float kIdleTurn = radians(15);  // toward the opponent, in one launch
constexpr float kClearOfLying = 0.5f;     // m from a root to the nearest part of who lies
constexpr float kWorthAStep = 0.03f;      // m that a step leads clear, at least
constexpr Tick kLookEvery = 6;            // ticks

// How far one is from standing clear where `launch` leads, m: of who lies as it ends, and of
// everybody on the way. 0 where it is clear.
float not_clear(const MotionLibrary& library, const BodyModel& body, Tick now, const Launch& launch,
                const std::vector<Bystanding>& others) {
  const Vec3 stands = root_at(library, launch, launch.end, body.scale).position();
  float deepest = 0, nearest = kClearOfLying;
  for (const Bystanding& other : others) {
    const auto shows = [&](Tick tick) {
      const Pose& pose = other.poses.at(static_cast<std::size_t>(tick - now));
      return capsules(*other.body, world_pose(other.body->skeleton, pose));
    };
    for (Tick tick = launch.start + kLookEvery; tick <= launch.end; tick += kLookEvery) {
      const Pose pose = pose_at(library, launch, tick, body.scale);
      const BodyCapsules own = capsules(body, world_pose(body.skeleton, pose));
      deepest = std::max(deepest, deepest_penetration(own, shows(tick)).depth);
    }
    if (!other.down) continue;
    for (const Capsule& part : shows(launch.end)) {
      const Vec3 a{part.a.x, 0, part.a.z}, b{part.b.x, 0, part.b.z};
      nearest = std::min(nearest, segment_distance(stands, stands, a, b).distance - part.radius);
    }
  }
  return deepest + kClearOfLying - nearest;
}

}  // namespace

std::vector<Launch> ways_to_stand(const MotionLibrary& library, const Launch& last, Tick now,
                                  Vec3 opponent, float scale, float ring) {
  const auto& edges = library.machine().edges(last.action);
  const auto by = [&](const Edge& edge) {
    return following(library, last, edge.to, now, opponent, scale, kIdleTurn);
  };
  const auto idle = std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) {
    return library.action(edge.to).kind == Kind::idle;
  });
  std::vector<Launch> ways{by(idle == edges.end() ? edges.front() : *idle)};
  for (const Edge& edge : edges) {
    const Action& action = library.action(edge.to);
    if (action.kind != Kind::transition || action.feint || action.switches) continue;
    const Launch step = by(edge);
    const Vec3 at = root_at(library, step, step.end, scale).position();
    const float inside = ring / 2 - kInsideRopes;
    if (ring > 0 && std::max(std::abs(at.x), std::abs(at.z)) > inside) continue;
    ways.push_back(step);
  }
  return ways;
}

Launch clearest(const MotionLibrary& library, const BodyModel& body, Tick now,
                const std::vector<Launch>& launches, const std::vector<Bystanding>& others) {
  Launch best = launches.front();
  float least = not_clear(library, body, now, best, others) - kWorthAStep;
  for (const Launch& launch : launches) {
    if (least <= 0) break;
    const float left = not_clear(library, body, now, launch, others);
    if (left >= least) continue;
    least = left;
    best = launch;
  }
  return best;
}

}  // namespace ringcraft
