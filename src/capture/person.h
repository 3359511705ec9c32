#pragma once
// One person of a capture of several: the motion where it happened in the capture's space, and the
// actions found in it.

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "motion/action.h"

namespace ringcraft {

struct CapturedAction {
  Action action;   // cut and turned to action space (cut.h)
  Tick begin = 0;  // tick of the capture at which it starts
  Placement root;  // there, in the capture's space: position in metres of the captured person
};

struct CapturedPerson {
  Clip clip;  // canonical skeleton, one frame a tick; the hips' ground position in captured metres
  std::vector<CapturedAction> actions;  // in order of their begins
  std::vector<std::string> notes;
};

// Reads, retargets and segments one capture. Unlike retarget() it keeps distances on the ground as
// they were captured, so that two files of one capture space stand to each other as the people did.
Result<CapturedPerson> read_person(const std::filesystem::path& capture);

}  // namespace ringcraft
