#pragma once
// Pace: how fast a launch runs through its clip. The tree knows that of what is in flight, and what
// fatigue will make of the rest; errors of execution are the fight's.

#include "motion/action.h"

namespace ringcraft {

class Pace {
 public:
  Pace() = default;  // as the clip
  // `factor` of the clip's speed until the last blow is over, easing back to the clip's afterwards;
  // of what is no attack all the way.
  Pace(const Action& action, float factor);

  // Age of the clip, ticks, `ticks` after the launch.
  float age(Tick ticks) const;
  // Ticks after the launch from which on the clip is at the age `clip`, or past it.
  Tick reached(Tick clip) const;
  float factor() const { return factor_; }
  bool as_the_clip() const { return factor_ == 1; }

  bool operator==(const Pace&) const = default;

 private:
  float factor_ = 1;
  float held_ = 0;  // ticks after the launch for which `factor_` holds
};

}  // namespace ringcraft
