#pragma once
// The moments of a bout at which a fighter chose, so that studies can choose there again.

#include <vector>

#include "scene/fight.h"

namespace ringcraft {

struct Moment {
  FightState state;
  FighterId fighter;
  ActionId launched;  // what it chose
  Tick horizon = 0;   // how far it looked
};

// All of them, in order; a bout that is interrupted ends early.
std::vector<Moment> moments_of(const MotionLibrary& library, const SceneFile& scene,
                               const FightOptions& options);

}  // namespace ringcraft
