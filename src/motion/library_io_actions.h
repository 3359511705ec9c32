#pragma once
// Actions and their clips as bytes. Inside the library file only.

#include <vector>

#include "motion/action.h"
#include "motion/library_io_bytes.h"

namespace ringcraft {

// Everything of an action but its clip.
void put_action(BytesOut& out, const Action& action);
Action get_action(BytesIn& in);

void put_clip(BytesOut& out, const Clip& clip);
Clip get_clip(BytesIn& in);

// What is wrong with an action that was read, for one that would break the rules that the fight
// relies on; empty for a good one. Its clip is looked at too.
std::string wrong_with(const Action& action);

}  // namespace ringcraft
