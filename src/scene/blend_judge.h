#pragma once
// What the body model has against a blended action.

#include "motion/interpolation.h"

namespace ringcraft {

// Refuses an action in which a joint of a body of canonical height goes beyond its range by more
// than 3 degrees, as `library check` does.
Judge joint_limit_judge();

}  // namespace ringcraft
