#include "fight/state.h"

#include <gtest/gtest.h>

#include "fight/synthetic_fixture.h"
#include "fight/timeline.h"
#include "motion/strike_fit.h"

namespace ringcraft {
namespace {

class StateTest : public SyntheticFixture {
 protected:
  static FightState state(std::vector<Tick> ends) {
    FightState state;
    for (const Tick end : ends) {
      FighterState fighter;
      fighter.launch = launch("idle", end - 36, {});
      fighter.launch.end = end;
      state.fighters.push_back(fighter);
    }
    return state;
  }
};

TEST_F(StateTest, SyntheticLibraryIsWhole) {
  EXPECT_TRUE(library().dropped().empty()) << library().dropped().front();
  for (const Action& action : library().actions()) {
    EXPECT_TRUE(faults(action.clip).empty()) << action.name << ": " << faults(action.clip).front();
  }
}

TEST_F(StateTest, AimIsEasedInOverTheFirstHalfOfTheStartup) {
  Launch jab = launch("jab", 10, {1, 2, 0.5f});
  jab.aim = 0.2f;
  const Tick startup = library().action(jab.action).strikes[0].active_begin;
  EXPECT_FLOAT_EQ(placement_at(library(), jab, 10).yaw, 0.5f);
  EXPECT_FLOAT_EQ(placement_at(library(), jab, 10 + startup / 2).yaw, 0.7f);
  EXPECT_FLOAT_EQ(placement_at(library(), jab, 10 + startup).yaw, 0.7f);
  float last = 0.5f;
  for (Tick t = 11; t <= 10 + startup / 2; ++t) {
    const float yaw = placement_at(library(), jab, t).yaw;
    EXPECT_GT(yaw, last);
    last = yaw;
  }
}

TEST_F(StateTest, AimOfAStepIsEasedInOverHalfTheClip) {
  Launch step = launch("step_fore", 0, {});
  step.aim = -0.3f;
  EXPECT_FLOAT_EQ(placement_at(library(), step, 24).yaw, -0.3f);
  EXPECT_GT(placement_at(library(), step, 12).yaw, -0.3f);
}

TEST_F(StateTest, FollowingActionStartsWhereTheLastOneEnds) {
  const float scale = 1.1f;
  const Launch step = launch("step_fore", 0, {1, -1, 0.4f});
  const Vec3 target = step.placement * Vec3(0.1f, 0, 1.5f);
  const Launch jab =
      following(library(), step, library().find("jab"), step.end, target, scale, radians(15));
  const Placement end = root_at(library(), step, step.end, scale);
  EXPECT_NEAR(end.x, 1 + 0.33f * std::sin(0.4f), 1e-4f);
  EXPECT_NEAR(end.z, -1 + 0.33f * std::cos(0.4f), 1e-4f);
  EXPECT_NEAR(jab.placement.x, end.x, 0.01f);
  EXPECT_NEAR(jab.placement.z, end.z, 0.01f);
  EXPECT_EQ(jab.start, step.end);
  EXPECT_EQ(jab.end, step.end + library().action(jab.action).length());
  const WorldPose before =
      world_pose(canonical_skeleton(1.75f * scale), pose_at(library(), step, step.end, scale));
  const WorldPose after =
      world_pose(canonical_skeleton(1.75f * scale), pose_at(library(), jab, jab.start, scale));
  EXPECT_LT(largest_joint_distance(before, after), 0.03f);
}

TEST_F(StateTest, AimPointsTheBlowAtTheTargetAndIsClamped) {
  const Launch idle = launch("idle", 0, {});
  const ActionId jab = library().find("jab");
  const auto aimed = [&](Vec3 target) {
    return following(library(), idle, jab, 36, target, 1, radians(15));
  };
  const Launch near = aimed(Vec3(0.1f, 0, 1));
  EXPECT_GT(near.aim, 0);
  EXPECT_NEAR(bearing(placement_at(library(), near, near.end), Vec3(0.1f, 0, 1)), 0, 1e-3f);
  EXPECT_FLOAT_EQ(aimed(Vec3(1, 0, 0.2f)).aim, radians(15));
  EXPECT_FLOAT_EQ(aimed(Vec3(-1, 0, 0.2f)).aim, -radians(15));
}

TEST_F(StateTest, TurnIsAimedByWhereItEndsFacing) {
  const Launch idle = launch("idle", 0, {});
  const Vec3 at_60_degrees = yaw_rotation(radians(60)) * Vec3(0, 0, 2);
  const Launch turn =
      following(library(), idle, library().find("turn_left"), 36, at_60_degrees, 1, radians(25));
  const Placement end = root_at(library(), turn, turn.end, 1);
  EXPECT_NEAR(bearing(end, at_60_degrees), 0, radians(1));
}

TEST_F(StateTest, ResponseStartsWhereTheCutActionStands) {
  Launch cross = launch("cross", 0, {0, 0, 1});
  cross.aim = 0.1f;
  const Launch response =
      forced_response(library(), cross, library().find("steps_back_1"), 30, 1.02f);
  EXPECT_EQ(response.placement, root_at(library(), cross, 30, 1.02f));
  EXPECT_TRUE(response.forced);
  EXPECT_EQ(response.start, 30);
  EXPECT_EQ(response.aim, 0);
}

// A root does not turn with a spin: what answers a blow then begins the way the body has turned,
// but for a quarter that it turns back.
TEST_F(StateTest, AnAnswerToABlowInASpinBeginsTheWayTheBodyHasTurned) {
  const ActionId cross = library().find("cross");
  const float guard = heading_of(standing_guard(library())->rotation[0]);
  for (const float turned : {-160.0f, -100.0f, -40.0f, 0.0f, 60.0f, 95.0f, 130.0f, 170.0f}) {
    std::vector<Action> actions = library().actions();
    for (Pose& pose : actions[cross.at()].clip.frames) {
      pose.rotation[0] = yaw_rotation(radians(turned) + guard);
    }
    const MotionLibrary spun = library().with(std::move(actions));
    const Launch cut = launch("cross", 0, {0, 0, 1});
    const Launch answer = forced_response(spun, cut, spun.find("steps_back_1"), 30, 1);
    const float root = root_at(spun, cut, 30, 1).yaw;
    const float beyond = std::max(0.0f, std::abs(turned) - 90);
    EXPECT_NEAR(wrapped_angle(answer.placement.yaw - root), radians(turned < 0 ? -beyond : beyond),
                1e-3f)
        << turned;
  }
}

// What follows must start where the body is, not where the whole clip would have left it.
TEST_F(StateTest, AShareOfAClipLeadsTheRootAsFar) {
  Launch turn;
  turn.action = library().find("turn_left");
  turn.end = library().action(turn.action).length();
  const Placement whole = root_at(library(), turn, turn.end, 1);
  ASSERT_GT(std::abs(whole.yaw), 0.1f);
  turn.share = 0.25f;
  const Placement part = root_at(library(), turn, turn.end, 1);
  EXPECT_FLOAT_EQ(part.yaw, 0.25f * whole.yaw);
  EXPECT_FLOAT_EQ(part.x, 0.25f * whole.x);
  turn.share = 0;
  EXPECT_EQ(root_at(library(), turn, turn.end, 1), turn.placement);
}

TEST_F(StateTest, GetUpStartsWhereTheBodyLies) {
  const Launch fall = launch("knockdown_back", 0, {2, 1, -0.7f});
  const Launch up = forced_get_up(library(), fall, library().find("get_up_back"), fall.end, 1);
  const Skeleton skeleton = canonical_skeleton();
  const WorldPose lying = world_pose(skeleton, pose_at(library(), fall, fall.end, 1));
  const WorldPose start = world_pose(skeleton, pose_at(library(), up, up.start, 1));
  EXPECT_LT(largest_joint_distance(lying, start), 0.02f);
}

TEST_F(StateTest, EarliestFinisherActsNext) {
  EXPECT_EQ(next_to_act(state({30, 20, 25})), FighterId(1));
  EXPECT_EQ(next_to_act(state({20, 20, 25})), FighterId(0));
  EXPECT_FALSE(next_to_act(state({})).valid());
}

TEST_F(StateTest, TiesAlternate) {
  FightState fight = state({20, 20});
  std::vector<FighterId> first;
  for (int tie = 0; tie < 4; ++tie) {
    const FighterId goes = next_to_act(fight);
    first.push_back(goes);
    note_expanded(fight, goes);
    fight.fighters[goes.at()].launch.end += 10;
    const FighterId then = next_to_act(fight);
    EXPECT_NE(then, goes);
    note_expanded(fight, then);
    fight.fighters[then.at()].launch.end += 10;
  }
  EXPECT_EQ(first,
            (std::vector<FighterId>{FighterId(0), FighterId(1), FighterId(0), FighterId(1)}));
}

TEST_F(StateTest, TieOfThreeLetsTheOtherTwoGoFirstNextTime) {
  FightState fight = state({20, 20, 20});
  note_expanded(fight, next_to_act(fight));
  fight.fighters[0].launch.end = 40;
  EXPECT_EQ(next_to_act(fight), FighterId(1));
  note_expanded(fight, FighterId(1));
  fight.fighters[1].launch.end = 40;
  fight.fighters[2].launch.end = 40;
  EXPECT_EQ(next_to_act(fight), FighterId(2));
}

TEST_F(StateTest, HashSeesEveryField) {
  const FightState base = state({20, 30});
  std::vector<FightState> changed(12, base);
  changed[0].now = 1;
  changed[1].fighters[0].launch.placement.x = 0.001f;
  changed[2].fighters[1].launch.aim = 0.1f;
  changed[3].fighters[1].launch.spent = 1;
  changed[4].fighters[0].health -= 1;
  changed[5].fighters[0].balance = 2;
  changed[6].fighters[0].last_at_tie = true;
  changed[7].fighters[0].opponent = FighterId(1);
  changed[8].fighters.pop_back();
  changed[9].fighters[1].launch.share = 0.5f;
  changed[10].fighters[0].launch.pace =
      Pace(library().action(changed[10].fighters[0].launch.action), 0.9f);
  changed[11].fighters[0].last_contact = 1;
  std::vector<std::uint64_t> hashes{base.hash()};
  for (const FightState& one : changed) {
    EXPECT_FALSE(one == base);
    hashes.push_back(one.hash());
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
  EXPECT_EQ(base.hash(), FightState(base).hash());
}

TEST(TimelineTest, HashSeesSegmentsAndEvents) {
  Timeline timeline;
  timeline.tracks.resize(1);
  timeline.tracks[0].segments.push_back({{}, "jab", Kind::attack});
  const std::uint64_t first = timeline.hash();
  EXPECT_EQ(first, Timeline(timeline).hash());
  timeline.tracks[0].segments[0].launch.start = 3;
  const std::uint64_t second = timeline.hash();
  EXPECT_NE(first, second);
  timeline.events.push_back({});
  EXPECT_NE(second, timeline.hash());
}

}  // namespace
}  // namespace ringcraft
