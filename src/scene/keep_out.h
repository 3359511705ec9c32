#pragma once
// Arms and free legs stay out of the other body: what is shown never sinks into what it struck.

#include "motion/clip.h"
#include "physics/body.h"

namespace ringcraft {

// `pose` (world) with hands, forearms and feet that are not `held` moved out of `other`, along the
// shortest way and by at most kMostKeptOut, by two-link IK. Unchanged where nothing penetrates.
inline constexpr float kMostKeptOut = 0.16f;  // m
Pose kept_out(const BodyModel& body, const Pose& pose, FootContacts held,
              const BodyCapsules& other);

}  // namespace ringcraft
