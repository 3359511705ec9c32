#include "io/events.h"

#include <gtest/gtest.h>

#include <sstream>

#include "io/sample_fight.h"

namespace ringcraft {
namespace {

using nlohmann::json;

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

TEST(Events, AreOneObjectALineBehindAHeader) {
  const Timeline timeline = sample::timeline();
  const std::string text =
      events_jsonl(timeline, sample::looks(), {{"scene", "duel"}, {"seed", 7}});
  const std::vector<json> lines = lines_of(text);
  ASSERT_EQ(lines.size(), timeline.events.size() + 1);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(lines[0]["type"], "header");
  EXPECT_EQ(lines[0]["scene"], "duel");
  EXPECT_EQ(lines[0]["seed"], 7);
  EXPECT_EQ(lines[0]["events"], timeline.events.size());
  EXPECT_EQ(lines[0]["fighters"][0]["name"], "Ana \"the Anvil\"");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_TRUE(lines[i]["t"].is_number());
    EXPECT_EQ(lines[i]["type"], name_of(timeline.events[i - 1].type));
    EXPECT_EQ(lines[i]["who"], timeline.events[i - 1].who.value);
  }
}

TEST(Events, TheHeaderKeepsWhatBothSayOfTheFighters) {
  const json header = {{"fighters", {{{"style", "careful"}}}}};
  const json first = lines_of(events_jsonl(sample::timeline(), sample::looks(), header))[0];
  ASSERT_EQ(first["fighters"].size(), 2u);
  EXPECT_EQ(first["fighters"][0]["style"], "careful");
  EXPECT_EQ(first["fighters"][0]["name"], "Ana \"the Anvil\"");
  EXPECT_DOUBLE_EQ(first["fighters"][0]["height_m"], 1.68);
}

TEST(Events, AHitSaysWhatPhysicsSaid) {
  const json hit = event_json(sample::events()[2], true);
  EXPECT_EQ(hit["part"], "head");
  EXPECT_EQ(hit["whom"], 1);
  EXPECT_DOUBLE_EQ(hit["impulse_Ns"], 5.0);
  EXPECT_DOUBLE_EQ(hit["t"], 0.4833);
  EXPECT_EQ(hit["impulse"], json::array({3.0, 0.0, 4.0}));
  EXPECT_EQ(hit["foreseen"], true);
  EXPECT_EQ(hit["response"], "absorb");
}

TEST(Events, ADecisionSaysWhatALineIsWorthByTermAndWhatWasStruckOff) {
  Event event = sample::events()[0];
  event.decision.lines[0].terms = {{{-500, 4750, 0, -250}, {0, 250, 0, 0}}};
  event.decision.struck_off = {{"jab", {"unanswered_hit", "penetration"}}};
  const json decision = event_json(event, true);
  const json& terms = decision["lines"][0]["terms"];
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0],
            json({{"location", -0.5}, {"hit", 4.75}, {"defense", 0.0}, {"control", -0.25}}));
  EXPECT_EQ(terms[1]["hit"], 0.25);
  EXPECT_FALSE(decision["lines"][1].contains("terms"));
  EXPECT_EQ(decision["struck_off"],
            json::array({{{"action", "jab"}, {"rules", {"unanswered_hit", "penetration"}}}}));
}

TEST(Events, ADecisionHoldsItsLinesWithActorsScoresAndForcedMoves) {
  const json decision = event_json(sample::events()[0], true);
  ASSERT_EQ(decision["lines"].size(), 2u);
  EXPECT_DOUBLE_EQ(decision["lines"][0]["score"], 4.25);
  EXPECT_DOUBLE_EQ(decision["lines"][1]["score"], -1.5);
  const json& moves = decision["lines"][0]["moves"];
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_EQ(moves[1], json({{"who", 1}, {"action", "absorb_back"}, {"forced", true}}));
  EXPECT_EQ(moves[2]["forced"], false);
  EXPECT_EQ(decision["pruned"]["unanswered_hit"], 3);
  EXPECT_EQ(decision["pruned"]["candidates"], 7);
  EXPECT_FALSE(event_json(sample::events()[0], false).contains("lines"));
}

TEST(Events, AResponseWithoutAnOpponentNamesNone) {
  const json response = event_json(sample::events()[3], true);
  EXPECT_FALSE(response.contains("whom"));
  EXPECT_EQ(response["steps"], 2);
}

TEST(Events, AGetUpAnswersNoBlow) {
  const json rises = event_json(sample::events().back(), true);
  ASSERT_EQ(rises["type"], "getup");
  EXPECT_EQ(rises["action"], "get_up_back");
  for (const char* of_an_answer : {"response", "steps", "direction_rad", "knockout"}) {
    EXPECT_FALSE(rises.contains(of_an_answer)) << of_an_answer;
  }
}

TEST(Events, BrokenTextAndNumbersDoNotBreakTheFile) {
  Timeline timeline = sample::timeline();
  timeline.events[1].action = "bad \xff name\nwith a break";
  timeline.events[2].impulse = {std::nanf(""), 1e30f, 0};
  const std::vector<json> lines = lines_of(events_jsonl(timeline, sample::looks(), nullptr));
  EXPECT_EQ(lines.size(), timeline.events.size() + 1);
  EXPECT_DOUBLE_EQ(lines[3]["impulse"][0], 0.0);
}

TEST(Events, RoundedNumbersHaveOneText) {
  EXPECT_EQ(json(rounded(-0.00001, 3)).dump(), "0.0");
  EXPECT_EQ(json(rounded(0.1f, 3)).dump(), "0.1");
  EXPECT_EQ(json(rounded(2.0005, 3)).dump(), json(rounded(2.0005, 3)).dump());
}

}  // namespace
}  // namespace ringcraft
