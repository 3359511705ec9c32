#pragma once
// What a decision costs by how far it looks ahead and by how many actions there are to choose from.

#include "motion/library.h"
#include "scene/scene_file.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

struct CostStudy {
  std::vector<double> horizons_s{1, 1.5, 2, 2.5, 3};
  std::vector<int> choices{25, 50, 100, 200};  // what a fighter may choose from
  std::size_t decisions = 20;                  // of one bout of the scene on each library
};

// Table: nodes and leaves, without a node limit. Timing: processor time of a decision on one thread
// with every impulse step known.
Study cost_study(const MotionLibrary& library, const SceneFile& scene, const CostStudy& cost,
                 const StudyRun& run);

// The same library with `choices` actions that a fighter may choose: every kind keeps its share
// (one of a kind at least); more than there are come from the same ones played at 0.92, 0.84 ...
// of their speed outside of their blows. What is not chosen (responses, get-ups) stays.
MotionLibrary resized_library(const MotionLibrary& library, int choices);

}  // namespace ringcraft
