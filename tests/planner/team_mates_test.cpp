// Those of its own team in a fighter's way.
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class TeamMatesTest : public DuelFixture {
 protected:
  TeamMatesTest() { prune_nothing(); }
  // A third fighter, of the team of fighter 0 or of nobody's.
  void add_third(const Launch& launch, bool mate) {
    setup_.others = {{InFlight(tables(), launch), FighterId(2), 0, mate ? 0 : -1}};
    setup_.side[0].team = 0;
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

// The edge ends where the opponent acts, which has nothing to do with what is in the way.
TEST_F(TeamMatesTest, WalkingIntoOneIsPrunedWhereverTheEdgeEnds) {
  setup_.settings.prune.penetration = true;
  const auto pruned = [&](const char* action, Tick lag) {
    Duel game(setup_, 240);
    const DuelNode root = Duel::root(setup_, facing(2.4f, lag));
    game.apply(root, choice(root, 0, action));
    return game.counts().penetration;
  };
  Launch stands = launch("idle", -6, {0, -0.4f, kPi});
  stands.end = 120;
  for (const Tick lag : {0, 1, 30, 60}) {
    add_third(stands, true);
    EXPECT_EQ(pruned("step_fore", lag), 1u) << lag;
    EXPECT_EQ(pruned("step_back", lag), 0u) << lag;
  }
  add_third(stands, false);
  EXPECT_EQ(pruned("step_fore", 1), 0u);  // an enemy is in an edge of its own
}

// Where every move leads into one, that is made which leads the least deep.
TEST_F(TeamMatesTest, AFaultIsHowDeepTheLaunchLeads) {
  setup_.settings.prune.penetration = true;
  add_third(launch("step_fore", 0, {0, -0.3f, kPi}), true);
  for (const char* action : {"idle", "step_fore"}) {
    Duel game(setup_, 240);
    const DuelNode root = Duel::root(setup_, facing(2.4f, 60));
    const Child<DuelNode> child = game.apply(root, choice(root, 0, action));
    const InFlight& self = child.node.side[0].flight;
    const InFlight& mate = setup_.others[0].flight;
    const Tick every = setup_.settings.prune.penetration_every;
    const Tick over = std::min(self.launch.end, mate.launch.end);
    float deepest = 0;
    for (Tick tick = every; tick <= over; tick += every) {
      deepest = std::max(deepest, penetration_at(self, mate, tick));
    }
    EXPECT_NEAR(child.fault, 1000 * deepest, 1) << action;
  }
}

}  // namespace
}  // namespace ringcraft
