#pragma once
// The paper's experiments: pairings of horizons or styles, many bouts of each with both sides
// swapped, counted and with confidence intervals.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "motion/library.h"
#include "scene/fight.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

// Two styles against each other. The first is the one whose wins are counted.
struct Pairing {
  std::string name;
  std::array<Style, 2> side;
};

// What one side did in a bout, or in all bouts of a pairing.
struct SideTally {
  std::int64_t attacks = 0, strikes = 0, hits = 0, defenses = 0, steps = 0, faced = 0;
  std::int64_t knockdowns = 0;               // that it made
  std::int64_t chosen = 0;                   // actions it chose
  std::map<std::string, std::int64_t> uses;  // of these, how often each
  std::int64_t feints = 0;
  std::int64_t taken_in = 0;  // feints that the other answered with a defense before their end
  double damage = 0;          // that it did, points
  std::int64_t decisions = 0;
  double ahead_s =
      0;  // looked ahead, s, summed over its decisions: less than t_f under a node limit
  SideTally& operator+=(const SideTally& o);
};

struct BoutTally {
  std::array<SideTally, 2> side;
  double seconds = 0, quiet_s = 0;         // the longest time without contact
  double distance_sum = 0, far_ticks = 0;  // m times ticks; ticks beyond kArmsLength
  double ticks = 0;
  double most_used = 0;  // the largest share that one action has of what a fighter chose
  std::string most_used_action;
  int winner = -1;  // 0, 1, or -1: a draw
  bool contact = false;
};

inline constexpr float kArmsLength = 1.25f;  // m between the hips: beyond it no fist lands
inline constexpr double kDrawPoints = 1;     // a lead in damage of no more is a draw

// Of a fight of two. A knockout wins, else the damage that was done.
BoutTally tally_of(const FightRecord& record);

struct BoutSeries {
  int bouts = 10;  // of each pairing; every second one with the sides swapped
  double duration_s = 60;
  float ring_m = 6;
};

// The scene of bout `i`: seeded places 1.6-3 m apart, up to 29 degrees off; bouts 2 k and 2 k + 1
// start alike with the sides swapped, but where a style fights itself every bout starts anew.
// `scene` gives bodies, health and planner.
SceneFile bout_scene(const SceneFile& scene, const Pairing& pairing, const BoutSeries& series,
                     int i);

struct PairingResult {
  Pairing pairing;
  std::vector<BoutTally> bouts;                  // side 0 is the pairing's first
  std::vector<std::vector<double>> decision_ms;  // one list a bout; what the clock said
};

// Every bout is a task of its own; results do not depend on the number of threads. A bout that was
// interrupted is not counted, and a pairing without bouts left out.
std::vector<PairingResult> run_pairings(const MotionLibrary& library, const SceneFile& scene,
                                        const std::vector<Pairing>& pairings,
                                        const BoutSeries& series, const StudyRun& run);

// "3v1": horizons in seconds, of `style` with that leaf value. Nothing where it does not read so.
std::optional<Pairing> horizon_pairing(const std::string& name, const Style& style);

// Table, timing and charts of the results; `study` has its name, title and what was said.
void fill_bouts(Study& study, const std::vector<PairingResult>& results);

}  // namespace ringcraft
