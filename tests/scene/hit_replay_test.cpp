#include "scene/hit_replay.h"

#include <limits>
#include <map>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/hash.h"
#include "base/random.h"
#include "io/outputs.h"
#include "physics/tone.h"
#include "scene/fight.h"
#include "scene/hit_fixture.h"
#include "scene/replay_bytes.h"

namespace ringcraft {
namespace {

using hits::query;
using ::testing::HasSubstr;

// Events of a hit that was simulated alone.
const std::string& hit_events() {
  static const std::string text = [] {
    HitQuery hit = query();
    hit.part = Part::chest;
    hit.impulse = {5, 1, -30};
    const auto answer = simulate_hit(default_library(), hit);
    if (!answer) throw std::runtime_error(to_string(answer.error()));
    return events_jsonl(answer->timeline, {{"one", answer->bodies[0]}}, {});
  }();
  return text;
}

Result<ReplayReport> replayed(const std::string& text, int threads = 1) {
  return replay_hits("events.jsonl", text, threads);
}

TEST(HitReplay, AFightsHitsComeOutToTheBit) {
  auto scene = read_scene("duel", {"duration_s=12", "seed=4"});
  ASSERT_TRUE(scene);
  const FightRecord record = simulate_fight(default_library(), *scene, {});
  std::vector<FighterLook> looks;
  for (const BodyModel& body : record.bodies) looks.push_back({body.spec.name, body});
  const std::string text = events_jsonl(record.timeline, looks, {});
  const auto report = replayed(text, 2);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->hits, record.counts.impacts);
  EXPECT_GT(report->hits, 0u);
  EXPECT_EQ(report->differ, 0u) << ::testing::PrintToString(report->lines);
  for (const Event& event : record.timeline.events) {
    EXPECT_LT(event.replay.size(), 8192u);
    const bool blow = event.type == EventType::hit || event.type == EventType::block;
    EXPECT_EQ(event.replay.empty(), !blow) << name_of(event.type);  // an answer has none of its own
  }
}

TEST(HitReplay, ATouchOfALimpBodyComesOutToo) {
  HitQuery hit = query();
  hit.part = Part::chest;
  hit.impulse = {0, 0, -3};
  hit.tone = .1f;
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer);
  const std::vector<FighterLook> looks{{"struck", answer->bodies.front()}};
  const auto report = replayed(events_jsonl(answer->timeline, looks, {}));
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->hits, 1u);
  EXPECT_EQ(report->differ, 0u) << ::testing::PrintToString(report->lines);
}

// Who staggers has less tone than who stands; what was struck is what the replay holds.
TEST(HitReplay, HasTheToneThatTheInterruptedActionLeaves) {
  int staggered = 0, others = 0;
  for (int seed = 1; seed <= 6 && staggered == 0; ++seed) {
    const auto scene = read_scene(
        "brawl3", {"duration_s=10", fmt::format("seed={}", seed), "planner.node_limit=300"});
    ASSERT_TRUE(scene);
    const FightRecord record = simulate_fight(default_library(), *scene, {});
    std::map<std::size_t, Tick> answered;  // when the fighter last began a response that stays up
    std::set<std::size_t> fell;
    for (const Event& event : record.timeline.events) {
      if (event.type == EventType::response) answered[event.who.at()] = event.tick;
      if (event.type == EventType::knockdown) fell.insert(event.who.at());
      if (event.replay.empty() || fell.contains(event.whom.at())) continue;
      if (event.type != EventType::hit && event.type != EventType::block) continue;
      std::string why;
      const auto replay = read_replay(event.replay, why);
      ASSERT_TRUE(replay) << why;
      const auto before = answered.find(event.whom.at());
      const Tick since = before == answered.end() ? 1000 : event.tick - before->second;
      const bool staggers = static_cast<float>(since) * kTickSeconds < kFirm;
      EXPECT_EQ(replay->input.tone < 1, staggers) << "seed " << seed << " tick " << event.tick;
      ++(staggers ? staggered : others);
    }
  }
  EXPECT_GT(staggered, 0);
  EXPECT_GT(others, 0);
}

TEST(HitReplay, IsNoPartOfTheTimelinesHash) {
  HitQuery hit = query();
  const auto answer = simulate_hit(default_library(), hit);
  ASSERT_TRUE(answer);
  Timeline without = answer->timeline;
  for (Event& event : without.events) event.replay.clear();
  EXPECT_EQ(without.hash(), answer->timeline.hash());
}

