// What people see of feet and hips under a blow.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "motion/quality.h"
#include "physics/ragdoll.h"
#include "scene/hit_fixture.h"

namespace ringcraft {
namespace {

struct StruckCase {
  const char* action;
  double at_s;
  Part part;
  Vec3 impulse;
  float tone;
};

HitAnswer answer_to_case(const StruckCase& c) {
  HitQuery hit = hits::query(c.action, c.at_s);
  hit.part = c.part;
  hit.impulse = c.impulse;
  hit.tone = c.tone;
  return simulate_hit(default_library(), hit).value();
}

std::span<const Pose> frames_from_hit(const HitAnswer& answer) {
  return std::span(answer.timeline.tracks.front().frames)
      .subspan(static_cast<std::size_t>(answer.hit_tick));
}

// A leg that is struck, a foot that a body is knocked off, a kick that is cut short and set down.
TEST(StruckFeet, DoNotSlideUnderABodyThatStaysUp) {
  const std::vector<StruckCase> cases{
      {"step_forward_left_long", .163, Part::right_thigh, {12.425f, 0, 10.467f}, .973f},
      {"jab", .111, Part::right_thigh, {8.430f, 0, 125.340f}, .748f},
      {"guard_2", .327, Part::right_thigh, {54.285f, 0, -93.265f}, .992f},
      {"slip_left", .312, Part::abdomen, {-81.620f, 0, -96.740f}, .862f},
      {"roundhouse_rear_middle_near", .284, Part::left_thigh, {-19.839f, 0, -5.402f}, .743f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    EXPECT_EQ(
        foot_skate_ratio(answer.bodies.front().skeleton, frames_from_hit(answer), kTicksPerSecond),
        0)
        << c.action;
  }
}

// No blow lifts a foot by itself that stands; a step takes time to begin.
TEST(StruckFeet, StandUntilTheBodyHasHadTimeToStep) {
  const std::vector<StruckCase> cases{
      {"rear_uppercut", .676, Part::abdomen, {-3.026f, 0, 98.929f}, .895f},
      {"low_guard", .303, Part::abdomen, {-84.214f, 0, -104.575f}, .835f},
      {"idle_guard_2", .202, Part::abdomen, {15.945f, 0, 71.456f}, .998f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    const BodyModel& body = answer.bodies.front();
    const auto frames = frames_from_hit(answer);
    for (Tick t = 0; t < ticks(.15); ++t) {
      const WorldPose world = world_pose(body.skeleton, frames[static_cast<std::size_t>(t)]);
      for (const Side side : {Side::left, Side::right}) {
        EXPECT_LT(sole_height(body, world, side), .025f) << c.action << " " << t;
      }
    }
  }
}

// The same number of steps, but as long as it takes: the feet end where the blow has driven them.
TEST(StruckBodies, GoFartherTheHarderTheyArePushed) {
  for (const Vec3& way : {Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    float last = 0;
    for (const float impulse : {.4f, .6f, .8f, 1.0f}) {  // of what one step holds
      const float most = way.z < 0 ? 115.0f : 45.0f;     // N s
      const HitAnswer answer =
          answer_to_case({"idle_guard_bounce", .1, Part::chest, most * impulse * way, 1});
      ASSERT_EQ(answer.outcome.steps, 1) << most * impulse;
      const auto frames = frames_from_hit(answer);
      const float went =
          glm::dot(frames[static_cast<std::size_t>(ticks(1.0))].hips - frames[0].hips, way);
      EXPECT_GT(went, last + .03f) << most * impulse;
      last = went;
    }
    EXPECT_GT(last, .35f);
  }
}

// A kick to the body is seen: whoever absorbs it gives way with the hips, folds over it, and has
// them back with its next action. 37 N s are what a front kick has (v / w0 is 8 cm there).
TEST(StruckBodies, GiveWayToAKickThatTheyAbsorb) {
  const HitAnswer answer = answer_to_case({"idle_guard_bounce", .1, Part::abdomen, {0, 0, -37}, 1});
  ASSERT_EQ(answer.outcome.response, ResponseKind::absorb);
  const auto frames = frames_from_hit(answer);
  const auto back = [&](double s) {
    return frames[0].hips.z - frames[static_cast<std::size_t>(ticks(s))].hips.z;
  };
  EXPECT_GT(back(.2), .07f);
  EXPECT_GT(back(.3), .03f);
  EXPECT_LT(back(.7), .02f);
  const Skeleton& skeleton = answer.bodies.front().skeleton;
  const auto over_hips = [&](double s) {
    const Pose& pose = frames[static_cast<std::size_t>(ticks(s))];
    return world_pose(skeleton, pose).position[index(Joint::upper_chest)].z - pose.hips.z;
  };
  EXPECT_LT(over_hips(.08) - over_hips(0), .01f);  // as one piece at first
  EXPECT_GT(over_hips(.22) - over_hips(0), .02f);
}

// Who was on the way somewhere else when the blow landed brakes, and goes the way of the blow.
TEST(StruckBodies, GoTheWayOfTheBlowWhereverTheyWereGoing) {
  const std::vector<StruckCase> cases{
      {"step_forward_long", .073, Part::right_thigh, {18.255f, 0, -62.071f}, .622f},
      {"cross", .370, Part::head, {-26.548f, 0, 40.630f}, .986f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    const auto frames = frames_from_hit(answer);
    const Vec3 went = frames[static_cast<std::size_t>(ticks(.4))].hips - frames[0].hips;
    const float off =
        wrapped_angle(yaw_of({went.x, 0, went.z}) - yaw_of(answer.input.blow.impulse));
    EXPECT_LT(std::abs(off), radians(30)) << c.action;
  }
}

// Largest change of a joint's velocity between two frames at 60 Hz, m/s, in ticks from the hit on.
float velocity_jump(const HitAnswer& answer, Tick from, Tick to) {
  const auto frames = frames_from_hit(answer);
  const auto at = [&](Tick t) {
    return world_pose(answer.bodies.front().skeleton, frames[static_cast<std::size_t>(t)]);
  };
  float largest = 0;
  for (Tick t = from; t < to; ++t) {
    const WorldPose before = at(t - 4), between = at(t - 2), now = at(t);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 change = now.position[j] - 2.0f * between.position[j] + before.position[j];
      largest = std::max(largest, glm::length(change) * 60);
    }
  }
  return largest;
}

// V7: who is struck on the leg that carries it alone falls where that is taken away, not where it
// only wavers.
TEST(StruckBodies, FallWhereTheirOnlyLegIsTakenAway) {
  const auto answer = [](float share) {
    const Vec3 impulse = share * Vec3{5.966f, 0, -108.625f};
    return answer_to_case({"leg_sweep", .4506, Part::left_thigh, impulse, .644f}).outcome.response;
  };
  EXPECT_EQ(answer(1), ResponseKind::knockdown);
  EXPECT_NE(answer(.2f), ResponseKind::knockdown);
  for (const StruckCase& c : std::vector<StruckCase>{
           {"roundhouse_lead_high", .717, Part::right_thigh, {13.8f, 0, -48.9f}, .69f},
           {"roundhouse_rear_low_near", .377, Part::left_thigh, {-40.3f, 0, -73.2f}, .88f}}) {
    EXPECT_EQ(answer_to_case(c).outcome.response, ResponseKind::knockdown) << c.action;
  }
}

// Where the simulation passes to the clip, at 60 Hz: a kicking leg neither stops nor sets out for
// its place in a frame, an arm that was flung is caught before, a leg does not hit the floor.
TEST(StruckBodies, PassToTheirClipWithoutAPop) {
  const std::vector<StruckCase> cases{
      {"roundhouse_rear_high", .422, Part::abdomen, {-8.343f, 0, -24.300f}, .871f},
      {"guard_2", .096, Part::left_upper_arm, {61.877f, 0, 30.140f}, .726f},
      {"duck", .096, Part::left_upper_arm, {-40.180f, 0, 6.492f}, .938f},
      {"check_kick_lead", .306, Part::chest, {-32.629f, 0, 25.656f}, .987f},
      {"knee_rear", .398, Part::left_upper_arm, {-11.354f, 0, 16.664f}, .645f},
      // spinning: arms that came round with the body and with their own swing
      {"roundhouse_rear_low_near", .41566952, Part::chest, {18.825232f, 0, 29.72795f}, .90457034f},
      {"jab_low_kick", .593401, Part::right_thigh, {-13.482088f, 0, -17.606865f}, .70505685f},
      // legs in the air, of which what hips, knee and ankle brake adds up at the toes
      {"step_back_away", .19019014, Part::left_thigh, {82.42688f, 0, -68.067696f}, .8896607f},
      {"jab_jab", .60020473, Part::right_thigh, {-119.43821f, 0, 14.577409f}, .6711317f},
      {"roundhouse_rear_middle", .12283563, Part::head, {-.52029157f, 0, -48.243404f}, .9484754f}};
  for (const StruckCase& c : cases) {
    EXPECT_LT(velocity_jump(answer_to_case(c), 19, 60), 1.5f) << c.action;
  }
}

// A clip bends a leg that has been straight to lift its foot, which waits here until the other is
// down: the hips do not drop to where that leg would be as bent. They dropped by 1.1 m/s in a
// frame.
TEST(StruckBodies, DoNotDropWhereAFootWaitsToLift) {
  const HitAnswer answer = answer_to_case(
      {"step_forward", .09813472, Part::chest, {-29.930508f, 0, 60.724922f}, .86317194f});
  const auto frames = frames_from_hit(answer);
  float jump = 0;  // m/s between two frames at 60 Hz
  for (std::size_t t = 74; t < 100; ++t) {
    const float change = frames[t].hips.y - 2 * frames[t - 2].hips.y + frames[t - 4].hips.y;
    jump = std::max(jump, 60 * std::abs(change));
  }
  EXPECT_LT(jump, .85f);
}

// A leg that was lifted when the blow landed, over a clip whose feet stand and whose knees
// straighten: its toes jump by 2.5 m/s, the clip's hips having their part in it; thrown by thigh
// and knee they jump by 4.0.
TEST(StruckBodies, ALegInTheAirIsNotThrownByTheKneeOfItsClip) {
  const HitAnswer answer = answer_to_case(
      {"knee_rear", .28680895, Part::right_thigh, {31.464165f, 0, 97.839134f}, .8099428f});
  const auto frames = frames_from_hit(answer);
  const auto toes_at = [&](std::size_t t) {
    return world_pose(answer.bodies.front().skeleton, frames[t]).position[index(Joint::right_toes)];
  };
  float jump = 0;  // m/s between two frames at 60 Hz
  for (std::size_t t = 40; t < 90; ++t) {
    jump = std::max(jump, 60 * glm::length(toes_at(t) - 2.0f * toes_at(t - 2) + toes_at(t - 4)));
  }
  EXPECT_LT(jump, 3.0f);
}

// How far, m, feet go along the floor faster than `speed`, m/s, their soles lower than `height`, m,
// once the simulation is over.
float skimmed(const HitAnswer& answer, float height, float speed) {
  const BodyModel& body = answer.bodies.front();
  const auto frames = frames_from_hit(answer);
  float skims = 0;
  for (std::size_t t = 19; t < frames.size(); ++t) {
    const WorldPose before = world_pose(body.skeleton, frames[t - 1]),
                    now = world_pose(body.skeleton, frames[t]);
    for (const Side side : {Side::left, Side::right}) {
      const Vec3 moved = now.position[index(toes(side))] - before.position[index(toes(side))];
      const float far = std::hypot(moved.x, moved.z);
      const bool low = sole_height(body, now, side) < height;
      skims += low && far > speed * kTickSeconds ? far : 0;
    }
  }
  return skims;
}

// A foot that was in the air comes down when it has slowed over the ground: until then its sole is
// off the floor. It skimmed over it for 0.59 to 0.70 m.
TEST(StruckBodies, SetFeetDownThatHaveSlowed) {
  const std::vector<StruckCase> cases{
      {"front_kick_rear", .1689, Part::head, {-3.19f, 0, 33.53f}, .779f},
      {"idle_guard_2", .4718, Part::right_thigh, {100.68f, 0, 32.59f}, .784f},
      {"roundhouse_rear_low", .4873, Part::head, {13.91f, 0, .41f}, .777f}};
  for (const StruckCase& c : cases)
    EXPECT_LT(skimmed(answer_to_case(c), .025f, 1), .4f) << c.action;
}

// A foot that was thrown aside is lifted on its way back: it was dragged along the floor for 0.6 to
// 1.1 m.
TEST(StruckBodies, BringAFootThatWasThrownAsideBackOverTheFloor) {
  const std::vector<StruckCase> cases{
      {"front_kick_rear_near", .5216274858, Part::left_upper_arm, {7.632f, 0, 56.333f}, .92307f},
      {"roundhouse_lead_middle", .9105979701, Part::left_thigh, {-109.49f, 0, -60.207f}, .73709f},
      {"step_back_right_long", .2508808225, Part::left_thigh, {-73.851f, 0, -38.394f}, .94034f},
      {"leg_sweep", .6393669248, Part::abdomen, {-29.903f, 0, 38.506f}, .71315f},
      // comes down fast, and steps as the next action begins
      {"front_kick_rear", .5370868862, Part::abdomen, {-5.92902f, 0, 8.37671f}, .652287f}};
  for (const StruckCase& c : cases)
    EXPECT_LT(skimmed(answer_to_case(c), .01f, .3f), .25f) << c.action;
}

// The longest time, s, from the end of the simulation on, in which neither sole is on the floor.
double longest_hop(const HitAnswer& answer) {
  const BodyModel& body = answer.bodies.front();
  const auto frames = frames_from_hit(answer);
  Tick longest = 0, hop = 0;
  for (std::size_t t = 18; t < frames.size(); ++t) {
    const WorldPose world = world_pose(body.skeleton, frames[t]);
    const bool off = sole_height(body, world, Side::left) > .012f &&
                     sole_height(body, world, Side::right) > .012f;
    hop = off ? hop + 1 : 0;
    longest = std::max(longest, hop);
  }
  return seconds(longest);
}

// The other foot carries until the one that was kicked aside is down, where it took a step at once:
// bodies were on no foot for 0.11 to 0.16 s, kickers who stood on an edge of their sole for 0.66.
TEST(StruckBodies, StandOnOneFootWhileTheOtherIsInTheAir) {
  const std::vector<StruckCase> cases{
      {"guard_1", .103, Part::left_thigh, {43, 0, -1.1f}, .92f},
      {"jab_far", .211, Part::left_thigh, {14.9f, 0, 56}, .92f},
      {"slip_left", .376, Part::right_thigh, {-50, 0, .8f}, .7f},
      {"cross_right_1", .503, Part::right_thigh, {-27, 0, -43.3f}, .67f},
      {"duck", .053, Part::right_thigh, {-49.7f, 0, 31.8f}, .89f}};
  for (const StruckCase& c : cases) EXPECT_LT(longest_hop(answer_to_case(c)), .05) << c.action;
  const HitAnswer kicker =
      answer_to_case({"roundhouse_rear_low", .392, Part::left_upper_arm, {34.5f, 0, -22.2f}, .79f});
  EXPECT_LT(longest_hop(kicker), .2);
}

// Feet come down on the floor. Heels and edges of soles that lay over went into it, by 4.3 to 6.2
// cm.
TEST(StruckBodies, SetTheirFeetOnTheFloorAndNotIntoIt) {
  const std::vector<StruckCase> cases{
      {"front_kick_rear_near",
       .401060691,
       Part::left_upper_arm,
       {22.349728f, 0, -24.416752f},
       .97354364f},
      {"front_kick_rear_near", .330021125, Part::abdomen, {35.290707f, 0, -50.8689f}, .89960015f},
      {"front_kick_rear_near",
       .371511316,
       Part::left_thigh,
       {-18.06151f, 0, -46.54961f},
       .676165f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    const BodyModel& body = answer.bodies.front();
    float lowest = 0;
    for (const Pose& frame : frames_from_hit(answer)) {
      for (const Side side : {Side::left, Side::right}) {
        lowest = std::min(lowest, sole_height(body, world_pose(body.skeleton, frame), side));
      }
    }
    EXPECT_GT(lowest, -.025f) << c.action << " at " << c.at_s;
  }
}

// Where a body turns back with a leg or an arm out, these go round with it: as long as if they went
// straight, they whirled at 10 m/s.
TEST(StruckBodies, TurnBackNoFasterThanTheirLimbsMayGoRound) {
  const std::vector<StruckCase> cases{
      {"spinning_back_kick", .53095239, Part::head, {-1.0902517f, 0, 11.499822f}, .6786987f},
      {"roundhouse_rear_middle", .42770613, Part::head, {4.095782f, 0, -16.445591f}, .871910f}};
  for (const StruckCase& c : cases) {
    EXPECT_LT(velocity_jump(answer_to_case(c), 24, 120), 1.5f) << c.action;
  }
}

// Who is spun by the blow, as a kicker on one leg is, answers from where it comes to a stop: it
// went on round to where it had faced, through 278 to 303 degrees.
TEST(StruckBodies, AnswerFromWhereTheBlowHasSpunThem) {
  const std::vector<StruckCase> cases{
      {"knee_rear", .3741625, Part::left_upper_arm, {7.42f, 0, -18.8f}, .884f},
      {"leg_sweep", .37792948, Part::head, {-2.0898595f, 0, -32.920799f}, .9167663f},
      {"roundhouse_rear_low", .47024613, Part::chest, {-27.46198f, 0, -21.972347f}, .89119923f},
      {"roundhouse_rear_low", .4219, Part::left_thigh, {6.62f, 0, -10.87f}, .865f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    float turned = 0, farthest = 0;
    std::optional<float> last;
    for (const Pose& frame : frames_from_hit(answer).first(ticks(1))) {
      const float heading = heading_of(frame.rotation[0]);
      turned += wrapped_angle(heading - last.value_or(heading));
      farthest = std::max(farthest, std::abs(turned));
      last = heading;
    }
    EXPECT_LT(farthest, radians(150)) << c.action << " at " << c.at_s;
  }
}

// A foot that stands where its leg comes to the end of its range steps before, and is not torn off,
// as in the last two, by 3.2 and 4.2 m/s.
TEST(StruckBodies, LetGoOfAFootBeforeTheirLegIsAtTheEndOfItsRange) {
  const std::vector<StruckCase> cases{
      {"step_forward_left", .25435505, Part::chest, {-42.22151f, 0, 45.560688f}, .68010616f},
      {"roundhouse_lead_low", .58243594, Part::left_thigh, {-63.03146f, 0, 29.456936f}, .64877856f},
      {"turn_left_50", .10254174, Part::chest, {-41.886627f, 0, 48.276802f}, .7684512f}};
  for (const StruckCase& c : cases) {
    EXPECT_LT(velocity_jump(answer_to_case(c), 60, 100), 1.5f) << c.action;
  }
}

// Where the next action begins, arms come back bent, a foot that its ankle kept off its place
// stands where it is, and a trunk that is still far from upright takes its time.
// The foot passes below the hip, where the knee goes farthest.
TEST(StruckBodies, StepNoFasterThanTheirKneesBend) {
  const std::vector<StruckCase> cases{
      {"roundhouse_rear_middle",
       .54341752,
       Part::left_upper_arm,
       {-28.62781f, 0, -36.001827f},
       .79290986f},
      {"roundhouse_rear_low", .47024613, Part::chest, {-27.46198f, 0, -21.972347f}, .89119923f}};
  for (const StruckCase& c : cases) {
    EXPECT_LT(velocity_jump(answer_to_case(c), 40, 100), 1.5f) << c.action;
  }
}

TEST(StruckBodies, GoOnFromTheirAnswerWithoutAPop) {
  const std::vector<StruckCase> cases{
      {"guard_2", .096, Part::left_upper_arm, {61.877f, 0, 30.140f}, .726f},
      {"guard_1", .237, Part::left_upper_arm, {43.579f, 0, 73.929f}, .668f},
      {"roundhouse_rear_low",
       .42108933,
       Part::right_thigh,
       {54.885242f, 0, -3.9854646f},
       .6142331f},
      {"roundhouse_rear_low", .25878227, Part::left_thigh, {28.367569f, 0, 17.05246f}, .6767378f},
      {"roundhouse_rear_middle_near",
       .40730617,
       Part::left_thigh,
       {13.927633f, 0, -.6516973f},
       .6403924f}};
  for (const StruckCase& c : cases) {
    const HitAnswer answer = answer_to_case(c);
    const Tick begins =
        answer.timeline.tracks.front().segments.at(2).launch.start - answer.hit_tick;
    EXPECT_LT(velocity_jump(answer, begins, begins + 30), 1.5f) << c.action;
  }
}

}  // namespace
}  // namespace ringcraft
