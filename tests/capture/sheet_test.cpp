#include "capture/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "capture/sheet_track.h"

namespace ringcraft {
namespace {

std::filesystem::path sheets_folder() {
  return assets_folder() / "kickboxing" / "sheets";
}

std::vector<std::filesystem::path> sheet_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(sheets_folder())) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// A sheet of this text with the poses of the library.
Result<std::vector<Action>> compiled_sheet(const std::string& text) {
  const TemporaryFolder folder;
  std::filesystem::copy(sheets_folder() / "guard.toml", folder.path());
  const auto written = write_file(folder.path() / "test.toml", "poses = \"guard.toml\"\n" + text);
  if (!written) return tl::unexpected(written.error());
  return compile_sheet_file(folder.path() / "test.toml");
}

Result<std::vector<Action>> compiled(const std::string& action) {
  return compiled_sheet("[[action]]\n" + action);
}

TEST(Sheet, EveryFileCompilesToSoundClips) {
  std::set<std::string> names;
  for (const auto& file : sheet_files()) {
    const auto actions = compile_sheet_file(file);
    ASSERT_TRUE(actions.has_value()) << to_string(actions.error());
    for (const Action& action : *actions) {
      EXPECT_TRUE(names.insert(action.name).second) << action.name << " is there twice";
      EXPECT_TRUE(faults(action.clip).empty()) << action.name << ": " << faults(action.clip)[0];
      EXPECT_FALSE(action.source.empty());
    }
  }
  EXPECT_GE(names.size(), 45u);
}

TEST(Sheet, AnUnknownKeyIsAnErrorThatNamesLineAndNearestKey) {
  const auto result = compiled(
      "name = \"a\"\nkind = \"attack\"\nlength = 0.5\nkey = [\n  { t = 0.1, lead_wirst = [0, 1, 0] "
      "},\n]\n");
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().place.find("7"), std::string::npos) << to_string(result.error());
  EXPECT_NE(to_string(result.error()).find("lead_wrist"), std::string::npos)
      << to_string(result.error());
}

TEST(Sheet, MistakesOfThePersonWhoWritesAreErrorsWithAPlace) {
  const std::string head = "name = \"a\"\nkind = \"transition\"\nlength = 0.5\n";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {head + "start = \"gaurd\"\n", "no pose"},
      {head + "end_at = [0, 0.2, 0]\n", "from its place"},
      {head + "key = [{ t = 0.6, lean = [0, 0] }]\n", "after the action's end"},
      {head + "key = [{ t = 0.3, lean = [0, 0] }, { t = 0.2, lean = [0, 0] }]\n", "order of time"},
      {head + "step = [{ foot = \"lead\", lift = 0.3, land = 0.2 }]\n", "impossible time"},
      {head + "strike = [{ kind = \"straight\", joint = \"leftHand\", zone = \"head\", start = "
              "0.1, contact = 0.3 }]\n",
       "no key gives lead_wrist"},
      {head + "key = [{ t = 0.1, lead_wrist = [0, 1, 0] }, { t = 0.3, lead_wrist = [0, 1, 0] }]\n"
              "strike = [{ kind = \"straight\", joint = \"leftHand\", zone = \"head\", start = "
              "0.1, contact = 0.3, active = [0.3, 0.2] }]\n",
       "are empty"},
      {head + "strike = [{ kind = \"front_kick\", joint = \"leftFoot\", zone = \"body\", start = "
              "0.1, contact = 0.3 }]\n",
       "stands on the ground"},
      {head + "defense = { kind = \"duck\", window = [0.2, 0.7] }\n", "protects"},
      {head + "strike = [{ kind = \"straight\", joint = \"leftHand\", zone = \"head\", start = "
              "0.1, contact = 0.3, reach = [1.5, 0.1] }]\n",
       "more than the farthest"},
      {head + "response = { kind = \"absorb\" }\n", "only an action of kind 'response'"},
      {head + "starts_lying = \"back\"\n", "only a get-up"},
      {head + "ends_lying = \"back\"\n", "only a response"},
      {"name = \"a\"\nkind = \"response\"\nlength = 0.5\n"
       "response = { kind = \"absorb\", steps = 3 }\n",
       "steps do not fit"},
      {"name = \"a\"\nkind = \"response\"\nlength = 0.5\n"
       "response = { kind = \"recovery_steps\" }\n",
       "steps do not fit"},
      {"name = \"a\"\nkind = \"response\"\nlength = 0.5\n", "response to nothing"},
      {"name = \"a\"\nkind = \"attack\"\nlength = 0.5\n", "strikes nothing"},
      {"name = \"a\"\nkind = \"response\"\nlength = 0.5\nends_lying = \"back\"\n"
       "response = { kind = \"absorb\" }\n",
       "'knockdown' ends lying"},
      {head + "length = 0.4\n", ""},
      {"name = \"a\"\nkind = \"transition\"\nlength = 1e9\n", ""},
  };
  for (const auto& [text, what] : wrong) {
    const auto result = compiled(text);
    ASSERT_FALSE(result.has_value()) << text;
    EXPECT_NE(result.error().what.find(what), std::string::npos) << to_string(result.error());
    EXPECT_FALSE(result.error().place.empty()) << to_string(result.error());
  }
}

