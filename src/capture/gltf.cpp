#include "capture/gltf.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/gltf_bind.h"
#include "capture/gltf_reader.h"

namespace ringcraft {
namespace {

constexpr double kRate = 60;            // frames a second
constexpr double kLongestClip = 1800;   // s
constexpr float kLargestNumber = 1e7f;  // of a joint's place

// Everything but nodes that only show a mesh.
std::vector<bool> joints_among(const GltfFile& gltf) {
  std::vector<bool> wanted(gltf.nodes.size());
  for (const GltfTrack& track : gltf.animation.tracks)
    wanted[static_cast<std::size_t>(track.node)] = true;
  for (std::size_t i = 0; i < gltf.nodes.size(); ++i) {
    const GltfNode& node = gltf.nodes[i];
    if (!node.mesh || node.joint || !node.bone.empty()) wanted[i] = true;
  }
  for (auto i = gltf.order.rbegin(); i != gltf.order.rend(); ++i) {
    const int parent = gltf.nodes[static_cast<std::size_t>(*i)].parent;
    if (wanted[static_cast<std::size_t>(*i)] && parent >= 0)
      wanted[static_cast<std::size_t>(parent)] = true;
  }
  return wanted;
}

glm::vec4 sample(const GltfTrack& track, float time) {
  const std::size_t stride = track.interpolation == GltfInterpolation::cubic ? 3 : 1;
  const auto value = [&](std::size_t key) { return track.values[key * stride + stride / 2]; };
  const auto after = static_cast<std::size_t>(
      std::upper_bound(track.times.begin(), track.times.end(), time) - track.times.begin());
  if (after == 0) return value(0);
  if (after == track.times.size() || track.interpolation == GltfInterpolation::step)
    return value(after - 1);
  const float span = track.times[after] - track.times[after - 1];
  const float t = (time - track.times[after - 1]) / span;
  const glm::vec4 a = value(after - 1);
  glm::vec4 b = value(after);
  if (track.interpolation == GltfInterpolation::cubic) {
    const glm::vec4 out = track.values[(after - 1) * 3 + 2] * span;
    const glm::vec4 in = track.values[after * 3] * span;
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * out + (3 * t2 - 2 * t3) * b +
           (t3 - t2) * in;
  }
  if (track.path != GltfPath::rotation) return glm::mix(a, b, t);
  const Quat turned = glm::slerp(glm::normalize(Quat(a.w, a.x, a.y, a.z)),
                                 glm::normalize(Quat(b.w, b.x, b.y, b.z)), t);
  return {turned.x, turned.y, turned.z, turned.w};
}

void apply(const GltfTrack& track, float time, GltfTransform& transform) {
  const glm::vec4 value = sample(track, time);
  if (track.path == GltfPath::translation) transform.translation = Vec3(value);
  if (track.path == GltfPath::scale) transform.scale = Vec3(value);
  if (track.path == GltfPath::rotation) {
    const Quat turn(value.w, value.x, value.y, value.z);
    if (glm::length(turn) > 1e-6f) transform.rotation = glm::normalize(turn);
  }
}

class Builder {
 public:
  Builder(GltfFile gltf, const std::string& file, const CaptureLimits& limits)
      : gltf_(std::move(gltf)), limits_(limits) {
    clip_.file = file;
    clip_.frame_seconds = 1 / kRate;
  }

  Result<GltfRest> rest() {
    if (auto ok = skeleton(); !ok) return tl::unexpected(ok.error());
    return GltfRest{std::move(clip_), std::move(node_of_), std::move(bind_)};
  }

  Result<RawClip> build() {
    if (auto ok = skeleton(); !ok) return tl::unexpected(ok.error());
    if (auto ok = frames(); !ok) return tl::unexpected(ok.error());
    return std::move(clip_);
  }

 private:
  tl::unexpected<Error> fault(std::string what, std::string remedy) const {
    return input_error(clip_.file, "clip " + gltf_.animation.name, std::move(what),
                       std::move(remedy));
  }

  Result<void> skeleton() {
    std::vector<GltfTransform> local;
    std::set<std::string> bones;
    for (const GltfNode& node : gltf_.nodes) {
      local.push_back(node.rest);
      if (!node.bone.empty()) bones.insert(node.bone);
    }
    bind_ = bind_pose(gltf_, worlds(gltf_, local), !bones.empty());
    const std::vector<bool> wanted = joints_among(gltf_);
    std::vector<int> joint_of(gltf_.nodes.size(), -1);
    for (const int i : gltf_.order) {
      const auto at = static_cast<std::size_t>(i);
      if (!wanted[at]) continue;
      const GltfNode& node = gltf_.nodes[at];
      RawJoint joint;
      joint.name = node.bone.empty() ? node.name : node.bone;
      if (node.bone.empty() && bones.contains(joint.name)) joint.name += "_";
      joint.offset = bind_[at].position;
      if (node.parent >= 0) {
        joint.parent = joint_of[static_cast<std::size_t>(node.parent)];
        joint.offset -= bind_[static_cast<std::size_t>(node.parent)].position;
      }
      if (!(glm::length(joint.offset) <= kLargestNumber))
        return fault(fmt::format("joint {} rests beyond {:.0e}", joint.name, kLargestNumber),
                     "export it again");
      joint_of[at] = static_cast<int>(clip_.joints.size());
      node_of_.push_back(at);
      clip_.joints.push_back(std::move(joint));
    }
    if (clip_.joints.size() > limits_.joints)
      return fault(fmt::format("{} joints are more than {}", clip_.joints.size(), limits_.joints),
                   "export the skeleton alone");
    return {};
  }

