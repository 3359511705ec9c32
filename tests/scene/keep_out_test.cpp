// What keeps limbs out of other bodies, and what stops them where they have landed.
#include "scene/keep_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/random.h"
#include "base/ticks.h"
#include "motion/ik.h"
#include "physics/penetration.h"
#include "physics/stances.h"
#include "scene/landed.h"

namespace ringcraft {
namespace {

class KeepOut : public ::testing::Test {
 protected:
  const BodyModel body = make_body({});
  const Pose pose = fighting_stance(body);
  const Vec3 glove = world_pose(body.skeleton, pose).position[index(Joint::left_hand)];

  // A bar across the way of the left glove, `before` it; everything else is far away.
  BodyCapsules bar(float before) const {
    BodyCapsules other;
    other.fill({{0, 50, 0}, {0, 51, 0}, .05f});
    const Vec3 at = glove + Vec3{0, 0, before};
    other[0] = {at - Vec3{.3f, 0, 0}, at + Vec3{.3f, 0, 0}, .05f};
    return other;
  }
  float depth(const LimbOffsets& offsets, const BodyCapsules& other) const {
    const Pose shown = with_offsets(body, pose, offsets);
    const Capsule own = capsules(body, world_pose(body.skeleton, shown))[index(Part::left_hand)];
    return own.radius + other[0].radius -
           segment_distance(own.a, own.b, other[0].a, other[0].b).distance;
  }
};

TEST_F(KeepOut, WhatNothingMeetsStaysWhereItIs) {
  const std::array<BodyCapsules, 1> others{bar(1)};
  EXPECT_EQ(kept_out(body, pose, {true, true}, others, {}), LimbOffsets{});
}

// A bar goes through the place where the glove would be and past it, 6 m/s fast.
TEST_F(KeepOut, AGloveIsPushedAlongAndNotPassedThrough) {
  LimbOffsets offsets{};
  for (int tick = 0; tick <= 7; ++tick) {
    const std::array<BodyCapsules, 1> others{bar(.3f - .05f * static_cast<float>(tick))};
    offsets = kept_out(body, pose, {true, true}, others, offsets);
    EXPECT_LT(depth(offsets, others[0]), .01f) << tick;
    EXPECT_LE(offsets[0].z, 0) << tick;
  }
  EXPECT_LT(offsets[0].z, -.05f);
  EXPECT_EQ(offsets[1], Vec3{});
  // Who asks anew where the bar is now would come out on its other side.
  const std::array<BodyCapsules, 1> others{bar(-.05f)};
  EXPECT_GT(kept_out(body, pose, {true, true}, others, {})[0].z, 0);
}

// A thick bar is suddenly where the glove is: its way out takes more than a tick.
TEST_F(KeepOut, AGloveIsThrownOutNoFasterThanItMay) {
  std::array<BodyCapsules, 1> others{bar(0)};
  others[0][0].radius = .1f;
  LimbOffsets offsets{};
  Tick ticks = 0;
  while (depth(offsets, others[0]) > .01f && ticks < 12) {
    const Vec3 before = offsets[0];
    offsets = kept_out(body, pose, {true, true}, others, offsets);
    EXPECT_LE(glm::distance(before, offsets[0]), kGoingOut * kTickSeconds + 1e-5f);
    ++ticks;
  }
  EXPECT_GT(ticks, 1);
  EXPECT_LT(ticks, 5);
}

// The same, and the glove is at its own shoulder.
TEST_F(KeepOut, AFoldedArmIsTurnedNoFasterThanItMay) {
  const Limb limb = arm(Side::left);
  const Vec3 shoulder = world_pose(body.skeleton, pose).position[index(limb.root)];
  Pose folded = pose;
  move_limb_end(body.skeleton, limb, shoulder + Vec3{0, .05f, .18f}, 1.0f, folded);
  const auto way_to = [&](const LimbOffsets& offsets) {
    const WorldPose world = world_pose(body.skeleton, with_offsets(body, folded, offsets));
    return glm::normalize(world.position[index(limb.end)] - shoulder);
  };
  BodyCapsules other;
  other.fill({{0, 50, 0}, {0, 51, 0}, .05f});
  const Vec3 at = shoulder + Vec3{.05f, 0, .18f};
  other[0] = {at - Vec3{0, 0, .3f}, at + Vec3{0, 0, .3f}, .1f};
  LimbOffsets offsets{};
  float turned = 0;
  for (int tick = 0; tick < 12; ++tick) {
    const Vec3 before = way_to(offsets);
    offsets = kept_out(body, folded, {true, true}, {{other}}, offsets);
    const float turn = std::acos(std::min(1.0f, glm::dot(before, way_to(offsets))));
    EXPECT_LE(turn, 1.05f * kTurningOut * kTickSeconds) << tick;  // an arc is longer than its chord
    turned += turn;
  }
  EXPECT_GT(turned, radians(20));
}

TEST_F(KeepOut, AGloveThatIsHeldFarOffIsWedgedByWhatItTouches) {
  LimbOffsets offsets{};
  const auto wedged = [&](const BodyCapsules& other) {
    const Pose shown = with_offsets(body, pose, offsets);
    return wedge(capsules(body, world_pose(body.skeleton, shown)), offsets, other);
  };
  for (const float far : {.05f, .14f, .20f, .27f}) {
    offsets[0] = {0, 0, -far};
    const Vec3 at = world_pose(body.skeleton, with_offsets(body, pose, offsets))
                        .position[index(Joint::left_hand)];
    EXPECT_NEAR(wedged(bar(at.z - glove.z + .05f)), std::max(0.0f, far - kMostKeptOut[0] / 2),
                1e-5f);
    EXPECT_EQ(wedged(bar(.6f)), 0);
  }
}

TEST_F(KeepOut, AGloveComesBackNoFasterThanItMay) {
  LimbOffsets offsets{};
  offsets[0] = {0, 0, -.05f};
  const std::array<BodyCapsules, 1> others{bar(1)};
  Tick ticks = 0;
  for (; offsets != LimbOffsets{} && ticks < kTicksPerSecond; ++ticks) {
    const Vec3 before = offsets[0];
    offsets = kept_out(body, pose, {true, true}, others, offsets);
    EXPECT_LE(glm::distance(before, offsets[0]), kComingFree * kTickSeconds + 1e-6f);
  }
  EXPECT_NEAR(seconds(ticks), .05 / static_cast<double>(kComingFree), .01);
}

// A kick is lifted beside somebody: a bar comes down on its thigh, at the knee or at the hip.
TEST_F(KeepOut, ALiftedThighIsClearAtTheKneeAndTheHipIsLeftAlone) {
  const Limb limb = leg(Side::left);
  Pose lifted = pose;
  const WorldPose stands = world_pose(body.skeleton, pose);
  const Vec3 hip = stands.position[index(limb.root)];
  move_limb_end(body.skeleton, limb, hip + Vec3{0, -.3f, .25f}, 1.0f, lifted);
  const Capsule thigh = capsules(body, world_pose(body.skeleton, lifted))[index(Part::left_thigh)];
  for (const float along : {.2f, .75f}) {
    BodyCapsules other;
    other.fill({{0, 50, 0}, {0, 51, 0}, .05f});
    const Vec3 at = glm::mix(thigh.a, thigh.b, along);
    LimbOffsets offsets{};
    float deep = 0;
    for (int tick = 0; tick < 12; ++tick) {  // 1.2 m/s, 5 cm into the thigh
      const Vec3 bar = at + Vec3{0, thigh.radius + .1f - .01f * static_cast<float>(tick + 1), 0};
      other[0] = {bar - Vec3{.15f, 0, 0}, bar + Vec3{.15f, 0, 0}, .03f};
      offsets = kept_out(body, lifted, {false, true}, {{other}}, offsets);
      const BodyCapsules own =
          capsules(body, world_pose(body.skeleton, with_offsets(body, lifted, offsets)));
      deep = deepest_penetration(own, other).depth;
    }
    if (along > .5f) {
      EXPECT_LT(deep, .01f);
      EXPECT_NE(offsets[2], Vec3{});
      // Unless its knee is to strike.
      const std::uint32_t knee = 1u << index(Part::left_thigh);
      EXPECT_EQ(kept_out(body, lifted, {false, true}, {{other}}, {}, std::identity{}, knee),
                LimbOffsets{});
    } else {
      EXPECT_EQ(offsets, LimbOffsets{});
    }
  }
}

// Bars that come upon a lifted leg from all around. Where inverse kinematics would fold the leg
// beyond its ranges it is shown elsewhere, and there it has to be clear.
TEST_F(KeepOut, ALegIsClearWhereItIsShown) {
  const auto in_range = [&](const Pose& of) { return within_limits(body, of, radians(2), pose); };
  const Limb limb = leg(Side::left);
  const Vec3 stands = world_pose(body.skeleton, pose).position[index(limb.end)];
  Random random(5);
  float asked = 0, unasked = 0;  // m, summed: how deep
  for (int bar = 0; bar < 300; ++bar) {
    const Vec3 to{random.uniform(-.5f, .5f), random.uniform(.1f, 1), random.uniform(-.6f, .6f)};
    Pose lifted = pose;
    move_limb_end(body.skeleton, limb, stands + to, 1.0f, lifted);
    lifted = in_range(lifted);
    const Vec3 ankle = world_pose(body.skeleton, lifted).position[index(limb.end)];
    const Vec3 way =
        glm::normalize(Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Vec3 across = glm::normalize(glm::cross(way, Vec3{.3f, .8f, .52f}));
    const auto deep_after = [&](const std::function<Pose(const Pose&)>& as_shown) {
      LimbOffsets offsets{};
      float depth = 0;
      for (int tick = 0; tick <= 12; ++tick) {
        BodyCapsules other;
        other.fill({{0, 50, 0}, {0, 51, 0}, .05f});
        const Vec3 at = ankle - way * (.25f - .02f * static_cast<float>(tick));
        other[0] = {at - across * .2f, at + across * .2f, .05f};
        offsets = kept_out(body, lifted, {false, true}, {{other}}, offsets, as_shown);
        const BodyCapsules own = capsules(
            body, world_pose(body.skeleton, in_range(with_offsets(body, lifted, offsets))));
        for (const Part part : {Part::left_shin, Part::left_foot}) {
          const Capsule& c = own[index(part)];
          const float gap = segment_distance(c.a, c.b, other[0].a, other[0].b).distance;
          depth = std::max(depth, c.radius + other[0].radius - gap);
        }
      }
      return depth;
    };
    asked += deep_after(in_range);
    unasked += deep_after(std::identity{});
  }
  EXPECT_LT(asked, .5f * unasked);
}

// A round kick that has landed and swings through is held where it landed, at last behind its own
// hip and on its other side.
TEST_F(KeepOut, ALegThatIsHeldBackDoesNotTurnOver) {
  const Limb limb = leg(Side::right);
  const Vec3 hip = world_pose(body.skeleton, pose).position[index(limb.root)];
  Pose kicks = pose;
  move_limb_end(body.skeleton, limb, hip + Vec3{-.10f, -.20f, .40f}, 1.0f, kicks);
  const Vec3 back = glm::normalize(Vec3{1, 0, -1});
  std::array<Quat, 2> before{};
  for (int centimetres = 0; centimetres <= 75; ++centimetres) {
    LimbOffsets offsets{};
    offsets[3] = .01f * static_cast<float>(centimetres) * back;
    const WorldPose shown = world_pose(body.skeleton, with_offsets(body, kicks, offsets));
    const std::array<Quat, 2> now{shown.rotation[index(limb.root)],
                                  shown.rotation[index(limb.middle)]};
    for (std::size_t i = 0; i < now.size() && centimetres > 0; ++i) {
      EXPECT_LT(glm::length(rotation_vector(now[i] * glm::conjugate(before[i]))), radians(10))
          << centimetres;
    }
    before = now;
  }
}

// A jab that is held back far from where its clip is: where the clip straightens the arm, whatever
// plane its few degrees of flexion lie in says nothing of where the elbow belongs.
TEST_F(KeepOut, AnArmThatIsHeldBackDoesNotThrowUpItsElbow) {
  const Limb limb = arm(Side::left);
  Pose jab = pose;
  const Vec3 shoulder = world_pose(body.skeleton, pose).position[index(limb.root)];
  move_limb_end(body.skeleton, limb, shoulder + Vec3{-.05f, .05f, 2}, 1.0f, jab);
  LimbOffsets offsets{};
  offsets[0] = {0, 0, -.2f};
  std::vector<Vec3> elbows, free;
  for (const float off : {-60.0f, 0.0f, 60.0f}) {
    Pose bent = jab;  // 17 degrees, up to 60 off the hinge's plane
    const Vec3 along = glm::normalize(body.skeleton.offset[index(limb.end)]);
    const Vec3 axis = glm::angleAxis(radians(off), along) * hinge_axis(limb);
    bent.rotation[index(limb.middle)] = glm::angleAxis(radians(17), axis);
    const WorldPose shown = world_pose(body.skeleton, with_offsets(body, bent, offsets));
    elbows.push_back(shown.position[index(limb.middle)]);
  }
  EXPECT_LT(glm::distance(elbows[0], elbows[1]), .10f);
  EXPECT_LT(glm::distance(elbows[2], elbows[1]), .10f);
}

// One limb is over another's that lies on the floor: the way out is not through the floor.
TEST_F(KeepOut, AFootIsNotPressedThroughTheFloor) {
  const Vec3 ankle = world_pose(body.skeleton, pose).position[index(Joint::left_foot)];
  BodyCapsules other;
  other.fill({{0, 50, 0}, {0, 51, 0}, .05f});
  const Vec3 at = ankle + Vec3{0, .06f, .05f};
  other[0] = {at - Vec3{.3f, 0, 0}, at + Vec3{.3f, 0, 0}, .06f};
  const std::array<BodyCapsules, 1> others{other};
  LimbOffsets offsets{};
  for (int tick = 0; tick < 12; ++tick) offsets = kept_out(body, pose, {}, others, offsets);
  EXPECT_GT(glm::length(offsets[2]), .02f);
  EXPECT_GE(offsets[2].y, 0);
}

class Landed : public KeepOut {
 protected:
  // The glove goes 6 cm in the tick, and meets something after two thirds of that.
  LandedLimb landed() const {
    Pose after = pose;
    after.hips += Vec3{0, 0, .06f};
    Contact contact;
    contact.striker = Part::left_hand;
    contact.velocity = {0, 0, 7.2f};
    contact.normal = {0, 0, -1};
    contact.share = 2.0f / 3;
    return LandedLimb(body, arm(Side::left), pose, after, contact);
  }
};

TEST_F(Landed, TheLimbGoesNoFartherThanTheContact) {
  LandedLimb limb = landed();
  EXPECT_TRUE(limb.holds());
  EXPECT_NEAR(limb.hold_back(glove + Vec3{0, 0, .06f}).z, -.02f, 1e-4f);
  EXPECT_NEAR(limb.hold_back(glove + Vec3{.3f, .1f, .50f}).z, -.46f, 1e-4f);
  EXPECT_EQ(LandedLimb().hold_back(glove), Vec3{});
}

TEST_F(Landed, ALimbThatIsOnItsWayBackIsFree) {
  LandedLimb limb = landed();
  EXPECT_EQ(limb.hold_back(glove + Vec3{0, 0, .035f}), Vec3{});
  EXPECT_TRUE(limb.holds());
  EXPECT_EQ(limb.hold_back(glove + Vec3{0, 0, .02f}), Vec3{});
  EXPECT_FALSE(limb.holds());
}

// A limb that waits at the plane until its clip is back there goes on with the clip's speed at
// once.
TEST_F(Landed, TheClipTakesTheLimbAlongGradually) {
  constexpr float kSpeed = 6, kFarthest = .25f;  // m/s, m beyond the contact
  LandedLimb limb = landed();
  std::vector<float> shown{.04f};  // m along the blow, one a tick from the contact on
  float clip = .04f;
  for (Tick tick = 1; limb.holds() && tick < kTicksPerSecond; ++tick) {
    const float way = kSpeed * kTickSeconds * static_cast<float>(tick);
    clip = .04f + kFarthest - std::abs(way - kFarthest);
    shown.push_back(clip + limb.hold_back(glove + Vec3{0, 0, clip}).z);
    EXPECT_LE(shown.back(), std::min(.04f, clip) + 1e-5f) << tick;  // not into what it struck
  }
  EXPECT_FALSE(limb.holds());
  EXPECT_EQ(shown.back(), clip);
  float jumps = 0;  // m/s, between frames at 60 Hz
  for (std::size_t i = 4; i < shown.size(); ++i) {
    jumps = std::max(jumps, 60 * std::abs(shown[i] - 2 * shown[i - 2] + shown[i - 4]));
  }
  EXPECT_LT(jumps, 1.5);
}

// Its next blow begins while the glove is still on its way back, and is not stopped where the other
// was.
TEST_F(Landed, ALimbThatStrikesAgainIsFree) {
  LandedLimb limb = landed();
  float clip = .04f, shown = .04f;  // m along the blow
  const auto go = [&](float to) {
    constexpr float kStep = 3 * kTickSeconds;
    while (std::abs(to - clip) > kStep) {
      clip += std::copysign(kStep, to - clip);
      limb.step();
      shown = clip + limb.hold_back(glove + Vec3{0, 0, clip}).z;
    }
  };
  go(.20f);
  EXPECT_NEAR(shown, .04f, 1e-4f);
  go(-.06f);
  EXPECT_TRUE(limb.holds());
  EXPECT_LT(shown, clip - .001f);
  go(.40f);
  EXPECT_FALSE(limb.holds());
  EXPECT_NEAR(shown, clip, 1e-4f);
}

// One that swings through, as a kick does, is let go slowly.
TEST_F(Landed, ALimbThatPressesOnComesFreeAfterAWhile) {
  LandedLimb limb = landed();
  const Vec3 wanted = glove + Vec3{0, 0, .2f};
  const float first = limb.hold_back(wanted).z;
  float before = first;
  Tick still = 0, all = 0;
  for (; glm::length(limb.hold_back(wanted)) > .01f && all < kTicksPerSecond; ++all) {
    limb.step();
    const float now = limb.hold_back(wanted).z;
    EXPECT_LE(now - before, kComingFree * kTickSeconds + 1e-5f);
    if (now == first) ++still;
    before = now;
  }
  EXPECT_NEAR(seconds(still), .15, .01);
  EXPECT_LT(seconds(all), .4);
}

// A round kick that steps through: its foot comes down half a metre beyond the blow and carries.
TEST_F(Landed, ALimbIsWhereItsClipIsBeforeItCarries) {
  LandedLimb limb = landed();
  float before = 0, fastest = 0;  // m of offset, m/s
  for (Tick tick = 1; tick <= ticks(.5); ++tick) {
    const float clip = .5f * std::min(1.0f, static_cast<float>(tick) / 12);
    limb.step();
    const float now = limb.hold_back(glove + Vec3{0, 0, .04f + clip}).z;
    if (seconds(tick) > .15) fastest = std::max(fastest, (now - before) / kTickSeconds);
    before = now;
  }
  EXPECT_EQ(before, 0);
  EXPECT_LT(fastest, 4);
  limb.let_go();
  EXPECT_EQ(limb.hold_back(glove), Vec3{});
}

}  // namespace
}  // namespace ringcraft
