// A body that falls upon another hits it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "default_library.h"
#include "physics/response.h"
#include "scene/fight.h"

namespace ringcraft {
namespace {

// Six of two teams in a close circle, each other one an opponent; the first good blow fells
// anybody.
SceneFile crowd(std::uint64_t seed, float radius) {
  auto scene = read_scene("brawl3", {"duration_s=4", "seed=" + std::to_string(seed)});
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  scene->fighters.resize(6, scene->fighters.front());
  for (std::size_t i = 0; i < scene->fighters.size(); ++i) {
    SceneFighter& fighter = scene->fighters[i];
    const float bearing = static_cast<float>(i) * kPi / 3;
    fighter.placement = {radius * std::sin(bearing), radius * std::cos(bearing),
                         wrapped_angle(bearing + kPi)};
    fighter.team = static_cast<int>(i % 2);
    fighter.health = 1;
    fighter.style.horizon_s = .6;
  }
  return std::move(*scene);
}

const Event* fall_upon_somebody(const Timeline& timeline) {
  const auto found = std::find_if(timeline.events.begin(), timeline.events.end(),
                                  [](const Event& event) { return event.fall; });
  return found == timeline.events.end() ? nullptr : &*found;
}

TEST(Fall, ABodyThatFallsUponAnotherHitsItLikeAnyOtherHit) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 8 && met == 0; ++seed) {  // until one falls upon somebody
    const FightRecord record = simulate_fight(default_library(), crowd(seed, .5f));
    const Event* hit = fall_upon_somebody(record.timeline);
    if (hit == nullptr) continue;
    ++met;
    EXPECT_TRUE(hit->type == EventType::hit || hit->type == EventType::block);
    EXPECT_GE(glm::length(hit->impulse), kTouchImpulse);
    EXPECT_GT(hit->effective_mass, 0);
    EXPECT_FALSE(hit->replay.empty());
    // Who falls was knocked down before, and hits each other fighter once.
    const auto& events = record.timeline.events;
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [&](const Event& event) {
      return event.type == EventType::knockdown && event.who == hit->who && event.tick <= hit->tick;
    }));
    EXPECT_EQ(std::count_if(events.begin(), events.end(),
                            [&](const Event& event) {
                              return event.fall && event.who == hit->who && event.whom == hit->whom;
                            }),
              1);
    if (hit->type == EventType::hit) {
      EXPECT_TRUE(std::any_of(events.begin(), events.end(), [&](const Event& event) {
        return event.who == hit->whom && event.tick == hit->tick &&
               (event.type == EventType::response || event.type == EventType::knockdown);
      }));
    }
  }
  EXPECT_GT(met, 0);
}

TEST(Fall, NobodyThrowsTheRestOfACombinationAtWhoFalls) {
  int held_back = 0;  // falls in the middle of a combination
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SceneFile scene = crowd(seed, .5f);
    scene.fighters.resize(2);
    scene.fighters[0].placement = {0, -.45f, 0};
    scene.fighters[1].placement = {0, .45f, kPi};
    const FightRecord record = simulate_fight(default_library(), scene);
    const auto& events = record.timeline.events;
    const auto fall = std::find_if(events.begin(), events.end(), [](const Event& event) {
      return event.type == EventType::knockdown;
    });
    if (fall == events.end()) continue;
    const FighterId winner(1 - fall->who.at());
    for (const Event& event : events) {
      if (event.type != EventType::strike || event.who != winner) continue;
      EXPECT_LE(event.tick, fall->tick + 12) << "seed " << seed;
    }
    for (const Segment& segment : record.timeline.tracks[winner.at()].segments) {
      if (segment.launch.start >= fall->tick || segment.launch.end <= fall->tick) continue;
      const Action& action = default_library().action(segment.launch.action);
      if (!action.attacks()) continue;
      const Tick age = fall->tick - segment.launch.start;
      held_back += action.strikes.back().active_begin > age + 14 ? 1 : 0;
      EXPECT_LT(segment.launch.end, segment.launch.start + action.length()) << "seed " << seed;
    }
  }
  EXPECT_GT(held_back, 0);
}

// Whom nobody may strike where it lies is left alone while somebody else stands.
TEST(Fall, WhoFightsSeveralTurnsToThoseThatStand) {
  int turned = 0;  // decisions of others while one is down
  for (std::uint64_t seed = 1; seed <= 12 && turned == 0; ++seed) {
    SceneFile scene = crowd(seed, .5f);
    scene.duration = 6 * kTicksPerSecond;
    scene.fighters.resize(3);
    scene.fighters[0].style = *style_named("aggressive");
    scene.fighters[0].style.horizon_s = 1;
    for (std::size_t i = 0; i < 3; ++i) {  // a giant among light ones, whom no blow puts out
      scene.fighters[i].team = static_cast<int>(i);
      scene.fighters[i].body.mass = i == 0 ? 130.0f : 40.0f;
      scene.fighters[i].body.toughness = 10;
      scene.fighters[i].health = 100'000'000;
    }
    const FightRecord record = simulate_fight(default_library(), scene);
    const auto down = [&](FighterId id, Tick tick) {
      const auto& segments = record.timeline.tracks[id.at()].segments;
      return std::any_of(segments.begin(), segments.end(), [&](const Segment& segment) {
        const Action& action = default_library().action(segment.launch.action);
        const bool lies = action.ends_lying != Lying::none || action.kind == Kind::get_up;
        return lies && segment.launch.start < tick && tick < segment.launch.end;
      });
    };
    for (const Event& event : record.timeline.events) {
      if (event.type != EventType::decision) continue;
      const FighterId third(3 - event.who.at() - event.whom.at());
      EXPECT_FALSE(down(event.whom, event.tick) && !down(third, event.tick)) << event.tick;
      turned += down(third, event.tick) ? 1 : 0;
    }
  }
  EXPECT_GT(turned, 0);
}

TEST(Fall, NobodyIsHitByAFallThatIsOutOfReach) {
  int falls = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SceneFile scene = crowd(seed, .5f);
    scene.ring = 12;
    scene.fighters.resize(4);
    for (std::size_t i = 0; i < 4; ++i) {  // two pairs, four metres apart
      scene.fighters[i].placement = {i < 2 ? -2.0f : 2.0f, i % 2 == 0 ? -.45f : .45f,
                                     i % 2 == 0 ? 0 : kPi};
    }
    const FightRecord record = simulate_fight(default_library(), scene);
    for (const Event& event : record.timeline.events) {
      falls += event.type == EventType::knockdown;
      EXPECT_FALSE(event.fall && event.who.at() / 2 != event.whom.at() / 2);
    }
  }
  EXPECT_GT(falls, 0);
}

}  // namespace
}  // namespace ringcraft
