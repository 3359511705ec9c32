#include "capture/person.h"

#include <algorithm>

#include "capture/canonical.h"
#include "capture/retarget.h"
#include "capture/segment.h"

namespace ringcraft {

namespace {

// The captured hips' way over the ground, in metres.
Result<void> keep_distances(const RawClip& raw, const SkeletonProfile& profile, Clip& clip) {
  const auto map = map_joints(profile, raw);
  if (!map) return tl::unexpected(map.error());
  const auto hips = static_cast<std::size_t>(map->source[index(Joint::hips)]);
  for (std::size_t tick = 0; tick < clip.frames.size(); ++tick) {
    const RawPose pose = raw_pose(raw, seconds(static_cast<Tick>(tick)));
    const Vec3 at = map->axes * pose.position[hips] * map->metres_per_unit;
    clip.frames[tick].hips.x = at.x;
    clip.frames[tick].hips.z = at.z;
  }
  return {};
}

}  // namespace

Result<CapturedPerson> read_person(const std::filesystem::path& capture) {
  const Skeleton skeleton = canonical_skeleton();
  const auto read = read_canonical(capture, skeleton);
  if (!read) return tl::unexpected(read.error());
  const Clip& clip = read->clip;

  CapturedPerson person;
  const std::string name = capture.stem().string();
  const Segmentation found = segment(skeleton, clip, name);
  person.notes = found.notes;
  const CaptureTracks tracks = tracks_of(clip, found.guard_at, found.guard_yaw);
  person.clip = clip;
  if (const auto kept = keep_distances(read->raw, read->profile, person.clip); !kept)
    return tl::unexpected(kept.error());
  for (const auto& segment : found.segments) {
    auto action = cut_action(skeleton, clip, tracks, segment.cut, capture.string(), "");
    if (!action) {
      person.notes.push_back("passed over: " + to_string(action.error()));
      continue;
    }
    const Tick begin = std::clamp(ticks(segment.cut.begin), 0, clip.length());
    const Vec3 at = person.clip.at(begin).hips;
    person.actions.push_back(
        {std::move(*action), begin, {at.x, at.z, facing_at(skeleton, clip, tracks, begin)}});
  }
  std::stable_sort(
      person.actions.begin(), person.actions.end(),
      [](const CapturedAction& a, const CapturedAction& b) { return a.begin < b.begin; });
  return person;
}

}  // namespace ringcraft
