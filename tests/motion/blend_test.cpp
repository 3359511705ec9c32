#include "motion/blend.h"

#include <gmock/gmock.h>

#include "motion/outcome.h"
#include "motion/quality.h"
#include "motion/registration.h"
#include "synthetic.h"

namespace ringcraft {
namespace {

// A left straight to `height`, m; its feet stay.
Action jab_to(const Skeleton& skeleton, float height, Tick length) {
  Action action = test::action_of(
      "jab", Kind::attack,
      test::clip_of(
          skeleton, length,
          [height](float t) {
            test::Stance stance;
            const float out = test::ramp(t, 0, 0.4f) * (1 - test::ramp(t, 0.45f, 0.9f));
            stance.hips.z += 0.06f * out;
            stance.chest_yaw = -0.4f * out;
            stance.left_hand += (Vec3(0.02f, height, 0.62f) - stance.left_hand) * out;
            return stance;
          },
          test::both, test::in_place));
  Strike strike;
  strike.active_begin = length * 3 / 10;
  strike.active_end = length / 2;
  action.strikes.push_back(strike);
  return action;
}

Action step_of(const Skeleton& skeleton, Vec3 way, Tick length) {
  return test::action_of("step", Kind::transition, test::step_clip(skeleton, way, length));
}

std::vector<Variant> variants_of(const Skeleton& skeleton, const std::vector<Action>& actions) {
  std::vector<Variant> variants;
  variants.reserve(actions.size());
  for (const Action& action : actions)
    variants.push_back({&action, registered(skeleton, actions[0].clip, action.clip,
                                            shared_phases(actions[0], action).value_or(Anchors{}))
                                     .tick});
  return variants;
}

float farthest_joint(const Skeleton& skeleton, const Clip& a, const Clip& b) {
  float most = 0;
  for (Tick t = 0; t <= a.length(); ++t)
    most = std::max(
        most, largest_joint_distance(world_pose(skeleton, a.at(t)), world_pose(skeleton, b.at(t))));
  return most;
}

class BlendTest : public ::testing::Test {
 protected:
  const Skeleton skeleton_ = canonical_skeleton();
};

TEST_F(BlendTest, OfIdenticalClipsIsTheClip) {
  for (const Action& one : {jab_to(skeleton_, 1.42f, 72), step_of(skeleton_, {0, 0, 0.4f}, 84)}) {
    const std::vector<Action> actions = {one, one, one};
    const auto variants = variants_of(skeleton_, actions);
    const Action mean = blended(skeleton_, variants, std::vector<float>{0.2f, 0.5f, 0.3f});
    ASSERT_EQ(mean.length(), one.length());
    EXPECT_LT(farthest_joint(skeleton_, mean.clip, one.clip), 1e-3f) << one.name;
    EXPECT_EQ(mean.clip.contacts, one.clip.contacts);
    EXPECT_TRUE(faults(mean.clip).empty());
  }
}

TEST_F(BlendTest, AWeightOfOneGivesThatRepetitionExactly) {
  const std::vector<Action> actions = {jab_to(skeleton_, 1.42f, 72), jab_to(skeleton_, 1.1f, 96)};
  const auto variants = variants_of(skeleton_, actions);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<float> weights(2, 0.0f);
    weights[i] = 1;
    const Action one = blended(skeleton_, variants, weights);
    ASSERT_EQ(one.length(), actions[i].length());
    EXPECT_EQ(farthest_joint(skeleton_, one.clip, actions[i].clip), 0);
    EXPECT_EQ(one.strikes[0].active_begin, actions[i].strikes[0].active_begin);
  }
}

TEST_F(BlendTest, ComesToARepetitionAsItsWeightComesToOne) {
  const std::vector<Action> actions = {jab_to(skeleton_, 1.42f, 72), jab_to(skeleton_, 1.1f, 96)};
  const auto variants = variants_of(skeleton_, actions);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<float> weights(2, 0.002f);
    weights[i] = 0.998f;
    const Action near = blended(skeleton_, variants, weights);
    ASSERT_EQ(near.length(), actions[i].length());
    EXPECT_LT(farthest_joint(skeleton_, near.clip, actions[i].clip), 0.01f) << i;
  }
}

TEST_F(BlendTest, PaceAndPhasesAreWeighed) {
  const std::vector<Action> actions = {jab_to(skeleton_, 1.42f, 80), jab_to(skeleton_, 1.1f, 120)};
  const Action half =
      blended(skeleton_, variants_of(skeleton_, actions), std::vector<float>{0.5f, 0.5f});
  EXPECT_EQ(half.length(), 100);
  EXPECT_EQ(half.strikes[0].active_begin, 30);
  EXPECT_EQ(half.strikes[0].active_end, 50);
}

