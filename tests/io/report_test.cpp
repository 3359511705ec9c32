#include "io/report.h"

#include <gtest/gtest.h>

#include "base/hash.h"
#include "io/quality.h"
#include "io/sample_fight.h"

namespace ringcraft {
namespace {

using nlohmann::json;

RunFacts facts() {
  RunFacts facts;
  facts.scene = "duel";
  facts.seed = 18446744073709551615u;
  facts.contestants = {{"aggressive", 2.0}, {"careful", 1.5}};
  facts.memo_hits = 40;
  facts.memo_misses = 12;
  facts.impulse_steps = 14;
  facts.foreseen = 2;
  return facts;
}

json sample_report() {
  return report_json(sample::timeline(), sample::looks(), sample::library(), facts());
}

TEST(Report, HasEveryFieldOfTheDesign) {
  const json report = sample_report();
  for (const char* pointer : {"/version",
                              "/scene",
                              "/seed",
                              "/library/name",
                              "/library/actions",
                              "/library/attacks",
                              "/library/defenses",
                              "/library/transitions",
                              "/library/responses",
                              "/duration_s",
                              "/hash",
                              "/planner/decisions",
                              "/planner/nodes",
                              "/planner/leaves",
                              "/planner/forced_nodes",
                              "/planner/pruned/unanswered_hit",
                              "/planner/pruned/back_turned",
                              "/planner/pruned/penetration",
                              "/planner/pruned/candidates",
                              "/planner/memo/hits",
                              "/planner/memo/misses",
                              "/physics/impacts",
                              "/physics/impulse_steps",
                              "/physics/mean_impulse_Ns",
                              "/physics/foreseen_agreement",
                              "/quality/penetration_p99_m",
                              "/quality/penetration_max_m",
                              "/quality/penetration_max_at_s",
                              "/quality/penetration_longest_s",
                              "/quality/foot_skate_ratio",
                              "/quality/joint_limit_violations",
                              "/quality/wrist_speed_p99_mps"}) {
    EXPECT_TRUE(report.contains(json::json_pointer(pointer))) << pointer;
  }
  ASSERT_EQ(report["fighters"].size(), 2u);
  for (const json& fighter : report["fighters"]) {
    for (const char* name :
         {"name", "style", "horizon_s", "strikes", "landed", "blocked", "missed", "defenses",
          "hits_taken", "recovery_steps", "knockdowns", "knockouts", "mean_distance_m", "launches",
          "launches_per_s", "most_launched", "most_launched_share"}) {
      EXPECT_TRUE(fighter.contains(name)) << name;
    }
  }
}

TEST(Report, SaysHowMuchAndHowVariedAFighterLaunches) {
  Timeline timeline = sample::timeline();
  FighterTrack& track = timeline.tracks[0];
  track.segments.clear();
  for (const char* name : {"opening", "jab", "idle", "jab", "absorb", "idle_of_who_has_won"}) {
    track.segments.push_back({Launch{}, name, Kind::attack});
    track.segments.back().launch.forced = track.segments.size() > 4;
  }
  const auto length = static_cast<double>(track.frames.size()) / kTicksPerSecond;
  const json report = report_json(timeline, sample::looks(), sample::library(), facts());
  const json& fighter = report["fighters"][0];
  EXPECT_EQ(fighter["launches"], 3);
  EXPECT_NEAR(fighter["launches_per_s"].get<double>(), 3 / length, 1e-3);
  EXPECT_EQ(fighter["most_launched"], "jab");
  EXPECT_NEAR(fighter["most_launched_share"].get<double>(), 2.0 / 3, 1e-3);
}

TEST(Report, CountsWhatHappened) {
  const json report = sample_report();
  const json& ana = report["fighters"][0];
  const json& bo = report["fighters"][1];
  EXPECT_EQ(ana["strikes"], 2);
  EXPECT_EQ(ana["landed"], 1);
  EXPECT_EQ(ana["blocked"], 1);
  EXPECT_EQ(ana["missed"], 0);
  EXPECT_EQ(ana["defenses"], 2);  // guard_high, duck
  EXPECT_EQ(ana["style"], "aggressive");
  EXPECT_EQ(bo["missed"], 1);
  EXPECT_EQ(bo["hits_taken"], 1);
  EXPECT_EQ(bo["recovery_steps"], 2);
  EXPECT_EQ(bo["knockdowns"], 1);
  EXPECT_EQ(bo["knockouts"], 1);
  EXPECT_EQ(bo["defenses"], 1);
  EXPECT_EQ(report["planner"]["decisions"], 1);
  EXPECT_EQ(report["planner"]["nodes"], 120);
  EXPECT_EQ(report["planner"]["pruned"]["back_turned"], 2);
  EXPECT_EQ(report["physics"]["impacts"], 2);
  EXPECT_DOUBLE_EQ(report["physics"]["mean_impulse_Ns"], 3.0);
  EXPECT_DOUBLE_EQ(report["physics"]["foreseen_agreement"], 0.5);
  EXPECT_EQ(report["seed"], 18446744073709551615u);
  EXPECT_EQ(report["hash"], hash_name(sample::timeline().hash()));
  EXPECT_EQ(report["library"]["attacks"], sample::library().count(Kind::attack));
  EXPECT_EQ(report["library"]["name"], sample::library().name());
}

TEST(Report, CountsTheActionsOfALibraryByKindAsItsBuilderDoes) {
  synthetic::Builder builder;
  synthetic::Key end;
  end.tick = 36;
  for (const auto& [name, kind] :
       {std::pair{"idle", Kind::idle}, std::pair{"jab", Kind::attack},
        std::pair{"one_two", Kind::combination}, std::pair{"one_two_three", Kind::combination}}) {
    builder.add(name, kind, {synthetic::Key{}, end});
  }
  builder.add("way", Kind::transition, {synthetic::Key{}, end}).connects = true;
  const json counts = library_counts(MotionLibrary("small", builder.take()));
  EXPECT_EQ(counts["attacks"], 1);
  EXPECT_EQ(counts["combinations"], 2);
  EXPECT_EQ(counts["idles"], 1);
  EXPECT_EQ(counts["transitions"], 0);
  EXPECT_EQ(counts["connecting"], 1);
  EXPECT_EQ(counts["actions"], 4);
}

// Who is finished where it lies falls no more; and the tree foresees strikes, not falling bodies.
TEST(Report, KnockoutsAreOfBlowsAndAgreementIsOfStrikes) {
  Timeline timeline = sample::timeline();
  std::erase_if(timeline.events,
                [](const Event& event) { return event.type == EventType::knockdown; });
  Event fall = timeline.events[2];
  ASSERT_EQ(fall.type, EventType::hit);
  fall.fall = true, fall.foreseen = false;
  timeline.events.push_back(fall);
  const json report = report_json(timeline, sample::looks(), sample::library(), facts());
  EXPECT_EQ(report["fighters"][1]["knockdowns"], 0);
  EXPECT_EQ(report["fighters"][1]["knockouts"], 1);
  EXPECT_EQ(report["physics"]["impacts"], 3);
  EXPECT_DOUBLE_EQ(report["physics"]["foreseen_agreement"], 0.5);
}

TEST(Report, AnEmptyFightHasZerosAndNoFaults) {
  const json report = report_json({}, {}, sample::library(), {});
  EXPECT_EQ(report["fighters"].size(), 0u);
  EXPECT_EQ(report["physics"]["mean_impulse_Ns"], 0.0);
  EXPECT_TRUE(report["physics"]["foreseen_agreement"].is_null());
  EXPECT_EQ(report["quality"]["penetration_max_m"], 0.0);
}

TEST(Timing, GivesPercentilesByNearestRank) {
  ClockFacts clock;
  clock.wall_s = 2;
  clock.threads = 2;
  for (int i = 1; i <= 100; ++i) clock.decision_ms.push_back(101 - i);
  const json timing = timing_json(sample::timeline(), clock);
  EXPECT_DOUBLE_EQ(timing["decision_ms"]["p50"], 50);
  EXPECT_DOUBLE_EQ(timing["decision_ms"]["p99"], 99);
  EXPECT_DOUBLE_EQ(timing["decision_ms"]["max"], 100);
  EXPECT_EQ(timing["impulse_step_us"]["p50"], 0.0);
  EXPECT_EQ(timing["threads"], 2);
  EXPECT_NEAR(timing["realtime_factor"].get<double>(), seconds(sample::timeline().end) / 2, 1e-3);
  EXPECT_TRUE(timing.contains("version"));
}

// Two fighters in guard, `apart` metres from root to root, facing each other.
Timeline standing(float apart, const char* first) {
  Timeline timeline;
  const std::vector<FighterLook> looks = sample::looks();
  timeline.tracks = {
      sample::track_of({first, "idle"}, {0, 0, 0}, looks[0].body.scale),
      sample::track_of({"idle", "idle", "idle"}, {0, apart, kPi}, looks[1].body.scale)};
  return timeline;
}

std::vector<BodyModel> bodies() {
  std::vector<BodyModel> bodies;
  for (const FighterLook& look : sample::looks()) bodies.push_back(look.body);
  return bodies;
}

TEST(Quality, BodiesApartDoNotPenetrateAndBodiesWithinEachOtherDo) {
  const FightQuality apart = quality_of(standing(2.0f, "idle"), bodies(), sample::library());
  EXPECT_EQ(apart.penetration_max_m, 0);
  const FightQuality within = quality_of(standing(0.15f, "idle"), bodies(), sample::library());
  EXPECT_GT(within.penetration_max_m, 0.1);
  EXPECT_GE(within.penetration_max_m, within.penetration_p99_m);
}

TEST(Quality, SaysWhenBodiesAreDeepestAndForHowLongTheyAreDeep) {
  const FightQuality apart = quality_of(standing(2.0f, "idle"), bodies(), sample::library());
  EXPECT_EQ(apart.penetration_max_at_s, 0);
  EXPECT_EQ(apart.penetration_longest_s, 0);
  Timeline meeting = standing(2.0f, "idle");
  std::vector<Pose>& frames = meeting.tracks[1].frames;
  const std::size_t half = frames.size() / 2;
  ASSERT_GT(half, 10u);
  for (std::size_t i = half; i < half + 10; ++i) {  // for ten ticks, deepest in the fourth
    frames[i].hips.z -= i == half + 3 ? 1.9f : 1.85f;
  }
  const FightQuality met = quality_of(meeting, bodies(), sample::library());
  EXPECT_NEAR(met.penetration_max_at_s, seconds(static_cast<Tick>(half) + 3), 1e-6);
  EXPECT_NEAR(met.penetration_longest_s, seconds(10), 1e-6);
}

TEST(Quality, TheStrikesIntendedContactIsExcepted) {
  const Timeline timeline = standing(0.62f, "jab");
  const std::vector<float> depths = penetration_by_tick(timeline, bodies(), sample::library());
  const Action& jab = sample::library().action(sample::library().find("jab"));
  const auto active = static_cast<std::size_t>(jab.strikes[0].active_begin);
  // The same frames, told to be an idle: the glove in the face counts.
  Timeline untold = timeline;
  for (Segment& segment : untold.tracks[0].segments) {
    segment.launch.action = sample::library().find("idle");
  }
  const std::vector<float> all = penetration_by_tick(untold, bodies(), sample::library());
  float told_deepest = 0, all_deepest = 0;
  for (std::size_t t = active; t < active + kIntendedContact; ++t) {
    told_deepest = std::max(told_deepest, depths[t]);
    all_deepest = std::max(all_deepest, all[t]);
  }
  EXPECT_GT(all_deepest, 0.02f);
  EXPECT_LT(told_deepest, all_deepest);
}

TEST(Quality, ABrokenKneeIsAViolationAtEveryTick) {
  Timeline timeline = standing(2.0f, "idle");
  const FightQuality before = quality_of(timeline, bodies(), sample::library());
  for (Pose& frame : timeline.tracks[1].frames) {
    frame.rotation[index(Joint::left_lower_leg)] = glm::angleAxis(radians(-40), kLeft);
  }
  const FightQuality after = quality_of(timeline, bodies(), sample::library());
  EXPECT_GE(after.joint_limit_violations,
            before.joint_limit_violations + timeline.tracks[1].frames.size());
}

// The hips carry both wrists along at 2 m/s; what answers a hit does not count.
TEST(Quality, WristSpeedsAreThoseOfChosenActions) {
  Timeline timeline = standing(2.0f, "idle");
  timeline.tracks.pop_back();
  FighterTrack& track = timeline.tracks[0];
  track.frames.assign(track.frames.size(), track.frames.front());
  for (std::size_t i = 0; i < track.frames.size(); ++i) {
    track.frames[i].hips.x += 2.0f * static_cast<float>(i) / kTicksPerSecond;
  }
  EXPECT_NEAR(quality_of(timeline, bodies(), sample::library()).wrist_speed_p99_mps, 2, 1e-3);
  for (Segment& segment : track.segments) segment.launch.forced = true;
  EXPECT_EQ(quality_of(timeline, bodies(), sample::library()).wrist_speed_p99_mps, 0);
}

}  // namespace
}  // namespace ringcraft
