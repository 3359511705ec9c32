#include "physics/contact.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "physics/penetration.h"
#include "physics/stance.h"

namespace ringcraft {
namespace {

// All capsules far away but those set.
BodyCapsules nothing(float away) {
  BodyCapsules c;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Vec3 p{away + 10 * static_cast<float>(i), -50, 0};
    c[i] = {p, p + kUp * .1f, .05f};
  }
  return c;
}

struct Meeting {
  SweptBody attacker, target;
};

// A fist that moves by `way` toward a head at the origin, from `start`.
Meeting fist_at_head(Vec3 start, Vec3 way) {
  Meeting m;
  m.attacker.before = m.attacker.after = nothing(1000);
  m.target.before = m.target.after = nothing(-1000);
  const Capsule fist{start, start + Vec3{0, 0, .05f}, .055f};
  m.attacker.before[index(Part::right_hand)] = fist;
  m.attacker.after[index(Part::right_hand)] = {fist.a + way, fist.b + way, fist.radius};
  m.target.before[index(Part::head)] =
      m.target.after[index(Part::head)] = {{}, {0, .05f, 0}, .095f};
  return m;
}

TEST(StrikeContact, FirstTouchIsWhereTheSurfacesMeet) {
  const Meeting m = fist_at_head({0, 0, -.30f}, {0, 0, .20f});
  const auto c = strike_contact(m.attacker, Part::right_hand, m.target);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->struck, Part::head);
  EXPECT_FALSE(c->blocked);
  EXPECT_NEAR(c->share, (.30f - .05f - .15f) / .20f, .002f);
  EXPECT_NEAR(c->velocity.z, .20f * 120, 1e-2f);
  EXPECT_NEAR(c->normal.z, -1, 1e-3f);
  EXPECT_NEAR(c->point.z, -.095f, 1e-3f);
}

TEST(StrikeContact, AFistThatPassesThroughWithinOneTickIsNotMissed) {
  const Meeting m = fist_at_head({0, 0, -.8f}, {0, 0, 1.6f});
  EXPECT_TRUE(strike_contact(m.attacker, Part::right_hand, m.target));
}

TEST(StrikeContact, ARetreatingOrShortFistMakesNoContact) {
  const Meeting away = fist_at_head({0, 0, -.19f}, {0, 0, -.2f});
  EXPECT_FALSE(strike_contact(away.attacker, Part::right_hand, away.target));
  const Meeting short_of = fist_at_head({0, 0, -.5f}, {0, 0, .2f});
  EXPECT_FALSE(strike_contact(short_of.attacker, Part::right_hand, short_of.target));
}

TEST(StrikeContact, AForearmInTheWayIsABlock) {
  Meeting m = fist_at_head({0, 0, -.40f}, {0, 0, .40f});
  m.target.before[index(Part::left_forearm)] =
      m.target.after[index(Part::left_forearm)] = {{0, -.1f, -.15f}, {0, .15f, -.15f}, .042f};
  const auto c = strike_contact(m.attacker, Part::right_hand, m.target);
  ASSERT_TRUE(c);
  EXPECT_TRUE(c->blocked);
  EXPECT_EQ(c->struck, Part::left_forearm);
  // Behind the head it guards nothing.
  m.target.before[index(Part::left_forearm)] =
      m.target.after[index(Part::left_forearm)] = {{0, -.1f, .15f}, {0, .15f, .15f}, .042f};
  EXPECT_FALSE(strike_contact(m.attacker, Part::right_hand, m.target)->blocked);
}

// A glove beside the way of a fist to the head, which going straight on would press it in by
// `pressed`.
Meeting fist_past_a_glove(float pressed) {
  Meeting m = fist_at_head({0, 0, -.40f}, {0, 0, .40f});
  const Vec3 beside{.11f - pressed, 0, -.15f};
  m.target.before[index(Part::left_hand)] =
      m.target.after[index(Part::left_hand)] = {beside, beside + Vec3{0, .05f, 0}, .055f};
  return m;
}

TEST(StrikeContact, AGuardThatIsOnlyBrushedLetsTheBlowGoOn) {
  const Meeting brushed = fist_past_a_glove(.01f), met = fist_past_a_glove(.03f);
  const auto c = strike_contact(brushed.attacker, Part::right_hand, brushed.target);
  ASSERT_TRUE(c);
  EXPECT_FALSE(c->blocked);
  EXPECT_EQ(c->struck, Part::head);
  const auto block = strike_contact(met.attacker, Part::right_hand, met.target);
  ASSERT_TRUE(block);
  EXPECT_TRUE(block->blocked);
  EXPECT_EQ(block->struck, Part::left_hand);
}

// A fist that has brushed past the rim of a glove and turns into it is blocked then.
TEST(StrikeContact, AGuardThatIsPressedInAfterAllIsABlock) {
  Meeting m = fist_past_a_glove(.01f);
  Capsule &was = m.attacker.before[index(Part::right_hand)],
          &is = m.attacker.after[index(Part::right_hand)];
  was = {{0, 0, -.22f}, {0, 0, -.17f}, .055f};
  is = {{0, 0, -.21f}, {0, 0, -.16f}, .055f};
  EXPECT_FALSE(strike_contact(m.attacker, Part::right_hand, m.target));
  is = {{.02f, 0, -.21f}, {.02f, 0, -.16f}, .055f};
  const auto c = strike_contact(m.attacker, Part::right_hand, m.target);
  ASSERT_TRUE(c);
  EXPECT_TRUE(c->blocked);
}

