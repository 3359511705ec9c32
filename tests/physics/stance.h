#pragma once
// Test poses made by IK: the square and fighting stances of docs/sources.md, R.

#include "motion/ik.h"
#include "physics/stances.h"

namespace ringcraft::stance {

inline Pose square(const BodyModel& body) {
  return square_stance(body);
}

inline Pose fighting(const BodyModel& body) {
  return fighting_stance(body);
}

// The fighting stance with one arm at full reach to `fist` (from the chin, body facing, m).
inline Pose punching(const BodyModel& body, Side side, Vec3 fist, Vec3 elbow) {
  Pose pose = fighting(body);
  const Limb a = arm(side);
  const WorldPose world = world_pose(body.skeleton, pose);
  solve_limb(body.skeleton, a,
             {world.position[index(Joint::head)] + body.scale * fist, elbow, 1.0f}, pose);
  set_world_rotation(body.skeleton, a.end,
                     world_pose(body.skeleton, pose).rotation[index(a.middle)], pose);
  return pose;
}

}  // namespace ringcraft::stance
