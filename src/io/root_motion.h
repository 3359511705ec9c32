#pragma once
// Root motion: where the body is on the ground and which way it is turned, one placement a tick.

#include <vector>

#include "fight/timeline.h"

namespace ringcraft {

// Under the hips, low-passed so that neither their swing nor the bounce is in it; the yaw is that
// of the hips while the body is upright, and keeps its last value while it lies.
std::vector<Placement> root_motion(const FighterTrack& track);

}  // namespace ringcraft
