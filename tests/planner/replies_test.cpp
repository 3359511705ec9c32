// The bystander that replies: who is asked, what it may do, and that the tree stays a minimax.
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class RepliesTest : public DuelFixture {
 protected:
  // A third fighter at `placement`, in its idle until `free`, which fights fighter 0.
  void add_third(const Placement& placement, Tick free) {
    Bystander one{InFlight(tables(), launch("idle", free - 36, placement)), FighterId(2), 0};
    setup_.others.push_back(one);
    Replier replier;
    replier.other = static_cast<int>(setup_.others.size()) - 1;
    replier.now.flight = one.flight;
    replier.choice = setup_.side[1];
    replier.choice.id = one.id;
    setup_.repliers.push_back(replier);
  }
  void only_third(const Placement& placement, Tick free) {
    setup_.others.clear(), setup_.repliers.clear();
    add_third(placement, free);
  }
  void weigh(int candidates) {
    Style style;
    style.candidates = candidates;
    set_style(style);
  }
  // Fighter 0, which fighter 1 stands opposite of until `lag`, idles until somebody is asked.
  DuelNode idled(Duel& game, Tick lag) const {
    const DuelNode root = Duel::root(setup_, facing(1, lag));
    return game.apply(root, choice(root, 0, "idle")).node;
  }
  // How often `flight` of a bystander meets one of the two, who stand as in `state`.
  std::size_t hits_of(const InFlight& flight, const FightState& state, int team = -1) {
    setup_.others = {{flight, FighterId(2), 0, team}};
    setup_.side[0].team = 0;
    Duel game(setup_, 120);
    std::vector<DuelEvent> met;
    game.record_into(&met);
    DuelNode node = Duel::root(setup_, state);
    node.side[0].flight.launch.end = 60;
    game.play_on(node);
    return met.size();
  }
  std::int32_t value_of(const DuelNode& root, Tick horizon) const {
    Duel game(setup_, horizon);
    SearchCounts counts;
    return minimax(game, root, counts);
  }
};

const Placement kBehind{0, -1.45f, 0};  // of fighter 0, who faces the other way

TEST_F(RepliesTest, WhoIsFreeAndReachesThePlannerMayAttackOrPass) {
  prune_nothing();
  add_third(kBehind, 12);
  Duel game(setup_, 120);
  EXPECT_EQ(game.actor(Duel::root(setup_, facing(1, 60))), Actor::maximizer);
  const DuelNode node = idled(game, 60);
  ASSERT_EQ(node.now, 12);  // the edge ends where somebody is asked
  EXPECT_EQ(game.actor(node), Actor::minimizer);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_EQ(moves.size(), 3u);
  for (const DuelMove& move : moves) {
    EXPECT_EQ(move.side, 2);
    EXPECT_EQ(move.passes(), &move == &moves.back());
    if (!move.passes()) {
      EXPECT_TRUE(library().action(move.action).attacks());
    }
  }
  std::vector<DuelEvent> met;
  game.record_into(&met);
  DuelNode struck = game.apply(node, moves[0]).node;
  while (met.empty() && struck.now < 60)
    struck = game.apply(struck, choice(struck, 0, "idle")).node;
  ASSERT_FALSE(met.empty());
  EXPECT_EQ(met[0].attacker, 2);
  EXPECT_EQ(met[0].victim, 0);
  EXPECT_LT(struck.side[0].health, node.side[0].health);
  EXPECT_LT(struck.gained, node.gained);
  const DuelNode passed = game.apply(node, moves.back()).node;
  EXPECT_EQ(passed.now, 36);  // and the planner acts, as it would without
}

TEST_F(RepliesTest, WhoReachesNobodyCanOnlyPass) {
  add_third({0, -4, 0}, 12);
  Duel game(setup_, 120);
  const DuelNode node = idled(game, 30);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_TRUE(moves[0].passes());
}

// One reply in a line, by whoever hurts most.
TEST_F(RepliesTest, OneOfThemReplies) {
  prune_nothing();
  add_third(kBehind, 6);
  add_third({.9f, -.5f, -kPi / 2}, 12);
  Duel game(setup_, 120);
  const DuelNode node = idled(game, 30);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_EQ(game.apply(node, moves[0]).node.now, 30);  // nobody is asked any more
  const DuelNode passed = game.apply(node, moves.back()).node;
  EXPECT_EQ(passed.now, 12);
  game.moves(passed, moves);
  EXPECT_GE(moves.size(), 2u);
  EXPECT_EQ(moves[0].side, 3);
}

TEST_F(RepliesTest, AReplyIsWorthNothingToThePlanner) {
  weigh(4);
  prune_nothing();
  int worse = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    only_third(kBehind, 4);
    const DuelNode root = Duel::root(setup_, random_state(seed));
    const std::int32_t with = value_of(root, 90);
    setup_.repliers.clear();
    const std::int32_t without = value_of(root, 90);
    EXPECT_LE(with, without) << seed;
    worse += with < without - 1000;
  }
  EXPECT_GT(worse, 2);
}

