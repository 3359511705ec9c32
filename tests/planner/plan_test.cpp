#include "planner/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include <set>
#include <string>

#include "planner/duel_fixture.h"
#include "planner/soft_choice.h"

namespace ringcraft {
namespace {

class PlanTest : public DuelFixture {
 protected:
  static Style quick() {
    Style style;
    style.horizon_s = 0.9;
    style.candidates = 5;
    return style;
  }
  static void expect_same(const Plan& a, const Plan& b) {
    EXPECT_EQ(a.launch, b.launch);
    EXPECT_EQ(a.record.nodes, b.record.nodes);
    EXPECT_EQ(a.record.leaves, b.record.leaves);
    EXPECT_EQ(a.record.forced_nodes, b.record.forced_nodes);
    EXPECT_EQ(a.record.pruned_unanswered_hit, b.record.pruned_unanswered_hit);
    EXPECT_EQ(a.record.pruned_back_turned, b.record.pruned_back_turned);
    EXPECT_EQ(a.record.pruned_penetration, b.record.pruned_penetration);
    EXPECT_EQ(a.record.pruned_candidates, b.record.pruned_candidates);
    EXPECT_EQ(a.record.chosen, b.record.chosen);
    ASSERT_EQ(a.record.lines.size(), b.record.lines.size());
    for (std::size_t i = 0; i < a.record.lines.size(); ++i) {
      EXPECT_EQ(a.record.lines[i].actions, b.record.lines[i].actions);
      EXPECT_EQ(a.record.lines[i].score, b.record.lines[i].score);
    }
    EXPECT_EQ(a.foreseen.size(), b.foreseen.size());
  }
};

TEST_F(PlanTest, SameForAnyNumberOfThreads) {
  PlanSettings one, many;
  many.threads = 3;
  Planner a(library(), contenders(2, quick()), one, 5),
      b(library(), contenders(2, quick()), many, 5);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const FightState state = random_state(seed);
    expect_same(a.plan(state, FighterId(0)), b.plan(state, FighterId(0)));
    EXPECT_EQ(a.memo_counts().hits, b.memo_counts().hits);
    EXPECT_EQ(a.memo_counts().misses, b.memo_counts().misses);
  }
}

TEST_F(PlanTest, SameSeedTwiceAndAWarmMemoChangesNothing) {
  const FightState state = random_state(11);
  Planner a(library(), contenders(2, quick()), {}, 5), b(library(), contenders(2, quick()), {}, 5);
  b.plan(random_state(12), FighterId(1));  // fills the memo
  const Plan first = a.plan(state, FighterId(0));
  expect_same(first, b.plan(state, FighterId(0)));
  expect_same(first, a.plan(state, FighterId(0)));
  EXPECT_EQ(a.memo_counts().misses > 0, true);
}

TEST_F(PlanTest, AFighterOfHalfTheSizeStandsHalfAsFarOff) {
  Style style = quick();
  style.distance_m = 1.4;
  style.location_weight = 100;
  // Points for where it stands on its best line.
  const auto place = [&](float scale, float apart) {
    std::vector<Contender> two = contenders(2, style);
    two[0].body = make_body({.height = scale * kCanonicalHeight});
    const Plan plan = Planner(library(), two, {}, 1).plan(facing(apart), FighterId(0));
    return (*plan.record.lines.front().terms)[0].location;
  };
  EXPECT_GT(place(1, 1.4f), place(1, 0.7f));
  EXPECT_GT(place(0.5f, 0.7f), place(0.5f, 1.4f));
}

TEST_F(PlanTest, SeedsChooseDifferentlyAmongNearlyEqualMovesOnly) {
  Style soft = quick();
  soft.temperature = 3;
  const FightState state = random_state(2);
  std::set<std::string> chosen;
  Style best = soft;
  best.temperature = 0;
  const Plan sure = Planner(library(), contenders(2, best), {}, 1).plan(state, FighterId(0));
  const double least = sure.record.lines[0].score - 1000 * SoftChoice::kMostBelow * 3;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Planner planner(library(), contenders(2, soft), {}, seed);
    const Plan plan = planner.plan(state, FighterId(0));
    const Line& line = plan.record.lines[static_cast<std::size_t>(plan.record.chosen)];
    chosen.insert(line.actions.front());
    EXPECT_FALSE(line.at_most);
    EXPECT_GE(line.score, least);
  }
  EXPECT_GT(chosen.size(), 1u);
  soft.temperature = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Planner planner(library(), contenders(2, soft), {}, seed);
    EXPECT_EQ(planner.plan(state, FighterId(0)).record.chosen, 0);
  }
}

