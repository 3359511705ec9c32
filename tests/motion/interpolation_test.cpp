#include "motion/interpolation.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "base/random.h"
#include "synthetic.h"

namespace ringcraft {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

// A left straight to a place before the fighter, m.
Action jab_at(const Skeleton& skeleton, const std::string& name, Vec3 place, Tick length) {
  Action action = test::action_of(name, Kind::attack,
                                  test::clip_of(
                                      skeleton, length,
                                      [place](float t) {
                                        test::Stance stance;
                                        const float out = test::ramp(t, 0, 0.4f) *
                                                          (1 - test::ramp(t, 0.45f, 0.9f));
                                        stance.hips.z += 0.06f * out;
                                        stance.chest_yaw = -0.4f * out;
                                        stance.left_hand += (place - stance.left_hand) * out;
                                        return stance;
                                      },
                                      test::both, test::in_place));
  Strike strike;
  strike.zone = place.y > 1.3f ? TargetZone::head : TargetZone::body;
  strike.active_begin = length * 3 / 10;
  strike.active_end = length / 2;
  action.strikes.push_back(strike);
  return action;
}

class InterpolationTest : public ::testing::Test {
 protected:
  const Skeleton skeleton_ = canonical_skeleton();
  const std::vector<Action> jabs_ = {jab_at(skeleton_, "high", {0.02f, 1.50f, 0.60f}, 72),
                                     jab_at(skeleton_, "low", {0.02f, 1.15f, 0.62f}, 80),
                                     jab_at(skeleton_, "side", {0.22f, 1.40f, 0.58f}, 76),
                                     jab_at(skeleton_, "near", {0.05f, 1.38f, 0.45f}, 70)};
  const std::vector<Action> steps_ = {
      test::action_of("short", Kind::transition, test::step_clip(skeleton_, {0, 0, 0.2f})),
      test::action_of("long", Kind::transition, test::step_clip(skeleton_, {0, 0, 0.5f}))};
};

TEST_F(InterpolationTest, FamiliesAreOfOneBlowOneLimbAndOneWay) {
  std::vector<Action> actions = jabs_;
  actions.insert(actions.end(), steps_.begin(), steps_.end());
  actions.push_back(mirrored(jabs_[0]));
  actions.push_back(test::action_of("kick", Kind::attack, test::kick_clip(skeleton_)));
  actions.back().strikes.push_back({StrikeKind::front_kick, Joint::right_foot});
  actions.push_back(test::action_of("idle", Kind::idle, test::idle_clip(skeleton_)));
  const auto found = families(skeleton_, actions);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].name, "step_forward");
  EXPECT_EQ(found[0].kind, Outcomes::step);
  EXPECT_EQ(found[1].name, "straight_left");
  EXPECT_THAT(found[1].members, SizeIs(4));
}

TEST_F(InterpolationTest, OfManyRepetitionsSomeStandForAll) {
  std::vector<Action> many(300, steps_[0]);
  many.insert(many.end(), 100, steps_[1]);
  const auto found = families(skeleton_, many);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].members, SizeIs(64));
  EXPECT_GE(std::count_if(found[0].members.begin(), found[0].members.end(),
                          [](std::size_t i) { return i >= 300; }),
            10);
}

TEST_F(InterpolationTest, ReachesWhatIsWantedBetweenRepetitions) {
  const auto found = families(skeleton_, jabs_);
  ASSERT_THAT(found, SizeIs(1));
  const OutcomeTable table(skeleton_, found[0].variants, Outcomes::blow);
  Random random(7);
  double before = 0, first = 0, after = 0;
  float worst = 0;
  constexpr int kCount = 40;
  for (int i = 0; i < kCount; ++i) {
    // Four repetitions span a body in space: any place inside of it can be asked for.
    Vec3 wanted{};
    float total = 0;
    for (std::size_t v = 0; v < 4; ++v) {
      const float w = random.uniform(0.15f, 1);
      wanted += table.samples()[v].outcome * w;
      total += w;
    }
    wanted /= total;
    const Reached reached = table.reach(wanted);
    // What is said is what the action does.
    EXPECT_NEAR(glm::distance(outcome_of(skeleton_, reached.action, Outcomes::blow), wanted),
                reached.error, 1e-5f);
    EXPECT_LE(reached.error, reached.first_error);
    before += static_cast<double>(table.nearest_variant(wanted));
    first += static_cast<double>(reached.first_error);
    after += static_cast<double>(reached.error);
    worst = std::max(worst, reached.error);
  }
  // A fist is 8 cm wide: half of that is a hit on what was aimed at.
  EXPECT_LT(worst, 0.04f);
  EXPECT_LT(after / kCount, 0.015);
  EXPECT_LT(after, 0.2 * before);
  EXPECT_LT(after, first);
}

