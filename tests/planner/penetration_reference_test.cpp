// The penetration check against a plain loop in double precision: the same set, frame by frame.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "fight/synthetic_library.h"
#include "physics/penetration.h"
#include "planner/motion_tables.h"

namespace ringcraft {
namespace {

using DVec3 = glm::dvec3;

// Distance of two segments by the definition: the least over the ends and the inner optimum.
double segment_distance_double(DVec3 a0, DVec3 a1, DVec3 b0, DVec3 b1) {
  const auto to_segment = [](DVec3 p, DVec3 s0, DVec3 s1) {
    const DVec3 d = s1 - s0;
    const double length2 = glm::dot(d, d);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - s0, d) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p - s0 - d * t);
  };
  double least = std::min({to_segment(a0, b0, b1), to_segment(a1, b0, b1), to_segment(b0, a0, a1),
                           to_segment(b1, a0, a1)});
  const DVec3 u = a1 - a0, v = b1 - b0, r = a0 - b0;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
  const double ur = glm::dot(u, r), vr = glm::dot(v, r), d = uu * vv - uv * uv;
  if (d > 0) {
    const double s = (uv * vr - ur * vv) / d, t = (uu * vr - uv * ur) / d;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      least = std::min(least, glm::length(a0 + u * s - b0 - v * t));
    }
  }
  return least;
}

double depth_double(const Capsule& a, const Capsule& b) {
  return static_cast<double>(a.radius) + static_cast<double>(b.radius) -
         segment_distance_double(DVec3(a.a), DVec3(a.b), DVec3(b.a), DVec3(b.b));
}

constexpr double kRounding = 2e-6;  // m: of the float arithmetic; nearer to zero either is right

class PenetrationReferenceTest : public testing::Test {
 protected:
  PenetrationReferenceTest() : library_(synthetic::library()), tables_(library_, make_body({})) {}

  BodyCapsules body_at(const Placement& at, Random& random) const {
    const ActionId action(
        static_cast<std::size_t>(random.below(static_cast<int>(library_.actions().size()))));
    const ActionTable& table = tables_.at(action);
    BodyCapsules capsules = table.capsules_at(random.below(table.length + 1));
    const Frame frame(at);
    for (Capsule& c : capsules) c.a = frame.to_outer(c.a), c.b = frame.to_outer(c.b);
    return capsules;
  }

  MotionLibrary library_;
  MotionTables tables_;
};

TEST_F(PenetrationReferenceTest, SameSetAsAPlainLoopInDoublePrecision) {
  Random random(3);
  std::size_t overlapping = 0, frames = 0;
  for (int i = 0; i < 3000; ++i) {
    const float distance = random.uniform(0.2f, 1.3f);
    const BodyCapsules a = body_at({0, 0, random.uniform(-0.5f, 0.5f)}, random);
    const BodyCapsules b =
        body_at({random.uniform(-0.3f, 0.3f), distance, kPi + random.uniform(-0.7f, 0.7f)}, random);
    const std::vector<Penetration> found = penetrations(a, b, 0);
    double deepest = 0;
    for (std::size_t j = 0; j < kPartCount; ++j) {
      for (std::size_t k = 0; k < kPartCount; ++k) {
        const double depth = depth_double(a[j], b[k]);
        deepest = std::max(deepest, depth);
        const auto one = std::find_if(found.begin(), found.end(), [&](const Penetration& p) {
          return p.a == part_at(j) && p.b == part_at(k);
        });
        if (std::abs(depth) > kRounding) {
          ASSERT_EQ(one != found.end(), depth > 0) << i << " " << j << " " << k << " " << depth;
        }
        if (one == found.end()) continue;
        EXPECT_NEAR(static_cast<double>(one->depth), depth, kRounding);
        ++overlapping;
      }
    }
    EXPECT_NEAR(static_cast<double>(deepest_penetration(a, b).depth), deepest, kRounding);
    frames += deepest > 0 ? 1u : 0u;
  }
  EXPECT_GT(frames, 500u);   // the states are not all apart,
  EXPECT_LT(frames, 2900u);  // nor all together
  EXPECT_GT(overlapping, 5000u);
}

TEST_F(PenetrationReferenceTest, TablesAgreeWithTheCapsulesInTheWorld) {
  Random random(5);
  std::size_t deep = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto launch = [&](const Placement& at) {
      Launch one;
      one.action = ActionId(
          static_cast<std::size_t>(random.below(static_cast<int>(library_.actions().size()))));
      one.end = library_.action(one.action).length();
      one.placement = at;
      return one;
    };
    const Launch first = launch({0.4f, -0.2f, 0.3f});
    const Launch second = launch({0.4f + random.uniform(-0.2f, 0.2f), random.uniform(0.1f, 0.9f),
                                  kPi + random.uniform(-0.6f, 0.6f)});
    const InFlight a(tables_, first), b(tables_, second);
    const Tick tick = random.below(std::max(1, std::min(first.end, second.end)));
    if (a.table->action->attacks() || b.table->action->attacks()) continue;  // nothing left out
    double deepest = 0;
    const Frame at_a = a.frame_at(tick), at_b = b.frame_at(tick);
    for (const Capsule& j : a.table->capsules_at(a.age(tick))) {
      for (const Capsule& k : b.table->capsules_at(b.age(tick))) {
        const Capsule ja{at_a.to_outer(j.a), at_a.to_outer(j.b), j.radius};
        const Capsule kb{at_b.to_outer(k.a), at_b.to_outer(k.b), k.radius};
        deepest = std::max(deepest, depth_double(ja, kb));
      }
    }
    if (std::abs(deepest) < 1e-5) continue;
    EXPECT_NEAR(static_cast<double>(penetration_at(a, b, tick)), deepest, 1e-5);
    deep += deepest > 0 ? 1u : 0u;
  }
  EXPECT_GT(deep, 100u);
}

}  // namespace
}  // namespace ringcraft
