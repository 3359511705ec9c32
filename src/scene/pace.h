#pragma once
// Pace: how fast a launch runs through its clip. The tree plans with the clip as it is; errors of
// execution and fatigue are the fight's.

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
  // Ticks after the launch from which on the clip is at its end.
  Tick length(Tick clip_length) const;

 private:
  float factor_ = 1;
  float held_ = 0;  // ticks after the launch for which `factor_` holds
};

}  // namespace ringcraft
