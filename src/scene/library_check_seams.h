#pragma once
// How smoothly actions follow each other: the seams of a library as playback shows them.

#include <string>
#include <vector>

#include "motion/library.h"

namespace ringcraft {

// One direct edge of the state machine: the end of one action, then the start of the next.
struct SeamMeasures {
  ActionId from, to;
  Joint joint = Joint::hips;  // the one that jumps most
  // m/s by which its shown velocity changes from one frame of 60 Hz to the next, beyond what the
  // two clips do themselves within 0.1 s of the seam.
  double jump = 0;
};

// m/s by which the velocity of the joint that jumps most changes in a clip from one frame of 60 Hz
// to the next.
double own_jump(const Skeleton& skeleton, const Clip& clip);

// Every edge between actions that a fighter can choose, out of responses and get-ups too, on a body
// of canonical height; by action and edge.
std::vector<SeamMeasures> measure_seams(const MotionLibrary& library);

}  // namespace ringcraft
