#pragma once
// What a library is worth: a table of its actions, and the faults it has, by name.

#include <string>
#include <vector>

#include "motion/library.h"

namespace ringcraft {

// Measures of one action, on a body of canonical height.
struct ActionMeasures {
  std::string name;
  Kind kind = Kind::idle;
  double seconds = 0;
  double peak_speed_mps = 0;  // of the striking joint relative to the hips; 0 without a strike
  double strike_begin_s = 0;  // first tick at which it can hit
  double travel_m = 0;        // of the root over the action
  double turn_rad = 0;
  double foot_skate = 0;             // validation table V4
  std::size_t limit_violations = 0;  // frames with a joint beyond its range by more than 3 degrees
  std::size_t leads_to = 0;          // direct edges
  std::string source;
};

std::vector<ActionMeasures> measure(const MotionLibrary& library);

// Named faults, one line each; empty for a good library: broken clips, joints beyond their range,
// sliding feet, responses that physics may ask for and that are missing, no idle, no get-up.
std::vector<std::string> library_faults(const MotionLibrary& library);

}  // namespace ringcraft
