#pragma once
// Simulated sparring: every attack of a library against every defense, over launch offsets and
// placements, with the contact test that the tree uses.

#include <atomic>
#include <functional>
#include <vector>

#include "motion/offense_defense_table.h"
#include "planner/motion_tables.h"

namespace ringcraft {

struct SparringSettings {
  // A defense is launched at the earliest this many ticks before the attack, at the latest when the
  // blow can first hit.
  Tick earliest = 30;
  Tick offset_step = kOffsetBin;
  int distances = 5;                 // over the range in which the blow lands on a standing guard
  float most_bearing = radians(15);  // the defender's facing off the attacker, both sides and none
  int threads = 1;                   // never changes the result
  const std::atomic<bool>* interrupted = nullptr;
};

struct Sparring {
  std::vector<SparringRecord> records;  // by attack, placement, defense, offset
  std::vector<ActionId> unlanded;       // attacks that meet no open target on a standing guard
};

// The attacker launches at tick 0, aimed as the tree aims; the defender stands in the library's
// first idle until it launches the defense, and stands on after it. Only placements from which the
// attack lands clean on the fighter that does nothing but stand are asked about. `attacker` and
// `defender` are tables of one library.
Sparring spar(const MotionTables& attacker, const MotionTables& defender,
              const SparringSettings& settings = {});

}  // namespace ringcraft
