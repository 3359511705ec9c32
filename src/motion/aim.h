#pragma once
// Named targets on a body: what a blow is aimed at.

#include <span>

#include "motion/action.h"

namespace ringcraft {

struct AimPoint {
  std::string_view name;
  TargetZone zone = TargetZone::head;
  Joint joint = Joint::head;
  Vec3 offset{};  // from the joint in its own axes, fraction of standing height
};

const AimPoint* aim_point(std::string_view name);  // null where there is none

// Where it is on a body of that height, in the space of the pose, m.
Vec3 position_of(const AimPoint& point, const WorldPose& world, float height);

// The same of somebody in `guard` (of canonical height) who is `ratio` times as tall and stands
// `distance` m away, looking back: in the action space of who strikes.
Vec3 opponent_aim(const AimPoint& point, const WorldPose& guard, float ratio, float distance);

// How near the way of a striking point, one position a tick, comes to `aim` while the strike is
// active, m; `at` is the last tick before that where it is asked for.
float passes(const Strike& strike, const std::vector<Vec3>& tip, Vec3 aim, Tick* at = nullptr);

// The point of the body that a strike lands with: knuckles, instep, ball of the foot, heel, elbow
// or knee, in the space of the pose, m.
Vec3 striking_point(const Strike& strike, const Skeleton& skeleton, const WorldPose& world);

}  // namespace ringcraft