TEST_F(PlanTest, AlphaBetaAndMinimaxPlanTheSame) {
  Style style = quick();
  style.candidates = 4;
  style.horizon_s = 0.75;
  style.temperature = 0.5;
  PlanSettings plain;
  plain.alpha_beta = false;
  plain.node_limit = 0;
  PlanSettings fast;
  fast.node_limit = 0;
  Planner a(library(), contenders(2, style), plain, 1), b(library(), contenders(2, style), fast, 1);
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const FightState state = random_state(seed);
    const Plan truth = a.plan(state, FighterId(0)), plan = b.plan(state, FighterId(0));
    EXPECT_EQ(truth.record.lines[0].score, plan.record.lines[0].score);
    EXPECT_EQ(truth.launch, plan.launch);
    EXPECT_LT(plan.record.nodes, truth.record.nodes);
  }
}

TEST_F(PlanTest, LaunchFollowsFromTheStateMachine) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  const FightState state = random_state(4);
  const Plan plan = planner.plan(state, FighterId(0));
  const Launch& last = state.fighters[0].launch;
  ASSERT_NE(library().machine().edge(last.action, plan.launch.action), nullptr);
  EXPECT_EQ(plan.launch.start, state.now);
  EXPECT_EQ(plan.launch.end, state.now + library().action(plan.launch.action).length());
  const std::string& name = library().action(plan.launch.action).name;
  EXPECT_EQ(plan.record.lines[static_cast<std::size_t>(plan.record.chosen)].actions[0], name);
  // The tree placed it where the fight will.
  const DuelNode root = Duel::root(setup_, state);
  Duel game(setup_, 240);
  const DuelNode child = game.apply(root, choice(root, 0, name.c_str())).node;
  const Launch& mine = child.side[0].flight.launch;
  EXPECT_NEAR(mine.placement.x, plan.launch.placement.x, 1e-5f);
  EXPECT_NEAR(mine.placement.z, plan.launch.placement.z, 1e-5f);
  EXPECT_NEAR(mine.aim, plan.launch.aim, 1e-5f);
}

TEST_F(PlanTest, LinesComeBestFirstAndNameActors) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  FightState state = random_state(4);
  state.fighters[1].launch.end = state.now;
  state.fighters[1].launch.start = state.now - 36;
  const Plan plan = planner.plan(state, FighterId(1));
  ASSERT_GT(plan.record.lines.size(), 1u);
  ASSERT_LE(plan.record.lines.size(), 6u);
  for (std::size_t i = 0; i < plan.record.lines.size(); ++i) {
    const Line& line = plan.record.lines[i];
    EXPECT_EQ(line.actions.size(), line.actors.size());
    EXPECT_EQ(line.actors[0], 1);
    if (i == 0) continue;
    const Line& before = plan.record.lines[i - 1];
    EXPECT_LE(before.at_most, line.at_most);
    if (before.at_most == line.at_most) {
      EXPECT_LE(line.score, before.score);
    }
  }
  EXPECT_GT(plan.record.leaves, 0u);
  EXPECT_GT(plan.record.nodes, plan.record.leaves);
}

