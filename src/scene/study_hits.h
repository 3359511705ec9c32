#pragma once
// The hits of a library held against published figures: strikes, balance, what people see, the
// failures that game makers report, the laws that must hold, robustness.

#include <cstdint>
#include <string>
#include <vector>

#include "motion/library.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

struct HitsSettings {
  int count = 200;                     // of random hits in each of the questions that try many
  std::uint64_t seed = 1;              // of those
  std::vector<std::string> only = {};  // of hit_questions(); all where it is empty
};

// The names of the study's questions, in the order of its rows.
std::vector<std::string> hit_questions();

struct HitsStudy {
  Study study;
  int missed = 0;  // bars that do not hold
};

// Every row: what was measured, what is published, the bar it is held to (if any) and whether it
// holds. Cost, asked for as "cost", stands in the study's timing.
HitsStudy hits_study(const MotionLibrary& library, const HitsSettings& settings,
                     const StudyRun& run);

}  // namespace ringcraft
