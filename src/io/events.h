#pragma once
// Events as JSON, the same objects in events.jsonl and in the extras of the GLB's animation.
//
// Every event: t (s), tick, type, who, whom (fighter indices; whom is absent where there is none),
// action. strike    + strike (kind) hit, block + strike, part, point [x, y, z] m, impulse [x, y, z]
// N s, impulse_Ns, speed_mps,
//             effective_mass_kg, head_spin_radps, damage, response, steps, direction_rad, knockout,
//             foreseen, and with lines: replay (what recomputes the hit, base64)
// response, knockdown, getup + response, steps, direction_rad, knockout
// decision  + nodes, leaves, forced_nodes, pruned{...}, chosen, and with lines: lines[]{score,
// moves[]{who,
//             action, forced}} best first

#include <nlohmann/json.hpp>

#include "fight/timeline.h"

namespace ringcraft {

// Rounded to `decimals`, never minus zero: the same number is always the same text.
double rounded(double value, int decimals);

nlohmann::json event_json(const Event& event, bool with_lines);

}  // namespace ringcraft
