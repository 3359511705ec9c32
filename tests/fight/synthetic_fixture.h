#pragma once
// Launches of the synthetic library.

#include <gtest/gtest.h>

#include "fight/state.h"
#include "fight/synthetic_library.h"
#include "launch_of.h"

namespace ringcraft {

class SyntheticFixture : public testing::Test {
 protected:
  static const MotionLibrary& library() {
    static const MotionLibrary kLibrary = synthetic::library();
    return kLibrary;
  }
  static Launch launch(const char* name, Tick start, Placement placement) {
    return launch_of(library(), name, start, placement);
  }
};

}  // namespace ringcraft
