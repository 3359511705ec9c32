#include "motion/state_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "motion/library.h"
#include "motion/pose_near.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using test::action_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A clip that goes from one stance to another; stances are told apart by the hips' height.
Clip between(float from, float to, Tick length = 30) {
  return test::clip_of(
      kSkeleton, length,
      [=](float t) {
        test::Stance stance;
        const float lower = from + (to - from) * test::ramp(t, 0, 1);
        stance.hips.y -= lower;
        stance.left_hand.y -= lower;
        stance.right_hand.y -= lower;
        return stance;
      },
      test::both, test::in_place);
}
constexpr float kGuard = 0, kCrouch = 0.35f, kSquat = 0.6f;

Action guard_idle() {
  return action_of("idle", Kind::idle, test::idle_clip(kSkeleton));
}
Action lying(std::string name, Kind kind, bool ends) {
  Clip clip = ends ? between(kGuard, kSquat) : between(kSquat, kGuard);
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const float down = static_cast<float>(ends ? i : clip.frames.size() - 1 - i) / 30;
    clip.frames[i].rotation[0] =
        glm::angleAxis(-down * kPi / 2, kLeft) * clip.frames[i].rotation[0];
  }
  Action action = action_of(std::move(name), kind, std::move(clip));
  (ends ? action.ends_lying : action.starts_lying) = Lying::back;
  return action;
}

TEST(StateMachine, AlignmentFindsTheFloorPlacementBetweenTwoClipsExactly) {
  // A steady drift, so that velocities before and after the cut are the same.
  Clip whole = test::idle_clip(kSkeleton, 40);
  for (std::size_t i = 0; i < whole.frames.size(); ++i) {
    const float t = static_cast<float>(i) * kTickSeconds;
    whole.frames[i] = whole.frames[0];
    whole.frames[i].hips += Vec3(0.3f, 0.1f, 0.8f) * t;
    whole.root[i] = {0.3f * t, 0.8f * t, 0.5f * t};
  }
  Random random(21);
  for (int n = 0; n < 30; ++n) {
    const Placement moved{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-kPi, kPi)};
    Clip second = cut(whole, 20, 40);
    for (Pose& pose : second.frames) pose = placed(pose, inverse(moved));
    const Alignment found = aligned(kSkeleton, cut(whole, 0, 20), second);
    EXPECT_NEAR(found.placement.x, moved.x, 1e-4f);
    EXPECT_NEAR(found.placement.z, moved.z, 1e-4f);
    EXPECT_NEAR(wrapped_angle(found.placement.yaw - moved.yaw), 0, 1e-4f);
    EXPECT_LT(found.distance, 1e-4f);
  }
}

TEST(StateMachine, AlignmentIgnoresWhereTheFirstClipEnds) {
  const Clip step = test::step_clip(kSkeleton, {0.3f, 0, 0.4f});
  const Alignment found = aligned(kSkeleton, step, test::idle_clip(kSkeleton));
  EXPECT_NEAR(found.placement.x, 0, 5e-3f);
  EXPECT_NEAR(found.placement.z, 0, 5e-3f);
  EXPECT_LT(found.distance, 0.03f);
}

TEST(StateMachine, AVelocityThatDiffersKeepsClipsApart) {
  const Clip jab = test::jab_clip(kSkeleton, 30);
  const Clip out = cut(jab, 0, 6), back = mirrored(mirrored(cut(jab, 6, 30)));
  Clip reversed = out;
  std::reverse(reversed.frames.begin(), reversed.frames.end());
  EXPECT_GT(aligned(kSkeleton, out, reversed).distance, 3 * aligned(kSkeleton, out, back).distance);
}

