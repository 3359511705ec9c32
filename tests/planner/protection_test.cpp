#include "planner/protection.h"

#include <gtest/gtest.h>

#include "fight/synthetic_fixture.h"
#include "planner/sparring.h"

namespace ringcraft {
namespace {

class ProtectionTest : public SyntheticFixture {
 protected:
  static const MotionTables& tables() {
    static const MotionTables kTables(library(), make_body({}));
    return kTables;
  }
  static float share(const char* attack, const char* defense) {
    static const Protection kProtection(tables());
    const ActionId blow = library().find(attack);
    return kProtection.against(tables().at(blow).first_strike)[library().find(defense).at()];
  }
};

TEST_F(ProtectionTest, IsTheShareOfBlowsThatADefenseAnswersAtItsBestTiming) {
  const OffenseDefenseTable table(spar(tables(), tables()).records);
  for (const char* attack : {"jab", "body_cross"}) {
    for (const char* defense : {"duck", "slip_right", "guard_high", "pull_away"}) {
      const DefenseEntry* entry = table.entry(library().find(attack), library().find(defense));
      ASSERT_NE(entry, nullptr);
      // From fewer exchanges, and with two that failed added to them.
      EXPECT_LE(share(attack, defense), best_timing(*entry).share()) << attack << ' ' << defense;
      EXPECT_GE(share(attack, defense), best_timing(*entry).share() / 2)
          << attack << ' ' << defense;
    }
  }
  EXPECT_GT(share("jab", "duck"), share("jab", "slip_right") + .5f);
  EXPECT_GT(share("body_cross", "slip_right"), share("body_cross", "duck") + .2f);
}

// A kick that should meet the head and goes to the belly lands on nobody.
TEST_F(ProtectionTest, IsTheMeanWhereNoSuchBlowLands) {
  std::vector<Action> actions = library().actions();
  const std::size_t kick = library().find("front_kick").at();
  actions[kick].strikes.front().zone = TargetZone::head;
  const MotionLibrary changed = library().with(actions);
  const MotionTables tables(changed, make_body({}));
  const Protection protection(tables);
  const std::size_t duck = library().find("duck").at();
  const float others = share("jab", "duck") + share("cross", "duck") + share("hook", "duck") +
                       share("body_cross", "duck");
  EXPECT_NEAR(protection.against(tables.at(ActionId(kick)).first_strike)[duck], others / 4, 1e-5f);
}

TEST_F(ProtectionTest, IsNothingOfWhatIsNoDefense) {
  EXPECT_EQ(share("jab", "idle"), 0);
  EXPECT_EQ(share("jab", "cross"), 0);
}

}  // namespace
}  // namespace ringcraft
