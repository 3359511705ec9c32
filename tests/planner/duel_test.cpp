#include "planner/duel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "physics/penetration.h"
#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class DuelTest : public DuelFixture {
 protected:
  // A third fighter that is knocked out, on its back long since.
  static Bystander lying(const Placement& placement) {
    Launch fall = launch("knockdown_back", -400, placement);
    fall.end = kNever;
    return {InFlight(tables(), fall), FighterId(2), 0};
  }
  // What a cross does to one who began `action` at `start`.
  struct Crossed {
    std::vector<DuelEvent> events;
    Duelist struck;
  };
  Crossed crossed_in(const char* action, Tick start, int balance) {
    FightState state = facing(0.9f);
    state.fighters[1].balance = balance;
    state.fighters[1].launch = launch(action, start, state.fighters[1].launch.placement);
    Duel game(setup_, 240);
    Crossed crossed;
    game.record_into(&crossed.events);
    DuelNode node = Duel::root(setup_, state);
    node.side[1].flight.launch.end = 200;
    crossed.struck = game.apply(node, choice(node, 0, "body_cross")).node.side[1];
    return crossed;
  }
  void set_fallen(bool any) {
    setup_.others.clear();
    setup_.fallen.clear();
    if (!any) return;
    setup_.others.push_back(lying({0.3f, -0.3f, 0.9f}));
    setup_.fallen.emplace_back(setup_.others.back().flight);
  }
};

BodyCapsules in_world(const InFlight& flight, Tick tick) {
  const Frame frame = flight.frame_at(tick);
  BodyCapsules result = flight.table->capsules_at(flight.age(tick));
  for (Capsule& c : result) c.a = frame.to_outer(c.a), c.b = frame.to_outer(c.b);
  return result;
}

TEST_F(DuelTest, TablesAgreeWithPosesInTheWorld) {
  Launch cross = launch("cross", 5, {0.3f, -0.2f, 0.7f});
  cross.aim = 0.2f;
  const InFlight flight(tables(), cross);
  const BodyModel& body = tables().body();
  for (const Tick tick : {5, 9, 20, 33, 67}) {
    const WorldPose world = world_pose(body.skeleton, pose_at(library(), cross, tick, body.scale));
    const BodyCapsules truth = capsules(body, world), mine = in_world(flight, tick);
    for (std::size_t i = 0; i < kPartCount; ++i) {
      EXPECT_LT(glm::distance(truth[i].a, mine[i].a), 1e-5f);
      EXPECT_LT(glm::distance(truth[i].b, mine[i].b), 1e-5f);
    }
    const Placement root = root_at(library(), cross, tick, body.scale);
    EXPECT_LT(glm::distance(root.position(), flight.root_at(tick).position()), 1e-5f);
    EXPECT_NEAR(wrapped_angle(root.yaw - flight.root_at(tick).yaw), 0, 1e-5f);
  }
}

TEST_F(DuelTest, PenetrationAgreesWithThatOfTheWorld) {
  Random random(4);
  int deep = 0;
  for (int run = 0; run < 300; ++run) {
    const char* names[] = {"idle", "guard_high", "slip_right", "step_fore", "duck"};
    const InFlight a(tables(), launch(names[random.below(5)], 0, {0, 0, random.uniform(-1, 1)}));
    const InFlight b(tables(), launch(names[random.below(5)], 0,
                                      {random.uniform(-0.4f, 0.4f), random.uniform(0.2f, 1.0f),
                                       kPi + random.uniform(-1, 1)}));
    const Tick tick = random.below(30);
    const float truth = deepest_penetration(in_world(a, tick), in_world(b, tick)).depth;
    EXPECT_NEAR(penetration_at(a, b, tick), truth, 1e-4f);
    for (const float least : {0.03f, 0.1f, 0.15f, 0.2f}) {  // small parts are less than that thick
      EXPECT_NEAR(penetration_at(a, b, tick, least), truth > least ? truth : 0, 1e-4f);
    }
    deep += truth > 0.03f ? 1 : 0;
  }
  EXPECT_GT(deep, 50);
  EXPECT_LT(deep, 290);
}

TEST_F(DuelTest, ContactsAgreeWithThoseOfTheWorld) {
  Random random(9);
  int met = 0, turned = 0;
  for (int run = 0; run < 200; ++run) {
    const char* names[] = {"jab", "cross", "hook", "body_cross", "front_kick"};
    Launch blow = launch(names[random.below(5)], 0, {});
    Launch steps =
        launch("step_back", 0, {random.uniform(-0.2f, 0.2f), random.uniform(0.7f, 1.2f), kPi});
    if (run % 2 == 1) {  // both turn as they go, the target while it is met
      blow.aim = random.uniform(-0.5f, 0.5f);
      steps.aim = random.uniform(-0.5f, 0.5f);
      const Tick begins = library().action(blow.action).strikes[0].active_begin;
      steps.end += begins - steps.start;
      steps.start = begins;
    }
    const InFlight attacker(tables(), blow), target(tables(), steps);
    const StrikeTable& strike = attacker.table->strikes[0];
    for (Tick tick = strike.strike.active_begin; tick < strike.strike.active_end; ++tick) {
      SweptBody a, b;
      a.before = in_world(attacker, tick - 1), a.after = in_world(attacker, tick);
      b.before = in_world(target, tick - 1), b.after = in_world(target, tick);
      const auto truth = strike_contact(a, strike.strike, b);
      const auto mine = contact_at(attacker, strike, target, tick);
      ASSERT_EQ(truth.has_value(), mine.has_value());
      if (!truth) continue;
      ++met;
      EXPECT_TRUE(may_reach(attacker, strike, target));
      EXPECT_EQ(truth->struck, mine->struck);
      const Frame seen = target.frame_at(tick);
      EXPECT_LT(glm::distance(truth->point, seen.to_outer(mine->point)), 1e-3f);
      EXPECT_LT(glm::distance(truth->velocity, yaw_rotation(seen.yaw) * mine->velocity), 1e-2f);
      turned += target.turning(tick - 1) ? 1 : 0;
    }
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(turned, 10);
}

TEST_F(DuelTest, AKeptTreeIsWhatASearchOfTheLongerHorizonWalksAnew) {
  Style style;
  style.candidates = 4;
  set_style(style);
  setup_.settings.prune = {};
  SearchSettings settings;  // nothing that orders moves by what was seen at a shorter horizon
  settings.table = settings.killers = settings.history = false;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    set_fallen(seed % 2 == 0);
    const DuelNode root = Duel::root(setup_, random_state(seed));
    Search<Duel> kept(settings);
    for (Tick horizon = 30; horizon <= 150; horizon += 20) {
      Search<Duel> anew(settings);
      Duel game(setup_, horizon), other(setup_, horizon);
      std::vector<DuelMove> line;
      EXPECT_EQ(kept.run(game, root, kWorst, kBest, line),
                anew.run(other, root, kWorst, kBest, line))
          << seed << " " << horizon;
      kept.next_horizon();
      EXPECT_EQ(kept.counts().nodes, anew.counts().nodes) << seed << " " << horizon;
      EXPECT_EQ(game.counts().unanswered_hit, other.counts().unanswered_hit);
      EXPECT_EQ(game.counts().back_turned, other.counts().back_turned);
      EXPECT_EQ(game.counts().penetration, other.counts().penetration);
      EXPECT_EQ(game.counts().candidates, other.counts().candidates);
    }
  }
}

