#pragma once
// Registration: which moments of two repetitions of one action belong together (Kovar and Gleicher
// 2004, "Flexible automatic motion blending with registration curves").
//
// Dynamic time warping of the point clouds of all frames, each pair aligned on the floor
// (point_cloud.h), between moments that are known to belong together: where a blow begins to be
// able to hit and where it no longer can, where a foot is lifted and set down. The path is made
// smooth and strictly rising.

#include <optional>
#include <utility>
#include <vector>

#include "motion/action.h"

namespace ringcraft {

struct Registration {
  std::vector<float> tick;  // of the other clip, for every tick of the reference; strictly rising
  float distance = 0;       // m: mean distance of the clouds along the warp
};

// Moments of the reference and of the other clip that belong together; the ends always do.
using Anchors = std::vector<std::pair<Tick, Tick>>;

// `anchors` rise in both, strictly, between the ends.
Registration registered(const Skeleton& skeleton, const Clip& reference, const Clip& other,
                        const Anchors& anchors = {});

// The same distance from every fourth frame only.
float registration_distance(const Skeleton& skeleton, const Clip& reference, const Clip& other,
                            const Anchors& anchors = {});

// The moments at which the phases of two actions change, if they have the same phases: blows of
// the same kinds with the same limbs, the same defense; of a transition, the same feet lifted and
// set down in the same order. Nothing where they differ.
std::optional<Anchors> shared_phases(const Action& reference, const Action& other);

}  // namespace ringcraft
