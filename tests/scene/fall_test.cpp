// A body that falls upon another hits it.
#include <gtest/gtest.h>

#include <algorithm>

#include "default_library.h"
#include "physics/response.h"
#include "scene/fight.h"

namespace ringcraft {
namespace {

// Red knocks blue out, and green, who is on blue's side, stands behind it.
SceneFile scene_with_somebody_behind(std::uint64_t seed, float behind) {
  auto scene = read_scene("brawl3", {"duration_s=2.5", "seed=" + std::to_string(seed)});
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  SceneFighter &red = scene->fighters[0], &blue = scene->fighters[1], &green = scene->fighters[2];
  red.placement = {0, -.45f, 0};
  blue.placement = {0, .45f, kPi};
  green.placement = {0, .45f + behind, kPi};
  green.team = blue.team;
  blue.health = 1;
  for (SceneFighter& fighter : scene->fighters) fighter.style.horizon_s = .6;
  return std::move(*scene);
}

const Event* fall_upon_somebody(const Timeline& timeline) {
  const auto found = std::find_if(timeline.events.begin(), timeline.events.end(),
                                  [](const Event& event) { return event.fall; });
  return found == timeline.events.end() ? nullptr : &*found;
}

TEST(Fall, ABodyThatFallsUponAnotherHitsItLikeAnyOtherHit) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const FightRecord record =
        simulate_fight(default_library(), scene_with_somebody_behind(seed, .4f));
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

TEST(Fall, NobodyIsHitByAFallThatIsOutOfReach) {
  const FightRecord record = simulate_fight(default_library(), scene_with_somebody_behind(1, 3.0f));
  const auto& events = record.timeline.events;
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const Event& event) {
    return event.type == EventType::knockdown && event.who == FighterId(1);
  }));
  EXPECT_TRUE(std::none_of(events.begin(), events.end(), [](const Event& event) {
    return event.fall && event.whom == FighterId(2) && event.who == FighterId(1);
  }));
}

}  // namespace
}  // namespace ringcraft
