#pragma once
// Biovision hierarchy files. Tolerant of what real files do (frame counts that lie, mixed line
// ends, Latin-1 names, zero-length joints), strict about what would be read wrong.

#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft {

// `file` is only for messages.
Result<RawClip> parse_bvh(std::string_view text, const std::string& file,
                          const CaptureLimits& limits = {});

Result<RawClip> read_bvh(const std::filesystem::path& path);

}  // namespace ringcraft
