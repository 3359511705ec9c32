#include <gtest/gtest.h>

#include "default_library.h"
#include "planner/condition.h"
#include "scene/fight.h"

namespace ringcraft {
namespace {

SceneFile duel(const std::string& seconds) {
  auto scene = read_scene("duel", {"duration_s=" + seconds});
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  for (SceneFighter& fighter : scene->fighters) fighter.style.horizon_s = 0.75;
  return std::move(*scene);
}

TEST(Life, ErrorsOfExecutionAreSeededAndChangeTheFight) {
  SceneFile scene = duel("4");
  const auto hash = [&] { return simulate_fight(default_library(), scene).timeline.hash(); };
  const std::uint64_t exact = hash();
  for (SceneFighter& fighter : scene.fighters) {
    fighter.style.aim_error_deg = 5;
    fighter.style.speed_error = 0.05;
  }
  const std::uint64_t erring = hash();
  EXPECT_NE(erring, exact);
  EXPECT_EQ(erring, hash());
}

// A launch of an erring fighter is not the planned one; the tree does not know by how much.
TEST(Life, SpeedErrorsChangeHowLongLaunchesLast) {
  SceneFile scene = duel("5");
  for (SceneFighter& fighter : scene.fighters) fighter.style.speed_error = 0.1;
  const FightRecord record = simulate_fight(default_library(), scene);
  int shorter = 0, longer = 0;
  for (const FighterTrack& track : record.timeline.tracks) {
    for (std::size_t i = 1; i + 1 < track.segments.size(); ++i) {
      const Launch& launch = track.segments[i].launch;
      EXPECT_EQ(launch.end, track.segments[i + 1].launch.start);
      if (launch.forced) continue;
      const Tick length = launch.end - launch.start;
      EXPECT_LE(launch.end, launch.when(default_library().action(launch.action).length()));
      longer += length > default_library().action(launch.action).length();
      shorter += length < default_library().action(launch.action).length();
    }
    EXPECT_EQ(track.frames.size(), static_cast<std::size_t>(record.timeline.end) + 1);
  }
  EXPECT_GT(longer, 0);
  EXPECT_GT(shorter, 0);
}

TEST(Life, FightersTireAndAreHurtOnlyWhereTheirStyleSaysSo) {
  SceneFile scene = duel("8");
  scene.fighters[0].style.fatigue = 10;
  scene.fighters[0].style.injury = 5;
  const FightRecord record = simulate_fight(default_library(), scene);
  ASSERT_EQ(record.condition.size(), 2u);
  EXPECT_GT(record.condition[0].fatigue(), 0.3);
  EXPECT_EQ(record.condition[1].fatigue(), 0);
  for (std::size_t limb = 0; limb < kLimbs; ++limb) {
    EXPECT_EQ(record.condition[1].injury(limb), 0);
  }
  float most = 0;
  for (const Event& event : record.timeline.events) {
    if (event.type != EventType::strike) continue;
    if (event.who == FighterId(0)) most = std::max(most, event.fatigue);
    if (event.who == FighterId(1)) {
      EXPECT_EQ(event.fatigue, 0);
    }
  }
  EXPECT_GT(most, 0.1f);
}

// A tired body has less tone: the tree is told of it, and foresees what it does. In each of these
// fights a body of full tone would once have answered otherwise.
TEST(Life, TheTreeForeseesWhatTiredBodiesDo) {
  int hits = 0, foreseen = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SceneFile scene = duel("12");
    scene.seed = seed;
    for (SceneFighter& fighter : scene.fighters) fighter.style.fatigue = 100;
    for (const Event& event : simulate_fight(default_library(), scene).timeline.events) {
      if (event.type != EventType::hit && event.type != EventType::block) continue;
      ++hits;
      foreseen += event.foreseen ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 10);
  EXPECT_LE(hits - foreseen, 1) << hits;
}

}  // namespace
}  // namespace ringcraft
