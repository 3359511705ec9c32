#include "scene/fight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "default_library.h"
#include "io/quality.h"
#include "physics/response.h"
#include "scene/bout.h"

namespace ringcraft {
namespace {

SceneFile scene_of(const std::string& name, const std::vector<std::string>& sets) {
  auto scene = read_scene(name, sets);
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  return std::move(*scene);
}

FightRecord short_duel(std::uint64_t seed, int threads) {
  const SceneFile scene = scene_of("duel", {"duration_s=5", "seed=" + std::to_string(seed)});
  FightOptions options;
  options.threads = threads;
  return simulate_fight(default_library(), scene, options);
}

TEST(Fight, SameSeedIsTheSameFightForAnyNumberOfThreads) {
  const FightRecord one = short_duel(3, 1);
  const FightRecord again = short_duel(3, 1);
  const FightRecord two = short_duel(3, 2);
  EXPECT_EQ(one.timeline.hash(), again.timeline.hash());
  EXPECT_EQ(one.timeline.hash(), two.timeline.hash());
  EXPECT_EQ(one.counts.memo_hits, two.counts.memo_hits);
  EXPECT_EQ(one.counts.memo_misses, two.counts.memo_misses);
}

TEST(Fight, AnotherSeedIsAnotherFight) {
  EXPECT_NE(short_duel(3, 1).timeline.hash(), short_duel(4, 1).timeline.hash());
}

TEST(Fight, EveryTickOfEveryFighterIsShown) {
  const FightRecord record = short_duel(3, 2);
  for (const FighterTrack& track : record.timeline.tracks) {
    EXPECT_EQ(track.frames.size(), static_cast<std::size_t>(record.timeline.end) + 1);
    EXPECT_EQ(track.contacts.size(), track.frames.size());
  }
}

TEST(Fight, SegmentsFollowEachOtherWithoutAGap) {
  const FightRecord record = short_duel(3, 2);
  for (const FighterTrack& track : record.timeline.tracks) {
    for (std::size_t i = 1; i < track.segments.size(); ++i) {
      EXPECT_EQ(track.segments[i].launch.start, track.segments[i - 1].launch.end);
    }
  }
}

TEST(Fight, AHitIsAnsweredByAForcedResponseAtTheSameTick) {
  const FightRecord record = short_duel(3, 2);
  for (const Event& event : record.timeline.events) {
    if (event.type != EventType::hit || glm::length(event.impulse) < kTouchImpulse) continue;
    const auto& segments = record.timeline.tracks[event.whom.at()].segments;
    const bool answered =
        std::any_of(segments.begin(), segments.end(), [&](const Segment& segment) {
          return segment.launch.forced && segment.launch.start == event.tick;
        });
    const bool was_down =
        std::any_of(segments.begin(), segments.end(), [&](const Segment& segment) {
          return segment.launch.forced && segment.launch.start < event.tick &&
                 segment.launch.end > event.tick;
        });
    EXPECT_TRUE(answered || was_down) << "hit at tick " << event.tick;
  }
}

TEST(Fight, WhoStandFarApartComeTogether) {
  const SceneFile scene = scene_of(
      "duel", {"duration_s=6", "ring_m=14", "fighter.0.position=[0,-4]", "fighter.1.position=[0,4]",
               "fighter.0.style=balanced", "fighter.0.horizon_s=1.25", "fighter.1.horizon_s=1.25"});
  const FightRecord record = simulate_fight(default_library(), scene);
  const auto hips = [&](int i) {
    return record.timeline.tracks[static_cast<std::size_t>(i)].frames.back().hips;
  };
  EXPECT_LT(glm::distance(hips(0), hips(1)), 3);
}

TEST(Fight, ThreeFightersEachFaceTheirNearestOpponent) {
  const SceneFile scene = scene_of("brawl3", {"duration_s=4"});
  const FightRecord record = simulate_fight(default_library(), scene);
  ASSERT_EQ(record.timeline.tracks.size(), 3u);
  std::set<std::int32_t> deciders;
  for (const Event& event : record.timeline.events) {
    if (event.type != EventType::decision) continue;
    deciders.insert(event.who.value);
    // The opponent of a decision is the nearest fighter at that tick (all are of different teams).
    const auto place = [&](std::size_t i) {
      const Vec3 hips = record.timeline.tracks[i].frames[static_cast<std::size_t>(event.tick)].hips;
      return Vec3(hips.x, 0, hips.z);
    };
    const float chosen = glm::distance(place(event.who.at()), place(event.whom.at()));
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == event.who.at()) continue;
      EXPECT_LT(chosen, glm::distance(place(event.who.at()), place(i)) + 0.35f);  // roots, not hips
    }
  }
  EXPECT_EQ(deciders.size(), 3u);
}

