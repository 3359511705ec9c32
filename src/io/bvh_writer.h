#pragma once
// The one writer of BVH.

#include <string>

#include "fight/timeline.h"
#include "motion/foreign_skeleton.h"

namespace ringcraft {

// One fighter's shown motion as BVH: the T-pose that looks forward as rest pose, 60 Hz, rotations
// as Z X Y. The root's offset is zero, its channels hold the hips' position in the world.
std::string fighter_bvh(const Skeleton& skeleton, const FighterTrack& track,
                        const ForeignSkeleton& form = vrm_skeleton());

}  // namespace ringcraft
