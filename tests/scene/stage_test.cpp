// What a planner is told of a launch in flight is what is shown.

#include "scene/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "default_library.h"
#include "launch_of.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

class StageTest : public testing::Test {
 protected:
  static Launch launch(const char* name, Tick start, const Placement& placement) {
    return launch_of(default_library(), name, start, placement);
  }
  // How far the farthest joint is off, m.
  static float apart(const Stage& stage, const Pose& a, const Pose& b) {
    const Skeleton& skeleton = stage.body(FighterId(0)).skeleton;
    const WorldPose one = world_pose(skeleton, a), other = world_pose(skeleton, b);
    float most = 0;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      most = std::max(most, glm::distance(one.position[i], other.position[i]));
    }
    return most;
  }
  // At each other, so near that arms meet arms.
  static Stage two_who_strike() {
    Stage stage(default_library(), {make_body({}), make_body({})});
    stage.begin(FighterId(0), launch("jab_jab_cross", 0, {}));
    stage.begin(FighterId(1), launch("double_jab_left", 0, {0, .6f, kPi}));
    return stage;
  }
  static void show(Stage& stage, Tick tick) {
    stage.show(tick);
    stage.keep_out_and_record();
  }
};

TEST_F(StageTest, AMotionInFlightIsWhatWillBeShown) {
  Stage stage(default_library(), {make_body({})}, Repetitions::varied);
  const FighterId self(0);
  stage.begin(self, launch("guard_1", 0, {}));
  for (Tick t = 0; t <= 30; ++t) show(stage, t);
  Launch jab =
      launch("jab_jab_cross", 30, {0.1f, 0.05f, 0.3f});  // not where the idle stands: a blend
  jab.pace = Pace(default_library().action(jab.action), 0.85f);
  jab.end = jab.start + jab.pace.reached(jab.end - jab.start);
  stage.begin(self, jab);
  const MotionInFlight motion = stage.in_flight(self, 30);
  EXPECT_EQ(motion.launch, jab);
  EXPECT_EQ(motion.from, 30);
  ASSERT_GT(static_cast<Tick>(motion.poses.size()), jab.end - jab.start);
  float off_clip = 0;
  for (Tick t = 31; t <= jab.end; ++t) {
    show(stage, t);
    const auto i = static_cast<std::size_t>(t - 30);
    EXPECT_LT(apart(stage, motion.poses[i], stage.shown(self)), 0.01f) << t;
    EXPECT_EQ(motion.clip_ages[i], jab.clip_age(t));
    off_clip =
        std::max(off_clip, apart(stage, stage.shown(self), pose_at(default_library(), jab, t, 1)));
  }
  EXPECT_GT(off_clip, 0.05f);  // the clip by itself would not do
}

// Its poses are told for 2 s, what it strikes to its end.
TEST_F(StageTest, ALongMotionInFlightKeepsItsLastBlow) {
  Stage stage(default_library(), {make_body({})});
  const FighterId self(0);
  Launch jabs = launch("jab_jab_cross_jab", 0, {});
  const Action& action = default_library().action(jabs.action);
  jabs.pace = Pace(action, 0.5f);
  jabs.end = jabs.when(action.length());
  ASSERT_GT(jabs.end, 3 * kTicksPerSecond);
  stage.begin(self, jabs);
  show(stage, 0);
  const MotionTables tables(default_library(), stage.body(self));
  const ActionTable table = tables.in_flight(stage.in_flight(self, 0));
  EXPECT_GE(table.length, jabs.end);
  ASSERT_EQ(table.strikes.size(), action.strikes.size());
  for (std::size_t i = 0; i < action.strikes.size(); ++i) {
    const Strike &shown = table.strikes[i].strike, &clip = action.strikes[i];
    EXPECT_NEAR(shown.active_begin, 2 * clip.active_begin, 1) << i;
    EXPECT_NEAR(shown.active_end, 2 * clip.active_end, 1) << i;
  }
  EXPECT_NEAR(table.root_at(jabs.end).z, tables.at(jabs.action).end.z, 1e-4f);
}

