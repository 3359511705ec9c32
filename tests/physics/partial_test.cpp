#include "physics/partial.h"

#include <cmath>

#include <gtest/gtest.h>

#include "motion/ik.h"
#include "physics/balance.h"
#include "physics/hit.h"

namespace ringcraft {
namespace {

class Partial : public testing::Test {
 protected:
  BodyModel body = make_body({});
  Pose fighting = stance::fighting(body);

  // Of a clip that bends the neck by 60 degrees.
  Absorbed shows(Part part, Vec3 impulse, Vec3 offset = {}) const {
    std::vector<Pose> clip(60, fighting);
    for (std::size_t i = 0; i < clip.size(); ++i) {
      const float bent = radians(static_cast<float>(i));
      clip[i].rotation[index(Joint::neck)] =
          from_rotation_vector({-bent, 0, 0}) * fighting.rotation[index(Joint::neck)];
    }
    const stance::Hit hit(body, fighting, part, impulse, offset);
    return absorbed(body, hit.input, {}, fighting, clip);
  }
  float share(Part part, Vec3 impulse, Vec3 offset = {}) const {
    return shows(part, impulse, offset).share;
  }
};

TEST_F(Partial, NoImpulseHasNothingOfTheClipAndAHarderBlowNeverLess) {
  for (const Part part : {Part::head, Part::chest, Part::abdomen}) {
    for (const Vec3& way : {Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}}) {
      EXPECT_EQ(share(part, {}), 0);
      float last = 0;
      for (const float impulse : {2.0f, 5.0f, 10.0f, 20.0f}) {
        const float now = share(part, impulse * way);
        EXPECT_GE(now, last) << name_of(part) << " " << impulse;
        last = now;
      }
      EXPECT_GT(last, 0);
    }
  }
  EXPECT_GT(share(Part::head, {0, 0, -12}), 1.3f * share(Part::head, {0, 0, -6}));
}

// Struck and unstruck bodies are compared as simulated on the same side.
TEST_F(Partial, ATouchHasNothingOfTheClipOnWhicheverSideItLands) {
  float sum = 0;
  for (const float side : {-1.0f, 1.0f}) {
    for (const float offset : {-.03f, .03f}) {
      sum += share(Part::head, {.01f * side, 0, -.01f}, {offset, 0, 0});
    }
  }
  EXPECT_LT(sum / 4, .008f);  // a millimetre of twelve centimetres; on different sides twice that
}

TEST_F(Partial, ABlowSwaysTheHipsItsWayAndTheyComeBack) {
  for (const Vec3& way : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}}) {
    float last = 0;
    for (const float impulse : {10.0f, 20.0f, 35.0f}) {
      const Sway sway = shows(Part::abdomen, impulse * way).sway;
      EXPECT_GT(glm::dot(sway.far, way), last + .005f) << impulse;
      EXPECT_GT(glm::dot(glm::normalize(sway.far), way), .9f) << impulse;
      last = glm::dot(sway.far, way);
      EXPECT_EQ(sway.at(0), Vec3{});
      EXPECT_LT(glm::distance(sway.at(24), sway.far), 1e-5f);
      EXPECT_LT(glm::length(sway.at(120)), .12f * last);
    }
  }
  EXPECT_EQ(shows(Part::abdomen, {}).sway.far, Vec3{});
}

// What the clip does with the hips by itself is not shown twice.
TEST_F(Partial, ASwayIsWhatTheClipLeavesOfTheWay) {
  const stance::Hit hit(body, fighting, Part::abdomen, {0, 0, -30});
  std::vector<Pose> clip(60, fighting);
  for (std::size_t i = 0; i < clip.size(); ++i) {
    clip[i].rotation[index(Joint::spine)] =
        from_rotation_vector({-radians(static_cast<float>(i)), 0, 0}) *
        fighting.rotation[index(Joint::spine)];
  }
  const Absorbed bends = absorbed(body, hit.input, {}, fighting, clip);
  for (Pose& pose : clip) pose.hips.z -= .1f;
  const Absorbed goes = absorbed(body, hit.input, {}, fighting, clip);
  EXPECT_LT(goes.share, bends.share);  // the clip goes farther
  EXPECT_NEAR(goes.sway.far.z, bends.sway.far.z + .1f * goes.share, 1e-4f);
}

TEST_F(Partial, WhoSwaysKeepsItsFeetAndNoStraighterLegs) {
  const WorldPose stood = world_pose(body.skeleton, fighting);
  for (const Vec3& offset : {Vec3{0, 0, -.1f}, Vec3{.08f, 0, 0}, Vec3{0, 0, .1f}}) {
    const Pose moved = swayed(body.skeleton, fighting, offset);
    const WorldPose world = world_pose(body.skeleton, moved);
    EXPECT_NEAR(moved.hips.x, fighting.hips.x + offset.x, 1e-5f);
    EXPECT_NEAR(moved.hips.z, fighting.hips.z + offset.z, 1e-5f);
    EXPECT_LE(moved.hips.y, fighting.hips.y);
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t end = index(leg(side).end);
      EXPECT_LT(glm::distance(world.position[end], stood.position[end]), 1e-3f);
      EXPECT_LT(reach_share(body.skeleton, leg(side), world),
                std::max(.95f, reach_share(body.skeleton, leg(side), stood)) + 1e-3f);
    }
  }
}