  Result<void> frames() {
    float begin = gltf_.animation.tracks[0].times.front();
    float end = begin;
    for (const GltfTrack& track : gltf_.animation.tracks) {
      begin = std::min(begin, track.times.front());
      end = std::max(end, track.times.back());
    }
    const double seconds = static_cast<double>(end) - static_cast<double>(begin);
    if (seconds > kLongestClip)
      return fault(fmt::format("{:.0f} s are longer than {:.0f} s", seconds, kLongestClip),
                   "cut the clip into shorter ones");
    const auto count = static_cast<std::size_t>(std::floor(seconds * kRate + 1e-3)) + 1;
    if (count * gltf_.nodes.size() > limits_.cells)
      return fault("more frames than are read", "cut the clip into shorter ones");
    std::vector<GltfTransform> local;
    for (const GltfNode& node : gltf_.nodes) local.push_back(node.rest);
    for (std::size_t f = 0; f < count; ++f) {
      const auto time =
          static_cast<float>(static_cast<double>(begin) + static_cast<double>(f) / kRate);
      for (const GltfTrack& track : gltf_.animation.tracks)
        apply(track, time, local[static_cast<std::size_t>(track.node)]);
      if (!add_frame(worlds(gltf_, local)))
        return fault(fmt::format("in frame {} a joint lies beyond {:.0e}", f, kLargestNumber),
                     "export it again");
    }
    return {};
  }

  // Rotations off the bind pose; false when a joint is nowhere.
  bool add_frame(const std::vector<WorldNode>& world) {
    for (std::size_t j = 0; j < clip_.joints.size(); ++j) {
      const std::size_t at = node_of_[j];
      const int parent = clip_.joints[j].parent;
      Quat turned = world[at].rotation * glm::inverse(bind_[at].rotation);
      Vec3 moved = world[at].position;
      if (!(glm::length(moved) <= kLargestNumber) || !(std::abs(glm::length(turned) - 1) < 0.1f))
        return false;
      if (parent >= 0) {
        const std::size_t carrier = node_of_[static_cast<std::size_t>(parent)];
        const Quat back =
            glm::inverse(world[carrier].rotation * glm::inverse(bind_[carrier].rotation));
        turned = back * turned;
        moved = back * (moved - world[carrier].position);
      }
      clip_.rotation.push_back(glm::normalize(turned));
      clip_.translation.push_back(moved);
    }
    ++clip_.frames;
    return true;
  }

  GltfFile gltf_;
  CaptureLimits limits_;
  RawClip clip_;
  std::vector<WorldNode> bind_;
  std::vector<std::size_t> node_of_;  // per joint
};

Result<RawClip> parse(std::string_view bytes, const std::string& file, const std::string& clip,
                      const std::filesystem::path& folder, const CaptureLimits& limits) {
  auto model = GltfModel::open(bytes, file, folder, limits);
  if (!model) return tl::unexpected(model.error());
  auto gltf = model->read(clip);
  if (!gltf) return tl::unexpected(gltf.error());
  return Builder(std::move(*gltf), file, limits).build();
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

Result<GltfRest> rest_of(const GltfFile& gltf, const std::string& file,
                         const CaptureLimits& limits) {
  return Builder(gltf, file, limits).rest();
}

Result<RawClip> parse_gltf(std::string_view bytes, const std::string& file, const std::string& clip,
                           const CaptureLimits& limits) {
  return parse(bytes, file, clip, {}, limits);
}

Result<RawClip> read_gltf(const std::filesystem::path& path, const std::string& clip) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse(*bytes, path.string(), clip, folder_of(path), {});
}

Result<void> each_gltf_clip(const std::filesystem::path& path, const GltfClipVisitor& visit) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto model = GltfModel::open(*bytes, path.string(), folder_of(path), {});
  if (!model) return tl::unexpected(model.error());
  const auto first = model->read("");
  if (!first) return tl::unexpected(first.error());
  for (const std::string& name : first->clips)
    visit(name, [&]() -> Result<RawClip> {
      auto gltf = model->read(name);
      if (!gltf) return tl::unexpected(gltf.error());
      return Builder(std::move(*gltf), path.string(), {}).build();
    });
  return {};
}

}  // namespace ringcraft