// Both gloves of a jab and cross are stopped. What stops the cross leaves the jab's as it is.
TEST_F(StageTest, ASecondLimbThatLandsDoesNotHoldTheFirstTwice) {
  Stage stage(default_library(), {make_body({})});
  const FighterId self(0);
  const Launch blows = launch("jab_jab_cross", 0, {});
  stage.begin(self, blows);
  const auto land = [&](Part striker) {
    Contact contact;
    contact.striker = striker;
    contact.velocity = {0, 0, 7};
    contact.normal = {0, 0, -1};
    stage.land(self, contact);
  };
  const auto left = [&](const Stage& of) {
    return world_pose(of.body(self).skeleton, of.shown(self)).position[index(Joint::left_hand)];
  };
  const Tick jab = default_library().action(blows.action).strikes[0].active_begin;
  for (Tick t = 0; t <= jab; ++t) show(stage, t);
  stage.show(jab + 1);
  land(Part::left_hand);
  stage.keep_out_and_record();
  for (Tick t = jab + 2; t <= jab + 6; ++t) show(stage, t);
  stage.show(jab + 7);
  Stage without = stage;
  land(Part::right_hand);
  stage.keep_out_and_record();
  without.keep_out_and_record();
  EXPECT_LT(glm::distance(left(stage), left(without)), .001f);

  Stage free(default_library(), {make_body({})});  // the blow by itself goes farther
  free.begin(self, blows);
  for (Tick t = 0; t <= jab + 7; ++t) show(free, t);
  EXPECT_GT(left(free).z, left(stage).z + .05f);
}

TEST_F(StageTest, ACheckGuardsWithTheShinThatItLifts) {
  Stage stage(default_library(), {make_body({})});
  const FighterId self(0);
  const Launch check = launch("check_kick_lead", 0, {});
  stage.begin(self, check);
  const std::uint32_t shin = 1u << index(Part::left_shin);
  int guards = 0;
  for (Tick t = 0; t <= check.end; ++t) {
    show(stage, t);
    guards += (stage.swept(self).guards & shin) != 0 ? 1 : 0;
  }
  const Defense& defense = *default_library().action(check.action).defense;
  EXPECT_GT(guards, (defense.end - defense.begin) / 2);
  EXPECT_LE(guards, defense.end - defense.begin);
}

TEST_F(StageTest, AMotionInFlightHasItsSimulatedPosesAndTheWayOutOfThem) {
  Stage stage(default_library(), {make_body({})});
  const FighterId self(0);
  stage.begin(self, launch("guard_1", 0, {}));
  for (Tick t = 0; t <= 30; ++t) show(stage, t);
  std::vector<Pose> simulated(15, stage.shown(self));
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    simulated[i].hips.x += 0.004f * static_cast<float>(i + 1);
  }
  const Launch step = launch("recover_back_1", 30, {});
  stage.begin(self, step, simulated);
  const MotionInFlight motion = stage.in_flight(self, 30);
  for (Tick t = 31; t <= 90; ++t) {
    show(stage, t);
    EXPECT_LT(apart(stage, motion.poses[static_cast<std::size_t>(t - 30)], stage.shown(self)),
              t <= 45 ? 1e-4f : 0.02f)
        << t;
  }
}

