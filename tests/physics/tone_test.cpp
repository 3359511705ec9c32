#include "physics/tone.h"

#include <cmath>

#include <gtest/gtest.h>

#include "physics/impact.h"

namespace ringcraft {
namespace {

Action response(ResponseKind kind) {
  Action action;
  action.kind = Kind::response;
  action.response = Response{.kind = kind};
  return action;
}

Tick after(float seconds) {
  return static_cast<Tick>(std::lround(seconds / kTickSeconds));
}

TEST(ToneLeft, IsAllOfItInWhateverAFighterChooses) {
  for (const Kind kind :
       {Kind::attack, Kind::defense, Kind::transition, Kind::combination, Kind::idle}) {
    Action action;
    action.kind = kind;
    for (const Tick age : {0, 10, 100}) EXPECT_EQ(tone_left(action, age), 1) << name_of(kind);
  }
}

TEST(ToneLeft, OfWhoHasJustBeenStruckIsLessUntilTheMusclesAreBack) {
  for (const ResponseKind kind : {ResponseKind::absorb, ResponseKind::recovery_steps}) {
    const Action staggers = response(kind);
    const float struck = tone_left(staggers, 0);
    EXPECT_GT(struck, .65f);  // legs and neck carry on
    EXPECT_LT(struck, .75f);
    float last = struck;
    for (Tick age = 0; age <= after(.4f); ++age) {
      const float now = tone_left(staggers, age);
      EXPECT_GE(now, last) << age;
      last = now;
    }
    EXPECT_NEAR(tone_left(staggers, after(kReflex)), struck, .02f);  // no reflex is faster
    EXPECT_FLOAT_EQ(tone_left(staggers, after(kFirm)), 1);
  }
}

TEST(ToneLeft, OfWhoFallsIsLittleAndComesBackInTheGetUp) {
  const float falls = tone_left(response(ResponseKind::knockdown), 20);
  EXPECT_GT(falls, kLeastStandingTone);
  EXPECT_LT(falls, .4f);
  Action gets_up;
  gets_up.kind = Kind::get_up;
  gets_up.clip.frames.resize(101);
  EXPECT_GT(tone_left(gets_up, 0), falls);
  EXPECT_LT(tone_left(gets_up, 0), tone_left(gets_up, 50));
  EXPECT_LT(tone_left(gets_up, 50), 1);
  EXPECT_FLOAT_EQ(tone_left(gets_up, 100), 1);
}

}  // namespace
}  // namespace ringcraft
