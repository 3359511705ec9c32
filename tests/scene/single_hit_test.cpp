#include "scene/single_hit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "physics/partial.h"
#include "physics/response.h"
#include "planner/motion_tables.h"
#include "scene/hit_fixture.h"

namespace ringcraft {
namespace {

using hits::query;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(SingleHit, NoImpulseIsAbsorbedWhateverTheActionDoes) {
  const auto& launchable = default_library().launchable();
  for (std::size_t i = 0; i < launchable.size(); i += 5) {
    const Action& action = default_library().action(launchable[i]);
    for (const double share : {0.1, 0.5, 0.9}) {
      const double at = share * seconds(action.length());
      const auto posed = posed_body(default_library(), query(action.name, at));
      ASSERT_TRUE(posed) << to_string(posed.error());
      for (const Part part : {Part::head, Part::left_thigh}) {
        const auto outcome = impulse_step(posed->body, with_impulse(*posed, part, {}, 1));
        EXPECT_EQ(outcome.response, ResponseKind::absorb)
            << action.name << " at " << at << " s, margin " << outcome.margin << " m";
      }
    }
  }
  // Whose turning carries it; who would not hold the pose that it is watched in.
  const auto answer = [](const char* action, double at, Part part, float tone) {
    const auto posed = posed_body(default_library(), query(action, at));
    return impulse_step(posed->body, with_impulse(*posed, part, {}, tone)).response;
  };
  EXPECT_EQ(answer("spinning_back_kick", .45, Part::left_thigh, 1), ResponseKind::absorb);
  EXPECT_EQ(answer("slip_left", .14645859, Part::chest, .533565f), ResponseKind::absorb);
}

// It neither stands up into an answer that begins on its feet nor lies as if nothing had met it: it
// goes where it is kicked, lies, and gets up from there.
TEST(SingleHit, WhoLiesIsMovedByABlowAndStaysDown) {
  for (const char* action : {"knockdown_back", "knockdown_front", "get_up_back"}) {
    const bool rises = std::string(action) == "get_up_back";
    HitQuery hit = query(action, rises ? .3 : 1.0);
    hit.part = Part::abdomen;
    hit.impulse = {60, 10, 0};
    const auto answer = simulate_hit(default_library(), hit);
    ASSERT_TRUE(answer) << to_string(answer.error());
    EXPECT_EQ(answer->outcome.response, ResponseKind::absorb) << action;
    EXPECT_NE(default_library().action(default_library().find(answer->response)).ends_lying,
              Lying::none)
        << answer->response;
    const auto& frames = answer->timeline.tracks.front().frames;
    const auto at = [&](float after) {
      return frames.at(static_cast<std::size_t>(answer->hit_tick + ticks(after))).hips;
    };
    EXPECT_GT(at(.4f).x, at(0).x + .05f) << action;
    for (const float t : {.1f, .3f, .5f, .8f}) EXPECT_LT(at(t).y, .35f) << action << " " << t;
    EXPECT_GT(frames.back().hips.y, .7f) << action;
  }
}

TEST(SingleHit, WhoSquatsTakesNoStep) {
  int fell = 0, squats = 0;
  for (double at = .5; at < 2.5; at += .1) {
    const auto posed = posed_body(default_library(), query("get_up_back", at));
    ASSERT_TRUE(posed) << to_string(posed.error());
    const Pose& pose = posed->input.pose;
    if (lies(posed->body, pose) || on_its_feet(posed->body, pose)) continue;
    ++squats;
    for (const float size : {10.0f, 20.0f, 30.0f, 40.0f, 50.0f}) {
      const ImpactInput input = with_impulse(*posed, Part::chest, {0, 0, -size}, 1);
      const ResponseKind response = impulse_step(posed->body, input).response;
      EXPECT_NE(response, ResponseKind::recovery_steps) << at << " s, " << size << " N s";
      fell += response == ResponseKind::knockdown ? 1 : 0;
      if (response != ResponseKind::absorb || size > 10) continue;
      HitQuery hit = query("get_up_back", at);  // goes on getting up
      hit.part = Part::chest;
      hit.impulse = {0, 0, -size};
      const auto answer = simulate_hit(default_library(), hit);
      ASSERT_TRUE(answer) << to_string(answer.error());
      EXPECT_EQ(answer->response, "get_up_back");
      EXPECT_EQ(answer->timeline.events.size(), 1u);
    }
  }
  EXPECT_GT(squats, 1);
  EXPECT_GT(fell, 1);
}

TEST(SingleHit, NoBlowKnocksDownWhoLies) {
  for (const char* fall : {"knockdown_back", "knockdown_front", "knockdown_left"}) {
    const Action& action = default_library().action(default_library().find(fall));
    const auto posed = posed_body(default_library(), query(fall, seconds(action.length())));
    ASSERT_TRUE(posed) << to_string(posed.error());
    for (const float size : {2.0f, 30.0f, 150.0f}) {
      const ImpactInput input = with_impulse(*posed, Part::chest, {0, 0, size}, 1);
      const ImpactOutcome outcome = impulse_step(posed->body, input);
      EXPECT_EQ(outcome.response, ResponseKind::absorb) << fall << " " << size;
      EXPECT_EQ(outcome.steps, 0);
    }
  }
}

TEST(SingleHit, TheImpulseIsInTheFightersOwnAxes) {
  const auto posed = posed_body(default_library(), query());
  ASSERT_TRUE(posed);
  const ImpactInput fore = with_impulse(*posed, Part::chest, {0, 0, 10}, 1);
  EXPECT_NEAR(yaw_of(fore.blow.impulse), posed->facing, 1e-5f);
  EXPECT_NEAR(glm::length(fore.blow.impulse), 10, 1e-5f);
  // It meets the chest from behind.
  EXPECT_LT(
      glm::dot(fore.blow.point - posed->input.pose.hips, yaw_rotation(posed->facing) * kForward),
      0.1f);
}

// As in a fight, where less than kTouchImpulse cuts nothing.
TEST(SingleHit, WhoIsOnlyTouchedGoesOn) {
  HitQuery hit = query();
  hit.part = Part::head;
  for (const float impulse : {-4.0f, -6.0f}) {
    hit.impulse = {0, 0, impulse};
    const auto answer = simulate_hit(default_library(), hit);
    ASSERT_TRUE(answer) << to_string(answer.error());
    const auto& events = answer->timeline.events;
    const bool answered = std::any_of(events.begin(), events.end(), [](const Event& event) {
      return event.type == EventType::response;
    });
    EXPECT_EQ(answered, impulse < -kTouchImpulse);
    EXPECT_EQ(answer->response == hit.action, !answered);
  }
  hit.tone = .1f;  // with it nobody stands
  hit.impulse = {0, 0, -4};
  const auto touched = simulate_hit(default_library(), hit);
  ASSERT_TRUE(touched) << to_string(touched.error());
  EXPECT_EQ(touched->outcome.response, ResponseKind::absorb);
  EXPECT_EQ(touched->timeline.events.at(0).response, ResponseKind::absorb);
  EXPECT_LT(touched->timeline.events.at(0).damage, 1);
}

TEST(SingleHit, WhatIsShownIsWholeAndHoldsTheHit) {
  HitQuery hit = query("idle_guard_bounce", 0.0);
  hit.impulse = {0, 0, -20};
  hit.part = Part::chest;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer) << to_string(answer.error());
  ASSERT_EQ(answer->timeline.tracks.size(), 1u);
  EXPECT_EQ(answer->hit_tick, 0);
  EXPECT_EQ(answer->timeline.tracks[0].frames.size(),
            static_cast<std::size_t>(answer->timeline.end) + 1);
  EXPECT_EQ(answer->timeline.events[0].type, EventType::hit);
}

// The frames of an answer in which a fallen body lies and gets up.
struct GetUp {
  HitAnswer answer;
  std::size_t begin = 0;  // the first frame of the get-up

