#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace ringcraft {
namespace {

constexpr int kDraws = 100'000;

// The demonstration of O'Neill's pcg32-demo: seed 42, stream 54, first six outputs.
TEST(RandomTest, IsPcg32) {
  Random random(42, 54);
  for (const std::uint32_t expected :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu}) {
    EXPECT_EQ(random.bits(), expected);
  }
}

TEST(RandomTest, StreamsDiffer) {
  Random a(1, 0), b(1, 1);
  EXPECT_NE(a.bits(), b.bits());
}

TEST(RandomTest, UniformStaysBelowOneAndIsFlat) {
  Random random(3);
  std::array<int, 10> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    ++counts[static_cast<std::size_t>(u * 10)];
  }
  // Standard deviation of a count is sqrt(n p (1 - p)) = 95: five of them.
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 10, 5 * 95);
}

TEST(RandomTest, UniformKeepsItsBounds) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const float u = random.uniform(-2.0f, 3.0f);
    EXPECT_GE(u, -2.0f);
    EXPECT_LE(u, 3.0f);
  }
}

TEST(RandomTest, BelowReachesEveryValueAndNoOther) {
  Random random(5);
  for (const int count : {1, 2, 3, 7}) {
    std::set<int> seen;
    for (int i = 0; i < 1000; ++i) seen.insert(random.below(count));
    EXPECT_EQ(static_cast<int>(seen.size()), count);
    EXPECT_EQ(*seen.begin(), 0);
    EXPECT_EQ(*seen.rbegin(), count - 1);
  }
}

TEST(RandomTest, NormalHasMeanZeroAndDeviationOne) {
  Random random(6);
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  // Five standard errors: 1/sqrt(n) and sqrt(2/n).
  EXPECT_NEAR(sum / kDraws, 0.0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
}

TEST(RandomTest, DerivedSeedsDependOnEachPart) {
  const std::set<std::uint64_t> seeds{derived_seed(1, "plan"), derived_seed(2, "plan"),
                                      derived_seed(1, "noise"), derived_seed(1, "plan", 1)};
  EXPECT_EQ(seeds.size(), 4u);
  EXPECT_EQ(derived_seed(1, "plan"), derived_seed(1, "plan", 0));
}

}  // namespace
}  // namespace ringcraft
