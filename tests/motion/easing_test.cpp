// A lead that turns a corner.
#include "motion/easing.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

constexpr float kAcceleration = 50, kRate = 30;

// Led at 1 m/s until it stops dead after 20 ticks, by a clip that does so itself or stands still.
std::vector<Vec3> follows(bool clip_stops_too) {
  const auto led = [](int tick) {
    return Vec3{static_cast<float>(std::min(tick, 20)) * kTickSeconds, 0, 0};
  };
  const auto clip = [&](int tick) { return clip_stops_too ? led(tick) : Vec3{}; };
  Easing<Vec3> path{led(0), led(-1), clip(0), clip(-1)};
  std::vector<Vec3> shown{led(-1), led(0)};
  for (int tick = 1; tick < 80; ++tick) {
    path.follow(led(tick), clip(tick), kAcceleration, kRate);
    shown.push_back(path.wanted() + path.eased());
  }
  return shown;
}

float most_acceleration(const std::vector<Vec3>& shown) {
  float most = 0;
  for (std::size_t i = 2; i < shown.size(); ++i) {
    most = std::max(most, glm::length(shown[i] - 2.0f * shown[i - 1] + shown[i - 2]));
  }
  return most / (kTickSeconds * kTickSeconds);
}

TEST(Easing, TakesACornerOffItsLead) {
  const auto shown = follows(false);
  EXPECT_LT(most_acceleration(shown), 2 * kAcceleration);  // 120 m/s2 led
  float farthest = 0;
  for (const Vec3& at : shown) farthest = std::max(farthest, at.x);
  const float led = 20 * kTickSeconds;
  EXPECT_GT(farthest, led + .002f);
  EXPECT_LT(farthest, led + .02f);
  EXPECT_NEAR(shown.back().x, led, 1e-4f);
}

TEST(Easing, LeavesACornerOfTheClipAsItIs) {
  const auto shown = follows(true);
  EXPECT_NEAR(most_acceleration(shown), 120, 1);
}

TEST(Easing, LeavesWhatIsSetAsideWhereItIsSet) {
  const Vec3 aside{.1f, 0, 0};
  Easing<Vec3> path{{}, {}, {}, {}};
  path.set_aside(aside);
  path.follow(aside, {}, kAcceleration, kRate);
  EXPECT_EQ(path.wanted() + path.eased(), aside);
}

}  // namespace
}  // namespace ringcraft
