#pragma once
// Events as JSON, the same objects in events.jsonl and in the extras of the GLB's animation.
//
// docs/files.md names their fields. With lines: what a decision weighed, and what recomputes a hit.

#include <nlohmann/json.hpp>

#include "fight/timeline.h"

namespace ringcraft {

// Rounded to `decimals`, never minus zero: the same number is always the same text.
double rounded(double value, int decimals);

nlohmann::json event_json(const Event& event, bool with_lines);

}  // namespace ringcraft
