#pragma once
// Feints: the beginning of an attack, turned back before the blow.

#include <span>
#include <string>

#include "motion/library.h"

namespace ringcraft {

// The feint of an attack: its own motion until the blow is about to come, slowed to a halt there
// and taken back the way it came, to where it began. Needs a first strike that may hit no earlier
// than kEarliestFeint ticks after the launch.
inline constexpr Tick kEarliestFeint = 15;
Action feint_of(const Action& attack);

// Whether an attack can be feigned.
bool can_be_feigned(const Action& action);

// The library with the feints of the named attacks behind its actions ("jab" gives "jab_feint"), in
// the order of the names, and its state machine built anew; names of which none can be feigned are
// passed over. No motion graph. Without names: as it is.
MotionLibrary with_feints(MotionLibrary library, std::span<const std::string> attacks);

}  // namespace ringcraft
