#pragma once
// A library in the paper's manner: "most actions longer than 1 second".

#include "motion/library.h"

namespace ringcraft {

// The same library with every action that a fighter may choose played slower by `factor`, except
// where a strike can hit: there time runs as it did, so that a blow is as hard as before. What
// leads up to a blow is slower like what answers it: were only the answers slower, none would come
// in time. Responses, falls and get-ups are not touched. The action machine is built anew.
MotionLibrary slowed_library(const MotionLibrary& library, float factor);

// One action of it.
Action slowed(const Action& action, float factor);

// The share of what a fighter may choose that is longer than `length_s`, 0..1.
double share_longer(const MotionLibrary& library, double length_s);

// Mean length of what a fighter may choose, s.
double mean_choice_seconds(const MotionLibrary& library);

}  // namespace ringcraft
