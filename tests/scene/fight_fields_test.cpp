// docs/files.md names every key that a fight writes, and none that it does not.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <map>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "fight/synthetic_library.h"
#include "scene/fight_files.h"

namespace ringcraft {
namespace {

using nlohmann::json;
using Keys = std::set<std::string>;

constexpr const char* kEventTypes[] = {"decision", "strike",   "hit",       "block",
                                       "miss",     "response", "knockdown", "getup"};

// "lines[].moves[].who": where values stand that are no objects.
void add_keys(const json& value, const std::string& path, Keys& keys) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      add_keys(inner, path.empty() ? key : path + "." + key, keys);
  } else if (value.is_array() && !value.empty() && value.front().is_object()) {
    for (const json& inner : value) add_keys(inner, path + "[]", keys);
  } else if (value != json::array()) {
    keys.insert(path);
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The keys of the table below "## title": those whose second column names `type`, where that is
// asked.
Keys documented(const std::string& title, const std::string& type = "") {
  const auto text = read_file(RINGCRAFT_SOURCE_DIR "/docs/files.md");
  if (!text) throw std::runtime_error(to_string(text.error()));
  Keys keys;
  bool inside = false;
  for (const std::string& line : lines_of(*text)) {
    if (line.starts_with("## ")) inside = line == "## " + title;
    if (!inside || !line.starts_with("| `")) continue;
    const std::size_t bar = line.find(" | ");
    std::istringstream of(line.substr(bar + 3, line.find(" | ", bar + 3) - bar - 3));
    bool asked = type.empty();
    for (std::string one; std::getline(of >> std::ws, one, ',');) {
      asked |= one == type || one == "every line" || (one == "every event" && type != "header");
    }
    if (!asked) continue;
    std::istringstream names(line.substr(0, bar));
    for (std::string name; std::getline(names, name, '`') && std::getline(names, name, '`');)
      keys.insert(name);
  }
  return keys;
}

// A short fight to whose events is added what only long ones have.
FightRecord whole_fight(const SceneFile& scene) {
  FightRecord record = simulate_fight(synthetic::library(), scene, {});
  DecisionRecord decision;
  for (const Event& event : record.timeline.events) {
    if (event.type == EventType::decision) decision = event.decision;
  }
  decision.lines.front().at_most = true;
  decision.struck_off = {{"jab", {"back_turned"}}};
  for (int type = 0; type <= static_cast<int>(EventType::getup); ++type) {
    Event event;
    event.type = static_cast<EventType>(type);
    event.who = FighterId(0);
    const bool answers = event.type >= EventType::response;
    if (!answers) event.whom = FighterId(1);
    event.fatigue = .5f;
    event.replay = "text";
    event.decision = decision;
    record.timeline.events.push_back(event);
    event.fall = true;
    record.timeline.events.push_back(event);
  }
  return record;
}

class FightFields : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_file(folder_.path() / "page.html",
                           "@@RINGCRAFT_GLB@@ @@RINGCRAFT_EVENTS@@ @@RINGCRAFT_REPORT@@"));
    ::setenv("RINGCRAFT_VIEWER", folder_.path().c_str(), 1);
    const auto scene = read_scene("duel", {"duration_s=1"});
    ASSERT_TRUE(scene);
    const auto written =
        write_fight(folder_.path(), *scene, synthetic::library(), whole_fight(*scene), 1, 1);
    ASSERT_TRUE(written) << to_string(written.error());
  }
  void TearDown() override { ::unsetenv("RINGCRAFT_VIEWER"); }

  std::string text(const char* name) const { return read_file(folder_.path() / name).value(); }
  Keys keys_of_file(const char* name) const {
    Keys keys;
    add_keys(json::parse(text(name)), "", keys);
    return keys;
  }

  TemporaryFolder folder_;
};

TEST_F(FightFields, OfEveryKindOfEventAreInTheirTable) {
  std::map<std::string, Keys> written;
  for (const std::string& line : lines_of(text("events.jsonl"))) {
    const json event = json::parse(line);
    add_keys(event, "", written[event["type"]]);
  }
  EXPECT_EQ(written.size(), std::size(kEventTypes) + 1);
  EXPECT_EQ(written["header"], documented("events.jsonl", "header"));
  for (const char* type : kEventTypes) {
    EXPECT_EQ(written[type], documented("events.jsonl", type)) << type;
  }
}

TEST_F(FightFields, OfTheReportAreInItsTable) {
  EXPECT_EQ(keys_of_file("report.json"), documented("report.json"));
}

TEST_F(FightFields, OfTheClockAreInTheirTable) {
  EXPECT_EQ(keys_of_file("timing.json"), documented("timing.json"));
}

}  // namespace
}  // namespace ringcraft