TEST_F(PlanTest, TermsOfALineAddUpToItsScore) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  int lines = 0, with_terms = 0;
  bool location = false, hit = false, control = false;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const DecisionRecord record = planner.plan(random_state(seed), FighterId(0)).record;
    for (const Line& line : record.lines) {
      lines += line.at_most ? 0 : 1;
      if (!line.terms) continue;
      ++with_terms;
      std::int32_t sum = 0;
      for (const LineTerms& of : *line.terms) {
        sum += of.location + of.hit + of.defense + of.control;
        location |= of.location != 0, hit |= of.hit != 0, control |= of.control != 0;
      }
      EXPECT_EQ(sum, line.score);
      EXPECT_FALSE(line.at_most);
    }
  }
  EXPECT_GT(with_terms, lines / 2);
  EXPECT_TRUE(location && hit && control);
}

TEST_F(PlanTest, FirstMovesThatWereStruckOffAreNamedWithTheirRules) {
  Style style = quick();
  style.temperature = 0;
  Planner planner(library(), contenders(2, style), {}, 3);
  // An attack of the opponent is under way, old enough to be seen: not to defend is struck off.
  FightState state = facing(0.7f);
  state.fighters[1].launch = launch("cross", -31, {0, 0.35f, kPi});
  const DecisionRecord record = planner.plan(state, FighterId(0)).record;
  ASSERT_FALSE(record.struck_off.empty());
  for (const StruckOff& one : record.struck_off) {
    EXPECT_FALSE(one.rules.empty()) << one.action;
    EXPECT_TRUE(library().find(one.action).valid());
    for (const Line& line : record.lines) EXPECT_NE(line.actions.front(), one.action);
  }
  PlanSettings nothing;
  nothing.prune.unanswered_hit = nothing.prune.back_turned = nothing.prune.penetration = false;
  Planner kept(library(), contenders(2, style), nothing, 3);
  EXPECT_TRUE(kept.plan(state, FighterId(0)).record.struck_off.empty());
}

TEST_F(PlanTest, NodeLimitShortensTheHorizonButAlwaysAnswers) {
  Style style = quick();
  style.horizon_s = 2;
  const FightState state = random_state(1);
  Tick last = 0;
  for (const std::uint64_t limit : {5, 200, 1500, 20'000}) {
    PlanSettings settings;
    settings.node_limit = limit;
    Planner planner(library(), contenders(2, style), settings, 3);
    const Plan plan = planner.plan(state, FighterId(0));
    EXPECT_TRUE(plan.launch.action.valid());
    EXPECT_LE(plan.record.nodes, std::max<std::uint64_t>(limit, 10));
    EXPECT_GE(plan.record.horizon, last);
    last = plan.record.horizon;
  }
  EXPECT_GT(last, ticks(1.0));
}

// What no horizon was finished for is weighed by one step, under the same rules.
TEST_F(PlanTest, AMoveWeighedByItsFirstStepIsNoneThatTheRulesStrikeOff) {
  PlanSettings tight;
  tight.node_limit = 1;
  int struck_off = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Planner planner(library(), contenders(2, quick()), tight, seed);
    FightState state = random_state(seed);
    state.fighters[1].launch = launch("front_kick", -70, state.fighters[1].launch.placement);
    const Plan plan = planner.plan(state, FighterId(0));
    ASSERT_EQ(plan.record.nodes, plan.record.lines.size());
    EXPECT_LT(plan.record.pruned_candidates, library().actions().size());
    for (const StruckOff& one : plan.record.struck_off) {
      ++struck_off;
      EXPECT_NE(one.action, library().action(plan.launch.action).name) << seed;
    }
  }
  EXPECT_GT(struck_off, 10);
}

TEST_F(PlanTest, FallenFighterGetsUp) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  FightState state = facing(1.5f, 20);
  state.fighters[0].balance = 2;
  state.fighters[0].launch = launch("knockdown_back", -150, state.fighters[0].launch.placement);
  const Plan plan = planner.plan(state, FighterId(0));
  EXPECT_EQ(library().action(plan.launch.action).kind, Kind::get_up);
  EXPECT_TRUE(plan.launch.forced);
}