TEST_F(BlendTest, WhatABlowComesToRisesWithItsWeight) {
  const std::vector<Action> actions = {jab_to(skeleton_, 1.1f, 72), jab_to(skeleton_, 1.5f, 84)};
  const auto variants = variants_of(skeleton_, actions);
  float before = -1;
  for (int k = 0; k <= 10; ++k) {
    const float share = 0.1f * static_cast<float>(k);
    const Action blend = blended(skeleton_, variants, std::vector<float>{1 - share, share});
    const Vec3 lands = outcome_of(skeleton_, blend, Outcomes::blow);
    EXPECT_GT(lands.y, before + 0.01f) << share;
    before = lands.y;
  }
}

// m: the most that a planted ball of the foot moves in a tick.
float most_slip(const Skeleton& skeleton, const Clip& clip) {
  float most = 0;
  for (const Side side : {Side::left, Side::right}) {
    Vec3 before{};
    for (Tick t = 0; t <= clip.length(); ++t) {
      const Vec3 ball = world_pose(skeleton, clip.at(t)).position[index(toes(side))];
      const bool planted = clip.contacts_at(t).of(side) && clip.contacts_at(t - 1).of(side);
      if (t > 0 && planted) most = std::max(most, glm::distance(ball, before));
      before = ball;
    }
  }
  return most;
}

TEST_F(BlendTest, FeetThatAreSetStandStill) {
  const std::vector<Action> actions = {step_of(skeleton_, {0, 0, 0.2f}, 84),
                                       step_of(skeleton_, {0.1f, 0, 0.35f}, 100)};
  const Action blend =
      blended(skeleton_, variants_of(skeleton_, actions), std::vector<float>{0.4f, 0.6f});
  EXPECT_TRUE(faults(blend.clip).empty());
  for (const Action& action : actions) EXPECT_LT(most_slip(skeleton_, action.clip), 2e-4f);
  EXPECT_LT(most_slip(skeleton_, blend.clip), 3e-4f);
  EXPECT_EQ(foot_skate_ratio(skeleton_, blend.clip.frames, kTicksPerSecond), 0);
  const Vec3 way = outcome_of(skeleton_, blend, Outcomes::step);
  EXPECT_NEAR(way.z, 0.29f, 0.01f);
  EXPECT_NEAR(way.x, 0.06f, 0.01f);
}

TEST_F(BlendTest, AFootThatOnlySomeLiftStaysWhereTheyWeighLess) {
  // The second one moves its right foot although the first does not.
  std::vector<Action> actions = {test::action_of("still", Kind::idle, test::idle_clip(skeleton_)),
                                 test::action_of("moves", Kind::idle, test::idle_clip(skeleton_))};
  actions[1].clip = test::clip_of(
      skeleton_, 60,
      [](float t) {
        test::Stance stance;
        stance.right_ball.x += 0.1f * test::ramp(t, 0.2f, 0.8f);
        stance.right_ball.y += 0.05f * test::bump(t, 0.2f, 0.8f);
        return stance;
      },
      [](float t) {
        return FootContacts{true, t < 0.2f || t > 0.8f};
      },
      test::in_place);
  const auto variants = variants_of(skeleton_, actions);
  const Action blend = blended(skeleton_, variants, std::vector<float>{0.7f, 0.3f});
  const auto ball = [&](Tick t) {
    return world_pose(skeleton_, blend.clip.at(t)).position[index(Joint::right_toes)];
  };
  for (Tick t = 0; t <= blend.length(); ++t) {
    EXPECT_TRUE(blend.clip.contacts_at(t).right);
    EXPECT_NEAR(std::hypot(ball(t).x - ball(0).x, ball(t).z - ball(0).z), 0, 2e-3f) << t;
  }
}

TEST_F(BlendTest, TurnsOfMoreThanHalfATurnAreAveragedTheLongWay) {
  const auto turn = [&](float most) {
    return test::action_of("turn", Kind::transition,
                           test::clip_of(
                               skeleton_, 80,
                               [most](float t) {
                                 test::Stance stance;
                                 const float yaw = most * test::ramp(t, 0, 1);
                                 const Quat q = yaw_rotation(yaw);
                                 stance.hips_yaw += yaw;
                                 stance.left_yaw += yaw;
                                 stance.right_yaw += yaw;
                                 stance.left_ball = q * stance.left_ball;
                                 stance.right_ball = q * stance.right_ball;
                                 stance.left_hand = q * stance.left_hand;
                                 stance.right_hand = q * stance.right_hand;
                                 return stance;
                               },
                               [](float) { return FootContacts{}; },
                               [most](float t) {
                                 return Placement{0, 0, wrapped_angle(most * test::ramp(t, 0, 1))};
                               }));
  };
  const std::vector<Action> actions = {turn(radians(160)), turn(radians(220))};
  const Action blend =
      blended(skeleton_, variants_of(skeleton_, actions), std::vector<float>{0.5f, 0.5f});
  EXPECT_NEAR(degrees(outcome_of(skeleton_, blend, Outcomes::turn).x), 190, 2);
}

}  // namespace
}  // namespace ringcraft
