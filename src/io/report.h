#pragma once
// report.json and timing.json of a fight.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fight/timeline.h"
#include "io/outputs.h"

namespace ringcraft {

// What a timeline does not know of its run.
struct RunFacts {
  struct Contestant {
    std::string style;
    double horizon_s = 0;
    // At the end, 0 .. 1: how tired, and how hurt left arm, right arm, left leg and right leg are.
    double fatigue = 0;
    std::array<double, 4> injuries{};
  };
  std::string version = RINGCRAFT_VERSION;
  std::string scene;
  std::uint64_t seed = 0;
  std::vector<Contestant> contestants;  // one a fighter
  std::uint64_t memo_hits = 0, memo_misses = 0;
  std::uint64_t impulse_steps = 0;     // in all: committed, and first-time in the tree
  std::uint64_t foreseen = 0;          // contacts that the tree had told of the strikes in flight
  std::uint64_t agreed_at_launch = 0;  // of them, rightly when somebody last began something
  bool interrupted = false;            // the report covers what was finished
};

// What the clock said.
struct ClockFacts {
  double wall_s = 0;
  int threads = 1;
  std::vector<double> decision_ms, impulse_step_us;
};

// How many actions a library has, by kind: attacks are single blows, combinations several. Those
// that only connect others are in no other count.
nlohmann::json library_counts(const MotionLibrary& library);

// Every field is the same for the same fight. A fighter's recovery_steps,
// knockdowns and knockouts are those it suffered; hits_taken are clean ones. foreseen_agreement is
// the share of the contacts that the tree foresaw from the actions in flight, with their kind of
// response, asked last in the tick before; foreseen_at_launch_agreement when somebody last began
// something. Null without a contact.
nlohmann::json report_json(const Timeline& timeline, const std::vector<FighterLook>& looks,
                           const MotionLibrary& library, const RunFacts& facts);

// The one output that differs from run to run.
nlohmann::json timing_json(const Timeline& timeline, const ClockFacts& clock,
                           const std::string& version = RINGCRAFT_VERSION);

}  // namespace ringcraft
