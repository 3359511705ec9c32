#include "physics/response.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ringcraft {
namespace {

// How ill an action's tag answers the outcome; smaller is better, compared in order.
struct Misfit {
  int kind = 0;         // 0 same kind
  int steps = 0;        // difference in steps
  float direction = 0;  // rad between the directions

  bool better_than(const Misfit& other) const {
    if (kind != other.kind) return kind < other.kind;
    // Half a step's worth of direction: a step more in the right direction beats the right count in
    // the opposite one (a wrong direction is seen sooner than a wrong strength, validation V4).
    const float a = static_cast<float>(steps) + direction / radians(60);
    const float b = static_cast<float>(other.steps) + other.direction / radians(60);
    return a < b;
  }
};

// Order of severity; an outcome without an action of its kind takes the next in this order.
int severity(ResponseKind kind) {
  return static_cast<int>(kind);
}

Misfit misfit(const Response& tag, const ImpactOutcome& outcome, float direction) {
  Misfit m;
  m.kind = std::abs(severity(tag.kind) - severity(outcome.response));
  if (outcome.response == ResponseKind::recovery_steps)
    m.steps = std::abs(tag.steps - outcome.steps);
  m.direction = std::abs(wrapped_angle(tag.direction - direction));
  return m;
}

// Joint positions about the hips, heading removed: lying poses compare by shape.
std::array<Vec3, kJointCount> shape_of(const Skeleton& skeleton, const Pose& pose, Quat unturned) {
  const WorldPose world = world_pose(skeleton, pose);
  std::array<Vec3, kJointCount> shape;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    Vec3 d = world.position[i] - world.position[0];
    d.y = world.position[i].y;
    shape[i] = unturned * d;
  }
  return shape;
}

// Yaw of the line from the hips to the head: the heading of a body that lies.
float yaw_of_body(const Skeleton& skeleton, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 d = world.position[index(Joint::head)] - world.position[0];
  return yaw_of(Vec3{d.x, 0, d.z});
}

}  // namespace

ActionId choose_response(const MotionLibrary& library, const ImpactOutcome& outcome, float facing) {
  const float direction = wrapped_angle(outcome.direction - facing);
  ActionId best;
  Misfit least;
  for (const ActionId id : library.responses()) {
    const Action& action = library.action(id);
    if (!action.response) continue;
    const Misfit m = misfit(*action.response, outcome, direction);
    if (!best.valid() || m.better_than(least)) {  // equal: the lower index stays
      best = id;
      least = m;
    }
  }
  return best;
}

ActionId choose_get_up(const MotionLibrary& library, const Skeleton& skeleton, const Pose& pose) {
  const float scale = skeleton.height / kCanonicalHeight;
  const auto lying = shape_of(skeleton, pose, yaw_rotation(-yaw_of_body(skeleton, pose)));
  ActionId best;
  float least = std::numeric_limits<float>::max();
  for (const ActionId id : library.get_ups()) {
    const Pose start = scaled(library.action(id).clip.at(0), scale);
    const auto shape = shape_of(skeleton, start, yaw_rotation(-yaw_of_body(skeleton, start)));
    float sum = 0;
    for (std::size_t i = 0; i < kJointCount; ++i) sum += glm::distance2(shape[i], lying[i]);
    if (!best.valid() || sum < least) {
      best = id;
      least = sum;
    }
  }
  return best;
}

}  // namespace ringcraft
