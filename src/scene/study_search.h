#pragma once
// The search, measured: what a decision costs and in which of its parts, how many leaves it visits
// against the Knuth-Moore minimal tree, and what each device of the search does for that.

#include "motion/library.h"
#include "scene/scene_file.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

struct SearchStudy {
  std::size_t decisions = 200;  // of bouts of the scene, seeds from the scene's own on
  int warm_up_bouts = 3;        // with other seeds, whose impulse steps are known beforehand
  int dives = 200;              // random ways down each tree, to know its shape
};

// Table: devices of the search, over the same trees. Timing: a decision and its parts.
Study search_study(const MotionLibrary& library, const SceneFile& scene, const SearchStudy& search,
                   const StudyRun& run);

}  // namespace ringcraft
