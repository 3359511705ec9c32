#pragma once
// What every fuzzer asks of a reader: a whole clip, or one error that says what and what to do.

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft::fuzzing {

// Small, so that a run is spent on reading and not on long clips.
inline constexpr CaptureLimits kLimits{64, 32, 4096};

inline void require(bool holds) {
  if (!holds) std::abort();
}

inline void check(const Result<RawClip>& clip) {
  if (!clip) {
    require(!clip.error().what.empty() && !clip.error().remedy.empty());
    return;
  }
  require(clip->frames > 0);
  require(clip->joints.size() <= kLimits.joints);
  require(clip->rotation.size() == clip->frames * clip->joints.size());
  require(clip->translation.size() == clip->rotation.size());
  for (std::size_t j = 0; j < clip->joints.size(); ++j)
    require(clip->joints[j].parent < static_cast<int>(j));
  for (const double time : {0.0, 0.3, 1e9}) {
    const RawPose pose = raw_pose(*clip, time);
    for (const Vec3& p : pose.position) require(std::isfinite(p.x + p.y + p.z));
    for (const Quat& q : pose.rotation) require(std::abs(glm::length(q) - 1) < 1e-2f);
  }
}

}  // namespace ringcraft::fuzzing
