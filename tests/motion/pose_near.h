#pragma once
// Poses compared as the eye does: by the distance of the worst joint, in centimetres.

#include <cstdlib>

#include <gtest/gtest.h>

#include "motion/pose.h"

namespace ringcraft::test {

// Multiplies every tolerance: RINGCRAFT_TOLERANCE_SCALE=0.01 shows the real residuals.
inline float tolerance_scale() {
  const char* text = std::getenv("RINGCRAFT_TOLERANCE_SCALE");
  return text ? std::strtof(text, nullptr) : 1.0f;
}

inline ::testing::AssertionResult pose_near(const Skeleton& skeleton, const Pose& a, const Pose& b,
                                            float centimetres) {
  const WorldPose wa = world_pose(skeleton, a), wb = world_pose(skeleton, b);
  std::size_t worst = 0;
  float distance = 0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const float d = 100 * glm::distance(wa.position[i], wb.position[i]);
    if (!(d <= distance)) worst = i, distance = d;
  }
  if (distance <= centimetres * tolerance_scale()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << vrm_name(joint_at(worst)) << " is " << distance
                                       << " cm off, " << centimetres << " cm allowed";
}

inline ::testing::AssertionResult point_near(Vec3 a, Vec3 b, float centimetres) {
  const float distance = 100 * glm::distance(a, b);
  if (distance <= centimetres * tolerance_scale()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "(" << a.x << ", " << a.y << ", " << a.z << ") is " << distance << " cm from (" << b.x
         << ", " << b.y << ", " << b.z << "), " << centimetres << " cm allowed";
}

}  // namespace ringcraft::test

#define EXPECT_POSE_NEAR(skeleton, a, b, centimetres) \
  EXPECT_TRUE(::ringcraft::test::pose_near(skeleton, a, b, centimetres))
#define EXPECT_POINT_NEAR(a, b, centimetres) \
  EXPECT_TRUE(::ringcraft::test::point_near(a, b, centimetres))
