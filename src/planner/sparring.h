#pragma once
// Simulated sparring: every attack of a library against every defense, over launch offsets and
// placements, with the contact test that the tree uses.

#include <atomic>
#include <cstdint>
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
  int distances = 3;                 // over the range in which the blow lands on a standing guard
  std::size_t idles = SIZE_MAX;      // in which the defender stands: so many of each stance
  float most_bearing = radians(15);  // the defender's facing off the attacker, both sides and none
  int threads = 1;                   // never changes the result
  const std::atomic<bool>* interrupted = nullptr;
};

struct Sparring {
  std::vector<SparringRecord> records;  // by attack, placement, defense, offset
  std::vector<ActionId> unlanded;       // attacks that meet no open target on a standing guard
};

// The attacker launches at tick 0, aimed as the tree aims; the defender stands in one idle after
// the other of the defense's stance until it launches that, and stands on after it. Only placements
// are asked about from which the first blow lands clean, in the zone it is made for, on the fighter
// that does nothing but stand: an uppercut smothered on the belly says nothing about what answers
// uppercuts, nor does a fist that is in the body already when it may first hit. A low kick that
// meets a shin while a check protects is blocked. `attacker` and `defender` are tables of one
// library.
Sparring spar(const MotionTables& attacker, const MotionTables& defender,
              const SparringSettings& settings = {});

}  // namespace ringcraft
