#pragma once
// From files to a library: a manifest names captures and technique sheets; actions are cut from the
// first and compiled from the second.

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/library.h"

namespace ringcraft {

// Reads the manifest (assets/schemas/manifest.schema.json), the captures and sheets it names, and
// builds the library. Paths in a manifest are relative to the manifest. A capture that is marked
// optional and is not there is passed over.
Result<MotionLibrary> build_library(const std::filesystem::path& manifest);

// The actions alone, before the state machine drops what is not connected; `notes`, when given,
// collects what was passed over and why.
Result<std::vector<Action>> collect_actions(const std::filesystem::path& manifest,
                                            std::vector<std::string>* notes = nullptr);

}  // namespace ringcraft
