#pragma once
// Poses: local (joint rotations and the hips' position) and world (positions and rotations).

#include <array>

#include "base/vec.h"
#include "motion/placement.h"
#include "motion/skeleton.h"

namespace ringcraft {

// Rotations relative to the parent; only the hips translate. The hips' position and rotation are in
// the space the pose is given in: a clip's action space or the world.
struct Pose {
  Vec3 hips{};  // m
  std::array<Quat, kJointCount> rotation{};
};

// Joint positions (m) and rotations in the space of the pose.
struct WorldPose {
  std::array<Vec3, kJointCount> position{};
  std::array<Quat, kJointCount> rotation{};
};

Pose rest_pose(const Skeleton& skeleton);
WorldPose world_pose(const Skeleton& skeleton, const Pose& pose);

// The pose moved by a placement: hips translated on the ground and turned about +Y.
Pose placed(const Pose& pose, const Placement& placement);

// Left and right exchanged across the plane x = 0. mirrored(mirrored(p)) == p.
Pose mirrored(const Pose& pose);

// The hips' position scaled, for a body of another height.
Pose scaled(const Pose& pose, float factor);

// Shortest-way blend: share 0 is a, 1 is b.
Pose mix(const Pose& a, const Pose& b, float share);

// Largest distance between the same joint of two poses, m.
float largest_joint_distance(const WorldPose& a, const WorldPose& b);

}  // namespace ringcraft
