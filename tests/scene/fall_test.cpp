// A body that falls upon another hits it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "default_library.h"
#include "physics/penetration.h"
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

// A light one whom three heavy ones kick wherever it is.
SceneFile gang(std::uint64_t seed) {
  auto scene = read_scene("outnumbered", {"duration_s=10", "seed=" + std::to_string(seed),
                                          "planner.hits_on_downed=true", "planner.node_limit=300",
                                          "fighter.1.style=kicker", "fighter.2.style=kicker"});
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  auto& fighters = scene->fighters;
  fighters.resize(4, fighters.back());
  for (std::size_t i = 0; i < fighters.size(); ++i) {
    const float bearing = static_cast<float>(i) * 2 * kPi / 3;
    fighters[i].body.mass = i == 0 ? 45.0f : 125.0f;
    fighters[i].placement = {1.1f * std::sin(bearing), 1.1f * std::cos(bearing),
                             wrapped_angle(bearing + kPi)};
  }
  fighters[0].placement = {};
  fighters[0].body.toughness = 3;  // falls often and is not knocked out
  return std::move(*scene);
}

// What each blow that cuts something does to a body that lies, falls or gets up.
TEST(Fall, WhoIsStruckOnTheGroundOrOnTheWayUpAnswersWithItsBody) {
  int moved = 0, felled = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const FightRecord record = simulate_fight(default_library(), gang(seed));
    const auto& events = record.timeline.events;
    EventType last = EventType::decision;  // what the light one does: falls, gets up, or fights
    bool out = false;
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Event& event = events[i];
      const bool hit = event.type == EventType::hit && event.whom == FighterId(0);
      if (hit && last == EventType::knockdown && glm::length(event.impulse) >= kTouchImpulse) {
        ASSERT_LT(i + 1, events.size());
        const Event& answer = events[i + 1];
        EXPECT_EQ(answer.type, EventType::response) << "it is down already";
        EXPECT_EQ(answer.who, FighterId(0));
        EXPECT_NE(default_library().action(default_library().find(answer.action)).ends_lying,
                  Lying::none);
        ++moved;
      }
      if (event.who != FighterId(0)) continue;
      felled += event.type == EventType::knockdown && last == EventType::getup ? 1 : 0;
      EXPECT_FALSE(out && event.type == EventType::getup);
      out = out || event.knockout;
      if (event.type == EventType::knockdown || event.type == EventType::getup ||
          event.type == EventType::decision) {
        last = event.type;
      }
    }
  }
  EXPECT_GT(moved, 0);
  EXPECT_GT(felled, 0);
}

const Event* fall_upon_somebody(const Timeline& timeline) {
  const auto found = std::find_if(timeline.events.begin(), timeline.events.end(),
                                  [](const Event& event) { return event.fall; });
  return found == timeline.events.end() ? nullptr : &*found;
}

