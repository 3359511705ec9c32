#include "planner/motion_tables.h"

#include <gtest/gtest.h>

#include "default_library.h"
#include "physics/partial.h"

namespace ringcraft {
namespace {

class PartsOfResponses : public testing::Test {
 protected:
  static const MotionTables& tables() {
    static const MotionTables kTables(default_library(), make_body({}));
    return kTables;
  }
  static std::vector<ActionId> absorbing() {
    std::vector<ActionId> all;
    for (const ActionId id : default_library().responses()) {
      if (default_library().action(id).response->kind == ResponseKind::absorb) all.push_back(id);
    }
    return all;
  }
};

TEST_F(PartsOfResponses, GoAsFarOfTheClipsWayAsTheirShare) {
  ASSERT_FALSE(absorbing().empty());
  const Skeleton& skeleton = tables().body().skeleton;
  for (const ActionId id : absorbing()) {
    const ActionTable& whole = tables().at(id);
    Pose rest = whole.pose.front();
    put_in_guard(default_library(), *whole.action, rest);
    EXPECT_FLOAT_EQ(whole.way, way_of_clip(skeleton, rest, whole.pose)) << whole.action->name;
    ASSERT_GT(whole.way, 0) << whole.action->name;
    for (const float share : {0.0f, 1.0f / 3, 2.0f / 3}) {
      const ActionTable& part = tables().at(id, share);
      // Turns are shared out, so the way is not quite straight.
      EXPECT_NEAR(way_of_clip(skeleton, rest, part.pose), share * whole.way, 0.1f * whole.way)
          << whole.action->name << " " << share;
      EXPECT_NEAR(part.end.yaw, share * whole.end.yaw, 1e-5f) << whole.action->name;
    }
  }
}

TEST_F(PartsOfResponses, AreTheNearestToTheShareAndLeadWhereTheWholeLeads) {
  for (const ActionId id : absorbing()) {
    const ActionTable& whole = tables().at(id);
    EXPECT_EQ(&tables().at(id, 1), &whole);
    EXPECT_EQ(&tables().at(id, 0.9f), &whole);
    EXPECT_EQ(&tables().at(id, 0.2f), &tables().at(id, 0.4f));
    EXPECT_NE(&tables().at(id, 0.1f), &tables().at(id, 0.2f));
    for (const float share : {0.0f, 0.3f, 0.6f}) {
      const ActionTable& part = tables().at(id, share);
      EXPECT_EQ(part.action, whole.action);
      EXPECT_EQ(part.length, whole.length);
      EXPECT_EQ(part.next.size(), whole.next.size());
      EXPECT_EQ(&tables().at(part.id), &part);  // by an id of its own
      EXPECT_GE(part.id.at(), default_library().actions().size());
    }
  }
}

TEST_F(PartsOfResponses, AreOfAbsorbingResponsesOnly) {
  for (std::size_t i = 0; i < default_library().actions().size(); ++i) {
    const Action& action = default_library().actions()[i];
    if (action.response && action.response->kind == ResponseKind::absorb) continue;
    EXPECT_EQ(&tables().at(ActionId(i), 0), &tables().at(ActionId(i))) << action.name;
  }
}

TEST_F(PartsOfResponses, WhoIsMovedByAFifthIsFreeBeforeTheClipIsOver) {
  for (const ActionId response : absorbing()) {
    const ActionTable& table = tables().at(response);
    ASSERT_EQ(table.way_left.size(), static_cast<std::size_t>(table.length) + 1);
    EXPECT_EQ(table.way_left.back(), 0) << table.action->name;
    EXPECT_LT(free_again(table.way_left, .2f), table.length * 7 / 10) << table.action->name;
  }
}

TEST_F(PartsOfResponses, WhoStepsIsFreeOnceItStandsWhereTheStepsLead) {
  int seen = 0;
  for (const ActionId id : default_library().responses()) {
    const ActionTable& table = tables().at(id);
    if (table.action->response->kind != ResponseKind::recovery_steps) continue;
    ++seen;
    const Tick free = free_again(table.way_left, 1);
    EXPECT_LT(free, table.length) << table.action->name;
    const Skeleton& skeleton = tables().body().skeleton;
    const WorldPose last = world_pose(skeleton, table.pose.back());
    for (Tick t = free; t <= table.length; ++t) {
      const WorldPose is = world_pose(skeleton, table.pose[static_cast<std::size_t>(t)]);
      for (const Joint joint : {Joint::hips, Joint::head, Joint::left_foot, Joint::right_foot}) {
        EXPECT_LT(glm::distance(is.position[index(joint)], last.position[index(joint)]), 0.0301f)
            << table.action->name << " " << t;
      }
    }
  }
  EXPECT_GT(seen, 10);
}

// A launch says how much of its clip is shown, and the body in flight is that.
TEST_F(PartsOfResponses, ALaunchFliesWithItsShare) {
  Launch launch;
  launch.action = absorbing().front();
  launch.end = tables().at(launch.action).length;
  EXPECT_EQ(InFlight(tables(), launch).table, &tables().at(launch.action));
  launch.share = 0;
  EXPECT_EQ(InFlight(tables(), launch).table, &tables().at(launch.action, 0));
}

}  // namespace
}  // namespace ringcraft