TEST(StateMachine, EdgesStandWithinTheThresholdNearestFirst) {
  const std::vector<Action> actions = {
      guard_idle(), action_of("duck", Kind::defense, between(kGuard, kCrouch)),
      action_of("rise", Kind::transition, between(kCrouch, kGuard))};
  const StateMachine machine(kSkeleton, actions, {});
  EXPECT_EQ(machine.edge(ActionId(0), ActionId(2)), nullptr);
  ASSERT_NE(machine.edge(ActionId(0), ActionId(1)), nullptr);
  ASSERT_NE(machine.edge(ActionId(1), ActionId(2)), nullptr);
  EXPECT_EQ(machine.edge(ActionId(1), ActionId(0)), nullptr);
  for (int i = 0; i < 3; ++i) {
    float last = 0;
    for (const Edge& edge : machine.edges(ActionId(i))) {
      EXPECT_LE(edge.alignment.distance, StateMachineSettings().threshold);
      EXPECT_GE(edge.alignment.distance, last);
      last = edge.alignment.distance;
    }
  }
}

TEST(StateMachine, APathLeadsOverTransitionsAndCountsTheirTicks) {
  const std::vector<Action> actions = {
      guard_idle(), action_of("duck", Kind::defense, between(kGuard, kCrouch)),
      action_of("rise slowly", Kind::transition, between(kCrouch, kGuard, 90)),
      action_of("rise", Kind::transition, between(kCrouch, kGuard, 40)),
      action_of("rise with a punch", Kind::attack, between(kCrouch, kGuard, 20))};
  const StateMachine machine(kSkeleton, actions, {});
  const Path* path = machine.path(ActionId(1), ActionId(0));
  ASSERT_NE(path, nullptr);
  EXPECT_THAT(path->via, ElementsAre(ActionId(3)));
  EXPECT_EQ(path->ticks, 40);
  const Path* direct = machine.path(ActionId(0), ActionId(1));
  ASSERT_NE(direct, nullptr);
  EXPECT_THAT(direct->via, IsEmpty());
  EXPECT_EQ(direct->ticks, 0);
  // From the duck into the next duck: up, then down again.
  const Path* again = machine.path(ActionId(1), ActionId(1));
  ASSERT_NE(again, nullptr);
  EXPECT_THAT(again->via, ElementsAre(ActionId(3)));
}

TEST(StateMachine, AnActionLeadsToWhatItSaysAndToTheRestOverThat) {
  std::vector<Action> actions = {guard_idle(),
                                 action_of("kick", Kind::attack, test::kick_clip(kSkeleton)),
                                 action_of("jab", Kind::attack, test::jab_clip(kSkeleton)),
                                 action_of("slip", Kind::defense, test::idle_clip(kSkeleton))};
  actions[1].leads_to = {"defense", "j*", "idle"};
  const StateMachine machine(kSkeleton, actions, {});
  EXPECT_THAT(machine.edges(ActionId(0)), SizeIs(4));  // nothing said: whatever begins there
  EXPECT_THAT(machine.edges(ActionId(1)), SizeIs(3));
  EXPECT_EQ(machine.edge(ActionId(1), ActionId(1)), nullptr);
  EXPECT_NE(machine.edge(ActionId(1), ActionId(2)), nullptr);
  EXPECT_NE(machine.edge(ActionId(1), ActionId(3)), nullptr);
  const Path* again = machine.path(ActionId(1), ActionId(1));
  ASSERT_NE(again, nullptr);
  EXPECT_THAT(again->via, ElementsAre(ActionId(0)));
  actions[1].leads_to = {"jab"};  // from which a path may not lead on
  EXPECT_THAT(unconnected(kSkeleton, actions, {}), ElementsAre(ActionId(1)));
}

TEST(StateMachine, ResponsesAreNoTargetsAndOnlyGetUpsFollowFalls) {
  const std::vector<Action> actions = {
      guard_idle(), action_of("stagger", Kind::response, between(kGuard, kGuard)),
      lying("fall", Kind::response, true), lying("rise from the back", Kind::get_up, false)};
  const StateMachine machine(kSkeleton, actions, {});
  for (const int from : {0, 1, 3}) {
    for (const Edge& edge : machine.edges(ActionId(from))) EXPECT_EQ(edge.to, ActionId(0));
    EXPECT_THAT(machine.edges(ActionId(from)), SizeIs(1));
  }
  ASSERT_THAT(machine.edges(ActionId(2)), SizeIs(1));
  EXPECT_EQ(machine.edges(ActionId(2))[0].to, ActionId(3));
  const Path* up = machine.path(ActionId(2), ActionId(0));
  ASSERT_NE(up, nullptr);
  EXPECT_THAT(up->via, ElementsAre(ActionId(3)));
}