// An opponent of which one action was seen in each situation, over and over.
Habits habits_of(const MotionLibrary& library) {
  Habits habits;
  Random random(1);
  for (std::uint8_t band = 0; band < 3; ++band) {
    for (std::uint8_t after = 0; after < 7; ++after) {
      const ActionId often(random.below(static_cast<int>(library.actions().size())));
      for (int i = 0; i < 40; ++i) habits.note({band, after, i % 2 == 0}, often);
    }
  }
  return habits;
}

TEST_F(DuelTest, AlphaBetaIsMinimaxOnRealFightsWithPruningOffAndOn) {
  const Habits habits = habits_of(library());
  setup_.learning = 1;
  Style style;
  style.candidates = 4;
  for (const bool paper : {false, true}) {
    style.leaf = paper ? LeafValue::paper : LeafValue::weighted;
    set_style(style);
    for (const bool prune : {false, true}) {
      setup_.settings.prune = {};
      if (!prune) prune_nothing();
      std::uint64_t all = 0, visited = 0;
      for (std::uint64_t seed = 0; seed < 12; ++seed) {
        setup_.habits = seed % 3 == 0 ? &habits : nullptr;
        const FightState state = random_state(seed);
        Duel game(setup_, 110);
        const DuelNode root = Duel::root(setup_, state);
        SearchCounts counts;
        const std::int32_t truth = minimax(game, root, counts);
        for (const bool memory : {false, true}) {
          SearchSettings settings;
          settings.table = settings.killers = settings.history = memory;
          Search<Duel> search(settings);
          std::vector<DuelMove> line;
          EXPECT_EQ(search.run(game, root, kWorst, kBest, line), truth) << seed;
          EXPECT_LE(search.counts().nodes, counts.nodes);  // a tree of forced nodes has no cut
          all += counts.nodes;
          visited += search.counts().nodes;
        }
      }
      EXPECT_LT(visited, all / 2);
    }
  }
}

TEST_F(DuelTest, EveryValueLiesInItsRange) {
  prune_nothing();
  const Habits habits = habits_of(library());
  setup_.learning = 1;
  int known = 0, unknown = 0, tight = 0, unusual = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    Random random(seed);
    setup_.habits = seed % 4 == 1 ? &habits : nullptr;
    setup_.settings.prune.penetration = seed % 4 == 1;  // which may strike off what is usual
    Style style;
    style.candidates = 4;
    style.leaf = seed % 2 == 0 ? LeafValue::paper : LeafValue::weighted;
    style.ropes_weight = random.uniform(0, 2);
    style.attack_bonus = random.uniform(-2, 5);
    set_style(style);
    for (SideSetup& side : setup_.side) {
      for (std::int32_t& points : side.launch) points = random.below(4000) - 3000;
    }
    setup_.settings.ring_half_m = 1;
    set_fallen(seed % 3 == 0);
    const Tick horizon = 20 + random.below(60);
    Duel game(setup_, horizon);
    DuelNode node = Duel::root(setup_, random_state(seed));
    std::vector<DuelMove> moves;
    while (!game.terminal(node)) {
      const ValueRange range = game.range(node);
      if (range.least == kWorst) {
        ++unknown;
        EXPECT_EQ(range.most, kBest);
      } else {
        ++known;
        SearchCounts counts;
        const std::int32_t value = minimax(game, node, counts);
        EXPECT_GE(value, range.least) << seed;
        EXPECT_LE(value, range.most) << seed;
        tight += range.most - value < 200 ? 1 : 0;
      }
      game.moves(node, moves);
      for (const DuelMove& move : moves) unusual += range.least != kWorst && move.unusual > 0;
      node =
          game.apply(node,
                     moves[static_cast<std::size_t>(random.below(static_cast<int>(moves.size())))])
              .node;
    }
  }
  EXPECT_GT(known, 200);
  EXPECT_GT(unknown, 200);
  EXPECT_GT(tight, 20);
  EXPECT_GT(unusual, 20);
}

TEST_F(DuelTest, AnythingMayComeWhileABlowMayLand) {
  FightState state = facing(1.0f);
  const Launch idle = state.fighters[1].launch;
  const auto known = [&](const Launch& of_1, Tick horizon) {
    state.fighters[1].launch = of_1;
    return Duel(setup_, horizon).range(Duel::root(setup_, state)).most < kBest;
  };
  const Tick lull = tables().lull();
  ASSERT_GT(lull, 10);
  EXPECT_TRUE(known(idle, lull));
  EXPECT_FALSE(known(idle, lull + 1));  // a blow that is launched now
  const Strike& strike = library().action(library().find("cross")).strikes[0];
  const auto cross = [&](Tick age) { return launch("cross", -age, idle.placement); };
  EXPECT_TRUE(known(cross(0), lull));
  EXPECT_FALSE(known(cross(strike.active_begin - lull), lull));  // begins at the horizon
  EXPECT_TRUE(known(cross(strike.active_begin - lull - 1), lull));
  EXPECT_FALSE(known(cross(strike.active_end - 1), lull));
  EXPECT_TRUE(known(cross(strike.active_end), lull));
}

