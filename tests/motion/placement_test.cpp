#include "motion/placement.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/pose_near.h"

namespace ringcraft {
namespace {

Placement random_placement(Random& random) {
  return {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-kPi, kPi)};
}

TEST(Placement, APositiveYawTurnsForwardToTheOwnLeft) {
  EXPECT_POINT_NEAR((Placement{0, 0, kPi / 2}.forward()), kLeft, 1e-4f);
  EXPECT_NEAR(bearing({1, 1, 0}, {3, 0, 1}), kPi / 2, 1e-6f);
  EXPECT_NEAR(bearing({1, 1, kPi / 2}, {3, 5, 1}), 0, 1e-6f);
}

TEST(Placement, ComposesAsItsPointsDo) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Placement a = random_placement(random), b = random_placement(random);
    const Vec3 p{random.uniform(-2, 2), random.uniform(0, 2), random.uniform(-2, 2)};
    EXPECT_POINT_NEAR((a * b) * p, a * (b * p), 1e-3f);
    EXPECT_POINT_NEAR(inverse(a) * (a * p), p, 1e-3f);
    const Placement none = a * inverse(a);
    EXPECT_NEAR(none.x, 0, 1e-5f);
    EXPECT_NEAR(none.z, 0, 1e-5f);
    EXPECT_NEAR(none.yaw, 0, 1e-5f);
  }
}

TEST(Placement, MirroringMirrorsItsPoints) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Placement a = random_placement(random);
    const Vec3 p{random.uniform(-2, 2), random.uniform(0, 2), random.uniform(-2, 2)};
    const Vec3 moved = a * p;
    EXPECT_POINT_NEAR(mirrored(a) * Vec3(-p.x, p.y, p.z), Vec3(-moved.x, moved.y, moved.z), 1e-3f);
  }
}

TEST(Placement, MixesTheShortWayAcrossTheSeamOfTheCircle) {
  const Placement a{0, 0, kPi - 0.1f}, b{2, 4, -kPi + 0.1f};
  const Placement half = mix(a, b, 0.5f);
  EXPECT_NEAR(half.x, 1, 1e-6f);
  EXPECT_NEAR(half.z, 2, 1e-6f);
  EXPECT_NEAR(std::abs(wrapped_angle(half.yaw - kPi)), 0, 1e-5f);
}

}  // namespace
}  // namespace ringcraft
