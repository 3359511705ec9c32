#include "physics/penetration.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "physics/stance.h"

namespace ringcraft {
namespace {

Vec3 random_point(Random& random, float size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

// Nearest distance by sampling both segments.
float sampled_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  constexpr int kSteps = 200;
  float best = 1e9f;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p = glm::mix(a0, a1, static_cast<float>(i) / kSteps);
    const Vec3 d = b1 - b0;
    const float dd = glm::dot(d, d);
    const float t = dd > 0 ? std::clamp(glm::dot(p - b0, d) / dd, 0.0f, 1.0f) : 0.0f;
    best = std::min(best, glm::distance(p, b0 + t * d));
  }
  return best;
}

TEST(SegmentDistance, AgreesWithSampling) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a0 = random_point(random, 1), b0 = random_point(random, 1);
    const Vec3 a1 = i % 10 == 0 ? a0 : random_point(random, 1);
    Vec3 b1 = i % 15 == 0 ? b0 : random_point(random, 1);
    if (i % 7 == 0) b1 = b0 + (a1 - a0) * random.uniform(-2, 2);  // parallel
    const SegmentDistance d = segment_distance(a0, a1, b0, b1);
    const float step = glm::distance(a0, a1) / 200;
    const float sampled = sampled_distance(a0, a1, b0, b1);
    EXPECT_LE(d.distance, sampled + 1e-4f) << i;
    EXPECT_GE(d.distance, sampled - step - 1e-4f) << i;
    EXPECT_NEAR(glm::distance(d.on_first, d.on_second), d.distance, 1e-5f);
  }
}

TEST(Penetration, DeepestPairIsThatOfTheFullSearch) {
  const BodyModel body = make_body({});
  Random random(3);
  int overlapping = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose a = stance::fighting(body);
    const Pose b =
        placed(i % 2 ? stance::square(body) : a,
               {random.uniform(-.5f, .5f), random.uniform(0, 1.0f), random.uniform(-3, 3)});
    const BodyCapsules ca = capsules(body, world_pose(body.skeleton, a)),
                       cb = capsules(body, world_pose(body.skeleton, b));
    const std::uint32_t excepted = i % 3 ? 0u : (7u << index(Part::left_upper_arm));
    float deepest = 0;
    for (std::size_t p = 0; p < kPartCount; ++p) {
      if ((excepted >> p) & 1u) continue;
      for (std::size_t q = 0; q < kPartCount; ++q) {
        deepest =
            std::max(deepest, ca[p].radius + cb[q].radius -
                                  segment_distance(ca[p].a, ca[p].b, cb[q].a, cb[q].b).distance);
      }
    }
    const Penetration found = deepest_penetration(ca, cb, excepted, 0);
    EXPECT_NEAR(found.depth, deepest, 1e-6f);
    overlapping += deepest > 0;
    std::size_t count = 0;
    for (const Penetration& p : penetrations(ca, cb, .01f)) {
      EXPECT_GT(p.depth, .01f);
      ++count;
    }
    if (excepted == 0) {
      EXPECT_EQ(count > 0, deepest > .01f);
    }
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 450);
}

}  // namespace
}  // namespace ringcraft
