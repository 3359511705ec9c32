#pragma once
// Pruning by penetration, tried: threshold and check rate against what is pruned, how deep bodies
// get in the committed fight, and what the pruning costs in value and time.

#include "motion/library.h"
#include "scene/scene_file.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

struct PenetrationSweep {
  std::vector<double> threshold_m = {0.01, 0.02, 0.03, 0.05, 0.10};
  std::vector<Tick> every = {1, 4, 12};  // ticks between checks
  std::size_t decisions = 40;            // states in which plans are compared
};

// A first bout without this pruning says where decisions fall; in these states every setting plans
// again, and a bout of its own is fought under every setting.
Study penetration_study(const MotionLibrary& library, const SceneFile& scene,
                        const PenetrationSweep& sweep, const StudyRun& run);

}  // namespace ringcraft