// Temporal expansion as a calendar: ends and ties only, no bodies.
struct Calendar {
  const MotionLibrary& library;
  const MotionTables& tables;
  Tick horizon;
  std::uint64_t nodes = 0, leaves = 0;

  struct State {
    Tick now = 0;
    ActionId action[2];
    Tick end[2] = {0, 0};
    bool last[2] = {false, false};
  };
  void count(const State& state) {
    ++nodes;
    if (state.now >= horizon) {
      ++leaves;
      return;
    }
    const int next = state.end[0] != state.end[1]     ? (state.end[0] < state.end[1] ? 0 : 1)
                     : state.last[0] != state.last[1] ? (state.last[0] ? 0 : 1)
                                                      : 0;
    for (const NextAction& one : tables.after(tables.at(state.action[next])).next) {
      State child = state;
      if (state.end[0] == state.end[1]) child.last[next] = false, child.last[1 - next] = true;
      child.action[next] = one.to;
      child.end[next] = state.now + library.action(one.to).length();
      child.now = std::min({child.end[0], child.end[1], horizon});
      count(child);
    }
  }
};

TEST_F(DuelTest, PerftIsThatOfTheCalendarWhereNobodyMeets) {
  Style style;
  style.candidates = 40;  // more than there are: nothing is left out
  style.late_sight_s = 0;
  set_style(style);
  prune_nothing();
  setup_.settings.ring_half_m = 0;
  for (const Tick lag : {0, 7, 20}) {
    for (const Tick horizon : {30, 60, 95}) {
      const FightState state = facing(6, lag);
      Duel game(setup_, horizon);
      SearchCounts counts;
      minimax(game, Duel::root(setup_, state), counts);
      Calendar calendar{library(), tables(), horizon};
      Calendar::State start;
      start.action[0] = start.action[1] = library().find("idle");
      start.end[1] = lag;
      calendar.count(start);
      EXPECT_EQ(counts.nodes, calendar.nodes) << lag << " " << horizon;
      EXPECT_EQ(counts.leaves, calendar.leaves);
      EXPECT_EQ(counts.forced, 0u);
    }
  }
}

TEST_F(DuelTest, TiesAlternateInTheTree) {
  const FightState state = facing(6);
  Duel game(setup_, 500);
  DuelNode node = Duel::root(setup_, state);
  std::vector<int> actors;
  for (int i = 0; i < 8; ++i) {  // both idle, so every decision is a tie
    const int next = game.next_side(node);
    actors.push_back(next);
    EXPECT_EQ(game.actor(node), next == 0 ? Actor::maximizer : Actor::minimizer);
    node = game.apply(node, choice(node, next, "idle")).node;
  }
  EXPECT_EQ(actors, (std::vector<int>{0, 1, 1, 0, 0, 1, 1, 0}));
}

TEST_F(DuelTest, EarliestFinisherActsNextAndMayActTwiceRunning) {
  const FightState state = facing(6);
  Duel game(setup_, 500);
  DuelNode node = Duel::root(setup_, state);
  node = game.apply(node, choice(node, 0, "front_kick")).node;  // 110 ticks
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(game.actor(node), Actor::minimizer);
    node = game.apply(node, choice(node, 1, "idle")).node;  // 36 ticks each
  }
  EXPECT_EQ(node.now, 108);
  node = game.apply(node, choice(node, 1, "idle")).node;
  EXPECT_EQ(node.now, 110);
  EXPECT_EQ(game.actor(node), Actor::maximizer);
}

// The first node on `node`'s way where somebody has been struck.
DuelNode struck(Duel& game, DuelNode node, const DuelMove& attack, const DuelMove& wait) {
  node = game.apply(node, attack).node;
  return game.apply(node, wait).node;
}

