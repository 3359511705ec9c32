#pragma once
// Skeleton profiles: which joint of a capture is which canonical bone, its units and axes.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "capture/raw_clip.h"
#include "motion/foreign_skeleton.h"

namespace ringcraft {

struct SkeletonProfile {
  std::string name;
  std::vector<float> metres_per_unit;  // tried before all others; the first that gives human legs
  Vec3 up{0, 1, 0};                    // in the file's axes, where its rest pose agrees
  Vec3 forward{0, 0, 1};               // where the rest pose looks, in the file's axes
  std::vector<std::string> prefixes;   // taken off the file's names before they are compared
  std::array<std::string, kJointCount> source;  // empty where the file has no such joint
  // Joints that hang elsewhere than below the bone that should carry them, as feet of rigs do that
  // are led by inverse kinematics.
  std::array<bool, kJointCount> detached{};
};

// A profile laid on one capture.
struct JointMap {
  std::array<int, kJointCount> source{};  // joint of the capture, -1 where there is none
  float metres_per_unit = 1;
  Quat axes{1, 0, 0, 0};    // turns the file's axes to ours
  Quat rest{1, 0, 0, 0};    // turns those of its rest pose, which may lie where the motion stands
  bool stands = true;       // in its rest pose; else its bones lie one along the other
  bool as_written = false;  // axes and unit are the profile's own
};

Result<SkeletonProfile> read_profile(const std::filesystem::path& path);

// The profile of a bare name in assets/profiles.
Result<SkeletonProfile> profile_named(const std::string& name);

// Turns the axes of a profile's files to ours.
Quat axes_of(const SkeletonProfile& profile);

// The canonical skeleton with a profile's names, in its first unit.
ForeignSkeleton foreign_skeleton(const SkeletonProfile& profile);

// All profiles of a folder, by file name.
Result<std::vector<SkeletonProfile>> read_profiles(const std::filesystem::path& folder);

// The hips of everybody in a capture who is named as the profile says, with any prefix.
std::vector<std::string> people_in(const SkeletonProfile& profile, const RawClip& clip);

// How well a profile fits, 0 to 1: the share of its joints that the capture has, each below the
// joint that should carry it. Zero when a limb is missing.
float score(const SkeletonProfile& profile, const RawClip& clip);

// The best fit with all four limbs; among equals the one whose own axes and units fit, then the one
// whose prefix the file's names have, then the one that names more joints, then the first. A
// profile whose legs have no human length comes last.
Result<SkeletonProfile> best_profile(const std::vector<SkeletonProfile>& profiles,
                                     const RawClip& clip);

// The rest pose says where its trunk points up and where its left is, if the profile's axes do not
// fit it; where nobody stands up along that axis, the motion says which one is up. Error when a
// needed joint is missing, the legs have no human length in any unit, or the hips have no width.
Result<JointMap> map_joints(const SkeletonProfile& profile, const RawClip& clip);

}  // namespace ringcraft
