// Those of its own team in a fighter's way.
#include <gtest/gtest.h>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class TeamMatesTest : public DuelFixture {
 protected:
  TeamMatesTest() { prune_nothing(); }
  // A third fighter, of the team of fighter 0 or of nobody's.
  void add_third(const Launch& launch, bool mate) {
    setup_.others = {{InFlight(tables(), launch), FighterId(2), 0}};
    setup_.others[0].strikes = {!mate, true};
  }
  // What the front kick of fighter 0 meets in its first second.
  std::vector<DuelEvent> kicked(const FightState& state) {
    Duel game(setup_, 240);
    std::vector<DuelEvent> met;
    game.record_into(&met);
    const DuelNode root = Duel::root(setup_, state);
    game.apply(root, choice(root, 0, "front_kick"));
    return met;
  }
};

// As in a fight, where a kick that meets a team mate is over (Bout::commit_touch).
TEST_F(TeamMatesTest, WhoStandsInTheWayStopsABlow) {
  const FightState state = facing(0.95f, 120);
  ASSERT_EQ(kicked(state).size(), 1u);
  add_third(launch("idle", -6, {0, 0, kPi / 2}), true);
  EXPECT_TRUE(kicked(state).empty());
  add_third(launch("idle", -6, {1, 0, kPi / 2}), true);  // out of the way
  EXPECT_EQ(kicked(state).size(), 1u);
}

// Nobody means a kick for a team mate: the foot is in its way like any other part.
TEST_F(TeamMatesTest, SteppingIntoTheirKicksIsPruned) {
  setup_.settings.prune.penetration = true;
  const Strike& strike = library().action(library().find("front_kick")).strikes[0];
  const auto pruned = [&](float apart) {
    Duel game(setup_, 240);
    const FightState state = facing(2, 60);
    const Placement behind{0, state.fighters[0].launch.placement.z - apart, 0};
    add_third(launch("front_kick", -strike.active_begin, behind), true);
    const DuelNode root = Duel::root(setup_, state);
    game.apply(root, choice(root, 0, "step_back"));
    return game.counts().penetration;
  };
  EXPECT_EQ(pruned(1.05f), 1u);
  EXPECT_EQ(pruned(2.0f), 0u);
}

}  // namespace
}  // namespace ringcraft
