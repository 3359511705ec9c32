#pragma once
// What a library is worth: a table of its actions, the gates it must pass, and the faults it has,
// by name.

#include <optional>
#include <string>
#include <vector>

#include "motion/library.h"
#include "physics/body.h"
#include "scene/library_check_seams.h"
#include "scene/library_check_strikes.h"
#include "scene/library_check_yardstick.h"

namespace ringcraft {

// Measures of one action, on a body of canonical height.
struct ActionMeasures {
  std::string name;
  Kind kind = Kind::idle;
  bool authored = false;
  bool steps_or_rises = false;  // a step, an answer that stays up, a getting up
  bool left_out = false;        // not thrown at this opponent: no gate and no fault counts it
  double seconds = 0;
  double peak_speed_mps = 0;  // of the striking joint relative to the hips; 0 without a strike
  double strike_begin_s = 0;  // first tick at which it can hit
  double travel_m = 0;        // of the root over the action
  double turn_rad = 0;
  double foot_skate = 0;             // docs/sources.md, V4
  double own_jump_mps = 0;           // library_check_seams.h
  std::size_t limit_violations = 0;  // frames with a joint beyond its range by more than 3 degrees
  double worst_limit_deg = 0;        // degrees beyond its range of the joint that is farthest so
  std::string worst_joint;           // that joint
  double self_penetration_m = 0;     // 99 % of its frames have less, between parts that are apart
  std::vector<float> self_depths_m;  // the same of every frame, smallest first
  std::string worst_pair;            // the parts that are deepest in each other
  double still_hands = 0;    // share of the time of both wrists slower than 0.15 m/s in the world
  double head_moves_m = 0;   // farthest from where it began, in the root's frame
  std::size_t leads_to = 0;  // direct edges
  std::vector<std::string> may_lead_to;  // what its sheet says of that (action.h)
  std::string source;
};

ActionMeasures measure_action(const BodyModel& body, const Action& action);

// The library's actions in their order, then its changes of stance.
std::vector<ActionMeasures> measure(const MotionLibrary& library);

// One figure and what it has to be.
struct Gate {
  std::string name;
  double value = 0;
  double least = 0, most = 0;
  std::string unit;
  bool passed() const { return value >= least && value <= most; }
};

struct LibraryCheck {
  std::vector<ActionMeasures> actions;
  std::vector<StrikeMeasures> strikes;
  std::vector<SeamMeasures> seams;
  std::optional<Yardstick> yardstick;
  std::vector<Gate> gates;
  std::vector<std::string> faults;  // one line each; empty for a good library
};

// Without a yardstick its gates are left out. Gates of authored motion are asked of a library that
// has authored strikes; captured ones are what they are.
// Strikes are measured on a body `ratio` times as tall.
LibraryCheck check_library(const MotionLibrary& library, std::optional<Yardstick> yardstick,
                           float ratio = 1);

}  // namespace ringcraft
