#include "motion/action.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

template <class T, class Name, class From>
void expect_names_lead_back(T last, Name name, From from) {
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    const T value = static_cast<T>(i);
    EXPECT_FALSE(name(value).empty());
    EXPECT_EQ(from(name(value)), value);
  }
  EXPECT_EQ(from("nonsense"), std::nullopt);
}

TEST(Action, EveryNameLeadsBackToItsValue) {
  expect_names_lead_back(
      Kind::idle, [](Kind k) { return name_of(k); }, kind_from_name);
  expect_names_lead_back(
      TargetZone::leg, [](TargetZone z) { return name_of(z); }, zone_from_name);
  expect_names_lead_back(
      StrikeKind::knee, [](StrikeKind k) { return name_of(k); }, strike_kind_from_name);
  expect_names_lead_back(
      DefenseKind::step_away, [](DefenseKind k) { return name_of(k); }, defense_kind_from_name);
  expect_names_lead_back(
      ResponseKind::knockdown, [](ResponseKind k) { return name_of(k); }, response_kind_from_name);
  expect_names_lead_back(
      Lying::seat, [](Lying l) { return name_of(l); }, lying_from_name);
}

TEST(Action, ItsFaultsAreItsClipsAndMoreThanThirtySeconds) {
  const Skeleton skeleton = canonical_skeleton();
  Action idle = test::action_of("idle", Kind::idle, test::idle_clip(skeleton, 3600));
  EXPECT_THAT(faults(idle), testing::IsEmpty());
  idle.clip.root[0].x = 0.1f;
  EXPECT_THAT(faults(idle), testing::ElementsAre(testing::StartsWith("rule 3")));
  // A capture may be longer, as what is cut from it is not.
  idle.clip = test::idle_clip(skeleton, 3601);
  EXPECT_THAT(faults(idle.clip), testing::IsEmpty());
  EXPECT_THAT(faults(idle), testing::ElementsAre("it lasts 30.0 s, longer than 30 s"));
}

TEST(Action, MirroringSwapsTheHandTheNameAndTheDirection) {
  const Skeleton skeleton = canonical_skeleton();
  Action jab = test::action_of("jab_left_to_right_knee", Kind::attack, test::jab_clip(skeleton));
  jab.strikes.push_back({StrikeKind::straight, Joint::left_hand, TargetZone::head, 18, 26});
  jab.response = Response{ResponseKind::recovery_steps, 2, 0.5f};
  jab.feint = Feint{"cross_right"};
  const Action other = mirrored(jab);
  EXPECT_EQ(other.name, "jab_right_to_left_knee");
  EXPECT_EQ(other.strikes[0].joint, Joint::right_hand);
  EXPECT_EQ(other.strikes[0].active_begin, 18);
  EXPECT_EQ(other.response->direction, -0.5f);
  EXPECT_EQ(other.feint->of, "cross_left");
  EXPECT_POSE_NEAR(skeleton, other.clip.at(24), mirrored(jab.clip.at(24)), 0);
  EXPECT_EQ(mirrored(other).name, jab.name);
  EXPECT_EQ(mirrored(other).strikes[0].joint, Joint::left_hand);
}

TEST(Action, DefensesThatAnswerOneAttackAreParticular) {
  EXPECT_TRUE(Defense{DefenseKind::slip}.particular());
  EXPECT_TRUE(Defense{DefenseKind::parry}.particular());
  EXPECT_FALSE(Defense{DefenseKind::guard}.particular());
  EXPECT_FALSE(Defense{DefenseKind::step_away}.particular());
}

}  // namespace
}  // namespace ringcraft