TEST(StateMachine, WhatOnlyAnAttackLeadsToIsDropped) {
  // The squat is entered by an attack alone, and a path may not lead over an attack.
  const std::vector<Action> actions = {guard_idle(),
                                       action_of("dive", Kind::attack, between(kGuard, kSquat)),
                                       action_of("rise", Kind::transition, between(kSquat, kGuard)),
                                       action_of("sweep", Kind::attack, between(kSquat, kGuard))};
  EXPECT_THAT(unconnected(kSkeleton, actions, {}),
              ElementsAre(ActionId(1), ActionId(2), ActionId(3)));
}

TEST(StateMachine, ADeadEndAndAnOrphanAreDropped) {
  const std::vector<Action> actions = {
      guard_idle(), action_of("sink", Kind::transition, between(kGuard, kSquat)),
      action_of("rise", Kind::transition, between(kCrouch, kGuard)),
      action_of("jab", Kind::attack, test::jab_clip(kSkeleton)),
      lying("fall", Kind::response, true)};
  EXPECT_THAT(unconnected(kSkeleton, actions, {}),
              ElementsAre(ActionId(1), ActionId(2), ActionId(4)));
}

TEST(StateMachine, WithoutTransitionsActionsThatFollowEachOtherAreKept) {
  const std::vector<Action> actions = {action_of("jab", Kind::attack, test::jab_clip(kSkeleton)),
                                       action_of("duck", Kind::defense, between(kGuard, kCrouch)),
                                       action_of("kick", Kind::attack, test::kick_clip(kSkeleton))};
  EXPECT_THAT(unconnected(kSkeleton, actions, {}), ElementsAre(ActionId(1)));
  EXPECT_THAT(unconnected(kSkeleton, {}, {}), IsEmpty());
}

// Random libraries: what is kept has a path to everything that can be launched.
TEST(StateMachine, InEveryLibraryEveryKeptActionReachesEveryLaunchableOne) {
  Random random(22);
  const std::array<float, 3> stances = {kGuard, kCrouch, kSquat};
  const std::array<Kind, 4> kinds = {Kind::attack, Kind::defense, Kind::transition, Kind::idle};
  std::size_t kept = 0, dropped = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<Action> actions;
    for (int i = 0; i < 8; ++i) {
      const float from = stances[static_cast<std::size_t>(random.below(3))];
      const float to = stances[static_cast<std::size_t>(random.below(3))];
      const Kind kind = kinds[static_cast<std::size_t>(random.below(4))];
      actions.push_back(action_of("action", kind, between(from, to, 10 + random.below(30))));
    }
    actions.push_back(lying("fall", Kind::response, true));
    actions.push_back(lying("rise", Kind::get_up, false));
    const MotionLibrary library("random", std::move(actions));
    kept += library.actions().size();
    dropped += library.dropped().size();
    for (std::size_t from = 0; from < library.actions().size(); ++from) {
      for (const ActionId to : library.launchable()) {
        const Path* path = library.machine().path(ActionId(from), to);
        ASSERT_NE(path, nullptr) << "library " << n;
        // The path can be played: every leg is an edge, the ticks are those of the actions on it.
        ActionId at(from);
        Tick ticks = 0;
        for (const ActionId next : path->via) {
          EXPECT_NE(library.machine().edge(at, next), nullptr);
          const Kind kind = library.action(next).kind;
          EXPECT_TRUE(kind == Kind::transition || kind == Kind::idle || kind == Kind::get_up);
          ticks += library.action(next).length();
          at = next;
        }
        EXPECT_NE(library.machine().edge(at, to), nullptr);
        EXPECT_EQ(path->ticks, ticks);
      }
    }
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(dropped, 100u);
}

}  // namespace
}  // namespace ringcraft
