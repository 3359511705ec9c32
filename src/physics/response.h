#pragma once
// Which action of the library answers an outcome.

#include "motion/library.h"
#include "physics/impact.h"

namespace ringcraft {

// The response action of the outcome's kind and steps whose direction is nearest to the outcome's,
// seen from a body that faces `facing` (world yaw). The library must hold one of each kind.
ActionId choose_response(const MotionLibrary& library, const ImpactOutcome& outcome, float facing);

// The get-up that starts from the lying pose nearest to `pose` (joint positions about the root).
ActionId choose_get_up(const MotionLibrary& library, const Skeleton& skeleton, const Pose& pose);

}  // namespace ringcraft
