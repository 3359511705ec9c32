#include "scene/give.h"

#include <gtest/gtest.h>

#include "base/ticks.h"
#include "physics/stances.h"

namespace ringcraft {
namespace {

TEST(ArmGive, GoesFarthestAfterAFortiethOfASecondAndComesBackWithoutSwingingOver) {
  ArmGive give;
  give.step();
  EXPECT_TRUE(give.at_rest());
  give.drive({0, 0, 4});
  float farthest = 0;
  Tick at = 0, ticks = 0;
  for (; !give.at_rest() && ticks < kTicksPerSecond; ++ticks) {
    give.step();
    EXPECT_GE(give.offset().z, 0);
    if (give.offset().z > farthest) farthest = give.offset().z, at = ticks + 1;
  }
  EXPECT_NEAR(farthest, 4.0f / 25 / 2.71828f, .001f);  // v / (w e)
  EXPECT_NEAR(seconds(at), 1.0 / 25, .01);
  EXPECT_LT(seconds(ticks), .5);
  give.drive({100, 0, 0});
  for (Tick t = 0; t < 5; ++t) give.step();
  EXPECT_LE(glm::length(give.offset()), .1f);
}

TEST(ArmGive, AGloveStopsAtTheOwnHead) {
  const BodyModel body = make_body({});
  const Pose pose = fighting_stance(body);
  const WorldPose world = world_pose(body.skeleton, pose);
  const Vec3 to_head = world.position[index(Joint::head)] - world.position[index(Joint::left_hand)];
  const Vec3 stopped = short_of_the_body(body, pose, Side::left, to_head);
  EXPECT_GT(glm::length(stopped), 0);
  EXPECT_LT(glm::length(stopped), .9f * glm::length(to_head));
  EXPECT_EQ(short_of_the_body(body, pose, Side::left, to_head * -.2f), to_head * -.2f);
}

}  // namespace
}  // namespace ringcraft