  const Skeleton& skeleton() const { return answer.bodies.front().skeleton; }
  const Pose& shown(std::size_t tick) const { return answer.timeline.tracks.front().frames[tick]; }
  float moved(std::size_t tick) const {  // of the joint that moves most, m in a tick
    return largest_joint_distance(world_pose(skeleton(), shown(tick - 1)),
                                  world_pose(skeleton(), shown(tick)));
  }
};

GetUp get_up_after(const HitQuery& hit) {
  const auto answer = simulate_hit(default_library(), hit);
  if (!answer) throw std::runtime_error(to_string(answer.error()));
  GetUp result{*answer};
  for (const Segment& one : result.answer.timeline.tracks.front().segments) {
    if (one.kind == Kind::get_up) result.begin = static_cast<std::size_t>(one.launch.start) + 1;
  }
  return result;
}

// Legs that a low kick leaves folded under the body: no get-up begins like that. Given up after the
// fall's clip, the body would be 0.25 m off its get-up; left as it comes to rest, 0.17 m.
TEST(SingleHit, WhoFallsInAHeapGathersItselfBeforeItGetsUp) {
  HitQuery hit = query("jab_low_kick", .462241286);
  hit.part = Part::right_thigh;
  hit.impulse = {116.837585f, 0, 8.693717f};
  hit.tone = .751024842f;
  const GetUp up = get_up_after(hit);
  ASSERT_GT(up.begin, 0u);
  const auto lying = lying_poses(default_library(), up.skeleton(), Stance::orthodox);
  EXPECT_LT(nearest_lying(up.skeleton(), lying, up.shown(up.begin)).apart, .14f);
  for (std::size_t t = up.begin; t < up.begin + 108; ++t) EXPECT_LT(up.moved(t), .08f) << t;
}

// What keeps a shown glove over the floor may not shake an arm that lies still.
TEST(SingleHit, WhoLiesDoesNotTremble) {
  HitQuery hit = query("cross_right_1", .6810);
  hit.part = Part::abdomen;
  hit.impulse = {-83.136f, 0, 102.038f};
  hit.tone = .6828f;
  const GetUp up = get_up_after(hit);
  ASSERT_GT(up.begin, 60u);
  for (std::size_t t = up.begin - 48; t < up.begin; ++t) EXPECT_LT(up.moved(t), .004f) << t;
}

// One that lies on the arm which its get-up has in front of it: held against its own weight, the
// arm stayed, and went 14 cm through the belly where the get-up began. One that has rolled from its
// side onto its back, with what it aimed at before. And one that stood on its head and a foot: it
// fell when its muscles let go, and got up on the way.
TEST(SingleHit, WhoGetsUpHasComeToLieAsItsGetUpBegins) {
  HitQuery on_its_arm = query("shuffle_back_short", .183112505);
  on_its_arm.part = Part::left_thigh;
  on_its_arm.impulse = {36.52803f, 0, -110.18712f};
  on_its_arm.tone = .813622f;
  HitQuery rolled = query("pivot_right", .251615869);
  rolled.part = Part::chest;
  rolled.impulse = {-74.373573f, 0, 92.267189f};
  rolled.tone = .75834763f;
  HitQuery on_its_head = query("step_away_back_left", .146298396);
  on_its_head.part = Part::left_thigh;
  on_its_head.impulse = {1.1223419f, 0, -112.28775f};
  on_its_head.tone = .85719764f;
  for (const HitQuery& hit : {on_its_arm, rolled, on_its_head}) {
    const GetUp up = get_up_after(hit);
    ASSERT_GT(up.begin, 0u);
    const auto lying = lying_poses(default_library(), up.skeleton(), Stance::orthodox);
    EXPECT_LT(nearest_lying(up.skeleton(), lying, up.shown(up.begin)).apart, .06f) << hit.action;
    for (std::size_t t = up.begin - 20; t < up.begin; ++t) {
      EXPECT_LT(up.moved(t), .004f) << hit.action << ' ' << t;
    }
  }
}

// The launch that answers the hit; without an action where there is none.
Launch response_of(const HitAnswer& answer) {
  for (const Segment& one : answer.timeline.tracks.front().segments) {
    if (one.kind == Kind::response) return one.launch;
  }
  return {};
}

TEST(SingleHit, WhoAbsorbsIsFreeAgainWhenTheTreeSaysSo) {
  for (const float impulse : {8.0f, 16.0f}) {
    HitQuery hit = query("idle_guard_bounce", 0.0);
    hit.impulse = {0, 0, -impulse};
    hit.part = Part::head;
    const auto answer = simulate_hit(default_library(), hit);
    ASSERT_TRUE(answer) << to_string(answer.error());
    const MotionTables tables(default_library(), answer->bodies.front());
    const Launch launch = response_of(*answer);
    ASSERT_TRUE(launch.action.valid());
    EXPECT_LT(launch.share, 1);
    EXPECT_EQ(launch.end - launch.start,
              free_again(tables.at(launch.action).way_left, launch.share));
    EXPECT_LT(launch.end - launch.start, default_library().action(launch.action).length());
  }
}

TEST(SingleHit, WhoStepsIsFreeAgainWhenTheTreeSaysSo) {
  HitQuery hit = query("idle_guard_bounce", 0.0);
  hit.impulse = {0, 0, -80};
  hit.part = Part::chest;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer) << to_string(answer.error());
  ASSERT_EQ(answer->outcome.response, ResponseKind::recovery_steps);
  const MotionTables tables(default_library(), answer->bodies.front());
  const Launch launch = response_of(*answer);
  ASSERT_TRUE(launch.action.valid());
  EXPECT_LT(launch.share, 1);
  EXPECT_EQ(launch.end - launch.start, free_again(tables.at(launch.action).way_left, launch.share));
}