TEST_F(InterpolationTest, MakesActionsWhereThereIsRoom) {
  std::vector<std::string> notes;
  const auto made = interpolated(skeleton_, steps_, {}, {}, notes);
  ASSERT_THAT(made, SizeIs(1));  // 0.35 m; from 0.275 m it is 7.5 cm only to the next
  EXPECT_EQ(made[0].name, "blend_step_forward_1");
  EXPECT_NEAR(made[0].clip.root.back().z, 0.35f, 0.02f);
  EXPECT_THAT(made[0].source, StartsWith("blend of short 0."));
  EXPECT_TRUE(is_blend(made[0]));
  EXPECT_TRUE(faults(made[0].clip).empty());
  ASSERT_THAT(notes, SizeIs(1));
  EXPECT_THAT(notes[0], HasSubstr("nearest repetition 15.0 cm off"));
}

TEST_F(InterpolationTest, BlendsAreNotBlendedAgainAndTheSameEveryTime) {
  std::vector<std::string> notes, again;
  std::vector<Action> actions = jabs_;
  const auto made = interpolated(skeleton_, actions, {}, {}, notes);
  const auto same = interpolated(skeleton_, actions, {}, {}, again);
  ASSERT_EQ(made.size(), same.size());
  EXPECT_EQ(notes, again);
  EXPECT_GE(made.size(), 2u);
  actions.insert(actions.end(), made.begin(), made.end());
  const auto found = families(skeleton_, actions);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].members, SizeIs(4));
}

TEST_F(InterpolationTest, AZoneIsThatOfTheRepetitionAtTheSameHeight) {
  std::vector<std::string> notes;
  const std::vector<Action> two = {jabs_[0], jabs_[1]};
  for (const Action& made : interpolated(skeleton_, two, {}, {}, notes)) {
    const float height = outcome_of(skeleton_, made, Outcomes::blow).y;
    const float high = outcome_of(skeleton_, two[0], Outcomes::blow).y;
    const float low = outcome_of(skeleton_, two[1], Outcomes::blow).y;
    EXPECT_EQ(made.strikes[0].zone,
              high - height < height - low ? TargetZone::head : TargetZone::body)
        << height;
  }
}

TEST_F(InterpolationTest, AJudgeMayRefuseAndIsHeard) {
  std::vector<std::string> notes;
  const auto made = interpolated(
      skeleton_, steps_, {}, [](const Action&) { return std::string("not today"); }, notes);
  EXPECT_THAT(made, IsEmpty());
  EXPECT_THAT(notes, Contains(HasSubstr("blend refused: step_forward of short")));
  EXPECT_THAT(notes, Contains(HasSubstr("not today")));
}

TEST_F(InterpolationTest, WhatSlidesJumpsOrIsSlowIsRefused) {
  const auto found = families(skeleton_, jabs_);
  const std::vector<float> weights = {0.5f, 0.5f, 0, 0};
  const auto& variants = found[0].variants;
  const Action good = blended(skeleton_, variants, weights);
  EXPECT_EQ(worse_than(skeleton_, good, variants, weights), "");
  Action slides = good;
  for (std::size_t i = 0; i < slides.clip.frames.size(); ++i)
    slides.clip.frames[i].hips.x += 0.004f * static_cast<float>(i);
  EXPECT_THAT(worse_than(skeleton_, slides, variants, weights), StartsWith("feet slide"));
  Action jumps = good;
  for (std::size_t i = 30; i < jumps.clip.frames.size(); ++i) jumps.clip.frames[i].hips.y += 0.03f;
  EXPECT_THAT(worse_than(skeleton_, jumps, variants, weights), StartsWith("a velocity jumps"));
  Action slow = good;
  slow.clip = test::idle_clip(skeleton_);
  EXPECT_THAT(worse_than(skeleton_, slow, variants, weights), StartsWith("the blow peaks"));
}

}  // namespace
}  // namespace ringcraft
