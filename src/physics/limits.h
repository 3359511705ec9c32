#pragma once
// How far joints are from the ends of their ranges, and poses that slow before they get there.

#include <array>
#include <optional>

#include "physics/body.h"

namespace ringcraft {

// Per limit of a body, in one order, how far a pose is beyond it, rad; below zero inside.
inline constexpr std::size_t kLimitCount = 16;
using LimitExcesses = std::array<float, kLimitCount>;
LimitExcesses limit_excesses(const Pose& pose);
std::optional<Side> leg_of_limit(std::size_t limit);  // the leg whose joint it is; none otherwise

// The pose with its joints inside their ranges and no corner in the motion: a joint may go as far
// as it is `free` to, and slows from there on to `most`, which it does not pass. A twist that has
// turned over stays on the side it was on `before`.
Pose within_limits(const BodyModel& body, const Pose& pose, float most, const Pose& before,
                   const LimitExcesses& free);

}  // namespace ringcraft