TEST(HitReplay, SaysWhereAnotherVersionWroteWhatDiffers) {
  const std::string header = R"({"type":"header","version":"0.0.9"})";
  std::string text = header + hit_events().substr(hit_events().find('\n'));
  EXPECT_TRUE(replayed(text)->lines.empty());  // what comes out the same needs no excuse
  const std::size_t at = text.find("\"steps\":") + 8;
  text[at] = text[at] == '7' ? '8' : '7';
  const auto report = replayed(text);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->differ, 1u);
  ASSERT_EQ(report->lines.size(), 2u);
  EXPECT_THAT(report->lines.back(), HasSubstr("written by ringcraft 0.0.9"));
  text.replace(text.find("0.0.9"), 5, R"(\u001b[31m)");
  EXPECT_THAT(replayed(text)->lines.back(), HasSubstr("written by ringcraft ?[31m"));
}

TEST(HitReplay, OneChangedDigitOfAnOutcomeIsFound) {
  for (const char* key : {"\"head_spin_radps\":", "\"damage\":", "\"direction_rad\":",
                          "\"impulse_Ns\":", "\"steps\":", "\"point\":["}) {
    std::string text = hit_events();
    const std::size_t at =
        text.find_first_of("0123456789", text.find(key) + std::string(key).size());
    text[at] = text[at] == '7' ? '8' : '7';
    const auto report = replayed(text);
    ASSERT_TRUE(report) << to_string(report.error());
    EXPECT_EQ(report->differ, 1u) << key;
    ASSERT_EQ(report->lines.size(), 1u);
    EXPECT_THAT(report->lines[0], HasSubstr("events.jsonl: line 2: "));
    EXPECT_EQ(report->lines[0].find('\n'), std::string::npos);
  }
}

TEST(HitReplay, OneChangedDigitOfTheReplayIsFound) {
  const std::string whole = hit_events();
  const std::size_t begin = whole.find("\"replay\":\"") + 10, end = whole.find('"', begin);
  ASSERT_LT(end, whole.size());
  for (std::size_t at = begin; at < end; at += 97) {
    std::string text = whole;
    text[at] = text[at] == 'A' ? 'B' : 'A';
    const auto report = replayed(text);
    ASSERT_FALSE(report) << at;
    EXPECT_EQ(report.error().kind, ErrorKind::input);
    EXPECT_EQ(report.error().place, "line 2");
  }
}

TEST(HitReplay, AnotherOutcomeThanTheWrittenOneIsFoundToTheBit) {
  HitQuery hit = query();
  hit.impulse = {0, 0, -20};
  const auto posed = posed_body(default_library(), hit);
  ASSERT_TRUE(posed);
  const ImpactInput input = with_impulse(*posed, Part::head, hit.impulse, 1);
  ImpactOutcome outcome = impulse_step(posed->body, input);
  outcome.margin = std::nextafter(outcome.margin, 1.0f);
  const auto answer = simulate_hit(default_library(), hit);
  Timeline timeline = answer->timeline;
  timeline.events[0].replay = replay_text(posed->body, input, outcome, 100'000);
  const auto report = replayed(events_jsonl(timeline, {{"one", posed->body}}, {}));
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->differ, 1u);
  EXPECT_THAT(report->lines.at(0), HasSubstr("differs to the bit"));
}

TEST(HitReplay, EveryCutOfTheFileIsAnError) {
  const std::string whole = hit_events();
  for (std::size_t size = 0; size + 1 < whole.size(); size += 1 + size / 16) {
    const std::string cut = whole.substr(0, size);
    const auto report = replayed(cut);
    ASSERT_FALSE(report) << size;
    EXPECT_EQ(report.error().kind, ErrorKind::input);
    EXPECT_THAT(report.error().place, HasSubstr("line "));
  }
}

TEST(HitReplay, AFileThatEndsBehindAWholeLineIsFoundByTheHeadersCount) {
  const std::string& whole = hit_events();
  const std::string header = whole.substr(0, whole.find('\n') + 1);
  const auto report = replayed(header);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::input);
  EXPECT_EQ(report.error().place, "line 1");
  EXPECT_THAT(report.error().what, HasSubstr("events, and 0 are there"));
  EXPECT_FALSE(replayed(whole + whole.substr(header.size())));
  EXPECT_FALSE(replayed("{\"type\":\"header\",\"events\":-1}\n"));
  EXPECT_TRUE(replayed("{\"type\":\"header\"}\n" + whole.substr(header.size())));  // no count
}

