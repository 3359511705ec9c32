// Keeps a body that sits or lies out of the floor: see clear_floor in retarget.h.
#include <algorithm>
#include <cmath>

#include "capture/ease.h"
#include "capture/retarget.h"
#include "motion/ik.h"

namespace ringcraft {
namespace {

constexpr float kElbow = 0.045f;             // m of the elbow over the floor
constexpr float kFist = 0.085f;              // m from wrist to knuckles
constexpr float kLargestBend = radians(60);  // of the wrist on the floor

void lift_arm(const Skeleton& skeleton, Side side, Pose& pose) {
  WorldPose world = world_pose(skeleton, pose);
  const Limb limb = arm(side);
  const Vec3 along = glm::normalize(skeleton.offset[index(limb.end)]);
  const Vec3 wrist = world.position[index(limb.end)];
  const Vec3 points = world.rotation[index(limb.end)] * along;
  const Vec3 forearm = world.rotation[index(limb.middle)] * along;
  float wrist_height = eased_up(wrist.y, kPalm, kLyingEase);
  const float knuckles = wrist_height + points.y * kFist;
  if (knuckles < kPalm + kLyingEase) {
    // 1. Bend the hand at the wrist until the knuckles lie no lower than the palm, or as far as it
    // goes.
    const float up =
        std::clamp((eased_up(knuckles, kPalm, kLyingEase) - wrist_height) / kFist, -1.0f, 1.0f);
    const Vec3 ground = normalized_or(Vec3(points.x, 0, points.z), kForward);
    const Vec3 wanted = ground * std::sqrt(std::max(0.0f, 1 - up * up)) + kUp * up;
    const Quat bend = rotation_between(forearm, wanted);
    const float share = std::min(1.0f, kLargestBend / std::max(glm::angle(bend), 1e-3f));
    const Vec3 bent = glm::slerp(Quat(1, 0, 0, 0), bend, share) * forearm;
    set_world_rotation(skeleton, limb.end,
                       rotation_between(points, bent) * world.rotation[index(limb.end)], pose);
    wrist_height = std::max(wrist_height, kPalm - bent.y * kFist);
  }
  // 2. Lift the wrist, and the elbow by turning the arm about the line from shoulder to wrist.
  const Vec3 elbow = world.position[index(limb.middle)];
  if (wrist_height <= wrist.y && elbow.y >= kElbow + kLyingEase) return;
  LimbTarget target;
  target.position = {wrist.x, wrist_height, wrist.z};
  target.pole = present_pole(world, limb, -kUp) +
                kUp * std::max(0.0f, (eased_up(elbow.y, kElbow, kLyingEase) - elbow.y) * 10);
  solve_limb(skeleton, limb, target, pose);
}

}  // namespace

void clear_floor(const Skeleton& skeleton, Clip& clip) {
  for (Pose& pose : clip.frames) {
    pose.hips.y = eased_up(pose.hips.y, kSeatHeight, kLyingEase);
    for (const Side side : {Side::left, Side::right}) lift_arm(skeleton, side, pose);
  }
}

}  // namespace ringcraft
