#pragma once
// The one writer of BVH.

#include <string>

#include "fight/timeline.h"

namespace ringcraft {

// One fighter's shown motion as BVH: bones by their VRM names, centimetres, +Y up, the T-pose
// facing +Z as rest pose, 60 Hz, rotations as Z X Y. The root's offset is zero, its channels hold
// the hips' position in the world.
std::string fighter_bvh(const Skeleton& skeleton, const FighterTrack& track);

}  // namespace ringcraft
