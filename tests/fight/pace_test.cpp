#include "fight/pace.h"

#include <cmath>

#include "fight/synthetic_fixture.h"

namespace ringcraft {
namespace {

class PaceTest : public SyntheticFixture {
 protected:
  static const Action& cross() { return library().action(library().find("cross")); }
  static Launch paced(const char* name, float factor, float aim = 0) {
    Launch launch = SyntheticFixture::launch(name, 100, {1, -1, 0.4f});
    const Action& action = library().action(launch.action);
    launch.aim = aim;
    launch.pace = Pace(action, factor);
    launch.end = launch.when(action.length());
    return launch;
  }
};

TEST_F(PaceTest, RunsAsTheClipWhereNothingIsWrong) {
  const Pace none, one(cross(), 1);
  for (const Tick t : {0, 1, 17, 200}) {
    EXPECT_EQ(none.age(t), static_cast<float>(t));
    EXPECT_EQ(one.age(t), static_cast<float>(t));
  }
  EXPECT_EQ(none.reached(80), 80);
}

TEST_F(PaceTest, HoldsItsFactorUntilTheBlowIsOverAndGoesOverSmoothly) {
  for (const float factor : {0.85f, 1.1f}) {
    const Action& action = cross();
    const Pace pace(action, factor);
    const auto until =
        static_cast<Tick>(static_cast<float>(action.strikes.back().active_end) / factor);
    for (Tick t = 1; t <= until; ++t) {
      EXPECT_NEAR(pace.age(t) - pace.age(t - 1), factor, 1e-4f);
    }
    float before = factor;
    for (Tick t = until + 1; t < until + 60; ++t) {
      const float rate = pace.age(t) - pace.age(t - 1);
      EXPECT_LT(std::abs(rate - before), 0.02f) << t;  // no jump of speed
      before = rate;
    }
    EXPECT_NEAR(before, 1, 1e-4f);
    const Tick length = pace.reached(action.length());
    EXPECT_GE(pace.age(length) + 1e-2f, static_cast<float>(action.length()));
    EXPECT_EQ(length > action.length(), factor < 1);
  }
}

TEST_F(PaceTest, ALaunchIsWhereItsClipIs) {
  for (const float factor : {0.8f, 1.25f}) {
    const Launch step = paced("step_fore", factor), whole = paced("step_fore", 1);
    for (const Tick clip : {10, 20, 30}) {
      const Tick tick = step.when(clip);
      EXPECT_NEAR(step.age(tick), clip, 1.25f);
      const Vec3 at = root_at(library(), step, tick, 1).position(),
                 of_clip = root_at(library(), whole, whole.start + clip, 1).position();
      EXPECT_LT(glm::distance(at, of_clip), 0.02f);
      EXPECT_LT(glm::distance(pose_at(library(), step, tick, 1).hips,
                              pose_at(library(), whole, whole.start + clip, 1).hips),
                0.02f);
    }
    EXPECT_EQ(root_at(library(), step, step.end, 1), root_at(library(), whole, whole.end, 1));
  }
}

TEST_F(PaceTest, AnActionThatFollowsBeginsWhereTheClipEnds) {
  const Vec3 target{1, 0, 3};
  const auto next = [&](const Launch& last) {
    return following(library(), last, library().find("jab"), last.end, target, 1, radians(15));
  };
  const Launch whole = next(paced("step_fore", 1)), fast = next(paced("step_fore", 1.25f));
  EXPECT_EQ(fast.placement, whole.placement);
  EXPECT_LT(fast.start, whole.start);
}

TEST_F(PaceTest, TheAimIsInWhenTheClipSaysSo) {
  const Launch slow = paced("cross", 0.8f, 0.2f);
  const Tick in = slow.when(aim_ticks(cross()));
  EXPECT_FLOAT_EQ(placement_at(library(), slow, in).yaw, 0.6f);
  EXPECT_LT(placement_at(library(), slow, slow.start + aim_ticks(cross())).yaw, 0.599f);
}

// The blow that is on its way is let out at its pace.
TEST_F(PaceTest, ABlowOnItsWayEndsAtItsPace) {
  const Strike& strike = cross().strikes.front();
  const auto free = [&](float factor) {
    const Launch launch = paced("cross", factor);
    return free_after_fall(cross(), launch, launch.when(strike.active_begin)) - launch.start;
  };
  EXPECT_GT(free(0.8f), free(1) + 3);
}

}  // namespace
}  // namespace ringcraft
