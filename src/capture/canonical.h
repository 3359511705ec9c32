#pragma once
// A capture of any known format on the canonical skeleton: read, its junk start replaced, its
// skeleton recognised, retargeted.

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "capture/profile.h"
#include "capture/read_capture.h"
#include "motion/clip.h"
#include "motion/skeleton.h"

namespace ringcraft {

struct CanonicalCapture {
  RawClip raw;  // as in the file
  SkeletonProfile profile;
  Clip clip;  // on the canonical skeleton, one frame a tick
};

// `profiles`: those that are tried; without them those of the folder assets/profiles.
Result<CanonicalCapture> read_canonical(const std::filesystem::path& path, const Skeleton& skeleton,
                                        const CaptureSource& source = {});
Result<CanonicalCapture> read_canonical(const std::filesystem::path& path, const Skeleton& skeleton,
                                        const std::vector<SkeletonProfile>& profiles,
                                        const CaptureSource& source = {});

// Of a capture that has been read.
Result<CanonicalCapture> canonical_of(RawClip raw, const Skeleton& skeleton,
                                      const std::vector<SkeletonProfile>& profiles);

}  // namespace ringcraft
