#pragma once
// A motion library as bytes, and back: what `ringcraft library build` writes.
//
// Layout, little-endian: magic, version, number of sections, size and hash (XXH3) of all that
// follows; a table of sections (name, offset, size); the sections: skeleton, actions, clips, edges,
// paths, graph, notes. The same library gives the same bytes. Nothing that the bytes say is
// trusted: sizes are checked against what is there before anything is made of them.

#include <string>
#include <string_view>

#include "base/error.h"
#include "motion/library.h"

namespace ringcraft {

inline constexpr std::uint32_t kLibraryVersion = 2;
inline constexpr std::size_t kMostActions = 2048;  // of a file: paths are a table of all pairs

std::string library_bytes(const MotionLibrary& library);

// Whether the bytes begin as a library file does.
bool looks_like_library(std::string_view bytes);

// The library of `bytes`, equal to the one they were made of; `file` is for messages.
Result<MotionLibrary> library_from_bytes(std::string_view bytes, const std::string& file);

}  // namespace ringcraft
