#pragma once
// Test poses made by IK: ragdoll.md's square and fighting stances.

#include "motion/ik.h"
#include "physics/body.h"

namespace ringcraft::stance {

struct Feet {
  Vec3 left{}, right{};  // ankles, m
  float left_yaw = 0, right_yaw = 0;
};

inline void plant(const BodyModel& body, const Feet& feet, Pose& pose) {
  const auto foot = [&](Side side, Vec3 ankle, float yaw) {
    const Limb l = leg(side);
    set_world_rotation(body.skeleton, l.end, yaw_rotation(yaw), pose);
    solve_limb(body.skeleton, l, {ankle, yaw_rotation(yaw) * kForward, 1.0f}, pose);
    set_world_rotation(body.skeleton, l.end, yaw_rotation(yaw), pose);
  };
  foot(Side::left, feet.left, feet.left_yaw);
  foot(Side::right, feet.right, feet.right_yaw);
}

inline void raise_guard(const BodyModel& body, Pose& pose) {
  const WorldPose world = world_pose(body.skeleton, pose);
  const Quat facing = yaw_rotation(heading_of(world.rotation[index(Joint::upper_chest)]));
  const Vec3 chin = world.position[index(Joint::head)];
  const float k = body.scale;
  const auto hand = [&](Side side, Vec3 at) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    const Limb a = arm(side);
    solve_limb(body.skeleton, a,
               {chin + facing * (k * Vec3{out * at.x, at.y, at.z}),
                facing * Vec3{out * .5f, -1, -.2f}, 1.0f},
               pose);
    set_world_rotation(body.skeleton, a.end,
                       world_pose(body.skeleton, pose).rotation[index(a.middle)], pose);
  };
  hand(Side::left, {.10f, -.02f, .28f});
  hand(Side::right, {.10f, -.06f, .18f});
}

// Feet 22 cm apart, the centre of mass 5 cm before the ankles, hands in guard.
inline Pose square(const BodyModel& body) {
  const float k = body.scale, ankle = body.skeleton.ankle_height();
  Pose pose = rest_pose(body.skeleton);
  pose.hips.y -= .02f * k;
  const Feet feet{{.11f * k, ankle, 0}, {-.11f * k, ankle, 0}, 0, 0};
  for (int i = 0; i < 4; ++i) {
    plant(body, feet, pose);
    raise_guard(body, pose);
    const Vec3 com = center_of_mass(body, world_pose(body.skeleton, pose));
    pose.hips.z += .05f * k - com.z;
    pose.hips.x -= com.x;
  }
  plant(body, feet, pose);
  raise_guard(body, pose);
  return pose;
}

// 45 cm of stagger, 24 cm wide, lead (left) foot turned 15 degrees in, rear 50 out, pelvis yawed 30
// and 8 cm lower: orthodox, facing +Z.
inline Pose fighting(const BodyModel& body) {
  const float k = body.scale, ankle = body.skeleton.ankle_height();
  Pose pose = rest_pose(body.skeleton);
  pose.hips.y -= .08f * k;
  pose.rotation[index(Joint::hips)] = yaw_rotation(radians(-30));
  pose.rotation[index(Joint::spine)] =
      yaw_rotation(radians(5)) * from_rotation_vector({.08f, 0, 0});
  pose.rotation[index(Joint::chest)] = yaw_rotation(radians(5));
  pose.rotation[index(Joint::neck)] = yaw_rotation(radians(10));
  pose.rotation[index(Joint::head)] = yaw_rotation(radians(10));
  const Feet feet{
      {.12f * k, ankle, .225f * k}, {-.12f * k, ankle, -.225f * k}, radians(-15), radians(-50)};
  for (int i = 0; i < 4; ++i) {
    plant(body, feet, pose);
    raise_guard(body, pose);
    const Vec3 com = center_of_mass(body, world_pose(body.skeleton, pose));
    pose.hips.z += .03f * k - com.z;
    pose.hips.x += -.02f * k - com.x;
  }
  plant(body, feet, pose);
  raise_guard(body, pose);
  return pose;
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
