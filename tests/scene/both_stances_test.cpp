#include "motion/both_stances.h"

#include <gtest/gtest.h>

#include "default_library.h"
#include "motion/aim.h"
#include "scene/fight.h"

namespace ringcraft {
namespace {

const MotionLibrary& both() {
  static const MotionLibrary kBoth = both_stances(default_library(), true);
  return kBoth;
}
std::size_t own() {
  return default_library().actions().size();
}
Vec3 across(Vec3 p) {
  return {-p.x, p.y, p.z};
}

TEST(BothStances, EveryStrikeLandsWhereItsMirrorImageDoes) {
  ASSERT_EQ(both().actions().size(), 2 * (own() + default_library().switches().size()));
  const Skeleton& skeleton = both().skeleton();
  std::size_t strikes = 0;
  for (std::size_t i = 0; i < own(); ++i) {
    const Action& action = both().action(ActionId(i));
    const Action& image = both().action(ActionId(i + own()));
    EXPECT_EQ(action.stance, Stance::orthodox);
    EXPECT_EQ(image.stance, Stance::southpaw);
    ASSERT_EQ(image.length(), action.length());
    ASSERT_EQ(image.strikes.size(), action.strikes.size());
    for (std::size_t k = 0; k < action.strikes.size(); ++k, ++strikes) {
      const Tick at = action.strikes[k].active_begin;
      const auto point = [&](const Action& of) {
        return striking_point(of.strikes[k], skeleton, world_pose(skeleton, of.clip.at(at)));
      };
      EXPECT_LT(glm::distance(point(image), across(point(action))), 1e-4f) << action.name;
      EXPECT_EQ(image.strikes[k].joint, mirrored(action.strikes[k].joint));
    }
    for (Tick t = 0; t <= action.length(); t += 10) {
      EXPECT_EQ(image.clip.contacts_at(t).left, action.clip.contacts_at(t).right);
    }
  }
  EXPECT_GT(strikes, 30u);
}

TEST(BothStances, LeadAndRearStayAndLeftAndRightChangePlaces) {
  const auto image = [&](const char* name) {
    return both().action(ActionId(both().find(name).at() + own()));
  };
  EXPECT_EQ(image("lead_uppercut").name, "lead_uppercut");
  EXPECT_EQ(image("lead_uppercut").strikes[0].joint, Joint::right_hand);
  EXPECT_EQ(image("step_left").name, "step_right");
  EXPECT_GT(both().action(both().find("step_left")).clip.root_at(1000).x, 0.1f);
  EXPECT_LT(image("step_left").clip.root_at(1000).x, -0.1f);
}

// The machine's edges are those that would be found between the mirrored clips.
TEST(BothStances, MirroredEdgesAlignTheMirroredClips) {
  for (std::size_t i = 0; i < own(); i += 7) {
    const auto& edges = both().machine().edges(ActionId(i + own()));
    std::size_t stays = 0;
    for (const Edge& edge : edges) {
      if (edge.to.at() >= 2 * own()) continue;  // a switch
      ASSERT_EQ(both().action(edge.to).stance, Stance::southpaw);
      if (++stays % 5 != 1) continue;
      const Alignment found = aligned(both().skeleton(), both().action(ActionId(i + own())).clip,
                                      both().action(edge.to).clip);
      EXPECT_NEAR(found.distance, edge.alignment.distance, 1e-4f);
      EXPECT_NEAR(found.placement.x, edge.alignment.placement.x, 1e-3f);
      EXPECT_NEAR(found.placement.z, edge.alignment.placement.z, 1e-3f);
      EXPECT_NEAR(wrapped_angle(found.placement.yaw - edge.alignment.placement.yaw), 0, 1e-3f);
    }
    EXPECT_EQ(stays, default_library().machine().edges(ActionId(i)).size());
  }
}

TEST(BothStances, OnlySwitchesLeadFromOneStanceToTheOther) {
  const MotionLibrary apart = both_stances(default_library());
  ASSERT_EQ(apart.actions().size(), 2 * own());
  const ActionId jab = apart.find("jab");
  for (std::size_t i = 0; i < own(); ++i) {
    EXPECT_EQ(apart.machine().path(jab, ActionId(i + own())), nullptr);
    EXPECT_EQ(apart.machine().path(ActionId(jab.at() + own()), ActionId(i)), nullptr);
  }
  const ActionId hop = both().find("stance_switch");
  ASSERT_TRUE(hop.valid());
  EXPECT_NE(both().machine().edge(jab, hop), nullptr);
  EXPECT_NE(both().machine().edge(hop, ActionId(jab.at() + own())), nullptr);
  EXPECT_EQ(both().machine().edge(hop, jab), nullptr);
  const ActionId back(hop.at() + 1);
  EXPECT_NE(both().machine().edge(hop, back), nullptr);
  EXPECT_NE(both().machine().edge(back, jab), nullptr);
}

// How far the left foot is ahead of the right one, in the own facing, m.
float left_foot_ahead(const FightRecord& record, const MotionLibrary& library, std::size_t fighter,
                      Tick tick) {
  const FighterTrack& track = record.timeline.tracks[fighter];
  const Skeleton& skeleton = record.bodies[fighter].skeleton;
  const WorldPose world = world_pose(skeleton, track.frames[static_cast<std::size_t>(tick)]);
  const Placement root = root_at(library, track.segments.front().launch, tick, 1);
  return glm::dot(
      world.position[index(Joint::left_foot)] - world.position[index(Joint::right_foot)],
      yaw_rotation(root.yaw) * kForward);
}

TEST(BothStances, ASouthpawFightsAsOneFromTheFirstTickToTheLast) {
  const auto scene = read_scene("duel", {"duration_s=12", "fighter.1.stance=southpaw"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  const MotionLibrary library = library_for(*scene, default_library());
  const FightRecord record = simulate_fight(library, *scene);
  EXPECT_GT(left_foot_ahead(record, library, 0, 0), 0.2f);
  EXPECT_LT(left_foot_ahead(record, library, 1, 0), -0.2f);
  std::size_t answers = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Segment& segment : record.timeline.tracks[i].segments) {
      EXPECT_EQ(library.action(segment.launch.action).stance,
                i == 1 ? Stance::southpaw : Stance::orthodox);
      answers += segment.kind == Kind::response ? 1 : 0;
    }
    EXPECT_GT(record.timeline.tracks[i].segments.size(), 6u);
  }
  EXPECT_GT(answers, 0u);
}

TEST(BothStances, ASceneOfOrthodoxFightersIsGivenTheLibraryAsItIs) {
  const auto scene = read_scene("duel");
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->needs_both_stances());
  EXPECT_EQ(library_for(*scene, default_library()).hash(), default_library().hash());
  const auto wrong = read_scene("duel", {"fighter.0.stance=lefthanded"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace ringcraft
