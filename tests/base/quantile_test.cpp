#include "base/quantile.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

TEST(QuantileTest, IsLinearBetweenNeighbours) {
  const std::vector<double> values = {4, 1, 3, 2};
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(median(values), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 4);
  EXPECT_DOUBLE_EQ(quantile(std::vector<double>{7}, 0.99), 7);
}

TEST(QuantileTest, OfNothingIsZero) {
  EXPECT_EQ(quantile(std::vector<float>{}, 0.5), 0);
  EXPECT_EQ(median(std::vector<double>{}), 0);
}

}  // namespace
}  // namespace ringcraft
