#pragma once
// How near authored boxing is to captured boxing, both ways: one way alone is won by blurring.

#include <string>
#include <vector>

#include "motion/library.h"

namespace ringcraft {

struct Yardstick {
  // m, median and 90 %, of the distance from each frame to the nearest of the other side: root mean
  // square over 12 joints relative to the pelvis and the hip line, with velocities weighed by 0.05
  // s (authored to real) and 0.1 s (real strikes to authored).
  double authored_median = 0, authored_90 = 0, strikes_median = 0, strikes_90 = 0;
  double fast_hand = 0;  // m/s: 99 % of the faster hand's speeds of authored boxing are below it
  struct Far {
    std::string action;
    double median = 0;  // m
  };
  std::vector<Far> farthest;  // authored boxing, the farthest action first
};

// `real`: a captured boxer of the library's stance; frames of [from, to). Kicks, falls and answers
// are left out of the authored side: the capture holds none.
Yardstick yardstick(const MotionLibrary& library, const Clip& real, Tick from, Tick to);

}  // namespace ringcraft
