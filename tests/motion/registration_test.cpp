#include "motion/registration.h"

#include <gmock/gmock.h>

#include "synthetic.h"

namespace ringcraft {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

// A jab out of a body that always shifts, at a pace of its own: `when(t)` is where in the motion it
// is at share t of its length.
Clip shifting_jab(const Skeleton& skeleton, Tick length, const std::function<float(float)>& when) {
  return test::clip_of(
      skeleton, length,
      [&](float t) {
        const float at = when(t);
        test::Stance stance;
        stance.hips.x += 0.05f * std::sin(2 * kPi * at);
        stance.hips.z += 0.08f * at;
        const float out = test::bump(at, 0.1f, 0.9f);
        stance.chest_yaw = -0.4f * out;
        stance.left_hand += (Vec3(0.02f, 1.42f, 0.66f) - stance.left_hand) * out;
        return stance;
      },
      test::both, test::in_place);
}

float even(float t) {
  return t;
}
// Slow first, then fast; its slope stays within 0.55 and 1.45.
float late(float t) {
  return t - 0.45f * std::sin(2 * kPi * t) / (2 * kPi);
}

class RegistrationTest : public ::testing::Test {
 protected:
  const Skeleton skeleton_ = canonical_skeleton();
};

TEST_F(RegistrationTest, OfAClipWithItselfIsTheIdentity) {
  const Clip clip = shifting_jab(skeleton_, 100, even);
  const Registration found = registered(skeleton_, clip, clip);
  ASSERT_EQ(found.tick.size(), 101u);
  for (std::size_t t = 0; t < found.tick.size(); ++t)
    EXPECT_NEAR(found.tick[t], static_cast<float>(t), 1e-3f);
  EXPECT_LT(found.distance, 1e-3f);
}

TEST_F(RegistrationTest, RecoversTheWarpOfACopy) {
  const Clip clip = shifting_jab(skeleton_, 100, even);
  for (const Tick length : {100, 130}) {
    const Clip copy = shifting_jab(skeleton_, length, late);
    const Registration found = registered(skeleton_, clip, copy);
    float worst = 0;
    for (std::size_t t = 0; t < found.tick.size(); ++t) {
      const float back = 100 * late(found.tick[t] / static_cast<float>(length));
      worst = std::max(worst, std::abs(back - static_cast<float>(t)));
    }
    // 25 ms: clouds foresee 0.1 s, so that two paces of one motion differ a little everywhere.
    EXPECT_LT(worst, 3.0f) << "ticks of the reference, copy of " << length;
    EXPECT_LT(found.distance, 0.01f);
  }
}

TEST_F(RegistrationTest, IsStrictlyRisingFromEndToEndAndKeepsTheAnchors) {
  const Clip clip = shifting_jab(skeleton_, 90, even), copy = shifting_jab(skeleton_, 120, late);
  const Registration found = registered(skeleton_, clip, copy, {{45, 66}});
  EXPECT_EQ(found.tick.front(), 0);
  EXPECT_EQ(found.tick.back(), 120);
  for (std::size_t t = 1; t < found.tick.size(); ++t)
    EXPECT_GT(found.tick[t], found.tick[t - 1]) << t;
  EXPECT_NEAR(found.tick[45], 66, 1e-3f);
}

TEST_F(RegistrationTest, OtherMotionLiesFarther) {
  const Clip jab = shifting_jab(skeleton_, 100, even);
  const Registration same = registered(skeleton_, jab, shifting_jab(skeleton_, 110, late));
  const Registration other = registered(skeleton_, jab, test::kick_clip(skeleton_, 110));
  EXPECT_GT(other.distance, 5 * same.distance);
  EXPECT_NEAR(registration_distance(skeleton_, jab, test::kick_clip(skeleton_, 110)),
              other.distance, 0.02f);
}

TEST_F(RegistrationTest, SurvivesLengthsThatNoWarpReaches) {
  const Clip clip = shifting_jab(skeleton_, 20, even), copy = shifting_jab(skeleton_, 240, even);
  const Registration found = registered(skeleton_, clip, copy);
  ASSERT_EQ(found.tick.size(), 21u);
  EXPECT_EQ(found.tick.back(), 240);
  EXPECT_TRUE(std::is_sorted(found.tick.begin(), found.tick.end()));
}

Action attack(Clip clip, StrikeKind kind, Tick begin, Tick end) {
  Action action = test::action_of("jab", Kind::attack, std::move(clip));
  Strike strike;
  strike.kind = kind;
  strike.active_begin = begin;
  strike.active_end = end;
  action.strikes.push_back(strike);
  return action;
}

TEST_F(RegistrationTest, PhasesOfTheSameBlowsBelongTogether) {
  const Action a = attack(test::jab_clip(skeleton_), StrikeKind::straight, 20, 30);
  const Action b = attack(test::jab_clip(skeleton_, 80), StrikeKind::straight, 25, 41);
  const auto shared = shared_phases(a, b);
  ASSERT_TRUE(shared);
  EXPECT_THAT(*shared, ElementsAre(Pair(20, 25), Pair(29, 40)));
  EXPECT_FALSE(shared_phases(a, attack(b.clip, StrikeKind::hook, 25, 41)));
}

TEST_F(RegistrationTest, StepsShareTheFeetTheySet) {
  const Action a =
      test::action_of("a", Kind::transition, test::step_clip(skeleton_, Vec3(0, 0, 0.3f), 84));
  const Action b =
      test::action_of("b", Kind::transition, test::step_clip(skeleton_, Vec3(0, 0, 0.5f), 100));
  const auto shared = shared_phases(a, b);
  ASSERT_TRUE(shared);
  EXPECT_EQ(shared->size(), 3u);  // left up, left down as right goes up, right down
  EXPECT_FALSE(shared_phases(a, mirrored(b)));
}

}  // namespace
}  // namespace ringcraft
