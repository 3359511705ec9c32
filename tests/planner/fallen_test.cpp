#include "planner/fallen.h"

#include <gtest/gtest.h>

#include <array>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class FallenTest : public DuelFixture {
 protected:
  // Who fell on its back long ago, and the middle of one of its parts on the ground.
  InFlight fall_{tables(), launch("knockdown_back", -400, {1, -2, 0.7f})};
  Vec3 middle_of(Part part) const {
    const Capsule& c = fall_.table->capsules_at(fall_.table->length)[index(part)];
    return fall_.aimed.to_outer((c.a + c.b) * 0.5f);
  }
};

TEST_F(FallenTest, ItLiesWhereTheFallEndsFromHeadToFeet) {
  const Fallen fallen(fall_);
  for (const Part part :
       {Part::head, Part::chest, Part::pelvis, Part::left_shin, Part::right_thigh}) {
    const Vec3 at = middle_of(part);
    EXPECT_LT(fallen.distance(at.x, at.z), 0.05f);
  }
  const Vec3 head = middle_of(Part::head), hips = middle_of(Part::pelvis);
  const Vec3 along = glm::normalize(Vec3(head.x - hips.x, 0, head.z - hips.z));
  const Vec3 aside(along.z, 0, -along.x), chest = (head + hips) * 0.5f + aside * 0.3f;
  EXPECT_NEAR(fallen.distance(chest.x, chest.z), 0.3f, 1e-3f);
  const Vec3 beyond = head + along * 0.4f;
  EXPECT_NEAR(fallen.distance(beyond.x, beyond.z), 0.4f, 1e-3f);
}

TEST_F(FallenTest, ARootOverlapsSeveralAsMuchAsEachOfThem) {
  const std::array<Fallen, 2> two{Fallen(fall_), Fallen(fall_)};
  const Vec3 hips = middle_of(Part::pelvis);
  for (const float off : {0.0f, 0.2f, 0.49f, 0.6f, 3.0f}) {
    const float x = hips.x + off;
    const double lacks = std::max(0.0, kOverlapDistance - two[0].distance(x, hips.z));
    EXPECT_NEAR(two[0].overlap(x, hips.z), lacks, 1e-6);
    EXPECT_DOUBLE_EQ(overlap(two, x, hips.z), 2 * two[0].overlap(x, hips.z));
  }
  EXPECT_GT(two[0].overlap(hips.x, hips.z), kOverlapDistance - 0.02);
}

}  // namespace
}  // namespace ringcraft
