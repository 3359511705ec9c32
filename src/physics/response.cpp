#include "physics/response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics/balance.h"
#include "physics/partial.h"

namespace ringcraft {
namespace {

constexpr float kMostUnlike = .2f;     // m
constexpr float kWrongZone = 3.0f;     // steps: a kick to the thigh does not throw the head back
constexpr float kMotionWeight = 3.0f;  // steps per metre that two motions differ by
constexpr float kStep = .4f;  // m that a clip's steps are too short or too long count as one
constexpr Tick kWindow = 14;  // of a response clip, against the 100 ms of the impulse step

// How far head, chest and hips of a clip go in its first 100 ms and a bit, action space.
std::array<Vec3, 3> moved(const Skeleton& skeleton, const Clip& clip) {
  const WorldPose from = world_pose(skeleton, clip.at(0)),
                  to = world_pose(skeleton, clip.at(kWindow));
  std::array<Vec3, 3> out;
  std::size_t n = 0;
  for (const Joint joint : {Joint::head, Joint::upper_chest, Joint::hips}) {
    out[n++] = to.position[index(joint)] - from.position[index(joint)];
  }
  return out;
}

// How differently head, chest and hips move, m, at most kMostUnlike: a response may be shown in
// part, so what counts is the share of the clip that comes nearest.
float unlike(const std::array<Vec3, 3>& simulated, const std::array<Vec3, 3>& clip) {
  float along = 0, whole = 0, sum = 0;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    along += glm::dot(simulated[i], clip[i]);
    whole += glm::dot(clip[i], clip[i]);
  }
  const float share = whole > 0 ? std::clamp(along / whole, 0.0f, 1.0f) : 0.0f;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    sum += glm::distance(simulated[i], share * clip[i]);
  }
  return std::min(sum, kMostUnlike);
}

// By how much the steps of a clip are too short or too long, m of the canonical body.
float out_of_reach(const Strides& strides, float stride) {
  return std::abs(stride - std::clamp(stride, strides.shortest, strides.longest));
}

// How ill an action answers the outcome, smaller is better: first the kind, then steps, direction
// and motion together. Sixty degrees weigh as much as a step: a step more in the right direction
// beats the right count in the opposite one (a wrong direction is seen sooner than a wrong
// strength, V4).
struct Misfit {
  int kind = 0;
  float rest = 0;
  bool better_than(const Misfit& other) const {
    return kind != other.kind ? kind < other.kind : rest < other.rest;
  }
};

// Order of severity; an outcome without an action of its kind takes the nearest in this order.
int severity(ResponseKind kind) {
  return static_cast<int>(kind);
}

Misfit misfit(const Response& tag, const ImpactOutcome& outcome, float direction) {
  Misfit m;
  m.kind = std::abs(severity(tag.kind) - severity(outcome.response));
  if (outcome.response == ResponseKind::recovery_steps) {
    m.rest += static_cast<float>(std::abs(tag.steps - outcome.steps));
  }
  m.rest += std::abs(wrapped_angle(tag.direction - direction)) / radians(60);
  if (tag.zone && *tag.zone != outcome.zone) m.rest += kWrongZone;
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

// What a joint counts for when lying poses are compared: limbs can be moved, a trunk has to roll.
float lying_weight(Joint joint) {
  for (const Side side : {Side::left, Side::right}) {
    for (const Limb& limb : {arm(side), leg(side)}) {
      if (joint == limb.middle) return .15f;
      if (joint == limb.end) return .05f;
    }
    if (joint == toes(side)) return 0;
  }
  return 1;
}

// Yaw of the line from the hips to the head: the heading of a body that lies.
float yaw_of_body(const Skeleton& skeleton, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 d = world.position[index(Joint::head)] - world.position[0];
  return yaw_of(Vec3{d.x, 0, d.z});
}

std::vector<ActionId> get_ups_of(const MotionLibrary& library, Stance stance) {
  std::vector<ActionId> result;
  std::copy_if(library.get_ups().begin(), library.get_ups().end(), std::back_inserter(result),
               [&](ActionId id) { return library.action(id).stance == stance; });
  return result;
}

}  // namespace

bool interrupts(bool blocked, float impulse, const ImpactOutcome& outcome) {
  return outcome.knockout ||
         (impulse >= kTouchImpulse && (!blocked || outcome.response != ResponseKind::absorb));
}

ImpactOutcome answered(bool cuts, ImpactOutcome outcome) {
  if (cuts) return outcome;
  outcome.response = ResponseKind::absorb;
  outcome.steps = 0;
  return outcome;
}

ActionId choose_response(const MotionLibrary& library, const BodyModel& body,
                         const ImpactOutcome& outcome, float facing, Stance stance) {
  const float direction = wrapped_angle(outcome.direction - facing);
  std::array<Vec3, 3> simulated = outcome.moved;
  for (Vec3& m : simulated) m = yaw_rotation(-facing) * m;
  const bool moves = outcome.moved != std::array<Vec3, 3>{};  // an outcome made by hand may not say
  const bool steps = outcome.response == ResponseKind::recovery_steps;
  const float stride = stride_to_catch(body, outcome.margin) / body.scale;
  ActionId best;
  Misfit least;
  for (const ActionId id : library.responses()) {
    const Action& action = library.action(id);
    if (!action.response || action.stance != stance) continue;
    Misfit m = misfit(*action.response, outcome, direction);
    if (best.valid() && !m.better_than(least)) continue;  // what follows only adds to it
    if (moves) m.rest += kMotionWeight * unlike(simulated, moved(library.skeleton(), action.clip));
    if (steps) {
      m.rest += out_of_reach(strides_of(library.skeleton(), action.clip, 1), stride) / kStep;
    }
    if (!best.valid() || m.better_than(least)) {  // equal: the lower index stays
      best = id;
      least = m;
    }
  }
  return best;
}

NearestLying nearest_lying(const Skeleton& skeleton, std::span<const Pose> lying,
                           const Pose& pose) {
  const auto is = shape_of(skeleton, pose, yaw_rotation(-yaw_of_body(skeleton, pose)));
  NearestLying best;
  float least = std::numeric_limits<float>::max(), weights = 0;
  for (std::size_t i = 0; i < kJointCount; ++i) weights += lying_weight(joint_at(i));
  for (std::size_t k = 0; k < lying.size(); ++k) {
    const auto shape = shape_of(skeleton, lying[k], yaw_rotation(-yaw_of_body(skeleton, lying[k])));
    float sum = 0;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      sum += lying_weight(joint_at(i)) * glm::distance2(shape[i], is[i]);
    }
    if (sum < least) {
      best = {k, std::sqrt(sum / weights)};
      least = sum;
    }
  }
  return best;
}

std::vector<Pose> lying_poses(const MotionLibrary& library, const Skeleton& skeleton,
                              Stance stance) {
  std::vector<Pose> poses;
  for (const ActionId id : get_ups_of(library, stance)) {
    poses.push_back(scaled(library.action(id).clip.at(0), skeleton.height / kCanonicalHeight));
  }
  return poses;
}

ActionId choose_get_up(const MotionLibrary& library, const Skeleton& skeleton, const Pose& pose,
                       Stance stance) {
  const std::vector<ActionId> get_ups = get_ups_of(library, stance);
  if (get_ups.empty()) return {};
  return get_ups[nearest_lying(skeleton, lying_poses(library, skeleton, stance), pose).pose];
}

}  // namespace ringcraft
