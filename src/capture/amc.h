#pragma once
// Acclaim motions (.amc) on their skeletons (.asf). The clip is in metres.

#include <filesystem>

#include "capture/asf.h"

namespace ringcraft {

// The format does not say its rate; CMU and HDM05 keep 120 frames a second.
inline constexpr double kAcclaimRate = 120;

// `file` is only for messages. Bones without motion keep their rest pose.
Result<RawClip> parse_amc(std::string_view text, const std::string& file,
                          const AsfSkeleton& skeleton, double frames_per_second = kAcclaimRate,
                          const CaptureLimits& limits = {});

Result<RawClip> read_asf_amc(const std::filesystem::path& asf, const std::filesystem::path& amc,
                             double frames_per_second = kAcclaimRate);

// The skeleton that lies beside a motion: of the motion's own name, or of what stands before one of
// its underscores (13_17.amc: 13.asf), the longest first.
Result<std::filesystem::path> skeleton_beside(const std::filesystem::path& amc);

}  // namespace ringcraft
