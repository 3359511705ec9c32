#pragma once
// The whole process, measured as a user runs it: a fight of a scene, and what it cost.

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/fight.h"
#include "scene/study_run.h"

namespace ringcraft {

// What a fight comes to, whatever the machine and the number of threads.
struct FightSignature {
  std::uint64_t decisions = 0, nodes = 0, leaves = 0, impacts = 0, memo_misses = 0, timeline = 0;
  bool operator==(const FightSignature&) const = default;
};
FightSignature signature_of(const FightRecord& record);
std::string signature_text(const FightSignature& signature);  // one line

struct Bench {
  FightSignature signature;  // of every round
  int rounds = 0;            // that were finished
  bool differs = false;      // a round gave another signature than the first
  bool interrupted = false;
  // What the clock said, over all rounds.
  double wall_s = 0;      // of the fights
  double fought_s = 0;    // length of the fights
  double deciding_s = 0;  // sum of the decisions
  std::vector<double> decision_ms, impulse_step_us;
  double frame_pairs_per_s = 0;  // of two bodies at one tick, through the tree's penetration check
};

// Fights the scene `rounds` times, each time from an empty memo.
Bench run_bench(const MotionLibrary& library, const SceneFile& scene, int rounds,
                const StudyRun& run);

// bench.json and timing.json.
nlohmann::json bench_json(const Bench& bench, const SceneFile& scene, const MotionLibrary& library);
nlohmann::json bench_timing_json(const Bench& bench, int threads);
std::string bench_text(const nlohmann::json& timing);  // a table: measure, value, unit

}  // namespace ringcraft