// Where nobody strikes who is down, the other stands back; where the scene lets it, it stays.
TEST_F(PlanTest, WhoLiesIsGivenRoomToRise) {
  const auto distance_after = [&](bool hits_on_downed) {
    PlanSettings settings;
    settings.hits_on_downed = hits_on_downed;
    Planner planner(library(), contenders(2, quick()), settings, 3);
    FightState state = facing(.9f, 20);
    state.fighters[1].balance = 2;
    state.fighters[1].launch = launch("knockdown_back", -30, state.fighters[1].launch.placement);
    for (int decisions = 0; decisions < 3; ++decisions) {
      const Plan plan = planner.plan(state, FighterId(0));
      state.fighters[0].launch = plan.launch;
      state.now = plan.launch.end;
    }
    const Placement at = root_at(library(), state.fighters[0].launch, state.now, 1);
    return glm::distance(at.position(), state.fighters[1].launch.placement.position());
  };
  EXPECT_GT(distance_after(false), distance_after(true) + .3f);
}

TEST_F(PlanTest, ForeseenEventsAreThoseOfTheChosenLine) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  int hits = 0;
  for (const float distance : {0.75f, 0.85f, 0.95f, 1.05f}) {
    FightState state = facing(distance);
    // The opponent has just begun a long kick at nobody: somewhere it can be hit.
    state.fighters[1].launch = launch("front_kick", -70, state.fighters[1].launch.placement);
    const Plan plan = planner.plan(state, FighterId(0));
    for (const Event& event : plan.foreseen) {
      EXPECT_GT(event.tick, state.now);
      EXPECT_LE(event.tick, state.now + plan.record.horizon);
      EXPECT_NE(event.who, event.whom);
      hits += event.who == FighterId(0) && event.type != EventType::miss && event.damage > 0;
    }
  }
  EXPECT_GT(hits, 0);
}

TEST_F(PlanTest, ForeseesWhatTheActionsInFlightDoWithoutADecision) {
  const Planner planner(library(), contenders(2, quick()), {}, 3);
  FightState state = facing(0.95f);
  state.now = 1;
  state.fighters[0].launch = launch("cross", 0, state.fighters[0].launch.placement);
  state.fighters[1].launch = launch("idle", 0, state.fighters[1].launch.placement);
  const std::vector<Event> seen = planner.foresee(state, FighterId(0));
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NE(seen[0].type, EventType::miss);
  EXPECT_EQ(seen[0].whom, FighterId(1));
  EXPECT_EQ(seen[0].action, "cross");
  EXPECT_GE(seen[0].tick, 20);  // while the cross can hit
  EXPECT_LT(seen[0].tick, 31);
  state.fighters[0].launch.spent = 1;  // a blow that has landed lands no more
  EXPECT_TRUE(planner.foresee(state, FighterId(0)).empty());
  state.fighters[1].launch.placement.z += 1;  // out of reach
  state.fighters[0].launch.spent = 0;
  EXPECT_TRUE(planner.foresee(state, FighterId(0)).empty());
}

