#include "scene/hit_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/hit_fixture.h"
#include "scene/hit_map.h"

namespace ringcraft {
namespace {

using hits::query;
using ::testing::HasSubstr;

HitSweep swept(const std::vector<std::string>& texts, Part part, int threads = 1) {
  std::vector<SweepRange> ranges;
  for (const std::string& text : texts) {
    auto range = sweep_range(text);
    if (!range) throw std::runtime_error(to_string(range.error()));
    ranges.push_back(std::move(*range));
  }
  HitQuery hit = query();
  hit.part = part;
  SweepOptions options;
  options.threads = threads;
  auto sweep = sweep_hits(default_library(), hit, std::move(ranges), options);
  if (!sweep) throw std::runtime_error(to_string(sweep.error()));
  return std::move(*sweep);
}

int severity(const ImpactOutcome& outcome) {
  if (outcome.knockout) return 5;
  if (outcome.response == ResponseKind::knockdown) return 4;
  return outcome.response == ResponseKind::absorb ? 0 : outcome.steps;
}

TEST(HitSweep, AHarderHitIsNeverAnsweredByLess) {
  for (const Part part : {Part::head, Part::chest, Part::pelvis}) {
    const HitSweep sweep = swept({"direction=0:315:45", "impulse=0:120:10"}, part, 2);
    for (std::size_t i = 1; i < sweep.points.size(); ++i) {
      const SweepPoint &less = sweep.points[i - 1], &more = sweep.points[i];
      if (less.direction != more.direction) continue;
      EXPECT_LE(severity(less.outcome), severity(more.outcome))
          << name_of(part) << " " << more.direction << " deg, " << more.impulse << " N s";
    }
    EXPECT_EQ(severity(sweep.points.front().outcome), 0);
    EXPECT_GT(severity(sweep.points.back().outcome), 0);
  }
}

// The point of a sweep at the query's own size and direction is the query's hit.
TEST(HitSweep, AnImpulseKeepsItsSteepness) {
  HitQuery hit = query();
  hit.part = Part::chest;
  hit.impulse = {0, -40, 30};
  const auto sweep =
      sweep_hits(default_library(), hit, {*sweep_range("impulse=50"), *sweep_range("direction=0")});
  const auto alone = simulate_hit(default_library(), hit);
  ASSERT_TRUE(sweep && alone);
  EXPECT_NEAR(sweep->points[0].outcome.head_spin, alone->outcome.head_spin, 1e-3f);
  EXPECT_NEAR(sweep->points[0].outcome.margin, alone->outcome.margin, 1e-4f);
  EXPECT_THAT(sweep->what, HasSubstr("53.1 deg downward"));
}

TEST(HitSweep, ATouchFellsNobody) {
  for (const SweepPoint& point : swept({"tone=0", "impulse=0:4:1"}, Part::chest).points) {
    EXPECT_EQ(severity(point.outcome), 0) << point.impulse << " N s";
  }
}

TEST(HitSweep, SameBytesForAnyNumberOfThreads) {
  const std::vector<std::string> ranges = {"impulse=0:60:15", "direction=0:360:90", "tone=0:1:.5"};
  const HitSweep one = swept(ranges, Part::chest, 1), two = swept(ranges, Part::chest, 2);
  EXPECT_EQ(sweep_csv(one), sweep_csv(two));
  EXPECT_EQ(sweep_json(one), sweep_json(two));
  EXPECT_EQ(sweep_svg(one), sweep_svg(two));
}

TEST(HitSweep, TheTableHoldsEveryPointInOrder) {
  const HitSweep sweep = swept({"direction=0:360:90", "impulse=10:30:10"}, Part::chest);
  ASSERT_EQ(sweep.points.size(), 12u);  // a whole turn is not repeated
  EXPECT_EQ(sweep.points[1].impulse, 20);
  EXPECT_EQ(sweep.points[3].direction, 90);
  const std::string csv = sweep_csv(sweep);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  EXPECT_THAT(csv, HasSubstr("\n20.0,270.0,1.0,"));
}

TEST(HitSweep, TheOrderOfTheAxesDoesNotChangeTheMap) {
  const std::string a = sweep_svg(swept({"direction=0:360:120", "impulse=10:50:20"}, Part::head));
  const std::string b = sweep_svg(swept({"impulse=10:50:20", "direction=0:360:120"}, Part::head));
  EXPECT_EQ(a, b);
  EXPECT_THAT(a, HasSubstr("own left"));
}

TEST(HitSweep, AGridAndAStripHaveAxesWithUnits) {
  EXPECT_THAT(sweep_svg(swept({"impulse=0:40:20"}, Part::head)), HasSubstr(">impulse (N s)<"));
  const std::string grid = sweep_svg(swept({"direction=0:90:45", "tone=0:1:1"}, Part::head));
  EXPECT_THAT(grid, HasSubstr(">direction (deg)<"));
  EXPECT_THAT(grid, HasSubstr(">tone<"));
}

TEST(HitSweep, WhatWasInterruptedKeepsWhatIsDone) {
  const std::atomic<bool> interrupted = true;
  SweepOptions options;
  options.interrupted = &interrupted;
  const auto sweep =
      sweep_hits(default_library(), query(), {*sweep_range("impulse=0:40:20")}, options);
  ASSERT_TRUE(sweep);
  EXPECT_TRUE(sweep->interrupted);
  EXPECT_EQ(std::ranges::count(sweep_csv(*sweep), '\n'), 1);
  EXPECT_THAT(sweep_svg(*sweep), HasSubstr("0 of 3"));
}

TEST(HitSweep, WrongRangesAreUsageErrors) {
  for (const char* text :
       {"", "impulse", "height=0:1:1", "impulse=", "impulse=0:10", "impulse=0:10:0",
        "impulse=0:10:-1", "impulse=10:0:1", "impulse=0:10:x", "impulse=0:10:1:1",
        "impulse=0:1e9:1", "impulse=nan:1:1", "impulse=0:2000:1e-9", "tone=0:2:1", "impulse=::"}) {
    const auto range = sweep_range(text);
    ASSERT_FALSE(range) << text;
    EXPECT_EQ(range.error().kind, ErrorKind::usage);
    EXPECT_EQ(range.error().place, "--sweep");
  }
}

TEST(HitSweep, AVerticalImpulseHasNoDirectionToGoOver) {
  HitQuery hit = query();
  hit.impulse = {0, -20, 0};
  const auto around = sweep_hits(default_library(), hit, {*sweep_range("direction=0:270:90")});
  ASSERT_FALSE(around);
  EXPECT_EQ(around.error().kind, ErrorKind::usage);
  EXPECT_EQ(around.error().place, "--impulse");
  EXPECT_TRUE(sweep_hits(default_library(), hit, {*sweep_range("impulse=20")}));
}

TEST(HitSweep, TooManyPointsAndAnAxisTwiceAreUsageErrors) {
  const SweepRange impulse = *sweep_range("impulse=0:1000:1"),
                   way = *sweep_range("direction=0:20:1");
  const auto many = sweep_hits(default_library(), query(), {impulse, way});
  ASSERT_FALSE(many);
  EXPECT_THAT(many.error().what, HasSubstr("more than 20000 points"));
  const auto twice = sweep_hits(default_library(), query(), {way, way});
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().what, HasSubstr("direction twice"));
}

}  // namespace
}  // namespace ringcraft
