// Do the paper's experiments emerge? Bouts inside the tree's own world: clips are shown as they
// are, the memo answers the hits. The slow library has the paper's long actions ("most longer than
// 1 second"). On the library that users have: tests/scene/experiments_test.cpp.

#include <gtest/gtest.h>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

struct Tally {
  int hits = 0;
  double damage = 0;
};

class BoutTest : public DuelFixture {
 protected:
  static const MotionLibrary& slow_library() {
    static const MotionLibrary kLibrary = synthetic::library(2.2f);
    return kLibrary;
  }

  // `seconds` of fight from a seeded start; one planner serves all bouts of a test.
  static void fight(Planner& planner, const DuelSetup& setup, std::uint64_t seed, double length,
                    std::array<Tally, 2>& tally) {
    const MotionLibrary& library = slow_library();
    Random random(seed);
    FightState state;
    for (int i = 0; i < 2; ++i) {
      FighterState fighter;
      fighter.launch.action = library.find("idle");
      fighter.launch.start = -library.action(fighter.launch.action).length();
      fighter.launch.placement = {random.uniform(-0.2f, 0.2f),
                                  (i == 0 ? -1.0f : 1.0f) * random.uniform(0.6f, 0.9f),
                                  (i == 0 ? 0 : kPi) + random.uniform(-0.3f, 0.3f)};
      fighter.opponent = FighterId(1 - i);
      state.fighters.push_back(fighter);
    }
    Duel world(setup, kNever - 1);
    std::vector<DuelEvent> events;
    world.record_into(&events);
    DuelNode node = Duel::root(setup, state);
    while (node.now < ticks(length)) {
      std::vector<DuelMove> moves;
      if (world.actor(node) == Actor::forced) {
        world.moves(node, moves);
      } else {
        const auto side = static_cast<std::size_t>(world.next_side(node));
        state.now = node.now;
        for (std::size_t i = 0; i < 2; ++i) {
          state.fighters[i].launch = node.side[i].flight.launch;
          state.fighters[i].balance = node.side[i].balance;
          state.fighters[i].last_at_tie = node.side[i].last_at_tie;
        }
        const ActionId action = planner.plan(state, FighterId(side)).launch.action;
        planner.note_launch(FighterId(side), action);
        const Followers& follow = setup.side[side].launches().after(*node.side[side].flight.table);
        moves.push_back({action, static_cast<std::uint8_t>(side), false, follow.find(action)});
      }
      events.clear();
      node = world.apply(node, moves[0]).node;
      node.side[0].health = node.side[1].health = 100'000;  // health does not decide here
      for (const DuelEvent& event : events) {
        if (event.kind == DuelEvent::Kind::evaded) continue;
        state.fighters[0].last_contact = state.fighters[1].last_contact = event.tick;
        Tally& attacker = tally[static_cast<std::size_t>(event.attacker)];
        attacker.hits += event.kind == DuelEvent::Kind::hit ? 1 : 0;
        attacker.damage += event.answer.damage / 1000.0;
      }
    }
  }

  // Of who looks `horizon_0` ahead and of the other; they change sides from bout to bout.
  std::array<Tally, 2> bouts(double horizon_0, double horizon_1, int count, double length) {
    static const MotionTables kTables(slow_library(), make_body({}));
    static const std::vector<std::int32_t> kDamage = damage_of_all(kTables, 5000);
    static ImpactMemo memo({&kTables});
    setup_.memo = &memo;
    for (SideSetup& side : setup_.side) {
      side.tables = &kTables;
      side.clean_damage = kDamage;
      side.launch.assign(slow_library().actions().size(), 0);
    }
    std::vector<Contender> both = contenders(2, {});
    std::array<Tally, 2> tally;
    for (int i = 0; i < count; ++i) {
      const auto seed = static_cast<std::uint64_t>(i);
      const bool swapped = i % 2 == 1;
      both[swapped ? 1 : 0].style.horizon_s = horizon_0;
      both[swapped ? 0 : 1].style.horizon_s = horizon_1;
      Planner planner(slow_library(), both, {}, seed);
      if (swapped) std::swap(tally[0], tally[1]);
      fight(planner, setup_, seed, length, tally);
      if (swapped) std::swap(tally[0], tally[1]);
    }
    return tally;
  }
};

TEST_F(BoutTest, DeeperFighterWinsAndDeepFightsAreCareful) {
  // Against 1 s the lead is hardly more than what chance makes in 48 bouts here.
  const std::array<Tally, 2> uneven = bouts(3, 0.75, 12, 30);
  EXPECT_GT(uneven[0].damage, 2 * uneven[1].damage);
  EXPECT_GT(uneven[0].hits, 2 * uneven[1].hits);

  const std::array<Tally, 2> shallow = bouts(1, 1, 14, 30), deep = bouts(3, 3, 14, 30);
  const auto sum = [](const std::array<Tally, 2>& t, auto field) {
    return static_cast<double>(t[0].*field) + static_cast<double>(t[1].*field);
  };
  EXPECT_LT(sum(deep, &Tally::hits), 0.75 * sum(shallow, &Tally::hits));
  EXPECT_LT(sum(deep, &Tally::damage), 0.75 * sum(shallow, &Tally::damage));
  EXPECT_GT(sum(deep, &Tally::hits), 0);  // careful, not passive
}

}  // namespace
}  // namespace ringcraft