// The head is out of the way, or the fist comes late, though both clips meet: the tree goes by what
// is shown.
TEST_F(PlanTest, ForeseesBodiesAsTheyAreShown) {
  FightState state = facing(0.95f);
  state.now = 1;
  state.fighters[0].launch = launch("cross", 0, state.fighters[0].launch.placement);
  state.fighters[1].launch = launch("idle", 0, state.fighters[1].launch.placement);
  const float scale = make_body({}).scale;
  const auto shown = [&](std::size_t who, Tick every, Vec3 moved) {
    MotionInFlight motion;
    motion.launch = state.fighters[who].launch;
    motion.from = state.now;
    for (Tick t = motion.launch.start; t <= motion.launch.end; ++t) {
      motion.clip_ages.push_back((t - motion.launch.start) / every);
      if (t < motion.from) continue;
      Pose pose =
          pose_at(library(), motion.launch, motion.launch.start + motion.clip_ages.back(), scale);
      pose.hips += moved;
      motion.poses.push_back(pose);
    }
    return motion;
  };
  Planner planner(library(), contenders(2, quick()), {}, 3);
  const std::vector<Event> clips = planner.foresee(state, FighterId(0));
  ASSERT_EQ(clips.size(), 1u);
  planner.show(FighterId(1), shown(1, 1, {}));  // as its clip
  const std::vector<Event> same = planner.foresee(state, FighterId(0));
  ASSERT_EQ(same.size(), 1u);
  EXPECT_EQ(same[0].tick, clips[0].tick);
  EXPECT_LT(glm::distance(same[0].point, clips[0].point), 1e-4f);
  EXPECT_LT(glm::distance(same[0].impulse, clips[0].impulse),
            0.01f * glm::length(clips[0].impulse));
  planner.show(FighterId(1), shown(1, 1, {0, 0, 1}));
  EXPECT_TRUE(planner.foresee(state, FighterId(0)).empty());
  planner.show(FighterId(1), shown(1, 1, {0, 0, 0.04f}));  // leans away a little: met later
  const std::vector<Event> leans = planner.foresee(state, FighterId(0));
  ASSERT_EQ(leans.size(), 1u);
  EXPECT_GT(leans[0].point.z, clips[0].point.z + 0.02f);
  for (FighterState& fighter : state.fighters) fighter.launch.end *= 2;
  planner.show(FighterId(1), shown(1, 2, {}));
  planner.show(FighterId(0), shown(0, 2, {}));
  const std::vector<Event> late = planner.foresee(state, FighterId(0));
  ASSERT_EQ(late.size(), 1u);
  EXPECT_NEAR(late[0].tick, 2 * clips[0].tick, 3);
  // Another launch is not what was shown.
  state.fighters[1].launch.start -= 1;
  state.fighters[0].launch = launch("cross", 1, state.fighters[0].launch.placement);
  EXPECT_EQ(planner.foresee(state, FighterId(0))[0].tick, clips[0].tick + 1);
}

TEST_F(PlanTest, RarityMakesARepeatedActionCostly) {
  Style style = quick();
  style.temperature = 0;
  style.rarity_weight = 20;
  const FightState state = facing(0.95f);
  Planner planner(library(), contenders(2, style), {}, 3);
  const ActionId first = planner.plan(state, FighterId(0)).launch.action;
  for (int i = 0; i < 20; ++i) planner.note_launch(FighterId(0), first);
  EXPECT_NE(planner.plan(state, FighterId(0)).launch.action, first);
}

TEST_F(PlanTest, ThirdFightersBlowIsAThreat) {
  // A kick of fighter 2 is on its way to where fighter 0 stands; fighter 1 is far off.
  FightState state = facing(4);
  FighterState third = state.fighters[1];
  third.launch = launch("front_kick", -35, {0.93f, -2, -kPi / 2});
  third.opponent = FighterId(0);
  state.fighters.push_back(third);
  state.fighters[0].opponent = FighterId(1);
  Style style = quick();
  style.temperature = 0;
  Planner planner(library(), contenders(3, style), {}, 3);
  const Plan threatened = planner.plan(state, FighterId(0));
  state.fighters[2].launch.placement = {0.93f, 2.5f, -kPi / 2};
  const Plan safe = planner.plan(state, FighterId(0));
  EXPECT_LT(threatened.record.lines[0].score, safe.record.lines[0].score);
}

