#pragma once
// Launches of the synthetic library.

#include <gtest/gtest.h>

#include "fight/state.h"
#include "fight/synthetic_library.h"

namespace ringcraft {

class SyntheticFixture : public testing::Test {
 protected:
  static const MotionLibrary& library() {
    static const MotionLibrary kLibrary = synthetic::library();
    return kLibrary;
  }
  static Launch launch(const char* name, Tick start, Placement placement) {
    Launch launch;
    launch.action = library().find(name);
    launch.start = start;
    launch.end = start + library().action(launch.action).length();
    launch.placement = placement;
    return launch;
  }
};

}  // namespace ringcraft