// Who kicks has a team mate in the way of the leg: it stops there, and nobody else is struck.
TEST(Fight, ABlowEndsWhereATeamMateStandsInItsWay) {
  const MotionLibrary& library = default_library();
  SceneFile scene = scene_of("brawl3", {"duration_s=2"});
  scene.fighters[1].team = scene.fighters[0].team;
  scene.fighters[0].placement = {0, 0, 0};
  scene.fighters[1].placement = {-.3f, .7f, 0};
  scene.fighters[2].placement = {0, 1.2f, kPi};
  Bout bout(library, scene, {});
  const FighterId kicker(0);
  for (auto fighter = run_to_decision(bout); fighter; fighter = run_to_decision(bout)) {
    const bool kicks = *fighter == kicker && bout.state().now < kTicksPerSecond / 2;
    Plan plan;
    plan.launch = following(library, bout.state().fighters[fighter->at()].launch,
                            library.find(kicks ? "roundhouse_rear_middle" : "guard_1"),
                            bout.state().now, {0, 0, 1.05f}, 1, 0);
    bout.commit(*fighter, plan);
  }
  const FightRecord record = bout.record();
  const auto& events = record.timeline.events;
  EXPECT_TRUE(std::none_of(events.begin(), events.end(), [](const Event& event) {
    return event.type == EventType::hit || event.type == EventType::block;
  }));
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [&](const Event& event) {
                            return event.type == EventType::miss && event.who == kicker;
                          }),
            1);
  const auto fastest = [&](std::span<const Pose> poses) {  // m/s: of the foot
    const auto foot = [&](std::size_t t) {
      return world_pose(record.bodies[0].skeleton, poses[t]).position[index(Joint::right_foot)];
    };
    float most = 0;
    for (std::size_t t = 1; t < poses.size(); ++t) {
      most = std::max(most, glm::distance(foot(t), foot(t - 1)) / kTickSeconds);
    }
    return most;
  };
  // It slipped round the mate at 15.8 m/s.
  const Clip& kick = library.action(library.find("roundhouse_rear_middle")).clip;
  EXPECT_LT(fastest(record.timeline.tracks[0].frames), 1.02f * fastest(kick.frames));
}

// Nobody has an enemy left: a moment later it is over, though two still stand.
TEST(Fight, ATeamsBoutEndsWithItsLastEnemy) {
  SceneFile scene = scene_of("brawl3", {"duration_s=30"});
  scene.fighters[1].team = scene.fighters[0].team;
  scene.fighters[2].health = 1;
  for (SceneFighter& fighter : scene.fighters) fighter.style.horizon_s = .6;
  const FightRecord record = simulate_fight(default_library(), scene);
  const auto& events = record.timeline.events;
  const auto out =
      std::find_if(events.begin(), events.end(), [](const Event& event) { return event.knockout; });
  ASSERT_NE(out, events.end());
  EXPECT_EQ(out->whom, FighterId(2));
  EXPECT_LT(record.timeline.end, out->tick + 8 * kTicksPerSecond);
  EXPECT_LT(record.timeline.end, scene.duration);
  // Who has won stands in guard, and has decided on none of it.
  for (std::size_t i = 0; i < record.timeline.tracks.size(); ++i) {
    const auto& segments = record.timeline.tracks[i].segments;
    const auto own = std::count_if(segments.begin() + 1, segments.end(),
                                   [](const Segment& one) { return !one.launch.forced; });
    EXPECT_EQ(own, std::count_if(events.begin(), events.end(), [&](const Event& event) {
                return event.type == EventType::decision && event.who == FighterId(i);
              }));
  }
}

// A blow that an answer cuts short, or the end of the bout, has missed.
TEST(Fight, EveryStrikeLandsIsBlockedOrMisses) {
  const auto open = [](const Timeline& timeline) {
    std::vector<int> strikes(timeline.tracks.size(), 0);
    for (const Event& event : timeline.events) {
      const bool ends = event.type == EventType::hit || event.type == EventType::block ||
                        event.type == EventType::miss;
      if (event.type == EventType::strike) ++strikes.at(event.who.at());
      if (ends && !event.fall) --strikes.at(event.who.at());
    }
    return strikes;
  };
  const std::vector<int> none(3, 0);
  bool cut = false;
  for (int seed = 13; seed <= 40 && !cut; ++seed) {  // the first that has one
    const SceneFile scene = scene_of(
        "brawl3", {"duration_s=3", "planner.node_limit=60", "seed=" + std::to_string(seed)});
    const Timeline timeline = simulate_fight(default_library(), scene).timeline;
    EXPECT_EQ(open(timeline), none) << "seed " << seed;
    for (std::size_t i = 1; i < timeline.events.size(); ++i) {
      const Event &miss = timeline.events[i - 1], &answer = timeline.events[i];
      cut |= miss.type == EventType::miss && miss.who == answer.who && miss.tick == answer.tick &&
             (answer.type == EventType::response || answer.type == EventType::knockdown);
    }
  }
  EXPECT_TRUE(cut);
  // The bout ends as its first blow is on its way.
  SceneFile scene = scene_of("brawl3", {"duration_s=3", "planner.node_limit=60"});
  const Timeline whole = simulate_fight(default_library(), scene).timeline;
  const auto first = std::find_if(whole.events.begin(), whole.events.end(), [](const Event& event) {
    return event.type == EventType::strike;
  });
  ASSERT_NE(first, whole.events.end());
  scene.duration = first->tick;
  const Timeline shorter = simulate_fight(default_library(), scene).timeline;
  EXPECT_EQ(open(shorter), none);
  EXPECT_EQ(shorter.events.back().type, EventType::miss);
}

