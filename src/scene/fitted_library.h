#pragma once
// The library as somebody does it against an opponent of another height.

#include "motion/library.h"

namespace ringcraft {

// fitted() of motion/strike_fit.h with every joint inside its range, and without the attacks that
// cannot be thrown so: they stay in their place, but only connect and nobody chooses them.
MotionLibrary fitted_library(const MotionLibrary& library, float ratio);

}  // namespace ringcraft