TEST_F(RepliesTest, AlphaBetaIsMinimaxWithThem) {
  weigh(3);
  int replies = 0;
  for (const bool prune : {false, true}) {
    setup_.settings.prune = {};
    if (!prune) prune_nothing();
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      Random random(seed);
      only_third({random.uniform(-.4f, .4f), random.uniform(-1.8f, -1.2f), 0}, random.below(40));
      if (seed % 2 == 0) add_third({random.uniform(.6f, 1), 0, -kPi / 2}, random.below(40));
      std::stable_sort(setup_.repliers.begin(), setup_.repliers.end(),
                       [](const Replier& a, const Replier& b) { return a.free() < b.free(); });
      const DuelNode root = Duel::root(setup_, random_state(seed));
      Duel game(setup_, 80);
      SearchCounts counts;
      const std::int32_t truth = minimax(game, root, counts);
      for (const bool memory : {false, true}) {
        SearchSettings settings;
        settings.table = settings.killers = settings.history = memory;
        Search<Duel> search(settings);
        std::vector<DuelMove> line;
        EXPECT_EQ(search.run(game, root, kWorst, kBest, line), truth) << seed;
        replies += std::any_of(line.begin(), line.end(), [](const DuelMove& move) {
          return move.side >= 2 && !move.passes();
        });
        // Step by step to the same horizon: what was walked on shorter ones is played on.
        Search<Duel> deepening(settings);
        for (const Tick horizon : {20, 50, 80}) {
          Duel nearer(setup_, horizon);
          const std::int32_t value = deepening.run(nearer, root, kWorst, kBest, line);
          if (horizon == 80) {
            EXPECT_EQ(value, truth) << seed;
          }
          deepening.next_horizon();
        }
      }
    }
  }
  EXPECT_GT(replies, 10);
}

TEST_F(RepliesTest, EveryValueLiesInItsRange) {
  prune_nothing();
  weigh(3);
  int known = 0, replied = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    only_third({random.uniform(-.4f, .4f), random.uniform(-1.8f, -1.2f), 0}, random.below(20));
    Duel game(setup_, 20 + random.below(60));
    DuelNode node = Duel::root(setup_, random_state(seed));
    std::vector<DuelMove> moves;
    while (!game.terminal(node)) {
      const ValueRange range = game.range(node);
      if (range.least != kWorst) {
        SearchCounts counts;
        const std::int32_t value = minimax(game, node, counts);
        EXPECT_GE(value, range.least) << seed;
        EXPECT_LE(value, range.most) << seed;
        ++known;
        replied += node.replier >= 0;
      }
      game.moves(node, moves);
      node =
          game.apply(node,
                     moves[static_cast<std::size_t>(random.below(static_cast<int>(moves.size())))])
              .node;
    }
  }
  EXPECT_GT(known, 60);
  EXPECT_GT(replied, 10);
}

TEST_F(RepliesTest, WhatAReplyEarnsStandsAmongTheOpponentsTerms) {
  prune_nothing();
  add_third(kBehind, 12);
  std::vector<std::int32_t>& cost = setup_.repliers[0].choice.launch;
  std::fill(cost.begin(), cost.end(), -700);
  Duel game(setup_, 120);
  const DuelNode node = idled(game, 60);
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  ASSERT_EQ(moves[0].side, 2);
  DuelTerms terms{};
  game.record_terms_into(&terms);
  const DuelNode struck = game.step(node, moves[0]).node;
  std::int32_t credited = 0;
  for (const auto& side : terms) {
    for (const TermSum& sum : side) credited += sum.credited;
  }
  EXPECT_EQ(struck.gained - node.gained, credited);
  EXPECT_LT(terms[1][static_cast<std::size_t>(Term::control)].points, -.5);  // the cost of it
}

// Who goes on to walk into the opponent is to blame for it, whoever is asked on the way.
TEST_F(RepliesTest, WhatThePlannerWalksIntoIsItsOwnFault) {
  add_third({0, -4, 0}, 12);
  Duel game(setup_, 240);
  const DuelNode root = Duel::root(setup_, facing(.9f, 60));
  const Child<DuelNode> fore = game.apply(root, choice(root, 0, "step_fore"));
  EXPECT_EQ(fore.node.now, 12);
  EXPECT_GT(fore.fault, 0);
  EXPECT_EQ(game.apply(root, choice(root, 0, "step_back")).fault, 0);
}

TEST_F(RepliesTest, NobodyIsStruckByItsOwnTeam) {
  prune_nothing();
  const InFlight kick(tables(), launch("front_kick", -10, kBehind));
  EXPECT_EQ(hits_of(kick, facing(1, 60)), 1u);
  EXPECT_EQ(hits_of(kick, facing(1, 60), 0), 0u);
}

TEST_F(RepliesTest, AStrikeOfABystanderLandsOnOneOfTheTwo) {
  prune_nothing();
  const InFlight cross(tables(), launch("cross", 0, {0, -.8f, 0}));
  // One in the other: whatever meets one meets both.
  EXPECT_EQ(hits_of(cross, facing(.1f, 60)), 1u);
}

TEST_F(RepliesTest, ThePlannerAsksThoseThatFightItAndStand) {
  Style style;
  style.horizon_s = .8;
  style.candidates = 3;
  const auto score = [&](FighterId of_third, int team, bool replies) {
    PlanSettings settings;
    settings.replies = replies;
    std::vector<Contender> three = contenders(3, style);
    three[0].team = 0;
    three[2].team = team;
    Planner planner(library(), three, settings, 1);
    FightState state = facing(1, 30);
    FighterState third;
    third.launch = launch("idle", 4 - 36, kBehind);
    third.opponent = of_third;
    state.fighters.push_back(third);
    const Plan plan = planner.plan(state, FighterId(0));
    return plan.record.lines[static_cast<std::size_t>(plan.record.chosen)].score;
  };
  const std::int32_t unasked = score(FighterId(0), -1, false);
  EXPECT_LT(score(FighterId(0), -1, true), unasked);
  EXPECT_EQ(score(FighterId(1), -1, true), unasked);  // it fights the other one
  EXPECT_EQ(score(FighterId(0), 0, true), unasked);   // a team mate, whatever the state says
}

}  // namespace
}  // namespace ringcraft
