#include "scene/keep_out.h"

#include <algorithm>
#include <array>

#include "motion/ik.h"
#include "physics/penetration.h"

namespace ringcraft {

namespace {

// How far, and which way, the part must move to clear the other body. Zero where it touches
// nothing.
Vec3 way_out(const Capsule& part, const BodyCapsules& other, Vec3 away) {
  Vec3 way{};
  for (int pass = 0; pass < 2; ++pass) {  // the way out of one part may lead into its neighbour
    float deepest = 0;
    Vec3 step{};
    for (const Capsule& obstacle : other) {
      const SegmentDistance nearest =
          segment_distance(part.a + way, part.b + way, obstacle.a, obstacle.b);
      const float depth = part.radius + obstacle.radius - nearest.distance;
      if (depth <= deepest) continue;
      deepest = depth;
      step = normalized_or(nearest.on_first - nearest.on_second, away) * depth;
    }
    if (deepest <= 0) break;
    way += step;
  }
  const float length = glm::length(way);
  return length > kMostKeptOut ? way * (kMostKeptOut / length) : way;
}

void move_end(const BodyModel& body, const Limb& limb, Vec3 way, Vec3 fallback_pole, Pose& pose) {
  const WorldPose world = world_pose(body.skeleton, pose);
  LimbTarget target;
  target.position = world.position[index(limb.end)] + way;
  target.pole = present_pole(world, limb, fallback_pole);
  target.soft_share = 1.0f;
  solve_limb(body.skeleton, limb, target, pose);
}

}  // namespace

Pose kept_out(const BodyModel& body, const Pose& pose, FootContacts held,
              const BodyCapsules& other) {
  Pose result = pose;
  struct Mover {
    Limb limb;
    std::array<Part, 2> parts;  // end first
    bool moves;
    Vec3 pole;
  };
  const WorldPose world = world_pose(body.skeleton, pose);
  const Vec3 forward = world.rotation[index(Joint::hips)] * kForward;
  const std::array<Mover, 4> movers = {{
      {arm(Side::left), {Part::left_hand, Part::left_forearm}, true, -kUp},
      {arm(Side::right), {Part::right_hand, Part::right_forearm}, true, -kUp},
      {leg(Side::left), {Part::left_foot, Part::left_shin}, !held.left, forward},
      {leg(Side::right), {Part::right_foot, Part::right_shin}, !held.right, forward},
  }};
  for (const Mover& mover : movers) {
    if (!mover.moves) continue;
    for (const Part part : mover.parts) {
      const BodyCapsules own = capsules(body, world_pose(body.skeleton, result));
      const Vec3 way = way_out(own[index(part)], other, -forward);
      if (way != Vec3{}) move_end(body, mover.limb, way, mover.pole, result);
    }
  }
  return result;
}

}  // namespace ringcraft
