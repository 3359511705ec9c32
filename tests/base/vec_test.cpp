#include "base/vec.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace ringcraft {
namespace {

constexpr float kTolerance = 1e-5f;

void expect_near(Vec3 a, Vec3 b, float tolerance = kTolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

Vec3 random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

Quat random_rotation(Random& random) {
  return glm::normalize(Quat(random.normal(), random.normal(), random.normal(), random.normal()));
}

TEST(VecTest, DefaultsAreZeroAndIdentity) {
  expect_near(Vec3(), Vec3(0, 0, 0));
  expect_near(Quat() * kForward, kForward);
}

TEST(VecTest, AxesAreRightHanded) {
  expect_near(glm::cross(kUp, kForward), kLeft);
}

TEST(VecTest, WrappedAngleLiesInHalfOpenTurn) {
  EXPECT_NEAR(wrapped_angle(0.5f), 0.5f, kTolerance);
  EXPECT_NEAR(wrapped_angle(2 * kPi + 0.5f), 0.5f, kTolerance);
  EXPECT_NEAR(wrapped_angle(-7 * kPi + 0.5f), -kPi + 0.5f, kTolerance);
  EXPECT_GT(wrapped_angle(-kPi), 0.0f);
  for (float a = -50; a < 50; a += 0.37f) {
    const float wrapped = wrapped_angle(a);
    EXPECT_GT(wrapped, -kPi - kTolerance);
    EXPECT_LE(wrapped, kPi + kTolerance);
    EXPECT_NEAR(std::cos(wrapped), std::cos(a), 1e-4f);
    EXPECT_NEAR(std::sin(wrapped), std::sin(a), 1e-4f);
  }
}

TEST(VecTest, PositiveYawTurnsForwardToTheLeft) {
  expect_near(yaw_rotation(kPi / 2) * kForward, kLeft);
  EXPECT_NEAR(yaw_of(kLeft), kPi / 2, kTolerance);
  EXPECT_EQ(yaw_of(kUp), 0.0f);
  for (float yaw = -3; yaw < 3; yaw += 0.25f) {
    EXPECT_NEAR(yaw_of(yaw_rotation(yaw) * kForward), yaw, kTolerance);
    EXPECT_NEAR(heading_of(yaw_rotation(yaw)), yaw, kTolerance);
  }
}

TEST(VecTest, NormalizedOrFallsBackForNothing) {
  expect_near(normalized_or({0, 3, 0}, kLeft), kUp);
  expect_near(normalized_or({0, 1e-7f, 0}, kLeft), kLeft);
}

TEST(VecTest, RotationBetweenTurnsOneDirectionIntoTheOther) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random_vector(random), b = random_vector(random);
    const Quat turn = rotation_between(a, b);
    EXPECT_NEAR(glm::length(turn), 1.0f, kTolerance);
    expect_near(turn * glm::normalize(a), glm::normalize(b), 1e-4f);
  }
  for (const Vec3& v : {kLeft, kUp, kForward, glm::normalize(Vec3(1, 1, 1))}) {
    expect_near(rotation_between(v, -v) * v, -v, 1e-4f);
    expect_near(rotation_between(v, v) * v, v);
  }
}

TEST(VecTest, RotationVectorGoesThereAndBack) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Quat q = random_rotation(random);
    const Vec3 v = rotation_vector(q);
    EXPECT_LE(glm::length(v), kPi + kTolerance);
    const Quat back = in_hemisphere_of(from_rotation_vector(v), q);
    EXPECT_NEAR(glm::dot(back, q), 1.0f, kTolerance);
  }
  expect_near(rotation_vector(Quat(1, 0, 0, 0)), Vec3(0, 0, 0));
  expect_near(rotation_vector(yaw_rotation(1e-5f)), Vec3(0, 1e-5f, 0), 1e-7f);
  expect_near(from_rotation_vector({0, kPi / 2, 0}) * kForward, kLeft);
}

TEST(VecTest, HemisphereKeepsTheRotation) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Quat q = random_rotation(random), reference = random_rotation(random);
    const Quat same = in_hemisphere_of(q, reference);
    EXPECT_GE(glm::dot(same, reference), 0.0f);
    expect_near(same * kForward, q * kForward);
  }
}

}  // namespace
}  // namespace ringcraft
