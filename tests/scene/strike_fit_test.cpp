#include "motion/strike_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "default_library.h"
#include "motion/aim.h"
#include "motion/quality.h"
#include "physics/body.h"
#include "scene/fight.h"

namespace ringcraft {
namespace {

std::vector<Vec3> tips(const Action& action, const Strike& strike) {
  std::vector<Vec3> tip;
  for (const Pose& pose : action.clip.frames) {
    tip.push_back(
        striking_point(strike, canonical_skeleton(), world_pose(canonical_skeleton(), pose)));
  }
  return tip;
}

// m: the nearest that the strike comes to its aim on somebody so tall, from any distance.
float nearest(const Action& action, const Strike& strike, float ratio) {
  const WorldPose guard = world_pose(canonical_skeleton(), *standing_guard(default_library()));
  const std::vector<Vec3> tip = tips(action, strike);
  float least = 1;
  for (float d = 0.3f; d < 2.5f; d += 0.01f) {
    least =
        std::min(least, passes(strike, tip, opponent_aim(*aim_point(strike.aim), guard, ratio, d)));
  }
  return least;
}

class StrikeFit : public ::testing::TestWithParam<float> {
 protected:
  const MotionLibrary& library() const { return default_library(); }
  MotionLibrary fit() const { return fitted(library(), GetParam()); }
};

TEST_P(StrikeFit, StrikesMeetTheirAimsOnTheActualOpponentOverTheirReach) {
  const MotionLibrary fits = fit();
  const WorldPose guard = world_pose(canonical_skeleton(), *standing_guard(library()));
  int missed_before = 0, checked = 0;
  for (const Action& action : fits.actions()) {
    for (std::size_t k = 0; k < action.strikes.size(); ++k) {
      const Strike& strike = action.strikes[k];
      const AimPoint* point = aim_point(strike.aim);
      if (point == nullptr || strike.kind == StrikeKind::elbow) continue;
      const std::vector<Vec3> tip = tips(action, strike);
      ASSERT_GT(strike.farthest, strike.nearest) << action.name << " " << k;
      for (float d = strike.nearest; d <= strike.farthest + 1e-4f; d += 0.005f) {
        EXPECT_LT(passes(strike, tip, opponent_aim(*point, guard, GetParam(), d)), 0.035f)
            << action.name << " " << k << " from " << d;
      }
      const Action& own = library().action(library().find(action.name));
      missed_before += nearest(own, own.strikes[k], GetParam()) > 0.03f ? 1 : 0;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30);
  EXPECT_GT(missed_before, checked / 2);  // the clips as they are do not meet them
}

TEST_P(StrikeFit, WhatLeadsToAClipAndFromItStays) {
  const MotionLibrary fits = fit();
  ASSERT_EQ(fits.actions().size(), library().actions().size());
  for (std::size_t i = 0; i < fits.actions().size(); ++i) {
    const Action &is = fits.actions()[i], &was = library().actions()[i];
    EXPECT_EQ(is.name, was.name);
    ASSERT_EQ(is.length(), was.length());
    EXPECT_EQ(is.clip.root, was.clip.root);
    EXPECT_EQ(is.clip.contacts, was.clip.contacts);
    for (const Tick t : {Tick{0}, is.length()}) {
      const WorldPose a = world_pose(fits.skeleton(), is.clip.at(t));
      EXPECT_LT(largest_joint_distance(a, world_pose(fits.skeleton(), was.clip.at(t))), 0.02f)
          << is.name << " at " << t;
    }
    EXPECT_TRUE(faults(is.clip).empty()) << is.name;
    EXPECT_LT(foot_skate_ratio(fits.skeleton(), is.clip.frames, kTicksPerSecond), 0.01) << is.name;
  }
}

// The limb takes its way without a jump: from tick to tick no joint changes its velocity by 1.5 m/s
// (the gate of the seams) more than it does in the clip, or a third more where that is a blow.
TEST_P(StrikeFit, NothingJumps) {
  const MotionLibrary fits = fit();
  const Skeleton& skeleton = fits.skeleton();
  for (std::size_t i = 0; i < fits.actions().size(); ++i) {
    const Clip &is = fits.actions()[i].clip, &was = library().actions()[i].clip;
    for (Tick t = 1; t < is.length(); ++t) {
      for (const Joint joint : {Joint::head, Joint::left_hand, Joint::right_hand, Joint::left_foot,
                                Joint::right_foot}) {
        const auto change = [&](const Clip& clip) {
          const auto at = [&](Tick tick) {
            return world_pose(skeleton, clip.at(tick)).position[index(joint)];
          };
          return (at(t + 1) - at(t) * 2.0f + at(t - 1)) * static_cast<float>(kTicksPerSecond);
        };
        EXPECT_LT(glm::distance(change(is), change(was)), 1.5f + 0.34f * glm::length(change(was)))
            << fits.actions()[i].name << " at " << t << " " << vrm_name(joint);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, StrikeFit, ::testing::Values(0.85f, 0.93f, 1.08f, 1.18f));

TEST(StrikeFit, AStrikeIsMovedFartherAndNearer) {
  const MotionLibrary& library = default_library();
  const Pose& guard = *standing_guard(library);
  const Action& jab = library.action(library.find("jab"));
  for (const float by : {0.08f, -0.08f}) {
    const Action moved = moved_reach(library.skeleton(), jab, guard, by);
    const float was = (jab.strikes[0].nearest + jab.strikes[0].farthest) / 2;
    const float is = (moved.strikes[0].nearest + moved.strikes[0].farthest) / 2;
    EXPECT_NEAR(is - was, by, 0.04f);
  }
}

// Captured in shadow work, where they end 20 cm under a standing head.
TEST(StrikeFit, CapturedBlowsAreLedToTheirAims) {
  const MotionLibrary& library = default_library();
  int led = 0;
  for (const Action& action : library.actions()) {
    if (is_authored(action)) continue;
    for (const Strike& strike : action.strikes) {
      if (strike.aim.empty()) continue;
      ++led;
      EXPECT_LT(nearest(action, strike, 1), 0.03f) << action.name;
      EXPECT_GT(strike.farthest, strike.nearest) << action.name;
    }
  }
  EXPECT_GE(led, 15);
}

// What cannot be thrown at somebody so tall is not chosen; all else stays inside the joints'
// ranges.
TEST(StrikeFit, ABlowThatDoesNotFitTheOpponentIsNotChosen) {
  const auto scene =
      read_scene("duel", {"fighter.0.body=lightweight", "fighter.1.body=heavyweight"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  const MotionLibrary library = library_for(*scene, default_library());
  const MotionLibrary& small = library.of(FighterId(std::size_t{0}));
  const auto chosen = [](const MotionLibrary& of, const char* name) {
    return std::count(of.launchable().begin(), of.launchable().end(), of.find(name)) > 0;
  };
  EXPECT_FALSE(chosen(small, "elbow_rear"));
  EXPECT_TRUE(chosen(library, "elbow_rear"));
  EXPECT_TRUE(chosen(small, "cross"));
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  for (const ActionId id : small.launchable()) {
    for (const Pose& pose : small.action(id).clip.frames) {
      EXPECT_TRUE(limit_violations(body, pose, radians(3)).empty()) << small.action(id).name;
    }
  }
}

TEST(StrikeFit, ASceneOfUnequalFightersGivesEachHisOwnClips) {
  const auto scene = read_scene(
      "duel", {"duration_s=6", "fighter.0.body=lightweight", "fighter.1.body=heavyweight"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  const MotionLibrary library = library_for(*scene, default_library());
  const ActionId jab = library.find("jab");
  const auto height = [&](const MotionLibrary& of) {
    const Action& action = of.action(jab);
    const Meeting met =
        meetings(library.skeleton(), library.action(jab), *standing_guard(library)).front();
    return tips(action, action.strikes[0])[static_cast<std::size_t>(met.tick)].y;
  };
  EXPECT_GT(height(library.of(FighterId(std::size_t{0}))), height(library) + 0.05f);
  EXPECT_LT(height(library.of(FighterId(std::size_t{1}))), height(library) - 0.05f);
  EXPECT_NE(library.hash(), default_library().hash());
  const FightRecord record = simulate_fight(library, *scene);
  EXPECT_GT(record.timeline.tracks[0].segments.size(), 5u);
}

}  // namespace
}  // namespace ringcraft
