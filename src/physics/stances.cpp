#include "physics/stances.h"

#include "motion/ik.h"

namespace ringcraft {
namespace {

struct Feet {
  Vec3 left{}, right{};  // ankles, m
  float left_yaw = 0, right_yaw = 0;
};

void plant(const BodyModel& body, const Feet& feet, Pose& pose) {
  const auto foot = [&](Side side, Vec3 ankle, float yaw) {
    const Limb l = leg(side);
    set_world_rotation(body.skeleton, l.end, yaw_rotation(yaw), pose);
    solve_limb(body.skeleton, l, {ankle, yaw_rotation(yaw) * kForward, 1.0f}, pose);
    set_world_rotation(body.skeleton, l.end, yaw_rotation(yaw), pose);
  };
  foot(Side::left, feet.left, feet.left_yaw);
  foot(Side::right, feet.right, feet.right_yaw);
}

void raise_guard(const BodyModel& body, Pose& pose) {
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

// Moves the body over its feet until its centre of mass is at (x, z) metres of a canonical body.
Pose balanced(const BodyModel& body, Pose pose, const Feet& feet, float x, float z) {
  for (int i = 0; i < 4; ++i) {
    plant(body, feet, pose);
    raise_guard(body, pose);
    const Vec3 com = center_of_mass(body, world_pose(body.skeleton, pose));
    pose.hips.z += z * body.scale - com.z;
    pose.hips.x += x * body.scale - com.x;
  }
  plant(body, feet, pose);
  raise_guard(body, pose);
  return pose;
}

}  // namespace

Pose square_stance(const BodyModel& body) {
  const float k = body.scale, ankle = body.skeleton.ankle_height();
  Pose pose = rest_pose(body.skeleton);
  pose.hips.y -= .02f * k;
  return balanced(body, pose, {{.11f * k, ankle, 0}, {-.11f * k, ankle, 0}, 0, 0}, 0, .05f);
}

Pose fighting_stance(const BodyModel& body) {
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
  return balanced(body, pose, feet, -.02f, .03f);
}

}  // namespace ringcraft