// By the impulse step alone, for the tree: as far as head, chest or hips go.
TEST_F(Partial, AForeseenShareIsTheWayOfTheBodyInTheWayOfTheClip) {
  ImpactOutcome outcome;
  EXPECT_EQ(share_foreseen(outcome, .1f), 0);
  EXPECT_EQ(share_foreseen(outcome, 0), 0);
  outcome.moved = {Vec3{0, 0, -.05f}, Vec3{0, 0, -.02f}, Vec3{0, 0, -.01f}};
  EXPECT_NEAR(share_foreseen(outcome, .1f), .5f, 1e-5f);
  EXPECT_EQ(share_foreseen(outcome, .01f), 1);  // never more than the clip
  outcome.moved = {Vec3{0, 0, -.01f}, Vec3{0, 0, -.03f}, Vec3{0, 0, -.04f}};  // a blow to the belly
  EXPECT_NEAR(share_foreseen(outcome, .1f), .4f, 1e-5f);
  outcome.zone = TargetZone::leg;  // a blow to a leg by its knee
  outcome.knee_moved = .02f;
  EXPECT_NEAR(share_foreseen(outcome, .1f), .2f, 1e-5f);
}

// A kick that bends a leg hardly moves head and chest: the leg is what its clip is measured by.
TEST_F(Partial, AKickToALegIsMeasuredByItsKnee) {
  std::vector<Pose> clip(60, fighting);  // the hips sink over feet that stand, the trunk leans
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const float share = std::min(1.0f, static_cast<float>(i) / 24);
    clip[i] = swayed(body.skeleton, fighting, Vec3{.02f, -.05f, -.02f} * share);
    clip[i].rotation[index(Joint::spine)] =
        from_rotation_vector({radians(20) * share, 0, 0}) * fighting.rotation[index(Joint::spine)];
  }
  float last = 0;
  for (const float impulse : {15.0f, 30.0f, 45.0f}) {
    const stance::Hit hit(body, fighting, Part::left_thigh, {impulse, 0, 0});
    ImpactOutcome outcome;
    outcome.zone = TargetZone::leg;
    const float share = absorbed(body, hit.input, outcome, fighting, clip).share;
    outcome.zone = TargetZone::body;
    EXPECT_GT(share, 1.5f * absorbed(body, hit.input, outcome, fighting, clip).share) << impulse;
    EXPECT_GT(share, last);
    last = share;
  }
}

// Recovery feet are placed by dv / w0.
TEST_F(Partial, StepsAreAsLongAsItTakesToCatchTheBody) {
  const Strides clip{.18f, .44f};  // m
  const auto share = [&](float margin) {
    ImpactOutcome outcome;
    outcome.margin = margin;
    return share_of_steps(body, outcome, clip);
  };
  const float least = clip.shortest / clip.longest;
  EXPECT_EQ(share(-.02f), least);
  EXPECT_EQ(share(.01f), least);
  EXPECT_EQ(share(.4f), 1);  // never more than the clip
  const float once = share(.1f);
  EXPECT_GT(once, least);
  EXPECT_NEAR(share(.15f), 1.5f * once, 1e-4f);
  // 0.1 m beyond the base at 100 ms is what a foot that lands 0.29 s later has to make up for.
  EXPECT_NEAR(clip.longest * once, .1f * std::exp(.29f * pendulum_rate(body)), 1e-4f);
  EXPECT_EQ(stride_to_catch(body, -1), 0);
}

// A clip that goes 12 cm out by its 20th tick and comes back by its 80th.
TEST_F(Partial, WhoIsMovedLessIsFreeEarlierButNoSoonerThanItChooses) {
  std::vector<float> left;
  for (int t = 0; t <= 80; ++t) {
    left.push_back(t < 20 ? .006f * static_cast<float>(t) : .002f * static_cast<float>(80 - t));
  }
  EXPECT_EQ(free_again(left, 1), 80 - 15 + 1);  // the first tick with less than 3 cm left
  EXPECT_EQ(free_again(left, .5f), 80 - 30 + 1);
  EXPECT_EQ(free_again(left, .2f), 36);  // 2.4 cm at most: as soon as it has chosen
  EXPECT_EQ(free_again(left, 0), 36);
  Tick last = 0;
  for (float share = 0; share <= 1; share += .05f) {  // a harder blow never frees earlier
    EXPECT_GE(free_again(left, share), last);
    last = free_again(left, share);
  }
  EXPECT_EQ(free_again(std::vector<float>(11, 1.0f), 1), 10);  // never later than the clip's end
  EXPECT_EQ(free_again({}, 1), 0);
}

TEST_F(Partial, APartialPoseStandsWhereRestAndClipStand) {
  const WorldPose stood = world_pose(body.skeleton, fighting);
  Pose crouched = fighting;
  crouched.hips.y -= .08f;
  crouched = partial_pose(body.skeleton, fighting, crouched, 0);
  EXPECT_LT(largest_joint_distance(world_pose(body.skeleton, crouched), stood), 1e-3f);
  crouched.hips.y -= .08f;
  for (const Side side : {Side::left, Side::right}) {  // over the same feet
    move_limb_end(body.skeleton, leg(side), stood.position[index(leg(side).end)], 1.0f, crouched);
  }
  const Pose half = partial_pose(body.skeleton, fighting, crouched, .5f);
  const WorldPose world = world_pose(body.skeleton, half);
  EXPECT_NEAR(half.hips.y, fighting.hips.y - .04f, 1e-4f);
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t end = index(leg(side).end);
    EXPECT_LT(glm::distance(world.position[end], stood.position[end]), 2e-3f);
  }
}

}  // namespace
}  // namespace ringcraft