// The feet of who stands stay where they are, as under any other push.
TEST_F(StageTest, WhatIsLeftOfASimulationGoesWhereItsBodyIsPushed) {
  for (const char* answer : {"recover_back_1", "knockdown_back"}) {
    Stage stage(default_library(), {make_body({})});
    const FighterId self(0);
    stage.begin(self, launch("guard_1", 0, {}));
    for (Tick t = 0; t <= 30; ++t) show(stage, t);
    const Pose still = stage.shown(self);
    stage.begin(self, launch(answer, 30, {}), std::vector<Pose>(20, still));
    for (Tick t = 31; t <= 38; ++t) {
      show(stage, t);
      stage.shift(self, {.01f, 0, -.005f});
    }
    const Pose pushed = stage.shown(self);
    EXPECT_NEAR(pushed.hips.x, still.hips.x + .07f, 1e-4f);
    EXPECT_NEAR(pushed.hips.z, still.hips.z - .035f, 1e-4f);
    EXPECT_NEAR(pushed.hips.y, still.hips.y, .01f);
    const bool falls = std::string(answer) == "knockdown_back";
    const Skeleton& skeleton = stage.body(self).skeleton;
    const WorldPose is = world_pose(skeleton, pushed), was = world_pose(skeleton, still);
    for (const Joint foot : {Joint::left_foot, Joint::right_foot}) {
      const Vec3 gone = is.position[index(foot)] - was.position[index(foot)];
      EXPECT_NEAR(gone.x, falls ? .07f : 0, 2e-3f) << answer;
      EXPECT_NEAR(gone.z, falls ? -.035f : 0, 2e-3f) << answer;
    }
  }
}

// A step that ends on the other's foot: what held the foot off in the air must not let it slide
// back once it carries.
TEST_F(StageTest, AFootThatComesDownBesideAnotherStaysWhereItStands) {
  const FighterId self(0), other(1);
  const auto step_from = [&](Stage& stage) {
    stage.begin(self, launch("step_forward_left_long", 0, {}));
  };
  const auto toes_of = [](const Stage& stage, FighterId who, Side side) {
    const WorldPose world = world_pose(stage.body(who).skeleton, stage.shown(who));
    return world.position[index(toes(side))];
  };
  constexpr Tick kSteps = 90;
  Stage alone(default_library(), {make_body({})}), stands(default_library(), {make_body({})});
  step_from(alone);
  for (Tick t = 0; t < kSteps; ++t) show(alone, t);
  stands.begin(self, launch("guard_1", 0, {0, 0, kPi}));
  show(stands, 0);
  const Vec3 from = toes_of(stands, self, Side::left), to = toes_of(alone, self, Side::left);
  int aside = 0;
  for (int i = 0; i < 9; ++i) {
    const int column = i % 3 - 1, row = i / 3;
    const Vec3 off = .05f * Vec3{static_cast<float>(column), 0, static_cast<float>(row)};
    Stage stage(default_library(), {make_body({}), make_body({})});
    step_from(stage);
    stage.begin(other, launch("guard_1", 0, {to.x - from.x + off.x, to.z - from.z + off.z, kPi}));
    Vec3 last{}, gone{};
    bool carried = false;
    for (Tick t = 0; t < kSteps; ++t) {
      show(stage, t);
      const Vec3 at = toes_of(stage, self, Side::left);
      if (stage.held(self).left && carried) {
        EXPECT_LT(std::hypot(at.x - last.x, at.z - last.z) / kTickSeconds, .5f) << i << ", " << t;
      }
      last = at;
      carried = stage.held(self).left;
      gone += stage.taken_aside(self);
    }
    aside += glm::length(gone) > .01f ? 1 : 0;
  }
  EXPECT_GE(aside, 3);
}

