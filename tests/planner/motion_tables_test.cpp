#include "planner/motion_tables.h"

#include <gtest/gtest.h>

#include "default_library.h"
#include "launch_of.h"
#include "physics/partial.h"

namespace ringcraft {
namespace {

class PartsOfResponses : public testing::Test {
 protected:
  static const MotionTables& tables() {
    static const MotionTables kTables(default_library(), make_body({}));
    return kTables;
  }
  static std::vector<ActionId> of_kind(ResponseKind kind) {
    std::vector<ActionId> all;
    for (const ActionId id : default_library().responses()) {
      if (default_library().action(id).response->kind == kind) all.push_back(id);
    }
    return all;
  }
  static std::vector<ActionId> absorbing() { return of_kind(ResponseKind::absorb); }
  static std::vector<ActionId> stepping() { return of_kind(ResponseKind::recovery_steps); }
};

TEST_F(PartsOfResponses, GoAsFarOfTheClipsWayAsTheirShare) {
  ASSERT_FALSE(absorbing().empty());
  const Skeleton& skeleton = tables().body().skeleton;
  for (const ActionId id : absorbing()) {
    const ActionTable& whole = tables().at(id);
    Pose rest = whole.pose.front();
    put_in_guard(default_library(), *whole.action, rest);
    EXPECT_FLOAT_EQ(whole.way, way_of_clip(skeleton, rest, whole.pose, TargetZone::body))
        << whole.action->name;
    EXPECT_FLOAT_EQ(whole.leg_way, way_of_clip(skeleton, rest, whole.pose, TargetZone::leg));
    ASSERT_GT(whole.way, 0) << whole.action->name;
    ASSERT_GT(whole.leg_way, 0) << whole.action->name;
    for (const float share : {0.0f, .25f, .5f, .75f}) {
      const ActionTable& part = tables().at(id, share);
      // Turns are shared out, so the way is not quite straight.
      EXPECT_NEAR(way_of_clip(skeleton, rest, part.pose, TargetZone::body), share * whole.way,
                  0.1f * whole.way)
          << whole.action->name << " " << share;
      EXPECT_NEAR(part.end.yaw, share * whole.end.yaw, 1e-5f) << whole.action->name;
    }
  }
}

TEST_F(PartsOfResponses, StepAsFarAsTheirShareOfTheClip) {
  ASSERT_FALSE(stepping().empty());
  for (const ActionId id : stepping()) {
    const ActionTable& whole = tables().at(id);
    const Strides strides =
        strides_of(default_library().skeleton(), whole.action->clip, tables().body().scale);
    EXPECT_EQ(whole.strides.longest, strides.longest) << whole.action->name;
    EXPECT_EQ(whole.strides.shortest, strides.shortest) << whole.action->name;
    const Vec3 went = whole.pose.back().hips - whole.pose.front().hips;
    for (const float share : {.25f, .5f, .75f}) {
      const ActionTable& part = tables().at(id, share);
      EXPECT_LT(glm::distance(part.pose.back().hips - part.pose.front().hips, share * went), .005f)
          << whole.action->name << " " << share;
      EXPECT_NEAR(part.end.x, share * whole.end.x, 1e-5f);
      EXPECT_NEAR(part.end.z, share * whole.end.z, 1e-5f);
    }
  }
}

// What ends in another stance, as captured steps do, has no part that ends in one.
TEST_F(PartsOfResponses, AreShownOfStepsThatEndInTheirStanceOnly) {
  const auto strides = [&](const char* name) {
    return tables().at(default_library().find(name)).strides;
  };
  EXPECT_LT(strides("recover_back_1").shortest, .5f * strides("recover_back_1").longest);
  EXPECT_EQ(strides("recover_left_1_boxer").shortest, strides("recover_left_1_boxer").longest);
}

TEST_F(PartsOfResponses, AreTheNearestToTheShareAndLeadWhereTheWholeLeads) {
  std::vector<ActionId> all = absorbing();
  for (const ActionId id : stepping()) all.push_back(id);
  for (const ActionId id : all) {
    const ActionTable& whole = tables().at(id);
    EXPECT_EQ(&tables().at(id, 1), &whole);
    EXPECT_EQ(&tables().at(id, 0.9f), &whole);
    EXPECT_EQ(&tables().at(id, 0.2f), &tables().at(id, 0.3f));
    EXPECT_NE(&tables().at(id, 0.1f), &tables().at(id, 0.2f));
    for (const float share : {0.0f, 0.3f, 0.6f}) {
      const ActionTable& part = tables().at(id, share);
      EXPECT_EQ(part.action, whole.action);
      EXPECT_EQ(part.length, whole.length);
      EXPECT_EQ(&tables().after(part), &tables().after(whole));
      EXPECT_EQ(&tables().at(part.id), &part);  // by an id of its own
      EXPECT_GE(part.id.at(), default_library().actions().size());
    }
  }
}

TEST_F(PartsOfResponses, AreOfResponsesThatStayUpOnly) {
  for (std::size_t i = 0; i < default_library().actions().size(); ++i) {
    const Action& action = default_library().actions()[i];
    if (action.response && action.response->kind != ResponseKind::knockdown) continue;
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

// A low kick goes to the leg of who stands, and into the lifted shin of who checks.
TEST(Contacts, ACheckBlocksALowKick) {
  const MotionTables tables(default_library(), make_body({}));
  const auto met = [&](const char* answer, Tick before) {
    int blocked = 0, hit = 0;
    for (float distance = 0.9f; distance < 1.3f; distance += 0.05f) {
      const InFlight kick(tables, launch_of(default_library(), "roundhouse_lead_low", 0, {}));
      const StrikeTable& strike = kick.table->strikes[0];
      const InFlight target(tables, launch_of(default_library(), answer,
                                              strike.landing_tick - before, {0, distance, kPi}));
      for (Tick t = strike.strike.active_begin; t < strike.strike.active_end; ++t) {
        const auto contact = contact_at(kick, strike, target, t);
        if (!contact || zone_of(contact->struck) != TargetZone::leg) continue;
        (contact->blocked ? blocked : hit) += 1;
        break;
      }
    }
    return std::pair{blocked, hit};
  };
  const auto [stands_blocked, stands_hit] = met("idle_guard_2", 20);
  EXPECT_EQ(stands_blocked, 0);
  EXPECT_GT(stands_hit, 0);
  const auto [checks_blocked, checks_hit] = met("check_kick_lead", 30);
  EXPECT_GT(checks_blocked, 0);
  const auto [late_blocked, late_hit] = met("check_kick_lead", 10);
  EXPECT_EQ(late_blocked, 0);
}

class MotionsInFlight : public testing::Test {
 protected:
  static const MotionTables& tables() {
    static const MotionTables kTables(default_library(), make_body({}));
    return kTables;
  }
  static Launch jab() {
    Launch launch = launch_of(default_library(), "jab", 50, {0.4f, -1.0f, 0.7f});
    launch.aim = radians(10);
    return launch;
  }
  // The clip as it lies in the world, `slow` times as long, from the first tick on.
  static MotionInFlight as_the_clip(float slow = 1) {
    MotionInFlight motion;
    motion.launch = jab();
    motion.from = motion.launch.start;
    const InFlight flight(tables(), motion.launch);
    const auto length = static_cast<Tick>(slow * static_cast<float>(flight.table->length));
    for (Tick t = 0; t <= length; ++t) {
      const auto age = static_cast<Tick>(static_cast<float>(t) / slow);
      motion.clip_ages.push_back(age);
      motion.poses.push_back(
          placed(flight.table->pose_at(age), flight.frame_at(motion.launch.start + t).placement()));
    }
    return motion;
  }
  static float apart(const BodyCapsules& a, const BodyCapsules& b) {
    float most = 0;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      most = std::max({most, glm::distance(a[i].a, b[i].a), glm::distance(a[i].b, b[i].b)});
    }
    return most;
  }
};

TEST_F(MotionsInFlight, ThatAreAsTheirClipsHaveTheirTables) {
  const MotionInFlight motion = as_the_clip();
  const ActionTable shown = tables().in_flight(motion), &clip = tables().at(motion.launch.action);
  EXPECT_EQ(shown.length, clip.length);
  EXPECT_EQ(&tables().after(shown), &tables().after(clip));
  ASSERT_EQ(shown.strikes.size(), clip.strikes.size());
  EXPECT_EQ(shown.strikes[0].strike.active_begin, clip.strikes[0].strike.active_begin);
  EXPECT_EQ(shown.strikes[0].strike.active_end, clip.strikes[0].strike.active_end);
  EXPECT_NEAR(shown.strikes[0].reach, clip.strikes[0].reach, 1e-4f);
  for (Tick t = 0; t <= clip.length; ++t) {
    EXPECT_LT(apart(shown.capsules_at(t), clip.capsules_at(t)), 1e-4f) << t;
    EXPECT_EQ(shown.clip_age(t), t);
  }
}

// Who turns to its aim is struck as it turns: what came before and what follows are seen from where
// its action space is at the blow.
TEST_F(MotionsInFlight, AreSeenAsTheyTurn) {
  MotionInFlight motion = as_the_clip();
  motion.launch.aim = radians(40);
  const InFlight flight(tables(), motion.launch);
  const Tick start = motion.launch.start, length = flight.table->length;
  const auto frame = [&](Tick age) { return flight.frame_at(start + age).placement(); };
  for (Tick t = 0; t <= length; ++t) {
    motion.poses[static_cast<std::size_t>(t)] = placed(flight.table->pose_at(t), frame(t));
  }
  const ActionTable shown = tables().in_flight(motion);
  float turned = 0;
  for (Tick now = 1; now < length; ++now) {
    for (const Tick age : {now - 1, now, std::min(length, now + 12)}) {
      const Pose is = placed(shown.pose_seen(age, now), frame(now)),
                 still = placed(shown.pose_at(age), frame(now)),
                 was_shown = motion.poses[static_cast<std::size_t>(age)];
      const auto shape = [&](const Pose& pose) {
        return capsules(tables().body(), world_pose(tables().body().skeleton, pose));
      };
      const auto off = [&](const Pose& pose) { return apart(shape(pose), shape(was_shown)); };
      EXPECT_LT(off(is), 1e-4f) << now << " " << age;
      turned = std::max(turned, off(still));
    }
  }
  EXPECT_GT(turned, 0.1f);
}

// A decision reckons with the root that the fight has: at the pace of the launch, aim and all.
TEST_F(MotionsInFlight, HaveTheRootOfTheFightAtAnyPace) {
  for (const float factor : {0.8f, 1.2f}) {
    MotionInFlight motion;
    motion.launch = launch_of(default_library(), "step_forward", 50, {0.4f, -1.0f, 0.7f});
    motion.launch.aim = radians(10);
    const Action& action = default_library().action(motion.launch.action);
    motion.launch.pace = Pace(action, factor);
    motion.launch.end = motion.launch.when(action.length());
    motion.from = motion.launch.start;
    for (Tick t = motion.launch.start; t <= motion.launch.end; ++t) {
      motion.poses.push_back(pose_at(default_library(), motion.launch, t, tables().body().scale));
      motion.clip_ages.push_back(motion.launch.clip_age(t));
    }
    const ActionTable shown = tables().in_flight(motion);
    InFlight flight(tables(), motion.launch);
    flight.table = &shown;
    for (Tick t = motion.launch.start; t <= motion.launch.end; ++t) {
      const Placement of_fight =
          root_at(default_library(), motion.launch, t, tables().body().scale);
      EXPECT_LT(glm::distance(flight.root_at(t).position(), of_fight.position()), 1e-4f) << t;
      EXPECT_NEAR(wrapped_angle(flight.root_at(t).yaw - of_fight.yaw), 0, 1e-4f) << t;
    }
  }
}

// Whatever a tired fighter may launch is where the fight will show it, when it will.
TEST_F(MotionsInFlight, OfTiredFightersArePlannedAsTheyWillBeShown) {
  constexpr float kPace = 0.88f;
  const MotionTables slow(tables(), kPace);
  const MotionLibrary& library = default_library();
  int defenses = 0;
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    const ActionId id(i);
    const Action& action = library.action(id);
    const ActionTable& table = slow.at(id);
    ASSERT_EQ(&slow.after(table), &slow.after(tables().at(id)));
    if (action.kind == Kind::response || action.kind == Kind::get_up) {
      EXPECT_EQ(&table, &tables().at(id)) << action.name;
      continue;
    }
    Launch launch;
    launch.action = id;
    launch.start = 50;
    launch.placement = {0.4f, -1.0f, 0.7f};
    launch.aim = radians(10);
    launch.pace = Pace(action, kPace);
    launch.end = launch.when(action.length());
    const InFlight flight(slow, launch);
    EXPECT_EQ(table.pace, launch.pace);
    EXPECT_EQ(table.length, launch.end - launch.start) << action.name;
    for (Tick t = launch.start; t <= launch.end; ++t) {
      const Placement root = root_at(library, launch, t, slow.body().scale);
      ASSERT_LT(glm::distance(flight.root_at(t).position(), root.position()), 1e-3f) << action.name;
      const Pose shown = pose_at(library, launch, t, slow.body().scale);
      const Pose planned = placed(table.pose_at(flight.age(t)), flight.frame_at(t).placement());
      const BodyModel& body = slow.body();
      ASSERT_LT(apart(capsules(body, world_pose(body.skeleton, planned)),
                      capsules(body, world_pose(body.skeleton, shown))),
                3e-3f)
          << action.name << " at " << t;
      for (std::size_t k = 0; k < action.strikes.size(); ++k) {
        const Strike& strike = table.strikes[k].strike;
        EXPECT_EQ(strike.active(flight.age(t)), action.strikes[k].active(launch.clip_age(t)))
            << action.name << " at " << t;
      }
    }
    if (!action.defense) continue;
    ++defenses;
    EXPECT_NEAR(launch.start + table.defense->begin, launch.when(action.defense->begin), 1);
    EXPECT_NEAR(launch.start + table.defense->end, launch.when(action.defense->end), 1);
  }
  EXPECT_GT(defenses, 5);
}

TEST_F(MotionsInFlight, OfTiredFightersFollowTheSameActionsLater) {
  const MotionTables slow(tables(), 0.85f);
  int paths = 0;
  for (std::size_t i = 0; i < default_library().actions().size(); ++i) {
    const Followers &own = slow.after(slow.at(ActionId(i))),
                    &clips = tables().after(tables().at(ActionId(i)));
    ASSERT_EQ(own.next.size(), clips.next.size());
    for (std::size_t k = 0; k < own.next.size(); ++k) {
      const NextAction &late = own.next[k], &next = clips.next[k];
      ASSERT_EQ(late.to, next.to);
      EXPECT_EQ(late.path, next.path);
      EXPECT_EQ(late.length, slow.at(next.to).length);
      EXPECT_GT(late.length, next.length);
      Tick lead = 0;
      for (const ActionId over : next.path) lead += slow.at(over).length;
      EXPECT_EQ(late.lead, lead);
      EXPECT_EQ(late.table, &slow.at(next.to));
      EXPECT_NEAR(late.end.x, next.end.x, 1e-3f);
      EXPECT_NEAR(late.alignment.z, next.alignment.z, 1e-3f);
      ASSERT_EQ(late.strikes.size(), next.strikes.size());
      for (std::size_t s = 0; s < late.strikes.size(); ++s) {
        EXPECT_GT(late.strikes[s].tick, next.strikes[s].tick);
        EXPECT_NEAR(late.strikes[s].ahead, next.strikes[s].ahead, 0.02f);
      }
      paths += next.path.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(paths, 0);
  EXPECT_GE(slow.lull(), tables().lull());
}

TEST_F(MotionsInFlight, AreWhereTheyAreShownAndBeforeThatWhereTheClipIs) {
  MotionInFlight motion = as_the_clip();
  const Tick from = 20;
  motion.from += from;
  motion.poses.erase(motion.poses.begin(), motion.poses.begin() + from);
  for (Pose& pose : motion.poses) pose.hips.y += 0.1f;
  const ActionTable shown = tables().in_flight(motion), &clip = tables().at(motion.launch.action);
  for (Tick t = 0; t <= clip.length; ++t) {
    EXPECT_NEAR(apart(shown.capsules_at(t), clip.capsules_at(t)), t < from ? 0 : 0.1f, 1e-4f) << t;
    EXPECT_NEAR(shown.bound_at(t).center.y, clip.bound_at(t).center.y + (t < from ? 0 : 0.1f),
                1e-4f);
  }
  // The way of the tick in which it begins is in what the contact test asks for.
  EXPECT_GT(shown.travel_at(from)[index(Part::head)], 0.09f);
}

TEST_F(MotionsInFlight, StrikeWhenTheirPaceHasThem) {
  const ActionTable slow = tables().in_flight(as_the_clip(1.5f));
  const StrikeTable &own = slow.strikes[0], &clip = tables().at(jab().action).strikes[0];
  EXPECT_NEAR(own.strike.active_begin, 1.5 * clip.strike.active_begin, 1);
  EXPECT_NEAR(own.strike.active_end, 1.5 * clip.strike.active_end, 1);
  EXPECT_NEAR(own.reach, clip.reach, 0.01f);
  EXPECT_EQ(slow.clip_age(own.strike.active_begin), clip.strike.active_begin);
}

}  // namespace
}  // namespace ringcraft
