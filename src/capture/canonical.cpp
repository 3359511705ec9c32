#include "capture/canonical.h"

#include "base/file.h"
#include "capture/retarget.h"

namespace ringcraft {

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
  auto clip = retarget(raw, *profile, skeleton);
  if (!clip) return tl::unexpected(clip.error());
  return CanonicalCapture{std::move(raw), std::move(*profile), std::move(*clip)};
}

}  // namespace ringcraft
