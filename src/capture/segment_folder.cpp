// A folder of captures to actions.

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/canonical.h"
#include "capture/gltf.h"
#include "capture/segment.h"

namespace ringcraft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 4096;  // of a folder
constexpr Tick kSameEvery = 12;           // ticks between the moments that are compared
constexpr float kSameWithin = 0.01f;      // m
constexpr float kSameTurn = radians(3);
constexpr Tick kKeptForComparison = 60 * kTicksPerSecond;

Result<std::vector<fs::path>> captures_in(const fs::path& root) {
  std::error_code fault;
  if (fs::is_regular_file(root, fault)) return std::vector<fs::path>{root};
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator it(root, fault), end; !fault && it != end;
       it.increment(fault)) {
    std::error_code ignored;
    const bool motion = is_capture_file(it->path()) || is_other_capture_file(it->path());
    if (it->is_regular_file(ignored) && motion) files.push_back(it->path());
    if (files.size() > kMostFiles)
      return input_error(root.string(), "", fmt::format("more than {} captures", kMostFiles),
                         "name a smaller folder");
  }
  if (fault)
    return input_error(root.string(), "", fault.message(), "name a folder that can be read");
  std::sort(files.begin(), files.end());
  return files;
}

struct Collection {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<SkeletonProfile> profiles;
  FolderSettings settings;
  std::vector<Action> actions;
  std::vector<std::pair<std::string, Clip>> seen;  // takes so far, by file
  std::set<std::string> names;
  std::vector<std::string>* notes = nullptr;

  void note(std::string text) {
    if (notes != nullptr) notes->push_back(std::move(text));
  }
};

std::string distinct(const std::set<std::string>& taken, const std::string& name) {
  if (!taken.contains(name)) return name;
  for (int i = 2;; ++i) {
    std::string other = fmt::format("{}_{}", name, i);
    if (!taken.contains(other)) return other;
  }
}

void add(Action action, const std::string& file, Collection& out) {
  const std::vector<std::string> wrong = faults(action);
  if (!wrong.empty()) {
    out.note(fmt::format("{}: {} passed over: {}", file, action.name, wrong.front()));
    return;
  }
  action.name = distinct(out.names, action.name);
  out.names.insert(action.name);
  out.actions.push_back(std::move(action));
}

Result<Clip> canonical_clip(const fs::path& path, Result<RawClip> raw, Collection& out) {
  if (!raw) return tl::unexpected(raw.error());
  auto read = canonical_of(std::move(*raw), out.skeleton, out.profiles);
  if (!read) return tl::unexpected(read.error());
  for (const std::string& note : read->raw.notes) out.note(path.string() + ": " + note);
  return std::move(read->clip);
}

// The same take in two formats gives its actions once.
bool same_motion(const Clip& a, const Clip& b) {
  if (a.length() != b.length()) return false;
  for (Tick t = 0; t <= a.length(); t += kSameEvery) {
    const Pose& p = a.at(t);
    const Pose& q = b.at(t);
    if (glm::distance(p.hips, q.hips) > kSameWithin) return false;
    for (std::size_t j = 0; j < kJointCount; ++j)
      if (glm::length(rotation_vector(glm::inverse(p.rotation[j]) * q.rotation[j])) > kSameTurn)
        return false;
  }
  return true;
}

void note_blows(const std::string& file, const Segmentation& found, Collection& out) {
  for (const FoundBlow& blow : found.blows) {
    const std::string_view kind = blow.blocks ? "block" : name_of(blow.strike.kind);
    out.note(fmt::format("{}: found {}{} {} at {:.2f} s: {}", file, blow.spins ? "spinning " : "",
                         kind, vrm_name(blow.strike.joint), blow.strike.at, blow.evidence));
  }
}

void cut_segment(const Clip& clip, const CaptureTracks& tracks, const FoundAction& segment,
                 const std::string& file, const std::string& source, Collection& out) {
  auto action = cut_action(out.skeleton, clip, tracks, segment.cut, file, "");
  if (!action) {
    out.note(fmt::format("passed over: {}", to_string(action.error())));
    return;
  }
  action->source = fmt::format("{} {:.2f}-{:.2f} s", source, segment.cut.begin, segment.cut.end);
  out.note(fmt::format("{}: {} {:.2f}-{:.2f} s: {}", file, action->name, segment.cut.begin,
                       segment.cut.end, segment.evidence));
  add(*action, file, out);
  if (!out.settings.mirrored) return;
  Action other = mirrored(*action);
  if (other.name == action->name) other.name += "_mirrored";
  other.source += ", mirrored";
  add(std::move(other), file, out);
}

void add_clip(const fs::path& path, const std::string& clip_name, Result<RawClip> raw,
              Collection& out) {
  const std::string file = path.string() + (clip_name.empty() ? "" : " " + clip_name);
  auto clip = canonical_clip(path, std::move(raw), out);
  if (!clip) {
    out.note(fmt::format("passed over: {}", to_string(clip.error())));
    return;
  }
  for (const auto& [other, motion] : out.seen) {
    if (!same_motion(motion, *clip)) continue;
    out.note(fmt::format("{}: the same motion as {}, passed over", file, other));
    return;
  }
  if (clip->length() <= kKeptForComparison) out.seen.emplace_back(file, *clip);
  std::string name = path.stem().string();
  if (!clip_name.empty()) name.append("_").append(clip_name.substr(clip_name.rfind('|') + 1));
  Segmentation found = segment(out.skeleton, *clip, name);
  for (const std::string& note : found.notes) out.note(fmt::format("{}: {}", file, note));
  note_blows(file, found, out);
  std::string source = path.filename().string();
  if (!clip_name.empty()) source.append(" ").append(clip_name);
  if (found.southpaw) {
    out.note(fmt::format("{}: southpaw; what follows is mirrored", file));
    source += ", southpaw mirrored,";
    *clip = mirrored(*clip);
    found = segment(out.skeleton, *clip, name);
  }
  const CaptureTracks tracks = tracks_of(*clip, found.guard_at, found.guard_yaw);
  for (const FoundAction& segment : found.segments)
    cut_segment(*clip, tracks, segment, file, source, out);
}

void add_capture(const fs::path& path, Collection& out) {
  if (!is_gltf_file(path)) {
    add_clip(path, "", read_capture(path), out);
    return;
  }
  const auto read = each_gltf_clip(
      path, [&](const std::string& clip, const auto& raw) { add_clip(path, clip, raw(), out); });
  if (!read) out.note(fmt::format("passed over: {}", to_string(read.error())));
}

}  // namespace

Result<std::vector<Action>> collect_folder_actions(const fs::path& folder_or_file,
                                                   std::vector<std::string>* notes,
                                                   const FolderSettings& settings) {
  auto files = captures_in(folder_or_file);
  if (!files) return tl::unexpected(files.error());
  auto profiles = read_profiles(assets_folder() / "profiles");
  if (!profiles) return tl::unexpected(profiles.error());
  Collection out;
  out.profiles = std::move(*profiles);
  out.settings = settings;
  out.notes = notes;
  for (const fs::path& file : *files) add_capture(file, out);
  return std::move(out.actions);
}

}  // namespace ringcraft
