#include "motion/pose.h"

#include <algorithm>

namespace ringcraft {

Pose rest_pose(const Skeleton& skeleton) {
  Pose pose;
  pose.hips = skeleton.offset[index(Joint::hips)];
  return pose;
}

WorldPose world_pose(const Skeleton& skeleton, const Pose& pose) {
  WorldPose world;
  world.position[0] = pose.hips;
  world.rotation[0] = pose.rotation[0];
  for (std::size_t i = 1; i < kJointCount; ++i) {
    const auto parent = static_cast<std::size_t>(kParent[i]);
    world.position[i] = world.position[parent] + world.rotation[parent] * skeleton.offset[i];
    world.rotation[i] = world.rotation[parent] * pose.rotation[i];
  }
  return world;
}

Pose placed(const Pose& pose, const Placement& placement) {
  Pose result = pose;
  result.hips = placement * pose.hips;
  result.rotation[0] = yaw_rotation(placement.yaw) * pose.rotation[0];
  return result;
}

Pose mirrored(const Pose& pose) {
  Pose result;
  result.hips = {-pose.hips.x, pose.hips.y, pose.hips.z};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    // A reflection across x = 0 keeps the turn about x and reverses those about y and z.
    const Quat q = pose.rotation[i];
    result.rotation[index(mirrored(joint_at(i)))] = Quat(q.w, q.x, -q.y, -q.z);
  }
  return result;
}

Pose scaled(const Pose& pose, float factor) {
  Pose result = pose;
  result.hips *= factor;
  return result;
}

Pose mix(const Pose& a, const Pose& b, float share) {
  Pose result;
  result.hips = a.hips + (b.hips - a.hips) * share;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    result.rotation[i] = glm::normalize(
        glm::slerp(a.rotation[i], in_hemisphere_of(b.rotation[i], a.rotation[i]), share));
  }
  return result;
}

float largest_joint_distance(const WorldPose& a, const WorldPose& b) {
  float largest = 0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    largest = std::max(largest, glm::distance(a.position[i], b.position[i]));
  }
  return largest;
}

}  // namespace ringcraft
