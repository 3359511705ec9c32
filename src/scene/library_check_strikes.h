#pragma once
// What a strike of a library is worth: speeds, chain of links, and what it does to a body that
// stands before it.

#include <optional>
#include <string>
#include <vector>

#include "motion/library.h"
#include "physics/body.h"

namespace ringcraft {

// One strike of one action against a body that stands in the guard.
struct StrikeMeasures {
  std::string action;
  std::size_t number = 0;  // in the action
  Strike strike;
  bool authored = false;
  // Of the striking point (motion/aim.h), m/s.
  double peak_world = 0;
  double peak_to_pelvis = 0;
  double impact = 0;        // against the standing body, in the world, where it lands fastest
  double impact_at = 0;     // m between the two roots at the launch for that
  double impact_aimed = 0;  // m/s, from where it meets what it aims at
  // m between the two roots at the launch from which it lands in its zone, its guard left out;
  // both 0 where it never does.
  double lands_from = 0, lands_to = 0;
  double start_to_contact_s = 0;  // from the action's first tick to the fastest landing
  // Of the wrist or ankle against the pelvis.
  double peak_fraction = 0;  // when it is fastest, as a share of the time from its start to the end
                             // of the stroke
  double push = 0, brake = 0;  // m/s2, largest changes of its speed
  // s between the peak rates of pelvis yaw, shoulder yaw and the limb's speed; of hands.
  double pelvis_to_chest_s = 0, chest_to_limb_s = 0;
  // m: how far it passes from what it aims at, at the best distance and at the worst of its reach;
  // negative where it aims at nothing, or says no reach.
  double aim_best_m = -1, aim_worst_m = -1;
  // m between the two roots at the launch from which it passes within 3 cm.
  double aim_from = 0, aim_to = 0;
};

// Every strike against a body `ratio` times as tall.
std::vector<StrikeMeasures> measure_strikes(const MotionLibrary& library, float ratio = 1);

}  // namespace ringcraft
