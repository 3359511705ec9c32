#include "motion/motion_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/library.h"
#include "motion/motion_graph_connect.h"
#include "motion/synthetic.h"

namespace ringcraft {
namespace {

using test::action_of;
using ::testing::SizeIs;

// The hips go from one height under the guard's to another, and then to a third.
Clip sinking(float from, float middle, float to, Tick first, Tick second) {
  const Tick length = first + second;
  const float knee = static_cast<float>(first) / static_cast<float>(length);
  return test::clip_of(
      kSkeleton, length,
      [=](float t) {
        test::Stance stance;
        const float lower = t < knee ? from + (middle - from) * test::ramp(t, 0, knee)
                                     : middle + (to - middle) * test::ramp(t, knee, 1);
        stance.hips.y -= lower;
        stance.left_hand.y -= lower;
        stance.right_hand.y -= lower;
        return stance;
      },
      test::both, test::in_place);
}

// A bow that only a slow rise leads out of: it begins lower and waits long at the bow's height.
std::vector<Action> bow_and_rise() {
  std::vector<Action> actions = {
      action_of("idle", Kind::idle, test::idle_clip(kSkeleton)),
      action_of("jab", Kind::attack, test::jab_clip(kSkeleton)),
      action_of("bow", Kind::defense, sinking(0, 0.30f, 0.30f, 30, 10)),
      action_of("rise", Kind::transition, sinking(0.36f, 0.30f, 0, 110, 40)),
      action_of("sink", Kind::transition, sinking(0, 0.36f, 0.36f, 60, 20))};
  actions[2].defense = Defense{DefenseKind::duck, 4, 38};
  actions[1].strikes = {{StrikeKind::straight, Joint::left_hand, TargetZone::head, 16, 30}};
  return actions;
}

MotionGraph graph_of(const std::vector<Action>& actions, const GraphSettings& settings = {}) {
  return build_motion_graph(kSkeleton, graph_sources(actions, settings), settings);
}

TEST(MotionGraph, TheDistanceMapIsThatOfTheAlignedClouds) {
  const Clip jab = test::jab_clip(kSkeleton), step = test::step_clip(kSkeleton, {0.2f, 0, 0.3f});
  constexpr Tick kStride = 7;
  const DistanceMap map = distance_map(kSkeleton, jab, step, kStride);
  ASSERT_EQ(map.rows, 9u);
  ASSERT_EQ(map.columns, 13u);
  for (std::size_t i = 0; i < map.rows; ++i) {
    for (std::size_t j = 0; j < map.columns; ++j) {
      const Alignment exact = align(cloud_at(kSkeleton, jab, kStride * static_cast<Tick>(i)),
                                    cloud_at(kSkeleton, step, kStride * static_cast<Tick>(j)));
      EXPECT_NEAR(map.distance[i * map.columns + j], exact.distance, 2e-3f) << i << " " << j;
    }
  }
}

TEST(MotionGraph, TransitionsLieUnderTheThresholdAndNeverInsideABlow) {
  const std::vector<Action> actions = bow_and_rise();
  const GraphSettings settings;
  const MotionGraph graph = graph_of(actions, settings);
  ASSERT_THAT(graph.clips, SizeIs(5));
  ASSERT_FALSE(graph.transitions.empty());
  bool out_of_jab = false, into_jab = false;
  for (const Transition& t : graph.transitions) {
    const Action &from = actions[static_cast<std::size_t>(t.from_clip)],
                 &to = actions[static_cast<std::size_t>(t.to_clip)];
    EXPECT_LE(t.alignment.distance, settings.striking);
    const Alignment exact =
        align(cloud_at(kSkeleton, from.clip, t.from), cloud_at(kSkeleton, to.clip, t.to));
    EXPECT_EQ(t.alignment.distance, exact.distance);
    if (from.name == "jab") {
      out_of_jab = true;
      EXPECT_GE(t.from, 30);
    }
    if (to.name == "jab") {
      into_jab = true;
      EXPECT_TRUE(t.to < 16 || t.to >= 30) << t.to;
    }
    if (t.from_clip == t.to_clip) {
      EXPECT_GE(std::abs(t.from - t.to), settings.apart);
    }
  }
  EXPECT_TRUE(out_of_jab && into_jab);
}

TEST(MotionGraph, AMinimumIsRefinedToTheTick) {
  // The bow's last frame is found again inside the rise, at the end of its wait.
  const std::vector<Action> actions = bow_and_rise();
  const MotionGraph graph = graph_of(actions);
  const Tick end = actions[2].length();
  float least = 1;
  Tick at = -1;
  for (Tick t = 0; t <= actions[3].length(); ++t) {
    const float d =
        align(cloud_at(kSkeleton, actions[2].clip, end), cloud_at(kSkeleton, actions[3].clip, t))
            .distance;
    if (d < least) least = d, at = t;
  }
  const auto found =
      std::find_if(graph.transitions.begin(), graph.transitions.end(), [&](const Transition& t) {
        return t.from_clip == 2 && t.from == end && t.to_clip == 3 && t.to == at;
      });
  ASSERT_NE(found, graph.transitions.end()) << at;
  EXPECT_EQ(found->alignment.distance, least);
}

TEST(MotionGraph, IsTheSameForAnyNumberOfThreads) {
  GraphSettings one, four;
  four.threads = 4;
  const MotionGraph a = graph_of(bow_and_rise(), one), b = graph_of(bow_and_rise(), four);
  EXPECT_EQ(a.pairs, b.pairs);
  EXPECT_EQ(a.minima, b.minima);
  ASSERT_EQ(a.transitions.size(), b.transitions.size());
  for (std::size_t i = 0; i < a.transitions.size(); ++i) {
    const Transition &s = a.transitions[i], &t = b.transitions[i];
    EXPECT_EQ(std::tie(s.from_clip, s.from, s.to_clip, s.to, s.alignment.distance),
              std::tie(t.from_clip, t.from, t.to_clip, t.to, t.alignment.distance));
  }
}

TEST(MotionGraph, WhatNothingLeadsOutOfIsDropped) {
  std::vector<Action> actions = bow_and_rise();
  actions.resize(3);
  const MotionGraph graph = graph_of(actions);
  EXPECT_GT(graph.dropped, 0u);
  for (const Transition& t : graph.transitions) {
    const bool ends_bow = t.from_clip == 2 && t.from == actions[2].length();
    EXPECT_FALSE(ends_bow);
  }
  EXPECT_TRUE(graph_of({}).transitions.empty());
}

TEST(MotionGraph, AWayThatIsShorterThanThePathBecomesAnActionThatConnects) {
  std::vector<Action> actions = bow_and_rise();
  const GraphSettings settings;
  const auto sources = graph_sources(actions, settings);
  const MotionGraph graph = build_motion_graph(kSkeleton, sources, settings);
  const std::vector<Action> connecting =
      connecting_actions(kSkeleton, actions, sources, graph, {}, {});
  ASSERT_FALSE(connecting.empty());
  for (const Action& action : connecting) {
    EXPECT_TRUE(action.connects);
    EXPECT_EQ(action.kind, Kind::transition);
    EXPECT_TRUE(faults(action.clip).empty()) << action.name;
  }
  ConnectSettings with_three;
  with_three.threads = 3;
  const std::vector<Action> same =
      connecting_actions(kSkeleton, actions, sources, graph, {}, with_three);
  ASSERT_EQ(same.size(), connecting.size());
  for (std::size_t i = 0; i < same.size(); ++i) {
    EXPECT_EQ(same[i].source, connecting[i].source);
    EXPECT_EQ(same[i].length(), connecting[i].length());
  }
  const MotionLibrary before("before", actions);
  actions.insert(actions.end(), connecting.begin(), connecting.end());
  const MotionLibrary after("after", actions);
  EXPECT_EQ(after.launchable(), before.launchable());  // it is never chosen for itself
  EXPECT_EQ(after.count(Kind::transition), before.count(Kind::transition));
  const Path* slow = before.machine().path(before.find("bow"), before.find("jab"));
  const Path* quick = after.machine().path(after.find("bow"), after.find("jab"));
  ASSERT_TRUE(slow != nullptr && quick != nullptr);
  EXPECT_EQ(slow->ticks, 150);
  EXPECT_LT(quick->ticks, 70);
}

TEST(MotionGraph, StretchesOfAWayAreStitchedWithoutAJump) {
  const std::vector<Action> actions = bow_and_rise();
  const auto sources = graph_sources(actions, {});
  // From the idle into the jab's recovery, which stands a little elsewhere.
  const Clip clip = stitched(kSkeleton, sources, {{0, 5, 40, {}}, {1, 34, 60, {0.03f, 0.02f, 0}}});
  EXPECT_EQ(clip.length(), 35 + 26);
  EXPECT_TRUE(faults(clip).empty());
  for (std::size_t i = 1; i < clip.frames.size(); ++i) {
    const float moved = largest_joint_distance(world_pose(kSkeleton, clip.frames[i - 1]),
                                               world_pose(kSkeleton, clip.frames[i]));
    EXPECT_LT(moved, 0.035f) << i;  // 4 m/s; a jump without the stitch is over 10 cm
    EXPECT_LT(glm::distance(clip.root[i].position(), clip.root[i - 1].position()), 0.01f) << i;
  }
}

}  // namespace
}  // namespace ringcraft