// A kick that is set down on the other's foot: what held it off upward must not let it sink in once
// it carries.
TEST_F(StageTest, AFootThatComesDownUponAnotherStandsBesideIt) {
  const FighterId self(0), other(1);
  const auto foot_of = [](const Stage& stage, FighterId who) {
    const BodyModel& body = stage.body(who);
    return capsules(body, world_pose(body.skeleton, stage.shown(who)))[index(Part::left_foot)];
  };
  const auto toes_of = [](const Stage& stage, FighterId who) {
    const WorldPose world = world_pose(stage.body(who).skeleton, stage.shown(who));
    return world.position[index(toes(Side::left))];
  };
  const Launch kick = launch("roundhouse_lead_low", 0, {});
  const Tick over = kick.end - 2;
  Stage alone(default_library(), {make_body({})}), stands(default_library(), {make_body({})});
  alone.begin(self, kick);
  for (Tick t = 0; t < over; ++t) show(alone, t);
  stands.begin(self, launch("guard_1", 0, {0, 0, kPi}));
  show(stands, 0);
  const Vec3 off = toes_of(alone, self) - toes_of(stands, self);
  int carries = 0;
  for (int i = 0; i < 25; ++i) {
    const float x = .03f * static_cast<float>(i % 5), z = .03f * static_cast<float>(i / 5);
    Stage stage(default_library(), {make_body({}), make_body({})});
    stage.begin(self, kick);
    stage.begin(other, launch("guard_1", 0, {off.x + x, off.z + z, kPi}));
    for (Tick t = 0; t < over + 60; ++t) {
      if (t == over) stage.begin(self, launch("guard_1", over, {}));
      show(stage, t);
      if (t < over / 2 || !stage.held(self).left) continue;
      ++carries;
      const Capsule own = foot_of(stage, self), its = foot_of(stage, other);
      const float apart = segment_distance(own.a, own.b, its.a, its.b).distance;
      EXPECT_LT(own.radius + its.radius - apart, .02f) << i << ", " << t;
    }
  }
  EXPECT_GT(carries, 100);
}

TEST_F(StageTest, AFootThatIsFallenUponIsDrawnAway) {
  const FighterId self(0), other(1);
  Stage stage(default_library(), {make_body({}), make_body({})});
  const auto capsule_of = [&](FighterId who, const Pose& pose, Part part) {
    return capsules(stage.body(who), world_pose(stage.body(who).skeleton, pose))[index(part)];
  };
  stage.begin(self, launch("guard_1", 0, {}));
  stage.begin(other, launch("guard_1", 0, {3, 3, kPi}));
  Tick now = 0;
  for (; now < 60 || !stage.held(self).left; ++now) show(stage, now);

  // A thigh comes down upon the foot.
  const Launch falls = launch("knockdown_back_right", now - 1, {});
  Pose lies = pose_at(default_library(), falls, falls.end, 1);
  const Capsule thigh = capsule_of(other, lies, Part::left_thigh);
  const Capsule foot = capsule_of(self, stage.shown(self), Part::left_foot);
  lies.hips += (foot.a + foot.b - thigh.a - thigh.b) / 2.0f + Vec3{0, .06f, 0};
  constexpr Tick kDrops = 60;
  std::vector<Pose> drops(kDrops, lies);
  for (std::size_t t = 0; t < kDrops; ++t) {
    drops[t].hips.y += .3f * (1 - static_cast<float>(t) / kDrops);
  }
  stage.begin(other, falls, drops);
  float deepest = 0;
  for (Tick t = 0; t < kDrops; ++t) {
    show(stage, now + t);
    const Capsule under = capsule_of(self, stage.shown(self), Part::left_foot);
    const Capsule upon = capsule_of(other, stage.shown(other), Part::left_thigh);
    deepest = std::max(deepest, under.radius + upon.radius -
                                    segment_distance(under.a, under.b, upon.a, upon.b).distance);
  }
  EXPECT_GT(deepest, .015f);
  EXPECT_LT(deepest, .03f);
}

// Two who strike at each other, nobody stopped by what he meets: who was kept out first gives way
// again where the other one could not.
TEST_F(StageTest, ArmsOfBothGiveWayToEachOther) {
  Stage stage = two_who_strike();
  const auto capsules_of = [&](FighterId who) {
    const BodyModel& body = stage.body(who);
    return capsules(body, world_pose(body.skeleton, stage.shown(who)));
  };
  const auto is_arm = [](Part part) {
    return part == Part::left_forearm || part == Part::left_hand || part == Part::right_forearm ||
           part == Part::right_hand;
  };
  int touches = 0, deep = 0;
  for (Tick t = 0; t < 90; ++t) {
    show(stage, t);
    float deepest = 0;
    for (const Penetration& one :
         penetrations(capsules_of(FighterId(0)), capsules_of(FighterId(1)), /*least=*/0)) {
      if (is_arm(one.a) && is_arm(one.b)) deepest = std::max(deepest, one.depth);
    }
    touches += deepest > 0 ? 1 : 0;
    deep += deepest > .03f ? 1 : 0;
  }
  EXPECT_GT(touches, 5);
  EXPECT_LT(deep, 4);  // 11 where each is kept out once
}