TEST(Fall, ABodyThatFallsUponAnotherHitsItLikeAnyOtherHit) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 24 && met == 0; ++seed) {  // until one falls upon somebody
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

// From above: whether the line from one foot to the other crosses the trunk or a leg of `lies`.
bool astride(const BodyCapsules& stands, const BodyCapsules& lies) {
  const auto side = [](Vec3 a, Vec3 b, Vec3 p) {
    return (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x);
  };
  const Vec3 left = stands[index(Part::left_foot)].a, right = stands[index(Part::right_foot)].a;
  for (const Part part : {Part::pelvis, Part::abdomen, Part::chest, Part::head, Part::left_thigh,
                          Part::right_thigh, Part::left_shin, Part::right_shin}) {
    const Capsule& c = lies[index(part)];
    if (side(left, right, c.a) * side(left, right, c.b) < 0 &&
        side(c.a, c.b, left) * side(c.a, c.b, right) < 0) {
      return true;
    }
  }
  return false;
}

// Two of six are out at the first blow, and the others fight on where they lie.
TEST(Fall, WhoFightsOnDoesNotStandAstrideWhoLies) {
  Tick lain = 0, stood_astride = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SceneFile scene = crowd(seed, 1.1f);
    scene.duration = 15 * kTicksPerSecond;
    scene.ring = 5;
    for (std::size_t i = 0; i < scene.fighters.size(); ++i) {
      scene.fighters[i].team = static_cast<int>(i);
      if (i % 3 != 0) scene.fighters[i].health = 100'000;
    }
    const FightRecord record = simulate_fight(default_library(), scene);
    const auto& tracks = record.timeline.tracks;
    const auto shown = [&](std::size_t i, std::size_t tick) {
      return capsules(record.bodies[i],
                      world_pose(record.bodies[i].skeleton, tracks[i].frames[tick]));
    };
    const auto down_since = [&](std::size_t i) {
      const Launch& last = tracks[i].segments.back().launch;
      const bool fell = default_library().action(last.action).ends_lying != Lying::none;
      return fell ? last.start : kNever;
    };
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      for (Tick tick = down_since(i) + 2 * kTicksPerSecond; tick < record.timeline.end; ++tick) {
        const BodyCapsules lies = shown(i, static_cast<std::size_t>(tick));
        ++lain;
        for (std::size_t j = 0; j < tracks.size(); ++j) {
          if (down_since(j) <= tick) continue;
          stood_astride += astride(shown(j, static_cast<std::size_t>(tick)), lies) ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(lain, 100 * kTicksPerSecond);
  EXPECT_LT(stood_astride, lain / 50);
}

// Who has nobody left to fight does not stay in or over the body that lies.
TEST(Fall, WhoHasWonStepsClearOfWhoLies) {
  int won = 0, over = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SceneFile scene = crowd(seed, .5f);
    scene.duration = 10 * kTicksPerSecond;
    scene.fighters.resize(2);
    scene.fighters[0].placement = {0, -.45f, 0};
    scene.fighters[1].placement = {0, .45f, kPi};
    const FightRecord record = simulate_fight(default_library(), scene);
    const auto& events = record.timeline.events;
    const auto fall = std::find_if(events.begin(), events.end(),
                                   [](const Event& event) { return event.knockout; });
    if (fall == events.end()) continue;
    ++won;
    const auto shown = [&](std::size_t i) {
      return capsules(record.bodies[i], world_pose(record.bodies[i].skeleton,
                                                   record.timeline.tracks[i].frames.back()));
    };
    const std::size_t loser = fall->type == EventType::knockdown ? fall->who.at() : fall->whom.at();
    const BodyCapsules stands = shown(1 - loser), lies = shown(loser);
    float apart = 1;
    for (const Part foot : {Part::left_foot, Part::right_foot}) {
      for (const Capsule& part : lies) {
        const Capsule& sole = stands[index(foot)];
        apart = std::min(apart, segment_distance(sole.a, sole.b, part.a, part.b).distance -
                                    sole.radius - part.radius);
      }
    }
    over += apart < .05f || astride(stands, lies) ? 1 : 0;
  }
  EXPECT_GT(won, 0);
  EXPECT_EQ(over, 0);
}

// No forearm of who is out stands up from the floor as in the guard that the blow has found.
TEST(Fall, WhoIsOutLetsItsArmsDown) {
  const BodyModel body = make_body({});
  const Clip& guard = default_library().action(default_library().find("guard_1")).clip;
  Random random(3);
  int steep = 0;
  for (int k = 0; k < 40; ++k) {
    std::vector<Pose> continued;
    const Tick from = 1 + random.below(guard.length() - kImpulseStepTicks - 2);
    for (Tick t = 0; t <= kImpulseStepTicks; ++t) continued.push_back(guard.at(from + t));
    ImpactInput input;
    input.pose = continued.front();
    input.pose_before = guard.at(from - 1);
    input.continued = continued;
    input.contacts = guard.contacts_at(from);
    input.blow.part = Part::head;
    input.blow.effective_mass = 3;
    const float yaw = random.uniform(-kPi, kPi);
    input.blow.impulse = Vec3{std::sin(yaw), 0, std::cos(yaw)} * random.uniform(20, 60);
    input.blow.point = capsules(body, world_pose(body.skeleton, input.pose))[index(Part::head)].a;
    ImpactOutcome outcome = impulse_step(body, input);
    outcome.response = ResponseKind::knockdown;
    outcome.knockout = true;
    const Pose rests = simulate_response(body, input, outcome, {}, 3 * kTicksPerSecond).back();
    const BodyCapsules lies = capsules(body, world_pose(body.skeleton, rests));
    for (const Part part : {Part::left_forearm, Part::right_forearm}) {
      const Capsule& forearm = lies[index(part)];
      steep += forearm.b.y - forearm.a.y > .7f * glm::distance(forearm.a, forearm.b) ? 1 : 0;
    }
  }
  EXPECT_LT(steep, 5);
}

// Gloves end a hand's length beyond the wrist, and so does what props a body up.
TEST(Fall, WhoGetsUpPropsItselfUpOnTheFloor) {
  const BodyModel body = make_body({});
  int get_ups = 0;
  for (const Action& action : default_library().actions()) {
    if (action.kind != Kind::get_up) continue;
    ++get_ups;
    float lowest = 1;
    for (Tick tick = 0; tick <= action.clip.length(); ++tick) {
      const BodyCapsules c = capsules(body, world_pose(body.skeleton, action.clip.at(tick)));
      for (const Part part : {Part::left_hand, Part::right_hand}) {
        const Capsule& glove = c[index(part)];
        lowest = std::min(lowest, std::min(glove.a.y, glove.b.y) - glove.radius);
      }
    }
    EXPECT_GT(lowest, -.035f) << action.name;
  }
  EXPECT_GT(get_ups, 3);
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
