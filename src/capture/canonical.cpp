#include "capture/canonical.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/retarget.h"

namespace ringcraft {
namespace {

// Of several people in one file one is read.
void note_other_people(const SkeletonProfile& profile, RawClip& raw) {
  const auto map = map_joints(profile, raw);
  if (!map) return;
  const std::vector<std::string> people = people_in(profile, raw);
  if (people.size() < 2) return;
  const std::string& hips =
      raw.joints[static_cast<std::size_t>(map->source[index(Joint::hips)])].name;
  raw.notes.push_back(fmt::format("the hips of {} people ({}): the first called {} are read",
                                  people.size(), fmt::join(people, ", "), hips));
}

}  // namespace

Result<CanonicalCapture> read_canonical(const std::filesystem::path& path, const Skeleton& skeleton,
                                        const CaptureSource& source) {
  const auto profiles = read_profiles(assets_folder() / "profiles");
  if (!profiles) return tl::unexpected(profiles.error());
  return read_canonical(path, skeleton, *profiles, source);
}

Result<CanonicalCapture> read_canonical(const std::filesystem::path& path, const Skeleton& skeleton,
                                        const std::vector<SkeletonProfile>& profiles,
                                        const CaptureSource& source) {
  auto raw = read_capture(path, source);
  if (!raw) return tl::unexpected(raw.error());
  return canonical_of(std::move(*raw), skeleton, profiles);
}

Result<CanonicalCapture> canonical_of(RawClip raw, const Skeleton& skeleton,
                                      const std::vector<SkeletonProfile>& profiles) {
  replace_junk_start(raw);
  mend_jumps(raw);
  auto profile = best_profile(profiles, raw);
  if (!profile) return tl::unexpected(profile.error());
  note_other_people(*profile, raw);
  auto clip = retarget(raw, *profile, skeleton);
  if (!clip) return tl::unexpected(clip.error());
  return CanonicalCapture{std::move(raw), std::move(*profile), std::move(*clip)};
}

}  // namespace ringcraft
