#pragma once
// A library in the paper's manner: "most actions longer than 1 second".

#include "motion/library.h"

namespace ringcraft {

// The same library with every action that a fighter may choose played slower by `factor`, except
// around its blows: from 0.12 s before a strike can hit until it no longer can, time runs as it
// did, so that a blow is as hard as before. Combinations have most of their length in such windows
// and stay nearly as they are; responses, falls and get-ups are not touched. The action machine is
// built anew.
MotionLibrary slowed_library(const MotionLibrary& library, float factor);

// One action of it.
Action slowed(const Action& action, float factor);

// Mean length of what a fighter may choose, s.
double mean_choice_seconds(const MotionLibrary& library);

}  // namespace ringcraft
