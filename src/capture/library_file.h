#pragma once
// Finding and loading a motion library for a scene or a command.

#include <filesystem>

#include "base/error.h"
#include "motion/library.h"

namespace ringcraft {

// `library`: a file that `ringcraft library build` wrote, a manifest, a folder that holds
// library.toml, or the name of a folder in assets. A manifest is built on the spot, without a
// motion graph: that is the work of `library build`.
Result<MotionLibrary> load_library(const std::filesystem::path& library);

// Whether a file's first bytes are those of a built library.
bool begins_as_library(const std::filesystem::path& file);

// What `library build` and load_library() are given: a library file or a manifest as it is, a
// folder's library.toml where it has one, else the folder.
std::filesystem::path library_source(const std::filesystem::path& named);

// Whether write_library() may: a file that is no library is not overwritten, and none is written
// that could not be read back.
Result<void> may_write_library(const std::filesystem::path& file);
// Writes the whole file or none. An error where may_write_library() has one or the place cannot be
// written.
Result<void> write_library(const MotionLibrary& library, const std::filesystem::path& file);

}  // namespace ringcraft