TEST(HitReplay, HostileFilesAreErrorsWithTheLine) {
  const std::string header = "{\"type\":\"header\"}\n";
  const auto hit = [](const std::string& replay) {
    return "{\"type\":\"hit\",\"replay\":" + replay + "}\n";
  };
  const std::vector<std::string> files = {
      "[]\n",
      "{}\n",
      "null\n",
      "{\"type\":7}\n",
      "\xff\xfe\n",
      "{\"type\":\"hit\"}\n",
      header + "x\n",
      header + header,
      header + "{\"type\":\"hitt\"}\n",
      header + hit("7"),
      header + hit("null"),
      header + hit("\"\""),
      header + hit("\"====\""),
      header + hit("\"" + std::string(20'000, 'A') + "\""),
      header + "{\"type\":\"block\"}\n",
      header + std::string(2u << 20, '[') + "\n",
      header + hit("\"" + base64(std::vector<std::uint8_t>(600, 1)) + "\"")};
  for (const std::string& file : files) {
    const auto report = replayed(file);
    ASSERT_FALSE(report) << file.substr(0, 60);
    EXPECT_EQ(report.error().kind, ErrorKind::input);
    EXPECT_THAT(report.error().place, HasSubstr("line "));
  }
}

TEST(HitReplay, AValueThatIsNestedDeeplyIsRefused) {
  std::string text = hit_events();
  const std::size_t begin = text.find("\"point\":") + 8, end = text.find(']', begin) + 1;
  text.replace(begin, end - begin, std::string(60'000, '[') + std::string(60'000, ']'));
  const auto report = replayed(text);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().place, "line 2");
  EXPECT_THAT(report.error().what, HasSubstr("nested deeper than 32"));
}

TEST(HitReplay, AComparedValueIsAWordANumberOrThree) {
  const std::string whole = hit_events();
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string text = whole;
    const std::size_t begin = text.find("\"" + key + "\":") + key.size() + 3;
    const std::size_t end = text[begin] == '[' ? text.find(']', begin) + 1 : text.find(',', begin);
    return text.replace(begin, end - begin, value);
  };
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"point", "[0,0,0,0]"},
           {"impulse", "[[],[],[]]"},
           {"damage", "{}"},
           {"part", '"' + std::string(99, 'x') + '"'}}) {
    const auto report = replayed(with(key, value));
    ASSERT_FALSE(report) << key;
    EXPECT_EQ(report.error().place, "line 2");
    EXPECT_THAT(report.error().what, HasSubstr("'" + key + "'"));
  }
  EXPECT_EQ(replayed(with("damage", "null"))->differ, 1u);
  EXPECT_EQ(replayed(with("part", "\"\""))->differ, 1u);
  const auto report = replayed(with("part", "\"\xc2\x9b\""));
  ASSERT_EQ(report->lines.size(), 1u);
  EXPECT_THAT(report->lines[0], HasSubstr("part is \"\\u009b\""));  // no control character
}

TEST(HitReplay, WhoHasTheLeastHealthOfAllIsOut) {
  const auto posed = posed_body(default_library(), query());
  ASSERT_TRUE(posed);
  const ImpactInput input = with_impulse(*posed, Part::head, {0, 0, -20}, 1);
  const ImpactOutcome outcome = impulse_step(posed->body, input);
  const auto report = replayed(
      "{\"type\":\"header\"}\n{\"type\":\"hit\",\"replay\":\"" +
      replay_text(posed->body, input, outcome, std::numeric_limits<std::int32_t>::min()) + "\"}\n");
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_THAT(report->lines.at(0), HasSubstr("knockout is missing, recomputed true"));
}

TEST(HitReplay, AFightWithoutHitsHasNothingToDiffer) {
  const auto report = replayed("{\"type\":\"header\"}\n{\"type\":\"decision\"}\n");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->hits, 0u);
}

TEST(ReplayText, ValuesThatNoHitHasAreRefusedThoughTheHashFits) {
  HitQuery hit = query();
  const auto posed = posed_body(default_library(), hit);
  ASSERT_TRUE(posed);
  const ImpactInput good = with_impulse(*posed, Part::head, {0, 0, -20}, 1);
  std::string why;
  EXPECT_TRUE(read_replay(replay_text(posed->body, good, {}, 1), why));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto refused = [&](const BodyModel& body, const ImpactInput& input) {
    return !read_replay(replay_text(body, input, {}, 1), why).has_value();
  };
  ImpactInput bad = good;
  bad.pose.hips.x = nan;
  EXPECT_TRUE(refused(posed->body, bad));
  bad = good;
  bad.pose.rotation[3] = Quat(0, 0, 0, 0);
  EXPECT_TRUE(refused(posed->body, bad));
  bad = good;
  bad.blow.impulse.y = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(refused(posed->body, bad));
  bad = good;
  bad.tone = nan;
  EXPECT_TRUE(refused(posed->body, bad));
  bad = good;
  bad.blow.part = static_cast<Part>(200);
  EXPECT_TRUE(refused(posed->body, bad));
  BodyModel giant = posed->body;
  giant.spec.height = 90;
  EXPECT_TRUE(refused(giant, good));
}