TEST_F(DuelTest, HitCutsTheActionAndTheForcedNodeHasOneEdge) {
  const FightState state = facing(0.95f);
  Duel game(setup_, 500);
  std::vector<DuelEvent> events;
  game.record_into(&events);
  const DuelNode root = Duel::root(setup_, state);
  const DuelNode hit =
      struck(game, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
  ASSERT_EQ(events.size(), 1u);
  ASSERT_TRUE(interrupts(events[0].blow.contact.blocked, events[0].answer.impulse,
                         events[0].answer.outcome));
  EXPECT_EQ(hit.now, events[0].tick);
  EXPECT_EQ(hit.side[1].flight.launch.end, hit.now);  // cut
  EXPECT_EQ(hit.side[0].flight.launch.end, 110);      // the attacker goes on
  EXPECT_EQ(hit.side[1].pending, events[0].answer.response);
  EXPECT_EQ(game.actor(hit), Actor::forced);
  std::vector<DuelMove> moves;
  game.moves(hit, moves);
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_TRUE(moves[0].forced);
  EXPECT_EQ(moves[0].action, events[0].answer.response);
  const Child<DuelNode> after = game.apply(hit, moves[0]);
  EXPECT_EQ(after.fault, 0);  // never pruned
  const Launch& response = after.node.side[1].flight.launch;
  EXPECT_TRUE(response.forced);
  EXPECT_EQ(response.start, hit.now);
  EXPECT_EQ(response.placement,
            root_at(library(), hit.side[1].flight.launch, hit.now, tables().body().scale));
}

TEST_F(DuelTest, NodesAreOthersWhereAnotherShareOfTheClipIsShown) {
  Duel game(setup_, 500);
  const DuelNode node = Duel::root(setup_, facing(0.95f));
  DuelNode shown = node, pending = node;
  shown.side[1].flight.launch.share = 0.5f;
  EXPECT_NE(game.hash(shown), game.hash(node));
  pending.side[1].pending = node.side[1].flight.launch.action;
  DuelNode less = pending;
  less.side[1].pending_share = 0.5f;
  EXPECT_NE(game.hash(less), game.hash(pending));
}

TEST_F(DuelTest, NobodyStandsWithoutHealth) {
  FightState state = facing(0.95f);
  state.fighters[1].health = 100;
  Duel game(setup_, 500);
  const DuelNode root = Duel::root(setup_, state);
  DuelNode node = struck(game, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
  EXPECT_TRUE(node.side[1].knocked_out);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_TRUE(library().action(moves[0].action).response.has_value());
  EXPECT_EQ(library().action(moves[0].action).response->kind, ResponseKind::knockdown);
  node = game.apply(node, moves[0]).node;
  EXPECT_EQ(node.side[1].flight.launch.end, kNever);
  EXPECT_EQ(node.side[1].balance, 2);
}

// Nobody boxes on through a body that falls, unless it may be hit there.
TEST_F(DuelTest, WhoKnocksDownIsFreeBeforeItsActionIsOver) {
  FightState state = facing(0.95f);
  state.fighters[1].health = 100;
  for (const bool allowed : {false, true}) {
    setup_.settings.hits_on_downed = allowed;
    Duel game(setup_, 500);
    const DuelNode root = Duel::root(setup_, state);
    const DuelNode node =
        struck(game, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
    const InFlight& kick = node.side[0].flight;
    const Tick whole = kick.launch.start + kick.table->length;
    const Tick active_end = kick.launch.start + kick.table->strikes[0].strike.active_end;
    if (allowed) {
      EXPECT_EQ(kick.launch.end, whole);
      continue;
    }
    EXPECT_LT(kick.launch.end, whole);
    EXPECT_GT(kick.launch.end, active_end);  // what is on its way is let out
    EXPECT_GE(kick.launch.end, node.now + 12);
  }
}

TEST_F(DuelTest, HitIsCreditedInFullToTheAttackerBySide) {
  Style style;
  style.location_weight = style.facing_weight = style.ropes_weight = 0;
  set_style(style);
  const FightState state = facing(0.95f);
  Duel game(setup_, 500);
  std::vector<DuelEvent> events;
  game.record_into(&events);
  const DuelNode root = Duel::root(setup_, state);
  const DuelNode mine =
      struck(game, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
  ASSERT_EQ(events.size(), 1u);
  const double won =
      hit_points(setup_.side[0].weights, StrikeKind::front_kick, events[0].answer.damage, false);
  EXPECT_EQ(mine.gained, thousandths(won));
  events.clear();
  DuelNode second = root;
  second.side[1].last_at_tie = true;
  const DuelNode theirs =
      struck(game, second, choice(root, 1, "front_kick"), choice(root, 0, "turn_left"));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(theirs.gained, thousandths(-1.5 * won));
}

TEST_F(DuelTest, HorizonClipsEventsAndIntegrals) {
  const FightState state = facing(0.95f);
  const DuelNode root = Duel::root(setup_, state);
  Duel whole(setup_, 500);
  std::vector<DuelEvent> events;
  whole.record_into(&events);
  struck(whole, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
  ASSERT_EQ(events.size(), 1u);
  const Tick hit = events[0].tick;
  for (const Tick horizon : {hit - 1, hit}) {
    Duel clipped(setup_, horizon);
    std::vector<DuelEvent> seen;
    clipped.record_into(&seen);
    const DuelNode end =
        struck(clipped, root, choice(root, 0, "front_kick"), choice(root, 1, "turn_left"));
    EXPECT_TRUE(clipped.terminal(end));
    EXPECT_EQ(end.now, horizon);
    EXPECT_EQ(seen.size(), horizon == hit ? 1u : 0u);
  }
}

TEST_F(DuelTest, LocationAddsUpHoweverTheRouteIsCut) {
  const FightState state = facing(2);
  Duel game(setup_, 72);
  const DuelNode root = Duel::root(setup_, state);
  // Fighter 0 kicks the air; fighter 1's way is cut into one action or into two.
  DuelNode cut = game.apply(root, choice(root, 0, "front_kick")).node;
  cut = game.apply(cut, choice(cut, 1, "idle")).node;
  cut = game.apply(cut, choice(cut, 1, "idle")).node;
  ASSERT_EQ(cut.now, 72);
  double sum = 0;
  for (Tick tick = 6; tick <= 72; tick += 6) {
    const Placement own = cut.side[0].flight.root_at(tick);
    const float distance = glm::distance(own.position(), cut.side[1].flight.root_at(72).position());
    sum += 0.05 * location_rate(setup_.side[0].weights, distance, 1, 2);
  }
  EXPECT_NEAR(cut.gained / 1000.0, sum, 0.05);
}

TEST_F(DuelTest, EvadedStrikeIsCreditedToTheDefender) {
  Style style;
  style.location_weight = style.facing_weight = style.ropes_weight = 0;
  set_style(style);
  const FightState state = facing(1.0f);
  Duel game(setup_, 200);
  std::vector<DuelEvent> events;
  game.record_into(&events);
  DuelNode node = Duel::root(setup_, state);
  node = game.apply(node, choice(node, 0, "cross")).node;
  node = game.apply(node, choice(node, 1, "pull_away")).node;
  while (node.now < 62) node = game.apply(node, choice(node, 1, "idle")).node;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, DuelEvent::Kind::evaded);
  // kappa_f 1.5 times w_d 0.3 of the clean damage of 5 points, against the planner.
  EXPECT_EQ(node.gained, thousandths(-1.5 * 0.3 * 5));
}

// Who likes to attack is to come near: a blow at the air earns nothing.
TEST_F(DuelTest, ABonusForAttackingIsEarnedWithinReach) {
  Style style;
  style.location_weight = style.facing_weight = style.ropes_weight = 0;
  style.attack_bonus = 7;
  set_style(style);
  const auto earned = [&](float distance, const char* name) {
    const DuelNode root = Duel::root(setup_, facing(distance));
    return Duel(setup_, 1).apply(root, choice(root, 0, name)).node.gained;
  };
  EXPECT_EQ(earned(0.85f, "cross"), 7000);
  EXPECT_EQ(earned(0.85f, "idle"), 0);
  EXPECT_EQ(earned(2.5f, "cross"), 0);
  // In between some of it: how well the blow reaches.
  bool some = false;
  for (float distance = 0.85f; distance < 2.0f; distance += 0.02f) {
    const std::int32_t points = earned(distance, "cross");
    EXPECT_LE(earned(distance + 0.02f, "cross"), points);
    some = some || (points > 0 && points < 7000);
  }
  EXPECT_TRUE(some);
}

TEST_F(DuelTest, AnAttackThatEarnsItsBonusIsAmongTheFirstCandidates) {
  Style style;
  style.candidates = 100;
  style.location_weight = style.facing_weight = style.ropes_weight = 0;
  style.fight_weight = 0;  // only the bonus has a worth
  style.attack_bonus = 7;
  set_style(style);
  const auto first = [&](float distance) {
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, facing(distance)), moves);
    return library().action(moves.front().action).attacks();
  };
  EXPECT_TRUE(first(0.85f));
  EXPECT_FALSE(first(2.5f));
}

TEST_F(DuelTest, WhoLikesToAttackDoesNotFightTheAir) {
  Style style;
  style.horizon_s = 1;
  style.temperature = 0;
  style.attack_bonus = 50;
  Planner planner(library(), contenders(2, style), {}, 1);
  EXPECT_FALSE(library().action(planner.plan(facing(2.5f), FighterId(0)).launch.action).attacks());
  EXPECT_TRUE(library().action(planner.plan(facing(1.0f), FighterId(0)).launch.action).attacks());
}

TEST_F(DuelTest, NobodyBoxesTheAir) {
  Style style;
  style.candidates = 40;
  set_style(style);
  const auto attacks = [&](float apart) {
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, facing(apart)), moves);
    EXPECT_GT(moves.size(), 3u) << apart;  // steps, defenses, an idle
    return std::count_if(moves.begin(), moves.end(), [&](const DuelMove& move) {
      return library().action(move.action).attacks();
    });
  };
  EXPECT_GT(attacks(1.6f), 3);
  EXPECT_EQ(attacks(4), 0);
  setup_.settings.prune.out_of_reach = false;
  EXPECT_GT(attacks(4), 3);
}