// Blows between others do not entertain who waits.
TEST_F(PlanTest, BoredomCountsFromTheFightersOwnLastContact) {
  FightState state = facing(1.2f);
  FighterState third = state.fighters[1];
  third.launch.placement = {3, -2, 0};
  state.fighters.push_back(third);
  state.fighters[0].opponent = FighterId(1);
  for (FighterState& fighter : state.fighters) fighter.last_contact = state.now;
  Style style = quick();
  style.temperature = 0;
  const auto score = [&] {
    Planner planner(library(), contenders(3, style), {}, 3);
    return planner.plan(state, FighterId(0)).record.lines[0].score;
  };
  const double met = score();
  const Tick long_ago = state.now - ticks(style.boredom_after_s + 10);
  state.fighters[2].last_contact = long_ago;
  EXPECT_EQ(score(), met);
  state.fighters[0].last_contact = long_ago;
  EXPECT_GT(score(), met + 1);  // attacks are worth more to it
}

TEST_F(PlanTest, WhoLiesInTheWayIsNotWalkedInto) {
  FightState state = facing(2.4f, 1);
  FighterState third = state.fighters[1];
  third.launch = launch("knockdown_back", -400, {0, -1, kPi});
  third.launch.end = kNever;
  third.balance = 2;
  state.fighters.push_back(third);
  Style style = quick();
  style.candidates = 40;
  Planner planner(library(), contenders(3, style), {}, 3);
  const Plan plan = planner.plan(state, FighterId(0));
  const auto& struck = plan.record.struck_off;
  const auto step = std::find_if(struck.begin(), struck.end(),
                                 [](const StruckOff& one) { return one.action == "step_fore"; });
  ASSERT_NE(step, struck.end());
  EXPECT_EQ(step->rules, std::vector<std::string>{"penetration"});
}

TEST_F(PlanTest, ToStandWhereAnotherLiesCosts) {
  FightState state = facing(0.95f);
  FighterState third = state.fighters[1];
  third.launch = launch("knockdown_back", -400, {3, 0, 0});
  third.launch.end = kNever;
  third.balance = 2;
  state.fighters.push_back(third);
  Style style = quick();
  style.temperature = 0;
  style.candidates = 40;
  PlanSettings settings;
  settings.prune.penetration = false;
  Planner planner(library(), contenders(3, style), settings, 3);
  const Plan beside = planner.plan(state, FighterId(0));
  state.fighters[2].launch.placement = {0.8f, -0.48f, kPi / 2};  // across where fighter 0 stands
  const Plan astride = planner.plan(state, FighterId(0));
  EXPECT_LT(astride.record.lines[0].score, beside.record.lines[0].score - 500);
  state.fighters[2].launch =
      launch("idle", 0, {0.8f, -0.48f, kPi / 2});  // who stands is no such thing
  state.fighters[2].balance = 0;
  EXPECT_EQ(planner.plan(state, FighterId(0)).record.lines[0].score, beside.record.lines[0].score);
}

TEST_F(PlanTest, ChiefOpponentIsTheNearestWhereNoneIsNamed) {
  FightState state = facing(1.0f);
  FighterState third = state.fighters[1];
  third.launch.placement = {2, 2, 0};
  state.fighters.push_back(third);
  for (FighterState& fighter : state.fighters) fighter.opponent = {};
  Planner planner(library(), contenders(3, quick()), {}, 3);
  const Plan plan = planner.plan(state, FighterId(0));
  for (const Line& line : plan.record.lines) {
    for (const int actor : line.actors) EXPECT_NE(actor, 2);
  }
}

TEST_F(PlanTest, AloneAFighterRests) {
  FightState state = facing(1);
  state.fighters.pop_back();
  state.fighters[0].opponent = {};
  Planner planner(library(), contenders(1, quick()), {}, 3);
  const Plan plan = planner.plan(state, FighterId(0));
  EXPECT_TRUE(plan.launch.action.valid());
  EXPECT_GT(plan.launch.end, state.now);
}