// A leg that is lifted to check a kick takes it; the one that stands, or comes down again, is hit.
TEST(StrikeContact, TheLiftedShinOfACheckIsAGuard) {
  Action check;
  check.defense = {DefenseKind::check, 10, 20};
  check.clip.frames.resize(31);
  check.clip.contacts.assign(31, {false, true});
  const std::uint32_t lifted = 1u << index(Part::left_shin) | 1u << index(Part::left_foot);
  EXPECT_EQ(guarding_parts(check, 9), guarding_parts());
  EXPECT_EQ(guarding_parts(check, 10), guarding_parts() | lifted);
  EXPECT_EQ(guarding_parts(check, 20), guarding_parts());
  check.defense->kind = DefenseKind::duck;
  EXPECT_EQ(guarding_parts(check, 10), guarding_parts());

  Meeting m = fist_at_head({0, 0, -.40f}, {0, 0, .40f});
  m.target.before[index(Part::left_shin)] =
      m.target.after[index(Part::left_shin)] = {{0, -.1f, -.15f}, {0, .15f, -.15f}, .05f};
  EXPECT_FALSE(strike_contact(m.attacker, Part::right_hand, m.target)->blocked);
  m.target.guards |= lifted;
  const auto c = strike_contact(m.attacker, Part::right_hand, m.target);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->struck, Part::left_shin);
  EXPECT_TRUE(c->blocked);
}

TEST(StrikeContact, ARoundhouseLandsWithTheShinToo) {
  Meeting m = fist_at_head({0, 0, -5}, {});
  Strike kick;
  kick.kind = StrikeKind::roundhouse;
  kick.joint = Joint::right_foot;
  m.attacker.before[index(Part::right_shin)] = {{-.2f, 0, -.3f}, {.2f, 0, -.3f}, .05f};
  m.attacker.after[index(Part::right_shin)] = {{-.2f, 0, -.1f}, {.2f, 0, -.1f}, .05f};
  const auto c = strike_contact(m.attacker, kick, m.target);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->striker, Part::right_shin);
  kick.kind = StrikeKind::front_kick;
  EXPECT_FALSE(strike_contact(m.attacker, kick, m.target));
}

// Against brute force: 1000 sub-steps of random meetings.
TEST(StrikeContact, AgreesWithSubSteps) {
  const BodyModel body = make_body({});
  Random random(11);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    SweptBody attacker, target;
    target.guards = 0;  // whatever is touched is struck
    attacker.before = attacker.after = nothing(1000);
    const Pose stand = placed(stance::square(body), {0, 0, random.uniform(-3, 3)});
    target.before = capsules(body, world_pose(body.skeleton, stand));
    target.after = capsules(body, world_pose(body.skeleton, placed(stand, {.01f, .02f, 0})));
    const Vec3 from{random.uniform(-.6f, .6f), random.uniform(.2f, 1.7f), -.7f};
    const Vec3 to = from + Vec3{random.uniform(-.3f, .3f), random.uniform(-.3f, .3f), .9f};
    attacker.before[index(Part::left_hand)] = {from, from + kForward * .05f, .055f};
    attacker.after[index(Part::left_hand)] = {to, to + kForward * .05f, .055f};
    const auto found = strike_contact(attacker, Part::left_hand, target);
    std::optional<float> share;
    for (int k = 0; k <= 1000 && !share; ++k) {
      const float s = static_cast<float>(k) / 1000;
      const Vec3 a = glm::mix(from, to, s);
      for (std::size_t p = 0; p < kPartCount; ++p) {
        const Capsule &t0 = target.before[p], &t1 = target.after[p];
        if (segment_distance(a, a + kForward * .05f, glm::mix(t0.a, t1.a, s),
                             glm::mix(t0.b, t1.b, s))
                .distance <= .055f + t0.radius) {
          share = s;
        }
      }
    }
    if (!share) {
      EXPECT_FALSE(found) << i;
      continue;
    }
    ASSERT_TRUE(found) << i;
    ++hits;
    EXPECT_NEAR(found->share, *share, .003f) << i;
    EXPECT_LT(glm::dot(found->velocity, found->normal), 0);
  }
  EXPECT_GT(hits, 100);
}

TEST(Zones, ArmsCountAsBody) {
  EXPECT_EQ(zone_of(Part::neck), TargetZone::head);
  EXPECT_EQ(zone_of(Part::right_hand), TargetZone::body);
  EXPECT_EQ(zone_of(Part::pelvis), TargetZone::body);
  EXPECT_EQ(zone_of(Part::left_thigh), TargetZone::leg);
}

TEST(FallContact, OnlyAPartThatItselfComesFallsUponAnother) {
  const auto of_head = [](Meeting m) {  // a head in the place of the fist
    for (BodyCapsules* c : {&m.attacker.before, &m.attacker.after}) {
      std::swap((*c)[index(Part::head)], (*c)[index(Part::right_hand)]);
    }
    return m;
  };
  const Meeting fist = fist_at_head({0, 0, -.20f}, {0, 0, .06f}), falls = of_head(fist);
  EXPECT_FALSE(fall_contact(fist.attacker, fist.target, 1));
  const auto met = fall_contact(falls.attacker, falls.target, 1);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->striker, Part::head);
  EXPECT_EQ(met->struck, Part::head);
  EXPECT_FALSE(fall_contact(falls.attacker, falls.target, 8));  // 7.2 m/s
  // One head runs into another that stays where it is.
  Meeting walked_into = of_head(fist_at_head({0, 0, -.18f}, {}));
  Capsule& head = walked_into.target.before[index(Part::head)];
  head.a.z += .06f;
  head.b.z += .06f;
  ASSERT_TRUE(strike_contact(walked_into.attacker, Part::head, walked_into.target));
  EXPECT_FALSE(fall_contact(walked_into.attacker, walked_into.target, 1));
}

}  // namespace
}  // namespace ringcraft
