#include "planner/tally.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

TEST(TallyTest, MinimalTreeIsThatOfKnuthAndMoore) {
  EXPECT_NEAR(knuth_moore_leaves(6, 4), 36 + 36 - 1, 1e-9);
  EXPECT_NEAR(knuth_moore_leaves(6, 5), 216 + 36 - 1, 1e-9);
  EXPECT_NEAR(knuth_moore_leaves(3, 1), 3, 1e-9);
  const double between = knuth_moore_leaves(6, 4.5);
  EXPECT_GT(between, 71);
  EXPECT_LT(between, 251);
}

}  // namespace
}  // namespace ringcraft