TEST_F(DuelTest, StrikeAtNobodyIsNotEvaded) {
  const FightState state = facing(2.5f);
  Duel game(setup_, 200);
  std::vector<DuelEvent> events;
  game.record_into(&events);
  DuelNode node = Duel::root(setup_, state);
  node = game.apply(node, choice(node, 0, "cross")).node;
  node = game.apply(node, choice(node, 1, "guard_high")).node;
  while (node.now < 62) node = game.apply(node, choice(node, 1, "idle")).node;
  EXPECT_TRUE(events.empty());
}

TEST_F(DuelTest, LateSightWithholdsParticularDefensesOnly) {
  Style style;
  style.candidates = 40;
  set_style(style);
  const auto offered = [&](Tick age) {
    FightState state = facing(0.95f);
    state.fighters[1].launch = launch("front_kick", -age, state.fighters[1].launch.placement);
    Duel game(setup_, 240);
    const DuelNode root = Duel::root(setup_, state);
    std::vector<DuelMove> moves;
    game.moves(root, moves);
    std::set<std::string> names;
    for (const DuelMove& move : moves) names.insert(library().action(move.action).name);
    return names;
  };
  const std::set<std::string> young = offered(29), seen = offered(30);
  EXPECT_EQ(young.count("slip_right") + young.count("duck"), 0u);
  EXPECT_EQ(seen.count("slip_right") + seen.count("duck"), 2u);
  for (const char* broad : {"guard_high", "pull_away", "step_back", "cross"}) {
    EXPECT_EQ(young.count(broad), 1u) << broad;
  }
}

TEST_F(DuelTest, CandidatesAreAsManyAtEveryDepthAndOfEveryKind) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    FightState state = random_state(seed);
    Duel game(setup_, 400);
    DuelNode node = Duel::root(setup_, state);
    Random random(seed);
    for (int depth = 0; depth < 8 && !game.terminal(node); ++depth) {
      std::vector<DuelMove> moves;
      game.moves(node, moves);
      if (game.actor(node) != Actor::forced) {
        EXPECT_EQ(moves.size(), 6u) << depth;
        std::set<Kind> kinds;
        for (const DuelMove& move : moves) kinds.insert(library().action(move.action).kind);
        EXPECT_TRUE(kinds.count(Kind::idle) && kinds.count(Kind::transition) &&
                    kinds.count(Kind::defense) && kinds.count(Kind::attack));
      }
      const auto pick = random.below(static_cast<int>(moves.size()));
      node = game.apply(node, moves[static_cast<std::size_t>(pick)]).node;
    }
  }
}

// What answers a blow in sparring is offered against it: a duck against a jab, a slip to the side
// against a cross to the body, which comes in as low as a duck goes.
TEST_F(DuelTest, DefensesAreWeighedByWhatTheyAnswerInSparring) {
  Style style;
  style.candidates = 5;    // an attack, two steps and two defenses
  style.late_sight_s = 0;  // all of them
  set_style(style);
  const auto offered = [&](const char* attack) {
    FightState state = facing(0.95f);
    state.fighters[1].launch = launch(attack, -4, state.fighters[1].launch.placement);
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, state), moves);
    std::set<std::string> names;
    for (const DuelMove& move : moves) names.insert(library().action(move.action).name);
    return names;
  };
  EXPECT_EQ(offered("jab").count("duck"), 1u);
  EXPECT_EQ(offered("jab").count("slip_right"), 0u);
  EXPECT_EQ(offered("body_cross").count("slip_right"), 1u);
  EXPECT_EQ(offered("body_cross").count("duck"), 0u);
}

// Who stands where it wants to stand has steps that keep it there, who stands too far away one that
// leads nearer, and all of them score better than the way out of the next blow.
TEST_F(DuelTest, TheFarthestStepIsAmongTheCandidates) {
  Style style;
  style.candidates = 5;
  style.distance_m = 1.05;
  style.distance_sigma_m = 0.1;
  set_style(style);
  for (const float distance : {1.0f, 1.2f}) {
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, facing(distance)), moves);
    EXPECT_EQ(moves.size(), 5u);
    EXPECT_EQ(std::count_if(moves.begin(), moves.end(),
                            [&](const DuelMove& move) {
                              return library().action(move.action).name == "step_back";
                            }),
              1)
        << distance;
  }
}

