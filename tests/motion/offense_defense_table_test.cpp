#include "motion/offense_defense_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/random.h"

namespace ringcraft {
namespace {

const ActionId kJab(0), kUppercut(1), kSlip(5), kSway(6);

SparringRecord record(ActionId attack, ActionId defense, Tick offset, ExchangeEnd end,
                      Placement relative = {0, 0.95f, kPi}) {
  return {attack, defense, offset, relative, end};
}

TEST(OffenseDefenseTable, CountsLaunchesAndSuccessesPerPair) {
  const std::vector<SparringRecord> records = {
      record(kJab, kSlip, 0, ExchangeEnd::evaded), record(kJab, kSlip, 3, ExchangeEnd::blocked),
      record(kJab, kSlip, 12, ExchangeEnd::struck), record(kJab, kSway, 0, ExchangeEnd::struck)};
  const OffenseDefenseTable table(records);
  ASSERT_EQ(table.against(kJab).size(), 2u);
  EXPECT_EQ(table.against(kJab)[0].defense, kSlip);
  EXPECT_EQ(table.entry(kJab, kSlip)->launched, 3u);
  EXPECT_EQ(table.entry(kJab, kSlip)->worked, 2u);
  EXPECT_EQ(table.entry(kJab, kSway)->worked, 0u);
  EXPECT_TRUE(table.against(kUppercut).empty());
  EXPECT_TRUE(table.against(ActionId()).empty());
  EXPECT_EQ(table.entry(kUppercut, kSlip), nullptr);
}

TEST(OffenseDefenseTable, TellsOffsetsDistancesAndBearingsApart) {
  const std::vector<SparringRecord> records = {
      record(kJab, kSlip, 0, ExchangeEnd::evaded, {0, 0.95f, kPi}),
      record(kJab, kSlip, 2, ExchangeEnd::evaded, {0.05f, 0.93f, 3}),
      record(kJab, kSlip, 6, ExchangeEnd::struck, {0, 0.95f, kPi}),
      record(kJab, kSlip, 0, ExchangeEnd::struck, {0, 1.15f, kPi}),
      record(kJab, kSlip, 0, ExchangeEnd::struck, {0.6f, 0.74f, kPi}),
      record(kJab, kSlip, -1, ExchangeEnd::struck, {0, 0.95f, kPi})};
  const OffenseDefenseTable table(records);
  // Offset, distance and bearing of the bin; launched, worked.
  const std::vector<std::array<int, 5>> wanted = {
      {-1, 9, 0, 1, 0}, {0, 9, 0, 2, 2}, {0, 9, 2, 1, 0}, {0, 11, 0, 1, 0}, {1, 9, 0, 1, 0}};
  std::vector<std::array<int, 5>> bins;
  for (const ExchangeBin& bin : table.entry(kJab, kSlip)->bins)
    bins.push_back({bin.offset, bin.distance, bin.bearing, static_cast<int>(bin.launched),
                    static_cast<int>(bin.worked)});
  EXPECT_EQ(bins, wanted);
  const ExchangeTiming best = best_timing(*table.entry(kJab, kSlip));
  EXPECT_EQ(best.offset, 0);
  EXPECT_EQ(best.launched, 4u);
  EXPECT_EQ(best.worked, 2u);
}

// A defense that works against everything belongs to nothing; one that works here alone does.
TEST(OffenseDefenseTable, LiftNamesThePairsThatBelongTogether) {
  std::vector<SparringRecord> records;
  for (int i = 0; i < 10; ++i) {
    records.push_back(record(kJab, kSlip, 0, ExchangeEnd::evaded));
    records.push_back(
        record(kUppercut, kSlip, 0, i < 2 ? ExchangeEnd::evaded : ExchangeEnd::struck));
    records.push_back(record(kJab, kSway, 0, ExchangeEnd::evaded));
    records.push_back(record(kUppercut, kSway, 0, ExchangeEnd::evaded));
  }
  const OffenseDefenseTable table(records);
  EXPECT_NEAR(table.lift(kJab, kSlip), 1.0f / 0.6f, 1e-5f);
  EXPECT_NEAR(table.lift(kUppercut, kSlip), 0.2f / 0.6f, 1e-5f);
  EXPECT_NEAR(table.lift(kJab, kSway), 1, 1e-5f);
}

TEST(OffenseDefenseTable, DoesNotDependOnTheOrderOfRecords) {
  Random random(7);
  std::vector<SparringRecord> records;
  for (int i = 0; i < 2000; ++i) {
    const auto pick = [&](int below) {
      return static_cast<int>(random.uniform() * static_cast<double>(below));
    };
    records.push_back(record(ActionId(std::size_t(pick(3))), ActionId(std::size_t(4 + pick(4))),
                             pick(60) - 20, static_cast<ExchangeEnd>(pick(3)),
                             {0, 0.7f + 0.01f * static_cast<float>(pick(60)), kPi}));
  }
  const OffenseDefenseTable forward(records);
  std::reverse(records.begin(), records.end());
  const OffenseDefenseTable backward(records);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto left = forward.against(ActionId(a)), right = backward.against(ActionId(a));
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i].defense, right[i].defense);
      EXPECT_EQ(left[i].worked, right[i].worked);
      ASSERT_EQ(left[i].bins.size(), right[i].bins.size());
    }
  }
}

}  // namespace
}  // namespace ringcraft