struct Placed {
  const char* strike;
  Part part;
};
void PrintTo(const Placed& placed, std::ostream* out) {
  *out << placed.strike;
}

// The change of any joint's velocity between two frames at 60 Hz, m/s, beyond what the clip of the
// get-up does itself, over its first 0.9 s.
float jump_into_get_up(const HitAnswer& answer) {
  const FighterTrack& track = answer.timeline.tracks.front();
  const BodyModel& body = answer.bodies.front();
  float largest = -1;
  for (const Segment& segment : track.segments) {
    if (segment.kind != Kind::get_up) continue;
    const auto jumps = [&](const auto& pose_of, Tick t) {
      const WorldPose a = world_pose(body.skeleton, pose_of(t - 4)),
                      b = world_pose(body.skeleton, pose_of(t - 2)),
                      c = world_pose(body.skeleton, pose_of(t));
      std::array<float, kJointCount> out;
      for (std::size_t j = 0; j < kJointCount; ++j) {
        out[j] = 60 * glm::length(c.position[j] - 2.0f * b.position[j] + a.position[j]);
      }
      return out;
    };
    const Tick start = segment.launch.start;
    for (Tick t = start + 4; t < start + 108; ++t) {
      const auto shown =
          jumps([&](Tick at) { return track.frames[static_cast<std::size_t>(at)]; }, t);
      const auto own = jumps(
          [&](Tick at) { return pose_at(default_library(), segment.launch, at, body.scale); }, t);
      for (std::size_t j = 0; j < kJointCount; ++j) largest = std::max(largest, shown[j] - own[j]);
    }
  }
  return largest;
}