// Who is out of reach now but steps in is struck at: where it will be counts, not where it is.
TEST_F(DuelTest, AnAttackIsWeighedByWhereTheOpponentWillBe) {
  Style style;
  style.candidates = 100;
  style.location_weight = style.facing_weight = style.ropes_weight = 0;  // only blows have a worth
  set_style(style);
  const auto leads_with_an_attack = [&](const FightState& state) {
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, state), moves);
    return library().action(moves.front().action).attacks();
  };
  int near = 0, comes = 0;
  for (float distance = 0.8f; distance < 2.4f; distance += 0.05f) {
    FightState state = facing(distance, 36);
    const bool still = leads_with_an_attack(state);
    state.fighters[1].launch = launch("step_fore", 0, {0, distance / 2, kPi});
    const bool stepping = leads_with_an_attack(state);
    near += still ? 1 : 0;
    comes += stepping && !still ? 1 : 0;
    EXPECT_TRUE(distance < 1.6f || !still) << distance;
  }
  EXPECT_GT(near, 3);
  EXPECT_GT(comes, 3);
}

TEST_F(DuelTest, ShowingTheBackIsPrunedButSomethingIsAlwaysLeft) {
  Style style;
  style.candidates = 40;
  set_style(style);
  FightState state = facing(1.2f);
  state.fighters[0].launch.placement.yaw = radians(90);  // turning left again shows the back
  Duel game(setup_, 240);
  std::vector<DuelMove> moves;
  game.moves(Duel::root(setup_, state), moves);
  const ActionId away = library().find("turn_left");
  EXPECT_TRUE(std::none_of(moves.begin(), moves.end(),
                           [&](const DuelMove& move) { return move.action == away; }));
  EXPECT_GT(game.counts().back_turned, 0u);
  state.fighters[0].launch.placement.yaw = kPi;  // whatever it does, the back is turned
  game.moves(Duel::root(setup_, state), moves);
  EXPECT_GE(moves.size(), 1u);
  setup_.settings.prune.back_turned = false;
  Duel unpruned(setup_, 240);
  unpruned.moves(Duel::root(setup_, state), moves);
  EXPECT_EQ(unpruned.counts().back_turned, 0u);
  EXPECT_GT(moves.size(), 10u);
}

TEST_F(DuelTest, NobodyWalksThroughTheRopes) {
  Style style;
  style.candidates = 40;
  set_style(style);
  FightState state = facing(1.2f);
  const auto offered = [&](double ring_half, const char* name) {
    setup_.settings.ring_half_m = ring_half;
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, state), moves);
    EXPECT_FALSE(moves.empty());
    return std::any_of(moves.begin(), moves.end(),
                       [&](const DuelMove& move) { return move.action == library().find(name); });
  };
  EXPECT_TRUE(offered(3, "step_back"));  // from 0.6 m off the middle to 0.9
  EXPECT_FALSE(offered(1, "step_back"));
  EXPECT_TRUE(offered(1, "step_fore"));
  EXPECT_FALSE(offered(0.5, "step_back"));  // outside already: no farther
  EXPECT_TRUE(offered(0.5, "step_fore"));   // but in again
  EXPECT_TRUE(offered(0, "step_back"));     // there is no ring
}

// Wherever the ropes are, rounding takes nobody through them.
TEST_F(DuelTest, WhoStandsAtTheRopesMayStay) {
  Style style;
  style.candidates = 40;
  set_style(style);
  setup_.settings.ring_half_m = 0.5;
  for (int turn = 0; turn < 60; ++turn) {
    FightState state = facing(1.2f);
    for (FighterState& one : state.fighters) {
      one.launch.placement =
          Placement{0, 0, 0.1f * static_cast<float>(turn)} * one.launch.placement;
    }
    Duel game(setup_, 240);
    std::vector<DuelMove> moves;
    game.moves(Duel::root(setup_, state), moves);
    EXPECT_TRUE(std::any_of(moves.begin(), moves.end(), [&](const DuelMove& move) {
      return move.action == library().find("idle");
    })) << turn;
  }
}

TEST_F(DuelTest, WalkingIntoTheOtherIsPruned) {
  const FightState state = facing(0.6f);
  const DuelNode root = Duel::root(setup_, state);
  Duel game(setup_, 240);
  DuelNode node = game.apply(root, choice(root, 0, "step_fore")).node;
  EXPECT_GT(game.apply(node, choice(node, 1, "step_fore")).fault, 0);
  EXPECT_EQ(game.counts().penetration, 1u);
  setup_.settings.prune.penetration = false;
  Duel unpruned(setup_, 240);
  node = unpruned.apply(root, choice(root, 0, "step_fore")).node;
  EXPECT_EQ(unpruned.apply(node, choice(node, 1, "step_fore")).fault, 0);
}

// Where every move leads into the other, that is made which leads the least deep, not the one that
// begins so.
TEST_F(DuelTest, AFaultIsHowDeepTheEdgeLeads) {
  const Tick every = setup_.settings.prune.penetration_every;
  for (const char* action : {"idle", "step_fore"}) {
    FightState state = facing(0.48f, 60);
    state.fighters[1].launch = launch("step_fore", -4, state.fighters[1].launch.placement);
    Duel game(setup_, 240);
    const DuelNode root = Duel::root(setup_, state);
    const Child<DuelNode> child = game.apply(root, choice(root, 0, action));
    std::vector<float> depths;
    for (Tick tick = 0; tick <= child.node.now; tick += every) {
      depths.push_back(penetration_at(child.node.side[0].flight, child.node.side[1].flight, tick));
    }
    const auto first = std::find_if(depths.begin(), depths.end(), [&](float depth) {
      return depth > static_cast<float>(setup_.settings.prune.penetration_m);
    });
    ASSERT_NE(first, depths.end()) << action;
    const float deepest = *std::max_element(depths.begin(), depths.end());
    EXPECT_GT(deepest, *first + 0.01f) << action;
    EXPECT_NEAR(child.fault, 1000 * deepest, 1) << action;
  }
}

// Where it goes once its action is over nobody knows; until then it stands where that ends.
TEST_F(DuelTest, WalkingIntoAThirdFighterIsPrunedAlsoWhenItsActionIsOver) {
  setup_.others.push_back(
      {InFlight(tables(), launch("idle", -33, {0, -0.42f, kPi})), FighterId(2), 0});
  Duel game(setup_, 240);
  const DuelNode root = Duel::root(setup_, facing(2.4f, 60));
  ASSERT_LT(setup_.others[0].flight.launch.end, 10);
  EXPECT_GT(game.apply(root, choice(root, 0, "step_fore")).fault, 0);
  EXPECT_EQ(game.apply(root, choice(root, 0, "step_back")).fault, 0);
}

