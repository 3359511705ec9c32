#include "planner/style.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "planner/evaluation.h"

namespace ringcraft {
namespace {

Result<Style> read_written(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "own_style.toml";
  std::ofstream(path) << text;
  return read_style(path);
}

TEST(StyleTest, EveryPublishedStyleReads) {
  for (const char* name : {"balanced", "aggressive", "careful", "outboxer", "infighter", "kicker",
                           "counter_puncher", "student", "repeater"}) {
    const auto style = read_style(assets_folder() / "styles" / (std::string(name) + ".toml"));
    ASSERT_TRUE(style) << to_string(style.error());
    EXPECT_EQ(style->name, name);
    EXPECT_LT(style->location_weight, 2);  // heavier ones lose the fight (docs/sources.md, P)
    EXPECT_GE(style->candidates, 5);       // shorter lists make depth harmful
  }
}

// What learning brings is measured against `counter_puncher`: nothing else may differ.
TEST(StyleTest, AStudentIsACounterPuncherButForItsLearning) {
  const auto styles = assets_folder() / "styles";
  const Style student = read_style(styles / "student.toml").value();
  const Style counter_puncher = read_style(styles / "counter_puncher.toml").value();
  EXPECT_EQ(student.learning, 1);
  EXPECT_EQ(counter_puncher.learning, 0);
  for (const auto number : {&Style::horizon_s, &Style::caution, &Style::defense_share,
                            &Style::attack_bonus, &Style::distance_m, &Style::distance_sigma_m,
                            &Style::late_sight_s, &Style::duration_weight, &Style::rarity_weight,
                            &Style::boredom_after_s, &Style::boredom_rate, &Style::temperature}) {
    EXPECT_EQ(student.*number, counter_puncher.*number);
  }
  EXPECT_EQ(student.strikes, counter_puncher.strikes);
  EXPECT_EQ(student.liked, counter_puncher.liked);
}

TEST(StyleTest, FieldsAreRead) {
  const auto style = read_written(
      "leaf = \"paper\"\nhorizon_s = 1\ncandidates = 9\n"
      "learning = 0.5\nfatigue = 2\ninjury = 3\n"
      "aim_error_deg = 4\nspeed_error = 0.05\n"
      "[strikes]\nhook = 2\n[liked]\njab = -0.5\n");
  ASSERT_TRUE(style) << to_string(style.error());
  EXPECT_EQ(style->name, "own_style");
  EXPECT_EQ(style->leaf, LeafValue::paper);
  EXPECT_EQ(style->horizon_s, 1);
  EXPECT_EQ(style->candidates, 9);
  EXPECT_EQ(style->strikes.at("hook"), 2);
  EXPECT_EQ(style->liked.at("jab"), -0.5);
  EXPECT_EQ(style->caution, Style().caution);
  EXPECT_EQ(style->learning, 0.5);
  EXPECT_EQ(style->fatigue, 2);
  EXPECT_EQ(style->injury, 3);
  EXPECT_EQ(style->aim_error_deg, 4);
  EXPECT_EQ(style->speed_error, 0.05);
}

TEST(StyleTest, UnknownKeyIsAnErrorThatNamesTheNearest) {
  const auto style = read_written("caution = 1\nattack_bonsu = 2\n");
  ASSERT_FALSE(style);
  const std::string message = to_string(style.error());
  EXPECT_NE(message.find("attack_bonus"), std::string::npos) << message;
  EXPECT_NE(message.find("line 2"), std::string::npos) << message;
}

TEST(StyleTest, ValueOutOfRangeIsAnError) {
  EXPECT_FALSE(read_written("horizon_s = 60\n"));
  EXPECT_FALSE(read_written("caution = \"much\"\n"));
}

TEST(EvaluationTest, LocationIsBestAtThePreferredDistanceFacingTheOpponent) {
  const Weights weights = weights_at({}, 0);
  const double best = location_rate(weights, weights.distance, 1, 3);
  EXPECT_EQ(best, 0);
  EXPECT_DOUBLE_EQ(location_rate(weights, weights.distance + weights.sigma, 1, 3), -1);
  EXPECT_DOUBLE_EQ(location_rate(weights, 50, 1, 3), -3);  // g(d) is bounded
  EXPECT_LT(location_rate(weights, weights.distance, -1, 3), -1.9);
  EXPECT_DOUBLE_EQ(location_rate(weights, weights.distance, 1, 0), -1);
  EXPECT_DOUBLE_EQ(location_rate(weights, weights.distance, 1, 0.4), -0.5);
  EXPECT_LT(location_rate(weights, 0.3, 1, 3), location_rate(weights, 0.5, 1, 3) - 2);
  EXPECT_DOUBLE_EQ(location_rate(weights, 50, -1, 0), -3 - 2 - 1);
  EXPECT_LE(least_location_rate(weights), location_rate(weights, 50, -1, 0));
  EXPECT_LE(least_location_rate(weights), location_rate(weights, 0, -1, 0));
}

TEST(EvaluationTest, HoweverFarApartAStepNearerCounts) {
  for (const double apart : {0.5, 2.0, 4.0, 8.0, 40.0}) {
    const Weights weights = weights_at({}, 0, apart);
    const double nearer = std::max(weights.distance, apart - 0.5);
    EXPECT_GE(location_rate(weights, nearer, 1, 3), location_rate(weights, apart, 1, 3));
    EXPECT_LT(location_rate(weights, apart + 0.5, 1, 3), location_rate(weights, nearer, 1, 3));
    EXPECT_LE(least_location_rate(weights), location_rate(weights, 100, -1, 0));
  }
  EXPECT_DOUBLE_EQ(location_rate(weights_at({}, 0, 1.5), 50, 1, 3), -3);  // near ones: as ever
}

TEST(EvaluationTest, PreferredDistancesGoWithTheBody) {
  Style style;
  style.distance_m = 1.2;
  const Weights small = weights_at(style, 0, 0, 0.8);
  EXPECT_DOUBLE_EQ(small.distance, 0.96);
  EXPECT_DOUBLE_EQ(small.sigma, 0.8 * style.distance_sigma_m);
  EXPECT_NEAR(weights_at(style, 1000, 0, 0.8).distance, 0.72, 1e-9);
}

TEST(EvaluationTest, WhoLiesIsGivenRoom) {
  const Weights weights = weights_at({}, 0);
  const double room = weights.distance + kLyingReach;
  EXPECT_DOUBLE_EQ(location_rate(weights, room, 1, 3, true), 0);
  EXPECT_LT(location_rate(weights, weights.distance, 1, 3, true), -1.5);
  EXPECT_LE(least_location_rate(weights), location_rate(weights, 0, -1, 0, true));
}

TEST(EvaluationTest, WhoStandsInOthersWhoLiePaysAsForTheOpponentsRoot) {
  const Weights weights = weights_at({}, 0);
  const double in_one = location_rate(weights, weights.distance, 1, 3, false, kOverlapDistance);
  EXPECT_DOUBLE_EQ(in_one, -weights.location * kFallenCost * kOverlapDistance);
  EXPECT_LE(least_location_rate(weights, 2),
            location_rate(weights, 0, -1, 0, true, 2 * kOverlapDistance));
}

TEST(EvaluationTest, BoredomComesCloserAndDaresMore) {
  Style style;
  style.distance_m = 1.6;
  style.caution = 3;
  const Weights fresh = weights_at(style, style.boredom_after_s);
  const Weights bored = weights_at(style, style.boredom_after_s + 5);
  EXPECT_EQ(fresh.distance, 1.6);
  EXPECT_EQ(fresh.caution, 3);
  EXPECT_NEAR(bored.distance, 1.1, 1e-9);
  EXPECT_NEAR(bored.caution, 1 + 2 * std::exp(-1.0), 1e-9);
  EXPECT_NEAR(bored.attack_bonus, 5, 1e-9);
  EXPECT_EQ(weights_at(style, 1000).distance, 0.9);
}

TEST(EvaluationTest, ControlFavoursShortAndSeldomUsedActions) {
  const Style style;
  const Weights weights = weights_at(style, 0);
  Action brief, lengthy;
  brief.clip.frames.resize(61);
  lengthy.clip.frames.resize(121);
  EXPECT_GT(launch_points(weights, style, brief, 0), launch_points(weights, style, lengthy, 0));
  EXPECT_GT(launch_points(weights, style, brief, 0), launch_points(weights, style, brief, 0.1));
  EXPECT_DOUBLE_EQ(launch_points(weights, style, lengthy, 0.25), -0.5 - 1);
}

TEST(EvaluationTest, EveryAttackPaysAPriceButABonusMustBeEarned) {
  const Style style;
  Weights weights = weights_at(style, 0);
  Action blow;
  blow.strikes.emplace_back();
  const double neutral = launch_points(weights, style, blow, 0);
  weights.attack_bonus = -2;
  EXPECT_EQ(launch_points(weights, style, blow, 0), neutral - 2);
  EXPECT_EQ(reach_bonus(weights), 0);
  weights.attack_bonus = 5;
  EXPECT_EQ(launch_points(weights, style, blow, 0), neutral);
  EXPECT_EQ(reach_bonus(weights), 5);
}

TEST(EvaluationTest, LeafFormsWeighTheOpponentDifferently) {
  Style style;
  const LeafFactors weighted = leaf_factors(weights_at(style, 0));
  EXPECT_EQ(weighted.events[1], -1.5);
  EXPECT_EQ(weighted.rest[1], 0);
  style.leaf = LeafValue::paper;
  const LeafFactors paper = leaf_factors(weights_at(style, 0));
  EXPECT_EQ(paper.events[1], -1);
  EXPECT_EQ(paper.rest[1], -1);
}

TEST(EvaluationTest, HitsCountByDamageKindAndKnockdown) {
  Style style;
  style.strikes["hook"] = 2;
  const Weights weights = weights_at(style, 0);
  EXPECT_DOUBLE_EQ(hit_points(weights, StrikeKind::straight, 3000, false), 3);
  EXPECT_DOUBLE_EQ(hit_points(weights, StrikeKind::hook, 3000, true), 12);
  EXPECT_DOUBLE_EQ(defense_points(weights, 5000), 1.5);
  EXPECT_EQ(defense_points(weights, -5000), 0);
  EXPECT_EQ(thousandths(1.2345), 1235);
}

}  // namespace
}  // namespace ringcraft
