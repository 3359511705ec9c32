#pragma once
// The page of `ringcraft library inspect`: everything a library holds, for looking.

#include <string>

#include "motion/library.h"
#include "motion/offense_defense_table.h"

namespace ringcraft {

// Every action with its phases, speeds, where it leads and its filmstrip; the graph of actions and
// the motion graph as pictures; the offense/defense table, where it is not empty; what was dropped
// and on what evidence actions stand.
std::string library_page(const MotionLibrary& library, const OffenseDefenseTable& table);

}  // namespace ringcraft