// The edge ends where the opponent acts, which has nothing to do with what is in the way.
TEST_F(DuelTest, WalkingIntoWhoLiesIsPrunedWhereverTheEdgeEnds) {
  setup_.others.push_back(lying({0, -1, kPi}));  // right ahead of fighter 0
  for (const Tick lag : {0, 1, 30, 60}) {
    Duel game(setup_, 240);
    const DuelNode root = Duel::root(setup_, facing(2.4f, lag));
    EXPECT_GT(game.apply(root, choice(root, 0, "step_fore")).fault, 0) << lag;
    EXPECT_EQ(game.counts().penetration, 1u) << lag;
    EXPECT_EQ(game.apply(root, choice(root, 0, "step_back")).fault, 0) << lag;
  }
}

TEST_F(DuelTest, WhoStandsInWhoLiesMayComeOutButNotGoDeeper) {
  setup_.others.push_back(lying({0, -1.4f, kPi}));
  Duel game(setup_, 240);
  const DuelNode root = Duel::root(setup_, facing(2.4f, 30));
  const InFlight& self = root.side[0].flight;
  ASSERT_GT(penetration_at(self, setup_.others[0].flight, 0), setup_.settings.prune.penetration_m);
  EXPECT_EQ(game.apply(root, choice(root, 0, "step_back")).fault, 0);
  EXPECT_GT(game.apply(root, choice(root, 0, "step_fore")).fault, 0);
}

TEST_F(DuelTest, TakingASeenBlowWithoutDefendingIsPruned) {
  FightState state = facing(0.95f);
  state.fighters[1].launch = launch("front_kick", -31, state.fighters[1].launch.placement);
  Duel game(setup_, 240);
  const DuelNode root = Duel::root(setup_, state);
  const Child<DuelNode> idle = game.apply(root, choice(root, 0, "turn_left"));
  ASSERT_TRUE(idle.node.side[0].pending.valid());
  EXPECT_GT(idle.fault, 0);
  EXPECT_EQ(game.counts().unanswered_hit, 1u);
  EXPECT_EQ(game.apply(root, choice(root, 0, "guard_high")).fault, 0);
}

TEST_F(DuelTest, DownedFightersAreHitOnlyWhereTheSceneSaysSo) {
  for (const bool allowed : {false, true}) {
    setup_.settings.hits_on_downed = allowed;
    const Crossed crossed = crossed_in("duck", -10, 2);
    EXPECT_EQ(crossed.events.size(), allowed ? 1u : 0u);
    EXPECT_FALSE(crossed.struck.pending.valid());  // lies already: nothing is cut
  }
}

// Who has just been struck has less tone, of what tiredness leaves.
TEST_F(DuelTest, ABlowMeetsTheToneThatTheInterruptedActionLeaves) {
  const auto tone = [&](const char* interrupted, float condition) {
    setup_.side[1].tone = condition;
    return crossed_in(interrupted, 0, 0).events.at(0).blow.tone;
  };
  EXPECT_EQ(tone("duck", 1), 1);
  EXPECT_LT(tone("absorb_back", 1), 0.9f);
  EXPECT_FLOAT_EQ(tone("absorb_back", .8f), .8f * tone("absorb_back", 1));
}

TEST_F(DuelTest, WhoGetsUpAnswersABlowOnceItIsOnItsFeet) {
  setup_.settings.hits_on_downed = true;
  for (const char* action : {"get_up_back", "duck"}) {
    const Crossed crossed = crossed_in(action, -170, 2);
    ASSERT_EQ(crossed.events.size(), 1u) << action;
    const Pose& pose = crossed.events[0].blow.struck.pose();
    ASSERT_TRUE(on_its_feet(tables().body(), pose)) << action;
    EXPECT_EQ(crossed.struck.pending.valid(), std::string(action) == "get_up_back") << action;
  }
}

// Lying it is out where it lies; on its way up it falls again.
TEST_F(DuelTest, WhoIsDownAndHasNoHealthLeftGetsUpNoMore) {
  setup_.settings.hits_on_downed = true;
  for (const char* down : {"duck", "get_up_back"}) {
    FightState state = facing(0.9f);
    state.fighters[1].balance = 2;
    state.fighters[1].health = 50;
    state.fighters[1].launch = launch(down, -130, state.fighters[1].launch.placement);
    Duel game(setup_, 240);
    DuelNode node = Duel::root(setup_, state);
    node.side[1].flight.launch.end = 200;
    node = game.apply(node, choice(node, 0, "body_cross")).node;
    const Duelist& struck = node.side[1];
    ASSERT_LE(struck.health, 0) << down;
    EXPECT_TRUE(struck.knocked_out) << down;
    const bool rises = library().action(library().find(down)).kind == Kind::get_up;
    EXPECT_EQ(struck.pending.valid(), rises) << down;
    if (!rises) {
      EXPECT_EQ(struck.flight.launch.end, kNever);
    }
  }
}

TEST_F(DuelTest, FallIsFollowedByAForcedGetUp) {
  FightState state = facing(1.5f, 30);
  state.fighters[1].balance = 2;
  state.fighters[1].launch = launch("knockdown_back", -140, state.fighters[1].launch.placement);
  Duel game(setup_, 400);
  DuelNode node = Duel::root(setup_, state);
  node = game.apply(node, choice(node, 0, "idle")).node;
  ASSERT_EQ(node.now, 10);
  EXPECT_EQ(game.actor(node), Actor::forced);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_EQ(library().action(moves[0].action).kind, Kind::get_up);
  node = game.apply(node, moves[0]).node;
  EXPECT_EQ(node.side[1].balance, 2);
  EXPECT_EQ(node.side[1].flight.launch.end, 10 + 180);
}

// Guard to a low stance, a blow from there, and back: no direct edge from the guard to the blow.
MotionLibrary with_low_stance() {
  synthetic::Builder builder;
  synthetic::Key guard, low, held, rise;
  guard.tick = 36;
  builder.add("idle", Kind::idle, {synthetic::Key{}, guard});
  low.hips_height = 0.55f;
  low.lean = 0.5f;
  low.left_hand.y = low.right_hand.y = 0.9f;
  held = low;
  low.tick = 30;
  builder.add("sink", Kind::transition, {synthetic::Key{}, low});
  synthetic::Key out = held, back = held;
  out.right_hand = {0, 0.9f, 0.9f};
  out.tick = 24;
  back.tick = 50;
  Action& blow = builder.add("low_cross", Kind::attack, {held, out, back});
  blow.strikes = {{StrikeKind::straight, Joint::right_hand, TargetZone::body, 16, 27}};
  rise.tick = 30;
  builder.add("rise", Kind::transition, {held, rise});
  synthetic::add_responses(builder);
  return {"low", builder.take()};
}