TEST_F(PlanTest, WithoutAClockLimitsChangeNothingButTheMark) {
  Style style = quick();
  PlanSettings settings;
  settings.node_limit = 0;
  Planner a(library(), contenders(2, style), settings, 3),
      b(library(), contenders(2, style), settings, 3);
  const FightState state = facing(0.95f, 12);
  const std::atomic<bool> never{false};
  const Plan whole = a.plan(state, FighterId(0)), live = b.plan(state, FighterId(0), {0, &never});
  EXPECT_TRUE(whole.reproducible);
  EXPECT_FALSE(live.reproducible);
  EXPECT_EQ(live.record.horizon, whole.record.horizon);  // deepened in steps to the same end
  EXPECT_EQ(live.record.lines.front().score, whole.record.lines.front().score);
  EXPECT_EQ(live.launch.action, whole.launch.action);
}

TEST_F(PlanTest, StoppedAtOnceAPlanStillHasALaunch) {
  Planner planner(library(), contenders(2, quick()), {}, 3);
  const std::atomic<bool> now{true};
  const Plan plan = planner.plan(facing(0.95f), FighterId(0), {0, &now});
  EXPECT_TRUE(plan.launch.action.valid());
  EXPECT_FALSE(plan.reproducible);
  EXPECT_LT(plan.record.horizon, ticks(quick().horizon_s));
}

TEST_F(PlanTest, StopEndsASearchThatIsUnderWay) {
  Style style = quick();
  style.horizon_s = 4;  // hours
  PlanSettings settings;
  settings.node_limit = 0;
  Planner planner(library(), contenders(2, style), settings, 3);
  std::atomic<bool> stop{false};
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  const Plan plan = planner.plan(facing(0.95f), FighterId(0), {0, &stop});
  other.join();
  EXPECT_TRUE(plan.launch.action.valid());
  EXPECT_LT(plan.record.horizon, ticks(4));
}

TEST_F(PlanTest, TimeLimitLeavesTheHorizonsThatWereFinished) {
  Style style = quick();
  style.horizon_s = 4;
  PlanSettings settings;
  settings.node_limit = 0;
  Planner planner(library(), contenders(2, style), settings, 3);
  const Plan plan = planner.plan(facing(0.95f), FighterId(0), {0.02, nullptr});
  EXPECT_TRUE(plan.launch.action.valid());
  EXPECT_LT(plan.record.horizon, ticks(4));
  EXPECT_FALSE(plan.record.lines.empty());
}

TEST_F(PlanTest, MemoAnswersWhatRecomputingAnswers) {
  ImpactMemo own({&tables()});
  Random random(8);
  std::vector<LandedBlow> blows;
  const char* struck[] = {"idle", "step_back", "guard_high", "jab"};
  for (int i = 0; i < 25; ++i) {
    LandedBlow blow;
    blow.attack.table = &tables().at(library().find(random.below(2) == 0 ? "cross" : "front_kick"));
    blow.struck.table = &tables().at(library().find(struck[random.below(4)]));
    blow.attack.age = 25 + random.below(10);
    blow.struck.age = random.below(40);
    blow.contact.striker = random.below(2) == 0 ? Part::right_hand : Part::right_foot;
    blow.contact.struck = random.below(2) == 0 ? Part::head : Part::abdomen;
    blow.contact.normal = yaw_rotation(random.uniform(-0.6f, 0.6f)) * kForward;
    blow.contact.velocity = -blow.contact.normal * random.uniform(1, 9);
    blow.attacker_yaw = kPi + random.uniform(-0.4f, 0.4f);
    blows.push_back(blow);
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (const LandedBlow& blow : blows) EXPECT_EQ(own.answer(blow), own.recomputed(blow));
  }
  EXPECT_EQ(own.counts().lookups, 50u);
  EXPECT_LE(own.counts().entries, 25u);
  // Blows that differ by less than a step share an answer.
  LandedBlow near = blows[0];
  const std::uint64_t entries = own.counts().entries;
  near.contact.velocity *= 1.0001f;
  EXPECT_EQ(own.answer(near).outcome, own.answer(blows[0]).outcome);
  EXPECT_EQ(own.counts().entries, entries);
}

}  // namespace
}  // namespace ringcraft