// A blow of a limb that is held off comes as fast in what a planner is told as it does in the
// fight.
TEST_F(StageTest, AMotionInFlightHasTheSpeedsOfALimbThatIsHeldOff) {
  Stage stage = two_who_strike(), alone(default_library(), {make_body({})});
  const FighterId self(0);
  alone.begin(self, launch("jab_jab_cross", 0, {}));
  int held_off = 0;
  for (Tick t = 0; t < 90; ++t) {
    stage.show(t);
    show(alone, t);
    stage.keep_out_and_record();
    held_off += apart(stage, stage.shown(self), alone.shown(self)) > .02f ? 1 : 0;
    const MotionInFlight motion = stage.in_flight(self, t);
    Stage next = stage;
    next.show(t + 1);
    EXPECT_LT(apart(stage, motion.poses[1], next.shown(self)), 1e-6f) << t;
  }
  EXPECT_GT(held_off, 20);
}

// An arm that is pushed aside as a new action begins does not fly on once nothing is in its way.
TEST_F(StageTest, ALimbThatIsHeldOffDoesNotFlyOnByItself) {
  const FighterId self(0), other(1);
  const auto hand = [](const Stage& of, Joint which) {
    return world_pose(of.body(FighterId(0)).skeleton, of.shown(FighterId(0)))
        .position[index(which)];
  };
  Stage stage = two_who_strike(), alone(default_library(), {make_body({})});
  alone.begin(self, launch("jab_jab_cross", 0, {}));
  std::array<float, 2> before{};
  int pushed = 0;
  for (Tick t = 0; t < 90; ++t) {
    show(stage, t);
    show(alone, t);
    for (const std::size_t i : {0, 1}) {
      const Joint joint = i == 0 ? Joint::left_hand : Joint::right_hand;
      const float off = glm::distance(hand(stage, joint), hand(alone, joint));
      const float speed = (off - std::exchange(before[i], off)) / kTickSeconds;
      if (off < .05f || speed < 1.5f) continue;
      ++pushed;
      Stage goes_on = stage, freely = alone;
      goes_on.shift(other, {0, 0, 5});
      for (Stage* one : {&goes_on, &freely}) one->begin(self, launch("guard_1", t, {}));
      for (Tick u = t + 1; u < t + 30; ++u) {
        show(goes_on, u);
        show(freely, u);
        EXPECT_LT(glm::distance(hand(goes_on, joint), hand(freely, joint)), off + .03f)
            << t << ", " << u - t;
      }
    }
  }
  EXPECT_GT(pushed, 5);
}

// Who is struck begins an answer within the tick that shows the blow: what held its arms off until
// then is not gone in that tick.
TEST_F(StageTest, AnArmThatIsHeldOffStaysWhereItIsInTheTickOfAnAnswer) {
  Stage stage = two_who_strike(), alone(default_library(), {make_body({})});
  const FighterId self(0);
  alone.begin(self, launch("jab_jab_cross", 0, {}));
  const auto hand = [&](const Stage& of, Joint which) {
    return world_pose(of.body(self).skeleton, of.shown(self)).position[index(which)];
  };
  int seen = 0;
  for (Tick t = 0; t < 90; ++t) {
    stage.show(t);
    show(alone, t);
    Stage answers = stage;
    answers.begin(self, launch("guard_1", t, {}));
    answers.keep_out_and_record();
    stage.keep_out_and_record();
    for (const Joint joint : {Joint::left_hand, Joint::right_hand}) {
      if (glm::distance(hand(stage, joint), hand(alone, joint)) < .15f) continue;
      ++seen;
      EXPECT_LT(glm::distance(hand(answers, joint), hand(stage, joint)), .03f) << t;
    }
  }
  EXPECT_GT(seen, 3);
}

}  // namespace
}  // namespace ringcraft