TEST(Sheet, WhatIsReadIsWhatTheHeaderSays) {
  const auto actions = compile_sheet_file(sheets_folder() / "combinations.toml");
  ASSERT_TRUE(actions.has_value());
  const Action& jab_cross = actions->at(0);
  EXPECT_EQ(jab_cross.kind, Kind::combination);
  ASSERT_EQ(jab_cross.strikes.size(), 2u);
  EXPECT_EQ(jab_cross.strikes[0].joint, Joint::left_hand);
  EXPECT_EQ(jab_cross.strikes[1].joint, Joint::right_hand);
  EXPECT_EQ(jab_cross.strikes[1].zone, TargetZone::head);
  for (const Strike& strike : jab_cross.strikes) {
    EXPECT_LT(strike.active_begin, strike.active_end);
    EXPECT_LE(strike.active_end, jab_cross.length());
  }
}

TEST(Sheet, WhatFollowsIsSaidByTheActionOrElseByTheFile) {
  const auto result = compiled_sheet(
      "leads_to = [\"jab*\", \"idle\"]\n[[action]]\nname = \"a\"\nkind = "
      "\"idle\"\nlength = 0.5\n[[action]]\nname = \"b\"\nkind = \"idle\"\nlength = 0.5\nleads_to = "
      "[\"step_left\"]\n");
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->at(0).leads_to, (std::vector<std::string>{"jab*", "idle"}));
  EXPECT_EQ(result->at(1).leads_to, (std::vector<std::string>{"step_left"}));
  EXPECT_EQ(mirrored(result->at(1)).leads_to, (std::vector<std::string>{"step_right"}));
  EXPECT_FALSE(compiled("name = \"a\"\nkind = \"idle\"\nlength = 0.5\nleads_to = [\"[\"]\n"));
  for (const auto& file : sheet_files()) {
    const auto actions = compile_sheet_file(file);
    ASSERT_TRUE(actions);
    for (const Action& action : *actions) EXPECT_FALSE(action.leads_to.empty()) << action.name;
  }
}

TEST(Sheet, TheSameSheetGivesTheSameBits) {
  for (const char* name : {"punches.toml", "falls.toml"}) {
    const auto a = compile_sheet_file(sheets_folder() / name);
    const auto b = compile_sheet_file(sheets_folder() / name);
    ASSERT_TRUE(a.has_value() && b.has_value());
    for (std::size_t i = 0; i < a->size(); ++i) {
      for (std::size_t f = 0; f < a->at(i).clip.frames.size(); ++f) {
        const Pose& p = a->at(i).clip.frames[f];
        const Pose& q = b->at(i).clip.frames[f];
        ASSERT_EQ(p.hips, q.hips);
        for (std::size_t j = 0; j < kJointCount; ++j) ASSERT_EQ(p.rotation[j], q.rotation[j]);
      }
    }
  }
}

TEST(SheetTrack, PassesItsKeysAndNeverOvershoots) {
  Track track;
  const std::vector<float> times = {0, 0.1f, 0.15f, 0.6f, 1.0f};
  const std::vector<float> values = {0, 0, 3, 3.1f, -2};
  for (std::size_t i = 0; i < times.size(); ++i) track.add(times[i], Vec3(values[i], 0, 0));
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(track.at(times[i]).x, values[i], 1e-5f);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (float u = 0; u <= 1; u += 0.05f) {
      const float x = track.at(times[i] + u * (times[i + 1] - times[i])).x;
      EXPECT_GE(x, std::min(values[i], values[i + 1]) - 1e-4f);
      EXPECT_LE(x, std::max(values[i], values[i + 1]) + 1e-4f);
    }
  }
}

TEST(SheetTrack, AStrikePathRunsByItsProfile) {
  const std::vector<float>* profile = speed_profile("cross");
  ASSERT_NE(profile, nullptr);
  EXPECT_EQ(speed_profile("uppercut of doom"), nullptr);
  const StrikePath path({0, 0.1f, 0.35f, 0.8f},
                        {{0, 0, 0}, {0, 0, 0.1f}, {0, 0, 1.0f}, {0, 0.2f, 0}},
                        {{0.1f, 0.35f, profile}});
  // Peak at 0.6 of the startup, on the way it is behind a symmetric ease and it arrives moving.
  float peak = 0, at_peak = 0;
  for (float t = 0.11f; t < 0.345f; t += 0.005f) {
    const float speed = glm::distance(path.at(t + 0.004f), path.at(t - 0.004f)) / 0.008f;
    if (speed > peak) peak = speed, at_peak = t;
  }
  EXPECT_NEAR((at_peak - 0.1f) / 0.25f, 0.6f, 0.08f);
  EXPECT_GT(peak, 1.5f * 0.9f / 0.25f);
  EXPECT_LT(path.at(0.1f + 0.3f * 0.25f).z, 0.1f + 0.9f * 0.20f);
  EXPECT_NEAR(glm::distance(path.at(0.35f), Vec3(0, 0, 1)), 0, 1e-3f);
}

TEST(SheetTrack, WideningCoversTheInputWithoutKinks) {
  std::vector<float> values(40, 0.0f);
  values[20] = 1;
  std::vector<float> wide = values;
  widen(wide, 6);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_GE(wide[i], values[i] - 1e-6f);
  for (std::size_t i = 1; i < wide.size(); ++i) EXPECT_LT(std::abs(wide[i] - wide[i - 1]), 0.2f);
}

}  // namespace
}  // namespace ringcraft