TEST(ReplayText, ForgedBytesWithAHashThatFitsNeitherCrashNorHang) {
  const std::string& whole = hit_events();
  const std::size_t begin = whole.find("\"replay\":\"") + 10, end = whole.find('"', begin);
  const auto bytes = *from_base64(std::string_view(whole).substr(begin, end - begin));
  Random random(11);
  std::size_t accepted = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<std::uint8_t> forged(bytes.begin(), bytes.end() - 8);
    for (int k = 0; k <= run % 3; ++k) {
      // Every second change among the first bytes, where everything but the poses stands.
      const int most = k % 2 == 0 ? 70 : static_cast<int>(forged.size());
      forged[static_cast<std::size_t>(1 + random.below(most - 1))] =
          static_cast<std::uint8_t>(random.below(256));
    }
    ByteWriter hash;
    hash.word(hash_bytes(std::as_bytes(std::span(forged))), 8);
    forged.insert(forged.end(), hash.bytes().begin(), hash.bytes().end());
    const auto report = replayed(whole.substr(0, begin) + base64(forged) + whole.substr(end));
    accepted += report.has_value() ? 1 : 0;
    if (!report) {
      EXPECT_EQ(report.error().kind, ErrorKind::input);
    }
  }
  EXPECT_GT(accepted, 30u);
  EXPECT_LT(accepted, 300u);
}

// docs/hits.md says the form, and how long the outcome before the hash is.
TEST(ReplayText, IsAsItsPageSays) {
  const auto posed = posed_body(default_library(), query());
  ASSERT_TRUE(posed);
  const ImpactInput input = with_impulse(*posed, Part::head, {0, 0, -20}, 1);
  const ImpactOutcome outcome = impulse_step(posed->body, input);
  const auto bytes = *from_base64(replay_text(posed->body, input, outcome, 1));
  const auto page = read_file(RINGCRAFT_SOURCE_DIR "/docs/hits.md");
  ASSERT_TRUE(page);
  EXPECT_THAT(*page, HasSubstr(fmt::format("| 1 | form: {} |", bytes.front())));
  std::smatch row;
  ASSERT_TRUE(std::regex_search(*page, row, std::regex(R"(\| 4, (\d+) x 4 \| outcome)")));
  const std::size_t before_hash = 8 + 4 * std::stoul(row[1]);
  ASSERT_GT(bytes.size(), before_hash);
  ByteReader floats(std::span<const std::uint8_t>(bytes).last(before_hash));
  EXPECT_EQ(floats.number(), outcome.direction);
  EXPECT_EQ(floats.number(), outcome.head_spin);
}

TEST(ReplayText, ReadsBackWhatWasWritten) {
  HitQuery hit = query("cross", 0.2);
  hit.body.sex = Sex::female;
  hit.body.height = 1.61f;
  const auto posed = posed_body(default_library(), hit);
  ASSERT_TRUE(posed);
  ImpactInput input = with_impulse(*posed, Part::left_forearm, {3, 2, -21}, 0.7f);
  input.blow.blocked = true;
  const ImpactOutcome outcome = impulse_step(posed->body, input);
  std::string why;
  const auto read = read_replay(replay_text(posed->body, input, outcome, 77), why);
  ASSERT_TRUE(read) << why;
  EXPECT_EQ(read->health, 77);
  EXPECT_EQ(read->body.height, 1.61f);
  EXPECT_EQ(read->body.sex, Sex::female);
  EXPECT_EQ(read->outcome, outcome);
  EXPECT_EQ(read->input.contacts, input.contacts);
  EXPECT_EQ(read->input.tone, 0.7f);
  EXPECT_TRUE(read->input.blow.blocked);
  EXPECT_EQ(read->input.blow.part, Part::left_forearm);
  EXPECT_EQ(read->input.blow.impulse, input.blow.impulse);
  const auto same = [](const Pose& a, const Pose& b) {
    return a.hips == b.hips && a.rotation == b.rotation;
  };
  EXPECT_TRUE(same(read->input.pose, input.pose));
  EXPECT_TRUE(same(read->input.pose_before, input.pose_before));
  ASSERT_EQ(read->continued.size(), static_cast<std::size_t>(kImpulseStepTicks) + 1);
  for (std::size_t i = 0; i < read->continued.size(); ++i) {
    EXPECT_TRUE(same(read->continued[i], input.continued[i])) << i;
  }
}

}  // namespace
}  // namespace ringcraft
