// Bouts of a study: scenes, counts, results that no thread changes, and the library slowed down.

#include "scene/study_bouts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "default_library.h"
#include "fight/synthetic_fixture.h"
#include "scene/study_slowed.h"

namespace ringcraft {
namespace {

class StudyBoutsTest : public SyntheticFixture {
 protected:
  static SceneFile scene() {
    SceneFile scene;
    scene.fighters.resize(2);
    scene.planner.node_limit = 400;
    return scene;
  }
  static Pairing pairing() {
    Style style;
    style.horizon_s = 0.6;
    return *horizon_pairing("0.8v0.4", style);
  }
};

TEST_F(StudyBoutsTest, PairingReadsTwoHorizons) {
  const auto pairing = horizon_pairing("3v2.5", {});
  ASSERT_TRUE(pairing);
  EXPECT_DOUBLE_EQ(pairing->side[0].horizon_s, 3);
  EXPECT_DOUBLE_EQ(pairing->side[1].horizon_s, 2.5);
  for (const char* wrong : {"3", "v1", "3v", "3v1s", "3v99", "3v-1", ""}) {
    EXPECT_FALSE(horizon_pairing(wrong, {})) << wrong;
  }
}

TEST_F(StudyBoutsTest, SidesSwapFromOneStart) {
  const BoutSeries series{4, 10, 8};
  const SceneFile even = bout_scene(scene(), pairing(), series, 2);
  const SceneFile odd = bout_scene(scene(), pairing(), series, 3);
  const SceneFile next = bout_scene(scene(), pairing(), series, 4);
  EXPECT_EQ(even.seed, odd.seed);
  EXPECT_NE(even.seed, next.seed);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(even.fighters[i].placement, odd.fighters[i].placement);
    EXPECT_EQ(even.fighters[i].style.horizon_s, odd.fighters[1 - i].style.horizon_s);
  }
  const Vec3 apart = even.fighters[0].placement.position() - even.fighters[1].placement.position();
  EXPECT_GT(glm::length(apart), 1.5f);
  EXPECT_LT(glm::length(apart), 3.2f);
  EXPECT_EQ(even.planner.ring_half_m, 4);
}

// A copy of a style with one weight changed keeps its name: it is another style all the same.
TEST_F(StudyBoutsTest, OnlyAStyleThatFightsItselfStartsEveryBoutAnew) {
  Pairing itself;
  const BoutSeries series{4, 10, 8};
  EXPECT_NE(bout_scene(scene(), itself, series, 2).seed,
            bout_scene(scene(), itself, series, 3).seed);
  itself.side[1].caution += 1;
  EXPECT_EQ(bout_scene(scene(), itself, series, 2).seed,
            bout_scene(scene(), itself, series, 3).seed);
}

TEST_F(StudyBoutsTest, ThreadsAndASharedStoreChangeNoResult) {
  const BoutSeries series{4, 3, 6};
  StudyRun one, two;
  two.threads = 2;
  const auto a = run_pairings(library(), scene(), {pairing()}, series, one);
  const auto b = run_pairings(library(), scene(), {pairing()}, series, two);
  Study first, second;
  fill_bouts(first, a);
  fill_bouts(second, b);
  EXPECT_EQ(a.front().bouts.size(), 4u);
  EXPECT_EQ(study_csv(first.table), study_csv(second.table));
  EXPECT_EQ(study_svg(first), study_svg(second));
  // Bout 1 alone, without a store, is the same bout.
  const FightRecord alone = simulate_fight(library(), bout_scene(scene(), pairing(), series, 1));
  const BoutTally tally = tally_of(alone);
  EXPECT_EQ(tally.side[1].damage, a.front().bouts[1].side[0].damage);  // the sides were swapped
  EXPECT_EQ(tally.side[0].attacks, a.front().bouts[1].side[1].attacks);
}

TEST_F(StudyBoutsTest, TallyCountsWhatTheEventsSay) {
  FightRecord record;
  Timeline& timeline = record.timeline;
  timeline.end = ticks(10);
  timeline.tracks.resize(2);
  const auto add = [&](Tick tick, EventType type, std::size_t who, float damage) -> Event& {
    Event event;
    event.tick = tick;
    event.type = type;
    event.who = FighterId(who);
    event.damage = damage;
    timeline.events.push_back(event);
    return timeline.events.back();
  };
  add(120, EventType::strike, 0, 0);
  add(130, EventType::hit, 0, 4);
  add(130, EventType::response, 1, 0);
  add(600, EventType::block, 1, 1);
  BoutTally tally = tally_of(record);
  EXPECT_EQ(tally.side[0].hits, 1);
  EXPECT_EQ(tally.side[1].hits, 0);
  EXPECT_DOUBLE_EQ(tally.side[1].damage, 1);
  EXPECT_EQ(tally.winner, 0);
  EXPECT_DOUBLE_EQ(tally.quiet_s, seconds(1200 - 600));
  add(650, EventType::hit, 1, 9).fall = true;  // a falling body's
  tally = tally_of(record);
  EXPECT_EQ(tally.side[1].hits, 0);
  EXPECT_EQ(tally.winner, 0);
  add(700, EventType::hit, 1, 1).knockout = true;
  add(700, EventType::knockdown, 0, 0);  // who falls is who acts
  tally = tally_of(record);
  EXPECT_EQ(tally.winner, 1);
  EXPECT_EQ(tally.side[1].knockdowns, 1);
  add(700, EventType::hit, 0, 1).knockout = true;  // both at once
  EXPECT_EQ(tally_of(record).winner, -1);
}

TEST_F(StudyBoutsTest, TableSaysLeadDrawsQuietAndTheMostUsedAction) {
  PairingResult result;
  result.pairing = pairing();
  for (int i = 1; i <= 5; ++i) {
    BoutTally bout;
    bout.side[0].damage = i;
    bout.seconds = 60;
    bout.quiet_s = 2 * i;
    bout.winner = i == 1 ? -1 : 0;
    bout.most_used = 0.1 * i;
    bout.most_used_action = i == 5 ? "jab" : "cross";
    result.bouts.push_back(bout);
  }
  Study study;
  fill_bouts(study, {result});
  ASSERT_EQ(study.table.columns.size(), study.table.rows.front().size());
  const auto cell = [&](const std::string& column) {
    const auto& columns = study.table.columns;
    const auto at = std::find(columns.begin(), columns.end(), column);
    EXPECT_NE(at, columns.end()) << column;
    return study.table.rows.front()[static_cast<std::size_t>(at - columns.begin())];
  };
  EXPECT_DOUBLE_EQ(std::get<double>(cell("draw_share")), 0.2);
  EXPECT_DOUBLE_EQ(std::get<double>(cell("lead_points")), 3);
  EXPECT_NEAR(std::get<double>(cell("lead_low")), 3 - 1.963, 0.01);  // t = 2.776, s = 1.581
  EXPECT_NEAR(std::get<double>(cell("lead_high")), 3 + 1.963, 0.01);
  EXPECT_DOUBLE_EQ(std::get<double>(cell("mean_quiet_s")), 6);
  EXPECT_EQ(std::get<std::string>(cell("most_used_action")), "jab");
  EXPECT_EQ(std::get<std::int64_t>(cell("bouts_without_contact")), 5);
}

TEST_F(StudyBoutsTest, MostUsedActionOfASideIsCountedOverAllBoutsOfItsPairing) {
  // Of three launches of a bout that ends soon a third is the least that one action can have.
  const auto bout_of = [](const std::vector<std::string>& first,
                          const std::vector<std::string>& second) {
    FightRecord record;
    record.timeline.tracks.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
      record.timeline.tracks[i].segments.emplace_back().name = "opening";  // nobody chose it
      for (const std::string& name : i == 0 ? first : second) {
        Segment segment;
        segment.name = name;
        record.timeline.tracks[i].segments.push_back(segment);
      }
    }
    record.timeline.tracks[0].segments.emplace_back().name = "absorb";
    record.timeline.tracks[0].segments.back().launch.forced = true;
    return tally_of(record);
  };
  PairingResult result;
  result.pairing = pairing();
  result.bouts.push_back(bout_of({"jab", "jab", "step"}, {"slip"}));
  result.bouts.push_back(bout_of({"cross", "hook", "kick", "knee", "jab"}, {"slip", "parry"}));
  Study study;
  fill_bouts(study, {result});
  const auto cell = [&](const std::string& column) {
    const auto& columns = study.table.columns;
    const auto at = std::find(columns.begin(), columns.end(), column);
    EXPECT_NE(at, columns.end()) << column;
    return study.table.rows.front()[static_cast<std::size_t>(at - columns.begin())];
  };
  ASSERT_EQ(study.table.columns.size(), study.table.rows.front().size());
  EXPECT_DOUBLE_EQ(std::get<double>(cell("a_most_used_share")), 3.0 / 8);
  EXPECT_EQ(std::get<std::string>(cell("a_most_used_action")), "jab");
  EXPECT_DOUBLE_EQ(std::get<double>(cell("b_most_used_share")), 2.0 / 3);
  EXPECT_EQ(std::get<std::string>(cell("b_most_used_action")), "slip");
  EXPECT_DOUBLE_EQ(std::get<double>(cell("most_used_share")), 1);  // the worst bout's
  EXPECT_EQ(std::get<std::string>(cell("most_used_action")), "slip");
}

