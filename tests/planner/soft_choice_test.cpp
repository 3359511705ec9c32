#include "planner/soft_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ringcraft {
namespace {

// How often each of `points` has the largest sum, over many decisions.
std::vector<double> shares(const std::vector<double>& points, double temperature) {
  constexpr int kDraws = 40'000;
  std::vector<double> shares(points.size(), 0.0);
  for (int draw = 0; draw < kDraws; ++draw) {
    const SoftChoice preference(temperature, static_cast<std::uint64_t>(draw));
    std::size_t best = 0;
    double largest = -1e9;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double sum = points[i] + preference(static_cast<std::uint32_t>(i)) / 1000.0;
      if (sum > largest) largest = sum, best = i;
    }
    shares[best] += 1.0 / kDraws;
  }
  return shares;
}

TEST(SoftChoiceTest, SharesAreThoseOfASoftmax) {
  const std::vector<double> points{1.0, 0.7, 1.0, 0.4};
  constexpr double kTemperature = 0.3;
  const std::vector<double> found = shares(points, kTemperature);
  double sum = 0;
  for (const double value : points) sum += std::exp(value / kTemperature);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(found[i], std::exp(points[i] / kTemperature) / sum, 0.02) << i;
  }
}

TEST(SoftChoiceTest, WhatIsFarBelowIsNeverChosen) {
  const double far = SoftChoice::kMostBelow * 0.3 + 0.002;  // two thousandths: both are rounded
  EXPECT_EQ(shares({0, -far}, 0.3)[1], 0);
}

TEST(SoftChoiceTest, WithoutTemperatureNothingIsAdded) {
  for (std::uint32_t move = 0; move < 50; ++move) EXPECT_EQ(SoftChoice(0, 7)(move), 0);
}

TEST(SoftChoiceTest, DecisionsDiffer) {
  EXPECT_NE(SoftChoice(0.3, 1)(4), SoftChoice(0.3, 2)(4));
  EXPECT_NE(SoftChoice(0.3, 1)(4), SoftChoice(0.3, 1)(5));
  EXPECT_EQ(SoftChoice(0.3, 1)(4), SoftChoice(0.3, 1)(4));
}

}  // namespace
}  // namespace ringcraft
