#include "motion/quality.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

// A foot that stands for a second, then slides at `speed` for `duration` seconds at `lift` metres.
FootPath sliding_foot(double rate, float speed, float duration, float lift) {
  FootPath foot;
  const int count = static_cast<int>(2 * rate);
  float z = 0;
  for (int i = 0; i < count; ++i) {
    const double time = i / rate;
    const bool slides = time >= 1 && time < 1 + static_cast<double>(duration) - 1e-6;
    foot.ankle.push_back({0, 0.07f + (slides ? lift : 0), z});
    foot.toes.push_back({0, 0.02f + (slides ? lift : 0), z + 0.13f});
    if (slides) z += speed / static_cast<float>(rate);
  }
  return foot;
}

double ratio(double rate, float speed, float duration, float lift = 0) {
  const FootPath still = sliding_foot(rate, 0, 0, 0);
  const std::vector<float> hips(still.ankle.size(), 0.9f);
  return foot_skate_ratio({sliding_foot(rate, speed, duration, lift), still}, hips, rate);
}

TEST(FootSkate, CountsTheShareOfTimeThatAFootSlides) {
  EXPECT_DOUBLE_EQ(ratio(60, 0, 0.5f), 0);
  // Half a second of two seconds of one of two feet.
  EXPECT_NEAR(ratio(60, 0.4f, 0.5f), 0.125, 0.003);
  EXPECT_NEAR(ratio(120, 0.4f, 0.5f), 0.125, 0.003);
}

TEST(FootSkate, LeavesOutWhatIsNoSlide) {
  EXPECT_DOUBLE_EQ(ratio(60, 0.1f, 0.5f), 0);         // slower than anybody sees
  EXPECT_DOUBLE_EQ(ratio(60, 1.2f, 0.5f), 0);         // a step
  EXPECT_DOUBLE_EQ(ratio(60, 0.4f, 0.10f), 0);        // too short
  EXPECT_DOUBLE_EQ(ratio(60, 0.4f, 0.5f, 0.05f), 0);  // lifted
}

TEST(FootSkate, APivotOnTheBallIsNoSlide) {
  const FootPath still = sliding_foot(60, 0, 0, 0);
  FootPath pivot = still;
  for (std::size_t i = 0; i < pivot.ankle.size(); ++i) {
    const float angle = 0.05f * static_cast<float>(i);
    pivot.ankle[i] = pivot.toes[i] + Vec3(0.13f * std::sin(angle), 0.05f, 0.13f * std::cos(angle));
  }
  const std::vector<float> hips(still.ankle.size(), 0.9f);
  EXPECT_DOUBLE_EQ(foot_skate_ratio({pivot, still}, hips, 60), 0);
}

TEST(FootSkate, AStandingBodyDoesNotSkate) {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Pose> frames(120, rest_pose(skeleton));
  EXPECT_DOUBLE_EQ(foot_skate_ratio(skeleton, frames, 120), 0);
  for (std::size_t i = 0; i < frames.size(); ++i)
    frames[i].hips.x += 0.3f * static_cast<float>(i) / 120;
  EXPECT_GT(foot_skate_ratio(skeleton, frames, 120), 0.9);  // dragged along
}

}  // namespace
}  // namespace ringcraft
