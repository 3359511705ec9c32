#pragma once
// Finding and loading a motion library for a scene or a command.

#include <filesystem>

#include "base/error.h"
#include "motion/library.h"

namespace ringcraft {

// `library`: a manifest file, a folder that holds library.toml, or the name of a folder in assets.
Result<MotionLibrary> load_library(const std::filesystem::path& library);

}  // namespace ringcraft