// The clips that answer blows from the front begin with the head turned away by 45 degrees.
TEST(SingleHit, ATapTurnsTheHeadLittleAndAHarderBlowMore) {
  for (const Vec3& way : {Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{1, 0, 0}}) {
    float last = 0;
    for (const float impulse : {3.0f, 6.0f, 14.0f}) {
      HitQuery hit = query("idle_guard_bounce", 0.1);
      hit.impulse = impulse * way;
      hit.part = Part::head;
      const auto answer = simulate_hit(default_library(), hit);
      ASSERT_TRUE(answer) << to_string(answer.error());
      const auto& frames = answer->timeline.tracks[0].frames;
      const auto from = static_cast<std::size_t>(answer->hit_tick);
      const auto head = [&](std::size_t i) {
        return world_pose(answer->bodies[0].skeleton, frames[i]).rotation[index(Joint::head)];
      };
      float turned = 0;
      for (std::size_t i = from; i < from + 60; ++i) {
        const Quat turn = in_hemisphere_of(head(i) * glm::conjugate(head(from)), Quat(1, 0, 0, 0));
        turned = std::max(turned, degrees(glm::length(rotation_vector(turn))));
      }
      EXPECT_GT(turned, last) << impulse << " N s";
      EXPECT_LT(turned, 4 * impulse) << impulse << " N s";
      last = turned;
    }
  }
}

// One that sat down with a leg stretched out: led along a line to where the get-up has it, the foot
// passed the hip and the leg turned over at 26 m/s. One whose arm lies behind its back. And one
// that has caught itself on its hands over a folded leg: its trunk never came down, it got up
// without having lain, and the leg turned over at 52 m/s.
TEST(SingleHit, NoLimbTurnsOverWhereAGetUpBegins) {
  HitQuery seated = query("step_forward_left_long", .059);
  seated.part = Part::right_thigh;
  seated.impulse = {-61, 0, 9.4f};
  seated.tone = .79f;
  HitQuery on_its_arm = query("step_left", .257);
  on_its_arm.part = Part::left_thigh;
  on_its_arm.impulse = {84.4f, 0, 11.7f};
  on_its_arm.tone = .66f;
  HitQuery caught = query("side_kick_lead", .7043473482131959);
  caught.part = Part::right_thigh;
  caught.impulse = {-13.471954f, 0, -83.82341f};
  caught.tone = .796262f;
  for (const HitQuery& hit : {seated, on_its_arm, caught}) {
    const auto answer = simulate_hit(default_library(), hit);
    ASSERT_TRUE(answer) << to_string(answer.error());
    ASSERT_EQ(answer->outcome.response, ResponseKind::knockdown) << hit.action;
    const float jump = jump_into_get_up(*answer);
    EXPECT_GE(jump, 0) << "no get-up";
    EXPECT_LT(jump, 1.5f) << hit.action;
  }
}

