#pragma once
// Which action of the library answers an outcome.

#include <span>
#include <vector>

#include "motion/library.h"
#include "physics/impact.h"

namespace ringcraft {

// A blow of less impulse is a touch: nobody is moved by it. N s.
inline constexpr float kTouchImpulse = 5.0f;

// Whether a blow cuts the struck fighter's action: not a touch, nor a block that holds without a
// step, but always a knockout. `impulse` in N s.
bool interrupts(bool blocked, float impulse, const ImpactOutcome& outcome);

// What is answered: a blow that cuts nothing (`interrupts`) is absorbed where the body is.
ImpactOutcome answered(bool cuts, ImpactOutcome outcome);

// The response action of the outcome's kind that fits best by steps and how far they can go, by
// direction (seen from a body that faces `facing`, world yaw) and by the motion of head, chest and
// hips that it continues.
// Equal ones: the lower index. The library must hold one response at least.
// Only responses of the struck fighter's stance count.
ActionId choose_response(const MotionLibrary& library, const BodyModel& body,
                         const ImpactOutcome& outcome, float facing,
                         Stance stance = Stance::orthodox);

// Which of the lying poses is nearest to `pose`: by where the trunk's joints are about the hips and
// how high, the limbs counting for less, since a lying body can move those. Not for an empty list.
struct NearestLying {
  std::size_t pose = 0;
  float apart = 0;  // m, rms over the joints with those weights
};
NearestLying nearest_lying(const Skeleton& skeleton, std::span<const Pose> lying, const Pose& pose);

// The poses that the library's get-ups of one stance start from, for that body, in their order.
std::vector<Pose> lying_poses(const MotionLibrary& library, const Skeleton& skeleton,
                              Stance stance = Stance::orthodox);

// The get-up of that stance that starts from the lying pose nearest to `pose`.
ActionId choose_get_up(const MotionLibrary& library, const Skeleton& skeleton, const Pose& pose,
                       Stance stance = Stance::orthodox);

}  // namespace ringcraft
