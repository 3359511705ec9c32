#pragma once
// Sparring records from a capture of two people in one space.

#include <vector>

#include "motion/action.h"
#include "motion/offense_defense_table.h"
#include "physics/body.h"

namespace ringcraft {

// What one of the two did, at a moment of the capture.
struct PairMove {
  ActionId id;  // what the records call it
  const Action* action = nullptr;
  Tick begin = 0;  // tick of the capture at which the action starts
  Placement root;  // there, in the capture's space
};

struct PairTake {
  const Clip* clip = nullptr;  // where it happened, one frame a tick
  std::vector<PairMove> moves;
};

// Every attack of one with every defense that the other launched from a quarter of a second before
// it until its last blow is over. The blow is tested against the body as it moved: swept capsules,
// guard first. `body`: both are taken to be of it.
std::vector<SparringRecord> pair_records(const BodyModel& body, const PairTake& attacker,
                                         const PairTake& defender);

}  // namespace ringcraft
