#include "capture/read_capture.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "capture/amc.h"
#include "capture/bvh.h"
#include "capture/gltf.h"
#include "capture/words.h"

namespace ringcraft {

bool is_gltf_file(const std::filesystem::path& path) {
  const std::string kind = lowered(path.extension().string());
  return kind == ".gltf" || kind == ".glb" || kind == ".vrm" || kind == ".vrma";
}

bool is_capture_file(const std::filesystem::path& path) {
  const std::string kind = lowered(path.extension().string());
  return kind == ".bvh" || kind == ".amc" || is_gltf_file(path);
}

bool is_other_capture_file(const std::filesystem::path& path) {
  static constexpr std::array<std::string_view, 8> kKinds = {".fbx", ".c3d", ".dae",  ".bip",
                                                             ".trc", ".htr", ".mvnx", ".npz"};
  return std::find(kKinds.begin(), kKinds.end(), lowered(path.extension().string())) !=
         kKinds.end();
}

std::optional<MisplacedSource> misplaced(const std::filesystem::path& path,
                                         const CaptureSource& source) {
  if (!is_capture_file(path)) return std::nullopt;  // that is worse
  constexpr const char* kAcclaim = "goes with .amc files only";
  const bool acclaim = lowered(path.extension().string()) == ".amc";
  if (!acclaim && !source.skeleton.empty()) return MisplacedSource{"skeleton", kAcclaim};
  if (!acclaim && source.frames_per_second) return MisplacedSource{"frame_rate", kAcclaim};
  if (!is_gltf_file(path) && !source.clip.empty())
    return MisplacedSource{"clip", "goes with glTF files only: this one holds one motion"};
  return std::nullopt;
}

Result<RawClip> read_capture(const std::filesystem::path& path, const CaptureSource& source) {
  const std::string kind = lowered(path.extension().string());
  const bool acclaim = kind == ".amc";
  const bool gltf = is_gltf_file(path);
  if (kind == ".asf")
    return input_error(path.string(), "", "a skeleton without motion", "give its .amc file");
  if (is_other_capture_file(path))
    return input_error(path.string(), "", fmt::format("captures in {} are not read", kind),
                       "export it as .bvh or .glb");
  if (!is_capture_file(path))
    return input_error(path.string(), "", "no capture by its extension",
                       "give a .bvh, .amc, .gltf, .glb, .vrm or .vrma file");
  if (const auto wrong = misplaced(path, source))
    return input_error(path.string(), "", wrong->key + " " + wrong->what, "take it out");
  if (gltf) return read_gltf(path, source.clip);
  if (!acclaim) return read_bvh(path);
  auto skeleton = source.skeleton.empty() ? skeleton_beside(path) : source.skeleton;
  if (!skeleton) return tl::unexpected(skeleton.error());
  return read_asf_amc(*skeleton, path, source.frames_per_second.value_or(kAcclaimRate));
}

}  // namespace ringcraft
