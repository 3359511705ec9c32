#include "physics/limb_room.h"

#include <gtest/gtest.h>

#include "motion/ik.h"

namespace ringcraft {
namespace {

class LimbRoomTest : public ::testing::Test {
 protected:
  const BodyModel body = make_body({});
  const Pose stands = rest_pose(body.skeleton);

  // Standing with a hand or a foot elsewhere.
  Pose with_end_at(const Limb& limb, Vec3 place) const {
    Pose pose = stands;
    move_limb_end(body.skeleton, limb, place, 1, pose);
    return pose;
  }
};

TEST_F(LimbRoomTest, ALimbThatIsInNothingLacksNone) {
  const LimbRoom room(body, {stands});
  for (const Side side : {Side::left, Side::right}) {
    EXPECT_EQ(room.lacks(arm(side), stands), 0);
    EXPECT_EQ(room.lacks(leg(side), stands), 0);
  }
}

TEST_F(LimbRoomTest, TheFloorIsInTheWayOfWhoSinksIntoIt) {
  const LimbRoom room(body, {stands});
  Pose sunk = stands;
  sunk.hips.y -= .1f;
  EXPECT_GT(room.lacks(leg(Side::left), sunk), .05f);
  EXPECT_EQ(room.lacks(arm(Side::left), sunk), 0);
  EXPECT_EQ(LimbRoom(body, {stands, sunk}).lacks(leg(Side::left), sunk), 0);
}

TEST_F(LimbRoomTest, TheOwnBodyIsInTheWayOfAHand) {
  const LimbRoom room(body, {stands});
  const Vec3 chest = world_pose(body.skeleton, stands).position[index(Joint::chest)];
  const Pose through = with_end_at(arm(Side::left), chest);
  EXPECT_GT(room.lacks(arm(Side::left), through), .05f);
  EXPECT_EQ(room.lacks(arm(Side::right), through), 0);
}

}  // namespace
}  // namespace ringcraft
