#pragma once
// Responses that physics may ask for and that captures seldom hold.

#include <string>
#include <vector>

#include "motion/action.h"

namespace ringcraft {

// Adds to `actions` those responses of `others` that nothing among them stands for (of the same
// kind, steps and zone, and within 45 degrees of its direction), the falls that go with them, the
// get-ups for every way somebody may lie, and an idle where there is none. `notes` says which.
void add_missing_responses(std::vector<Action>& actions, std::vector<Action> others,
                           const std::string& named, std::vector<std::string>& notes);

}  // namespace ringcraft