TEST_F(StudyBoutsTest, NearlyEqualDamageIsADraw) {
  FightRecord record;
  record.timeline.end = 1200;
  record.timeline.tracks.resize(2);
  EXPECT_EQ(tally_of(record).winner, -1);
  EXPECT_FALSE(tally_of(record).contact);
}

TEST_F(StudyBoutsTest, StoppedStudyKeepsNothingUnfinished) {
  std::atomic<bool> stop{true};
  StudyRun run;
  run.interrupted = &stop;
  const auto results = run_pairings(library(), scene(), {pairing()}, {2, 3, 6}, run);
  Study study;
  fill_bouts(study, results);
  EXPECT_TRUE(study.table.rows.empty());
  EXPECT_TRUE(study.timing.rows.empty());
}

TEST(StudySlowedTest, BlowsKeepTheirSpeedAndTheRestIsSlower) {
  const MotionLibrary library = synthetic::library();
  const Action& cross = library.action(library.find("cross"));
  const Action slow = slowed(cross, 2.2f);
  EXPECT_TRUE(faults(slow.clip).empty());
  EXPECT_GT(slow.length(), cross.length() * 5 / 4);
  const auto peak = [&](const Action& action) {
    float most = 0;
    const Strike& strike = action.strikes.front();
    for (Tick t = strike.active_begin; t < strike.active_end; ++t) {
      const auto at = [&](Tick tick) {
        return world_pose(library.skeleton(), action.clip.at(tick)).position[index(strike.joint)];
      };
      most = std::max(most, glm::distance(at(t), at(t - 1)) / kTickSeconds);
    }
    return most;
  };
  EXPECT_NEAR(peak(slow), peak(cross), 0.05f * peak(cross));
  const Action& step = library.action(library.find("step_back"));
  EXPECT_NEAR(static_cast<double>(slowed(step, 2.2f).length()), 2.2 * step.length(), 2);
  const Placement end = step.clip.root.back(), slow_end = slowed(step, 2.2f).clip.root.back();
  EXPECT_NEAR(end.z, slow_end.z, 1e-4);
}