// Of a get-up, how deep, m, any part but gloves and feet is in the floor where it is worst.
float deepest_in_floor(const GetUp& up) {
  const BodyModel& body = up.answer.bodies.front();
  const FighterTrack& track = up.answer.timeline.tracks.front();
  float deepest = 0;
  for (std::size_t t = up.begin; t < track.frames.size(); ++t) {
    const BodyCapsules c = capsules(body, world_pose(body.skeleton, up.shown(t)));
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const Part part = part_at(i);
      if (part == Part::left_hand || part == Part::right_hand) continue;
      if (part == Part::left_foot || part == Part::right_foot) continue;
      deepest = std::max(deepest, c[i].radius - std::min(c[i].a.y, c[i].b.y));
    }
  }
  return deepest;
}

// By the shortest turn, knees and elbows that lie on the wrong side of their body would go 7 to 21
// cm through the floor.
TEST(SingleHit, NoLimbGoesThroughTheFloorWhereAGetUpBegins) {
  struct Fall {
    double at_s;
    Vec3 impulse;
  };
  for (const Fall& fall : {Fall{.3, {30, 40, -150}},
                           {.1, {40, 0, -170}},
                           {.3, {80, 0, -150}},
                           {.3, {-60, 0, -160}},
                           {.9, {128, -2, 41}}}) {
    HitQuery hit = query("idle_guard_bounce", fall.at_s);
    hit.part = Part::chest;
    hit.impulse = fall.impulse;
    const GetUp up = get_up_after(hit);
    ASSERT_GT(up.begin, 0u);
    EXPECT_LT(deepest_in_floor(up), .04f) << fall.at_s << " s, " << fall.impulse.x << " N s";
    EXPECT_LT(jump_into_get_up(up.answer), 1.5f);
  }
}

class PlacedStrikeTest : public ::testing::TestWithParam<Placed> {};

TEST_P(PlacedStrikeTest, LandsInTheZoneAndIsAnsweredAsItsImpulseAlone) {
  HitQuery hit = query();
  hit.strike = GetParam().strike;
  hit.part = GetParam().part;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer) << to_string(answer.error());
  const Blow& blow = answer->input.blow;
  EXPECT_EQ(zone_of(blow.part), zone_of(hit.part));
  EXPECT_GT(blow.speed, 2);
  EXPECT_GT(glm::length(blow.impulse), 3);
  // J = share (1 + e) v / (1/m + 1/M) with e = 0.45: never more than (1 + e) v m.
  EXPECT_LE(glm::length(blow.impulse), 1.45f * blow.speed * blow.effective_mass * 1.001f);
  ASSERT_EQ(answer->timeline.tracks.size(), 2u);
  for (const FighterTrack& track : answer->timeline.tracks) {
    EXPECT_EQ(track.frames.size(), static_cast<std::size_t>(answer->timeline.end) + 1);
  }
  // The same blow given directly, to a body that was never on a stage with another.
  ImpactInput direct = answer->input;
  const auto posed =
      posed_body(default_library(), query(hit.action, static_cast<double>(answer->at_s)));
  ASSERT_TRUE(posed);
  direct.continued = posed->continued;
  const ImpactOutcome outcome = impulse_step(posed->body, direct);
  EXPECT_EQ(outcome.response, answer->outcome.response);
  EXPECT_EQ(outcome.steps, answer->outcome.steps);
  EXPECT_NEAR(outcome.head_spin, answer->outcome.head_spin,
              0.05f * answer->outcome.head_spin + 0.1f);
  EXPECT_NEAR(outcome.margin, answer->outcome.margin, 0.02f);
}

INSTANTIATE_TEST_SUITE_P(Strikes, PlacedStrikeTest,
                         ::testing::Values(Placed{"cross", Part::head},
                                           Placed{"roundhouse_rear_low", Part::left_thigh},
                                           Placed{"front_kick_rear", Part::abdomen},
                                           Placed{"knee_lead", Part::pelvis}),
                         [](const auto& test) { return std::string(test.param.strike); });

