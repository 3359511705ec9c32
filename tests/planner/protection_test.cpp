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

TEST_F(ProtectionTest, IsNothingOfWhatIsNoDefense) {
  EXPECT_EQ(share("jab", "idle"), 0);
  EXPECT_EQ(share("jab", "cross"), 0);
}

}  // namespace
}  // namespace ringcraft