TEST(StudySlowedTest, EveryBlowIsAsFastAndComesLaterLikeItsAnswers) {
  const MotionLibrary& library = default_library();
  const auto fastest = [&](const Action& action, const Strike& strike) {
    float most = 0;
    for (Tick t = strike.active_begin; t < strike.active_end; ++t) {
      const Vec3 from =
          world_pose(library.skeleton(), action.clip.at(t - 1)).position[index(strike.joint)];
      const Vec3 to =
          world_pose(library.skeleton(), action.clip.at(t)).position[index(strike.joint)];
      most = std::max(most, glm::distance(from, to) / kTickSeconds);
    }
    return most;
  };
  int strikes = 0;
  for (const ActionId id : library.launchable()) {
    const Action& action = library.action(id);
    const Action slow = slowed(action, 2.2f);
    for (std::size_t i = 0; i < action.strikes.size(); ++i, ++strikes) {
      const float speed = fastest(action, action.strikes[i]);
      EXPECT_NEAR(fastest(slow, slow.strikes[i]), speed, 0.001f * speed) << action.name;
    }
    if (action.strikes.empty()) continue;
    EXPECT_GT(slow.strikes[0].active_begin, 1.6 * action.strikes[0].active_begin) << action.name;
  }
  EXPECT_GT(strikes, 50);
}

TEST(StudySlowedTest, MostActionsAreLongerThanASecond) {
  const MotionLibrary& library = default_library();
  EXPECT_LT(share_longer(library, 1), 0.5);
  EXPECT_GT(share_longer(slowed_library(library, 2.2f), 1), 0.5);
  EXPECT_EQ(share_longer(library, 0), 1);
  EXPECT_EQ(share_longer(library, 100), 0);
}

TEST(StudySlowedTest, ResponsesAreNotTouched) {
  const MotionLibrary library = synthetic::library();
  const MotionLibrary slow = slowed_library(library, 2.2f);
  EXPECT_GT(mean_choice_seconds(slow), 1.5 * mean_choice_seconds(library));
  for (const ActionId id : library.responses()) {
    const ActionId same = slow.find(library.action(id).name);
    ASSERT_TRUE(same.valid());
    EXPECT_EQ(slow.action(same).length(), library.action(id).length());
  }
}

}  // namespace
}  // namespace ringcraft
