#pragma once
// Which action of the library answers an outcome.

#include "motion/library.h"
#include "physics/impact.h"

namespace ringcraft {

// A blow of less impulse is a touch: nobody is moved by it. N s.
inline constexpr float kTouchImpulse = 5.0f;

// Whether a blow cuts the struck fighter's action: not a touch, and not a block that holds without
// a step. `impulse` in N s.
bool interrupts(bool blocked, float impulse, const ImpactOutcome& outcome);

// The response action of the outcome's kind that fits best by steps, by direction (seen from a body
// that faces `facing`, world yaw) and by the motion of head, chest and hips that it continues.
// Equal ones: the lower index. The library must hold one response at least.
ActionId choose_response(const MotionLibrary& library, const ImpactOutcome& outcome, float facing);

// The get-up that starts from the lying pose nearest to `pose` (joint positions about the root).
ActionId choose_get_up(const MotionLibrary& library, const Skeleton& skeleton, const Pose& pose);

}  // namespace ringcraft