// Two of one team step at each other behind their jabs, so near that their arms cannot give enough.
TEST(Fight, BodiesGiveWayWhereLimbsCannot) {
  const MotionLibrary& library = default_library();
  SceneFile scene = scene_of("brawl3", {"duration_s=2"});
  scene.fighters[1].team = scene.fighters[0].team;
  scene.fighters[0].placement = {0, 0, 0};
  scene.fighters[1].placement = {0, .75f, kPi};
  scene.fighters[2].placement = {3.5f, 3.5f, kPi};
  Bout bout(library, scene, {});
  for (auto fighter = run_to_decision(bout); fighter; fighter = run_to_decision(bout)) {
    const bool jabs = fighter->at() < 2 && bout.state().now < kTicksPerSecond / 2;
    Plan plan;
    plan.launch =
        following(library, bout.state().fighters[fighter->at()].launch,
                  library.find(jabs ? "jab_step" : "guard_1"), bout.state().now, {}, 1, 0);
    bout.commit(*fighter, plan);
  }
  const FightRecord record = bout.record();
  const std::vector<float> depths = penetration_by_tick(record.timeline, record.bodies, library);
  EXPECT_LT(*std::max_element(depths.begin(), depths.end()), .03f);
}

// One boxes the air where one of its team steps back to: hands that are to strike are not meant for
// it, and push it away as the rest does.
TEST(Fight, ATeamMateIsNoTargetForWhatIsToStrike) {
  const MotionLibrary& library = default_library();
  for (const float ahead : {.7f, .8f}) {
    SceneFile scene = scene_of("brawl3", {"duration_s=1.5"});
    scene.fighters[1].team = scene.fighters[0].team;
    scene.fighters[0].placement = {0, 0, 0};
    scene.fighters[1].placement = {-.15f, ahead, 0};
    scene.fighters[2].placement = {0, 3.5f, kPi};
    Bout bout(library, scene, {});
    for (auto fighter = run_to_decision(bout); fighter; fighter = run_to_decision(bout)) {
      const std::size_t i = fighter->at();
      const Launch& last = bout.state().fighters[i].launch;
      const bool boxes = i == 0 && bout.state().now < kTicksPerSecond / 2;
      const bool steps = i == 1 && bout.state().now < kTicksPerSecond * 3 / 4;
      const char* action = boxes ? "jab_jab_cross_jab" : steps ? "step_back" : "guard_1";
      Plan plan;
      plan.launch =
          following(library, last, library.find(action), bout.state().now, {0, 0, 5}, 1, 0);
      bout.commit(*fighter, plan);
    }
    const FightRecord record = bout.record();
    const std::vector<float> depths = penetration_by_tick(record.timeline, record.bodies, library);
    // 7 ticks; 14 where they are left out.
    EXPECT_LT(std::count_if(depths.begin(), depths.end(), [](float d) { return d > .03f; }), 11);
  }
}

TEST(Fight, NobodyLeavesTheRing) {
  for (const char* seed : {"seed=7", "seed=21"}) {
    SceneFile scene =
        scene_of("duel", {"duration_s=10", seed, "ring_m=3", "fighter.0.style=outboxer"});
    scene.fighters[0].style.ropes_weight = 0;  // it retreats as far as it is let
    const FightRecord record = simulate_fight(default_library(), scene);
    float farthest = 0;
    for (const FighterTrack& track : record.timeline.tracks) {
      for (const Pose& pose : track.frames) {
        farthest = std::max({farthest, std::abs(pose.hips.x), std::abs(pose.hips.z)});
      }
    }
    EXPECT_LT(farthest, scene.ring / 2) << seed;
    EXPECT_GT(farthest, scene.ring / 2 - 0.4f) << seed;  // they come near
  }
}

}  // namespace
}  // namespace ringcraft