TEST_F(DuelTest, PathIsOneChoiceThatIsPlayedInFull) {
  const MotionLibrary low = with_low_stance();
  ASSERT_TRUE(low.dropped().empty());
  const MotionTables low_tables(low, make_body({}));
  const std::vector<std::int32_t> damage = damage_of_all(low_tables, 5000);
  Style style;
  style.candidates = 40;
  set_style(style);
  for (SideSetup& side : setup_.side) {
    side.tables = &low_tables;
    side.launch.assign(low.actions().size(), 0);
    side.clean_damage = damage;
  }
  setup_.settings.prune.out_of_reach = false;  // they stand where nobody meets
  FightState state = facing(3);
  for (FighterState& fighter : state.fighters) fighter.launch.action = low.find("idle");
  Duel game(setup_, 400);
  const DuelNode root = Duel::root(setup_, state);
  std::vector<DuelMove> moves;
  game.moves(root, moves);
  const ActionId sink = low.find("sink"), blow = low.find("low_cross");
  const auto found = std::find_if(moves.begin(), moves.end(),
                                  [&](const DuelMove& move) { return move.action == blow; });
  ASSERT_NE(found, moves.end());
  EXPECT_EQ(found->next->path, std::vector<ActionId>{sink});
  EXPECT_EQ(found->first(), sink);
  DuelNode node = game.apply(root, *found).node;
  EXPECT_EQ(node.side[0].queue[0], blow);
  node =
      game.apply(node, {low.find("idle"), 1, false,
                        low_tables.after(low_tables.at(low.find("idle"))).find(low.find("idle"))})
          .node;
  ASSERT_EQ(node.now, 30);
  EXPECT_EQ(game.actor(node), Actor::forced);
  game.moves(node, moves);
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_EQ(moves[0].action, blow);
  node = game.apply(node, moves[0]).node;
  EXPECT_EQ(node.side[0].flight.launch.end, 30 + 50);
  EXPECT_FALSE(node.side[0].queue[0].valid());
  // Where the path's frames say it starts, there the tree starts it (but for the aim).
  const Placement planned =
      (Frame(root.side[0].flight.root_at(0)) * found->next->alignment).placement();
  EXPECT_LT(glm::distance(planned.position(), node.side[0].flight.launch.placement.position()),
            0.05f);
}

// Seen was only what the opponent launched: of what may come of it, the best for it is foreseen.
TEST_F(DuelTest, OfWhatBeginsAsWasSeenTheBestIsForeseen) {
  const MotionLibrary low = with_low_stance();
  const MotionTables low_tables(low, make_body({}));
  const std::vector<std::int32_t> damage = damage_of_all(low_tables, 0);
  const ActionId sink = low.find("sink"), blow = low.find("low_cross");
  set_style({});
  Habits habits;
  for (int i = 0; i < 100; ++i) habits.note(situation_of(3, Kind::idle, false), sink);
  setup_.habits = &habits;
  setup_.learning = 1;
  setup_.settings.prune.out_of_reach = false;  // they stand where nobody meets
  FightState state = facing(3);
  for (FighterState& fighter : state.fighters) fighter.launch.action = low.find("idle");
  for (const ActionId best : {sink, blow}) {
    for (SideSetup& side : setup_.side) {
      side.tables = &low_tables;
      side.launch.assign(low.actions().size(), -90'000);
      side.launch[best.at()] = 0;
      side.clean_damage = damage;
    }
    DuelNode node = Duel::root(setup_, state);
    node.side[0].flight.launch.end = 60;  // the opponent acts
    Duel game(setup_, 400);
    std::vector<DuelMove> moves;
    game.moves(node, moves);
    ASSERT_FALSE(moves.empty());
    EXPECT_EQ(moves[0].action, best);
    EXPECT_EQ(moves[0].first(), sink);
  }
}

TEST_F(DuelTest, PlanLaunchesAPathsFirstActionAndNamesTheRest) {
  const MotionLibrary low = with_low_stance();
  Style style;
  style.horizon_s = 0.8;
  style.candidates = 40;
  style.temperature = 0;
  style.liked["low_cross"] = 50;  // so that it is chosen whatever it brings
  style.liked["sink"] = style.liked["idle"] = style.liked["rise"] = -50;
  FightState state = facing(3);
  for (FighterState& fighter : state.fighters) fighter.launch.action = low.find("idle");
  PlanSettings settings;
  settings.prune.out_of_reach = false;
  Planner planner(low, contenders(2, style), settings, 1);
  const Plan plan = planner.plan(state, FighterId(0));
  EXPECT_EQ(low.action(plan.launch.action).name, "sink");
  EXPECT_EQ(plan.then, std::vector<ActionId>{low.find("low_cross")});
  const Line& line = plan.record.lines[static_cast<std::size_t>(plan.record.chosen)];
  EXPECT_EQ(line.actions[0], "sink");
  EXPECT_NE(std::find(line.actions.begin(), line.actions.end(), "*low_cross"), line.actions.end());
}

TEST_F(DuelTest, HashSeesWhatTheFutureDependsOn) {
  const DuelNode root = Duel::root(setup_, random_state(3));
  Duel game(setup_, 240);
  const std::uint64_t hash = game.hash(root);
  DuelNode gained = root;
  gained.gained = 12345;  // how the node was reached
  EXPECT_EQ(game.hash(gained), hash);
  DuelNode tie = root, spent = root, moved = root, balance = root, tired = root;
  tired.side[0].health -= 1;
  tie.side[1].last_at_tie = true;
  spent.side[0].flight.launch.spent = 1;
  moved.side[0].flight.launch.placement.x += 1e-4f;
  balance.side[1].balance = 1;
  for (const DuelNode& other : {tie, spent, moved, balance, tired})
    EXPECT_NE(game.hash(other), hash);
}

}  // namespace
}  // namespace ringcraft
