#pragma once
// Two fighters of the synthetic library, and the tree between them.

#include "base/random.h"
#include "fight/synthetic_fixture.h"
#include "planner/duel.h"
#include "planner/plan.h"

namespace ringcraft {

class DuelFixture : public SyntheticFixture {
 protected:
  static const MotionTables& tables() {
    static const MotionTables kTables(library(), make_body({}));
    return kTables;
  }
  static ImpactMemo& memo() {
    static ImpactMemo memo({&tables()});
    return memo;
  }

  DuelFixture() {
    for (std::size_t i = 0; i < 2; ++i) {
      SideSetup& side = setup_.side[i];
      side.tables = &tables();
      side.id = FighterId(i);
      side.style = &style_;
      side.launch.assign(library().actions().size(), 0);
      side.clean_damage = clean_damage_;
    }
    static const Protection kProtection(tables());
    setup_.protection = &kProtection;
    setup_.memo = &memo();
    set_style(style_);
  }

  void set_style(const Style& style) {
    style_ = style;
    for (SideSetup& side : setup_.side) side.weights = weights_at(style_, 0);
    setup_.factors = leaf_factors(setup_.side[0].weights);
  }
  void prune_nothing() {
    PruneSettings& prune = setup_.settings.prune;
    prune.unanswered_hit = prune.back_turned = prune.out_of_reach = prune.penetration = false;
  }

  // Fighters face each other, `distance` m apart; fighter 0 acts at tick 0, fighter 1 at `lag`.
  static FightState facing(float distance, Tick lag = 0) {
    FightState state;
    for (int i = 0; i < 2; ++i) {
      FighterState fighter;
      const float z = i == 0 ? -distance / 2 : distance / 2;
      fighter.launch = launch("idle", (i == 0 ? 0 : lag) - 36, {0, z, i == 0 ? 0 : kPi});
      fighter.opponent = FighterId(1 - i);
      state.fighters.push_back(fighter);
    }
    return state;
  }
  static FightState random_state(std::uint64_t seed) {
    Random random(seed);
    FightState state = facing(random.uniform(0.7f, 1.3f), random.below(30));
    for (FighterState& fighter : state.fighters) {
      fighter.launch.placement.x += random.uniform(-0.2f, 0.2f);
      fighter.launch.placement.yaw += random.uniform(-0.5f, 0.5f);
    }
    return state;
  }

  DuelMove choice(const DuelNode& node, int side, const char* name) const {
    const ActionId action = library().find(name);
    return {action, static_cast<std::uint8_t>(side), false,
            tables().after(*node.side[static_cast<std::size_t>(side)].flight.table).find(action)};
  }
  static std::vector<Contender> contenders(std::size_t count, const Style& style) {
    return std::vector<Contender>(count, {make_body({}), style});
  }

  // SideSetup::clean_damage, the same of every strike.
  static std::vector<std::int32_t> damage_of_all(const MotionTables& tables, std::int32_t damage) {
    std::size_t strikes = 0;
    for (const Action& action : tables.library().actions()) strikes += action.strikes.size();
    return std::vector<std::int32_t>(strikes, damage);
  }

  std::vector<std::int32_t> clean_damage_ = damage_of_all(tables(), 5000);
  Style style_;
  DuelSetup setup_;
};

}  // namespace ringcraft
