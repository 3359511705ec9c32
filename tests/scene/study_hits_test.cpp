// The rows of the hits study: a figure that is broken misses its bar.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "default_library.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {
namespace {

bool holds(double measured, const HitBar& bar) {
  HitRows rows;
  rows.group("group");
  rows.held("what", "m", measured, "published", bar);
  EXPECT_EQ(rows.table.rows.size(), 1u);
  const bool yes = std::get<std::string>(rows.table.rows.front().back()) == "yes";
  EXPECT_EQ(rows.missed, yes ? 0 : 1);
  return yes;
}

TEST(HitRows, ARowHoldsWithinItsBarAndMissesBeyondIt) {
  EXPECT_TRUE(holds(1.5, at_most(1.5)));
  EXPECT_FALSE(holds(1.5001, at_most(1.5)));
  EXPECT_TRUE(holds(95, at_least(95)));
  EXPECT_FALSE(holds(94.9, at_least(95)));
  EXPECT_TRUE(holds(30, {.low = 27, .high = 34}));
  EXPECT_FALSE(holds(26, {.low = 27, .high = 34}));
  EXPECT_FALSE(holds(35, {.low = 27, .high = 34}));
}

TEST(HitRows, WhatIsNotANumberMissesEveryBar) {
  const double broken = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(holds(broken, at_most(1.5)));
  EXPECT_FALSE(holds(broken, at_least(95)));
}

TEST(HitRows, WhatWasNotMeasuredHasNeitherValueNorVerdict) {
  HitRows rows;
  rows.held("share of none", "%", std::nullopt, "", at_least(90));
  EXPECT_EQ(rows.missed, 0);
  EXPECT_THAT(study_csv(rows.table), ::testing::HasSubstr("share of none,%,,,>= 90,\n"));
}

TEST(HitRows, WhatIsOnlySaidMissesNothing) {
  HitRows rows;
  rows.said("what", "m", -1e9, "");
  EXPECT_EQ(rows.missed, 0);
  EXPECT_EQ(rows.table.rows.size(), 1u);
}

TEST(HitsStudy, OneQuestionAloneGivesItsOwnRowsOnly) {
  HitsSettings settings;
  settings.only = {"recovery"};
  const HitsStudy found = hits_study(default_library(), settings, {});
  ASSERT_FALSE(found.study.table.rows.empty());
  for (const auto& row : found.study.table.rows) {
    const auto& group = std::get<std::string>(row.front());
    EXPECT_TRUE(group == "V2 lean release" || group == "V2 first recovery step" ||
                group == "V2 fall from stance")
        << group;
  }
  EXPECT_TRUE(found.study.timing.rows.empty());  // cost was not asked for
}

TEST(HitsStudy, TheLongestStepOfTheRagdollIsHeldToNoBar) {
  HitsSettings settings;
  settings.only = {"laws"};
  settings.count = 1;
  const std::string csv = study_csv(hits_study(default_library(), settings, {}).study.table);
  EXPECT_THAT(csv, ::testing::ContainsRegex("at 120 Hz, [^,]*\",mm,[0-9.e-]*,,,\n"));
  EXPECT_THAT(csv, ::testing::ContainsRegex("at 240 Hz, [^,]*\",mm,[0-9.e-]*,[a-z ]*,<= .*,yes\n"));
}

}  // namespace
}  // namespace ringcraft
