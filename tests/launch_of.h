#pragma once
// A launch of an action by its name, played to its end.

#include "fight/state.h"

namespace ringcraft {

inline Launch launch_of(const MotionLibrary& library, const char* name, Tick start,
                        const Placement& placement) {
  Launch launch;
  launch.action = library.find(name);
  launch.start = start;
  launch.end = start + library.action(launch.action).length();
  launch.placement = placement;
  return launch;
}

}  // namespace ringcraft
