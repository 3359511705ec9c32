#include <gtest/gtest.h>

#include "physics/hit.h"
#include "physics/impact.h"

namespace ringcraft {
namespace {

class BlowOf : public testing::Test {
 protected:
  BodyModel body = make_body({});

  float fist_mass(Side side, Vec3 fist, Vec3 elbow, Vec3 line, float tone) const {
    const Pose pose = stance::punching(body, side, fist, elbow);
    const Part hand = side == Side::left ? Part::left_hand : Part::right_hand;
    return effective_mass(body, pose, hand,
                          capsules(body, world_pose(body.skeleton, pose))[index(hand)].b, line,
                          tone);
  }
  float struck_mass(Part part, Vec3 offset, Vec3 line, float tone) const {
    const Pose pose = stance::fighting(body);
    const Capsule c = capsules(body, world_pose(body.skeleton, pose))[index(part)];
    return effective_mass(body, pose, part, (c.a + c.b) * .5f + offset, line, tone);
  }
};

// docs/sources.md, R4: relaxed jab 1.47, cross 3.24, lead hook 1.46, rear hook 1.24;
// trained 2.5-3.
TEST_F(BlowOf, EffectiveMassesAreThoseOfTheTable) {
  const Vec3 down{.3f, -1, 0};
  const float bent = fist_mass(Side::left, {.05f, -.03f, .52f}, down, kForward, 0);
  const float straight = fist_mass(Side::left, {.05f, -.03f, .60f}, down, kForward, 0);
  EXPECT_GT(bent, .6f);
  EXPECT_LT(bent, 1.7f);
  EXPECT_GT(straight, 2 * bent);  // nearly singular
  EXPECT_LT(straight, 4.5f);
  EXPECT_NEAR(fist_mass(Side::left, {.02f, -.02f, .38f}, {1, -.1f, -.2f}, -kLeft, 0), 1.46f, .6f);
  EXPECT_NEAR(fist_mass(Side::right, {-.02f, -.02f, .34f}, {-1, -.1f, -.2f}, kLeft, 0), 1.24f, .5f);
  EXPECT_NEAR(fist_mass(Side::left, {.02f, -.02f, .38f}, {1, -.1f, -.2f}, -kLeft, .5f), 2.7f, .9f);
}

// Struck, relaxed: jaw straight back 2.6 kg, sideways 1.3, thigh 20, shin 5.6.
TEST_F(BlowOf, StruckMassesAreThoseOfTheTable) {
  EXPECT_NEAR(struck_mass(Part::head, {0, -.07f, .08f}, -kForward, 0), 2.6f, 1.0f);
  EXPECT_NEAR(struck_mass(Part::head, {.06f, -.07f, .08f}, -kLeft, 0), 1.3f, .6f);
  EXPECT_NEAR(struck_mass(Part::left_thigh, {}, -kForward, 0), 20, 7);
  EXPECT_NEAR(struck_mass(Part::left_shin, {}, -kForward, 0), 5.6f, 1.5f);
  EXPECT_GT(struck_mass(Part::head, {0, -.07f, .08f}, -kForward, .25f), 6);
}

TEST_F(BlowOf, MuscleToneOnlyAddsMassAndNeverMoreThanTheBody) {
  float last = 0;
  for (const float tone : {0.0f, .1f, .25f, .5f, 1.0f}) {
    const float m = struck_mass(Part::head, {0, -.05f, .08f}, -kForward, tone);
    EXPECT_GE(m, last);
    EXPECT_LT(m, body.spec.mass);
    last = m;
  }
}

// A contact of a fist that arrives straight at the middle of the head.
Contact straight_contact(const BodyModel& body, const Pose& attacker, const Pose& target,
                         float speed) {
  const WorldPose a = world_pose(body.skeleton, attacker), t = world_pose(body.skeleton, target);
  const Capsule head = capsules(body, t)[index(Part::head)];
  Contact c;
  c.striker = Part::right_hand;
  c.struck = Part::head;
  const Vec3 center = (head.a + head.b) * .5f - kUp * .03f;
  const Vec3 fist = capsules(body, a)[index(Part::right_hand)].b;
  c.normal = glm::normalize(Vec3{fist.x - center.x, 0, fist.z - center.z});
  c.point = center + c.normal * head.radius;
  c.velocity = -c.normal * speed;
  return c;
}

TEST_F(BlowOf,
       ACrossCarriesWhatOlympicBoxersDo) {  // V1: 26 N s at 9.1 m/s, effective mass 2.9 +- 2.0
  const Pose attacker = stance::punching(body, Side::right, {0, -.03f, .44f}, {-.5f, -1, 0});
  const Vec3 fist = capsules(body, world_pose(body.skeleton, attacker))[index(Part::right_hand)].b;
  const Pose target = placed(stance::fighting(body), {fist.x, fist.z + .20f, kPi});
  const Contact c = straight_contact(body, attacker, target, 9.1f);
  const Blow blow = blow_of(body, attacker, body, target, c, StrikeKind::straight);
  EXPECT_GT(blow.effective_mass, .9f);
  EXPECT_LE(blow.effective_mass, 4.0f);
  EXPECT_GT(glm::length(blow.impulse), 12);
  EXPECT_LT(glm::length(blow.impulse), 32);
  EXPECT_NEAR(blow.speed, 9.1f, .3f);
}

TEST_F(BlowOf, ImpulseGrowsWithSpeedAndABlockPassesOnLess) {
  const Pose attacker = stance::punching(body, Side::right, {0, -.03f, .44f}, {-.5f, -1, 0});
  const Vec3 fist = capsules(body, world_pose(body.skeleton, attacker))[index(Part::right_hand)].b;
  const Pose target = placed(stance::fighting(body), {fist.x, fist.z + .20f, kPi});
  Contact c = straight_contact(body, attacker, target, 6);
  const Blow slow = blow_of(body, attacker, body, target, c, StrikeKind::straight);
  c.velocity *= 1.5f;
  const Blow fast = blow_of(body, attacker, body, target, c, StrikeKind::straight);
  EXPECT_NEAR(glm::length(fast.impulse), 1.5f * glm::length(slow.impulse), .01f);
  c.blocked = true;
  const Blow blocked = blow_of(body, attacker, body, target, c, StrikeKind::straight);
  EXPECT_LT(glm::length(blocked.impulse), .6f * glm::length(fast.impulse));
  // Guard or not, the part itself is struck as hard: faster than the striker goes on, by e v.
  const float left = blocked.speed - 2 * glm::length(blocked.impulse) / blocked.effective_mass;
  EXPECT_NEAR(glm::length(struck_velocity(blocked)), left + .45f * blocked.speed, 1e-3f);
  EXPECT_NEAR(glm::length(struck_velocity(fast)), glm::length(struck_velocity(blocked)), 1e-3f);
}

TEST(Damage, CleanBlowsCostWhatIsExpectedOfThem) {
  const auto points = [](Part part, float impulse, float spin, bool blocked) {
    Blow blow;
    blow.part = part;
    blow.impulse = {0, 0, impulse};
    blow.blocked = blocked;
    ImpactOutcome outcome;
    outcome.head_spin = spin;
    return static_cast<float>(damage_of(blow, outcome)) / 1000;
  };
  EXPECT_NEAR(points(Part::head, 15, 15, false), 3, .3f);
  EXPECT_NEAR(points(Part::head, 21, 30, false), 4.7f, .5f);
  EXPECT_NEAR(points(Part::chest, 45, 3, false), 7.5f, .7f);
  EXPECT_GT(points(Part::head, 30, 20, false), points(Part::chest, 30, 0, false));
  EXPECT_GT(points(Part::chest, 30, 0, false), points(Part::left_thigh, 30, 0, false));
  EXPECT_LT(points(Part::left_forearm, 13, 0, true), 1.5f);
  EXPECT_EQ(points(Part::head, 0, 0, false), 0);
  Blow blow;
  ImpactOutcome felled;
  felled.response = ResponseKind::knockdown;
  blow.impulse = {0, 0, 6};
  EXPECT_GT(damage_of(blow, felled), 5000);
  blow.impulse = {0, 0, 4};  // a touch: it goes on
  EXPECT_LT(damage_of(blow, felled), 1000);
}

}  // namespace
}  // namespace ringcraft
