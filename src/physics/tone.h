#pragma once
// How much tone the muscles of a struck body have: in the simulation that is shown, in the impulse
// step, and what the interrupted action leaves of it (docs/hits.md, "Tone").

#include "motion/action.h"
#include "physics/muscles.h"

namespace ringcraft {

inline constexpr float kReflex = .12f;  // s: no reflex is faster; until then the struck body gives
inline constexpr float kFirm = .30f;    // s: full tone again
inline constexpr float kGatherTone = .6f;  // of a body that lies and is about to get up

// Of a body that stays up, `seconds` after the blow: trunk and arms are slack until the reflex, the
// legs carry on; the neck has its full torque but gives like a muscle (stiffness-limited).
Tone standing_tone(float seconds, float tone);

// Of one that falls and protects itself.
Tone falling_tone();

// Of one in the impulse step.
Tone struck_tone(float tone);

// What an action leaves of a fighter's tone at `age`, share of full: of who has just been struck or
// falls as much as the simulation that is shown gives its muscles, the mean by their torques; who
// gets up comes back to the whole from what it gathered itself with. Any other action: 1.
float tone_left(const Action& action, Tick age);

}  // namespace ringcraft