TEST(PlacedStrike, ThatCannotLandSaysWhatItMeets) {
  HitQuery hit = query();
  hit.strike = "cross";
  hit.part = Part::left_shin;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().kind, ErrorKind::usage);
  EXPECT_THAT(answer.error().what, HasSubstr("cross does not land on the leftShin"));
  EXPECT_THAT(answer.error().remedy, HasSubstr("head 0."));
}

// A thigh is thicker than the shin that lands: kept out like any other, it would hold off its knee.
TEST(PlacedStrike, OfAKneeIsNotHeldOffByItsThigh) {
  HitQuery hit = query("idle_guard_bounce", .4);
  hit.strike = "knee_rear";
  hit.part = Part::abdomen;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer) << to_string(answer.error());
  EXPECT_GT(answer->input.blow.speed, 5);
}

TEST(PlacedStrike, ThatIsHeldOffOnItsWaySaysSo) {
  HitQuery hit = query();
  hit.strike = "knee_rear";
  hit.part = Part::pelvis;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error().what, HasSubstr("knee_rear does not land on the pelvis"));
  EXPECT_THAT(answer.error().remedy, HasSubstr("held off"));
  EXPECT_THAT(answer.error().remedy, HasSubstr("pelvis 0."));
}

TEST(PlacedStrike, FromAGivenDistanceMeetsOrSaysFromWhereItWould) {
  HitQuery hit = query();
  hit.strike = "cross";
  hit.distance = 0.95f;
  const auto near = simulate_hit(default_library(), hit);
  ASSERT_TRUE(near) << to_string(near.error());
  EXPECT_FLOAT_EQ(near->distance, 0.95f);
  hit.distance = 2.5f;
  const auto far = simulate_hit(default_library(), hit);
  ASSERT_FALSE(far);
  EXPECT_THAT(far.error().what, HasSubstr("from 2.5 m"));
}

TEST(PlacedStrike, OfAnAttackerOfAnotherHeightIsFittedAsInAFight) {
  HitQuery hit = query();
  hit.strike = "jab";
  for (const auto& [attacker, struck] : {std::pair{1.94f, 1.62f}, std::pair{1.62f, 1.94f}}) {
    hit.attacker.height = attacker;
    hit.body.height = struck;
    const auto answer = simulate_hit(default_library(), hit);
    ASSERT_TRUE(answer) << to_string(answer.error());
    EXPECT_EQ(answer->input.blow.part, Part::head);
    EXPECT_GT(glm::length(answer->input.blow.impulse), 12) << attacker;  // as at one's own height
  }
  hit.strike = "roundhouse_rear_high";
  hit.attacker.height = 1.55f;
  hit.body.height = 2.05f;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error().what,
              HasSubstr("cannot be thrown by a body of 1.55 m at one of 2.05"));
}

TEST(SingleHit, UnknownNamesAndTimesOutsideAreUsageErrors) {
  for (const HitQuery& wrong : {query("crosss"), query("cross", -1), query("cross", 1e300)}) {
    const auto answer = simulate_hit(default_library(), wrong);
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().kind, ErrorKind::usage);
    EXPECT_EQ(answer.error().place, "--pose");
  }
}

TEST(SingleHit, AGuardThatHoldsGivesWayAndSpringsBack) {
  HitQuery hit = query("parry_left", 0.3);
  hit.strike = "cross";
  hit.part = Part::left_hand;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer) << to_string(answer.error());
  ASSERT_TRUE(answer->input.blow.blocked);
  const std::vector<Pose>& frames = answer->timeline.tracks.front().frames;
  const Vec3 line = glm::normalize(answer->input.blow.impulse);
  const auto gone = [&](Joint hand, Tick after) {
    const auto place = [&](Tick tick) {
      const WorldPose world =
          world_pose(answer->bodies.front().skeleton, frames[static_cast<std::size_t>(tick)]);
      return glm::dot(world.position[index(hand)] - world.position[index(Joint::chest)], line);
    };
    return place(answer->hit_tick + after) - place(answer->hit_tick);
  };
  EXPECT_GT(gone(Joint::left_hand, 5), .03f);
  EXPECT_LT(std::abs(gone(Joint::right_hand, 5)), .02f);
  EXPECT_LT(gone(Joint::left_hand, 30), .5f * gone(Joint::left_hand, 5));
}

}  // namespace
}  // namespace ringcraft
