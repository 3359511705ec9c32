// How much the thresholds of segmentation matter: each of them 15 % up and down.
// RINGCRAFT_PRINT=1 prints the table of docs/captures.md.

#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture/segment_measure.h"
#include "capture/segment_truth.h"

namespace ringcraft {
namespace {

using namespace testing;

struct Take {
  Measures measures;
  std::vector<Descent> falls;
};

Take take_of(const char* file) {
  const Clip clip = canonical_clip_of(mocap_folder() / file);
  Take take{measured(canonical_skeleton(), clip), {}};
  take.falls = descents(take.measures);
  return take;
}

struct Takes {
  std::vector<Take> listed, kicks, peaceful;
};

Takes all_takes() {
  Takes takes;
  for (const ListedTake& take : kListed) takes.listed.push_back(take_of(take.file));
  for (const KickTake& kick : kKicks) takes.kicks.push_back(take_of(kick.file));
  for (const char* file : kPeaceful) takes.peaceful.push_back(take_of(file));
  return takes;
}

struct Outcome {
  std::vector<Score> scores;
  int kicks_right = 0;  // found alone, with side and kind
  int kicks_found = 0;  // with side
  int false_strikes = 0;
};

Outcome outcome_of(const Takes& takes, const SegmentSettings& settings) {
  Outcome out;
  const auto blows = [&](const Take& take) {
    return all_blows(take.measures, take.falls, settings);
  };
  for (std::size_t i = 0; i < kListed.size(); ++i)
    out.scores.push_back(score_of(blows(takes.listed[i]), kListed[i].eye, kListed[i].rule));
  for (std::size_t i = 0; i < kKicks.size(); ++i) {
    const std::vector<FoundBlow> found = blows(takes.kicks[i]);
    const KickTake& kick = kKicks[i];
    const auto side = [&](const FoundBlow& blow) { return blow.strike.joint == kick.foot; };
    out.kicks_found += std::any_of(found.begin(), found.end(), side) ? 1 : 0;
    out.kicks_right += found.size() == 1 && side(found[0]) && found[0].strike.kind == kick.kind &&
                               found[0].spins == kick.spins
                           ? 1
                           : 0;
  }
  for (const Take& take : takes.peaceful) out.false_strikes += static_cast<int>(blows(take).size());
  return out;
}

struct Threshold {
  const char* name;
  float SegmentSettings::*value;
};

const std::vector<Threshold> kThresholds = {{"straight_speed", &SegmentSettings::straight_speed},
                                            {"arm_opens", &SegmentSettings::arm_opens},
                                            {"arm_opens_late", &SegmentSettings::arm_opens_late},
                                            {"arm_open", &SegmentSettings::arm_open},
                                            {"goes_ahead", &SegmentSettings::goes_ahead},
                                            {"bent_speed", &SegmentSettings::bent_speed},
                                            {"bent_ahead", &SegmentSettings::bent_ahead},
                                            {"bent_least", &SegmentSettings::bent_least},
                                            {"bent_gain", &SegmentSettings::bent_gain},
                                            {"gaze_turn", &SegmentSettings::gaze_turn},
                                            {"block_speed", &SegmentSettings::block_speed},
                                            {"across", &SegmentSettings::across},
                                            {"rises", &SegmentSettings::rises},
                                            {"kick_speed", &SegmentSettings::kick_speed},
                                            {"leg_folds", &SegmentSettings::leg_folds},
                                            {"leg_opens", &SegmentSettings::leg_opens},
                                            {"kick_height", &SegmentSettings::kick_height},
                                            {"kick_ahead", &SegmentSettings::kick_ahead},
                                            {"round_turn", &SegmentSettings::round_turn},
                                            {"spin_turn", &SegmentSettings::spin_turn},
                                            {"shortest", &SegmentSettings::shortest},
                                            {"standing", &SegmentSettings::standing},
                                            {"travelling", &SegmentSettings::travelling}};

void print_row(const std::string& name, float value, const Outcome& o) {
  if (std::getenv("RINGCRAFT_PRINT") == nullptr) return;
  std::string row = fmt::format("| {} | {:.3g} |", name, value);
  for (const Score& s : o.scores)
    row += fmt::format(" {:.2f} {:.2f} {:.2f} |", s.precision, s.recall, s.kind);
  fmt::print("{} {}, {} | {} |\n", row, o.kicks_found, o.kicks_right, o.false_strikes);
}

TEST(SegmentSensitivity, NoThresholdMattersMuchWithinFifteenPercent) {
  if (!std::filesystem::exists(mocap_folder())) GTEST_SKIP() << "skipped: no captures";
  const Takes takes = all_takes();
  print_row("as set", 0, outcome_of(takes, {}));
  for (const Threshold& threshold : kThresholds) {
    for (const float factor : {0.85f, 1.15f}) {
      SegmentSettings settings;
      settings.*threshold.value *= factor;
      const Outcome outcome = outcome_of(takes, settings);
      print_row(threshold.name, settings.*threshold.value, outcome);
      for (const Score& score : outcome.scores) {
        EXPECT_GE(score.precision, 0.9) << threshold.name << " x " << factor;
        EXPECT_GE(score.recall, 0.85) << threshold.name << " x " << factor;
        EXPECT_GE(score.kind, 0.8) << threshold.name << " x " << factor;
      }
      EXPECT_GE(outcome.kicks_found, 7) << threshold.name << " x " << factor;
      EXPECT_LE(outcome.false_strikes, 1) << threshold.name << " x " << factor;
    }
  }
}

}  // namespace
}  // namespace ringcraft
