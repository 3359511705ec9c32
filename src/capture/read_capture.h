#pragma once
// Captures of any format that is known, by the extension of their file.

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft {

// What a file does not say itself; each goes with one format only.
struct CaptureSource {
  std::filesystem::path skeleton;           // .amc: its .asf; empty for the one beside it
  std::optional<double> frames_per_second;  // .amc: 120 without it
  std::string clip;                         // glTF: the animation; empty for the first
};

// By the ending, in any case.
bool is_gltf_file(const std::filesystem::path& path);
bool is_capture_file(const std::filesystem::path& path);        // one that read_capture() takes
bool is_other_capture_file(const std::filesystem::path& path);  // motion that it does not read

// What `source` says, by its key in a manifest, that is for files of another format.
struct MisplacedSource {
  std::string key, what;
};
std::optional<MisplacedSource> misplaced(const std::filesystem::path& path,
                                         const CaptureSource& source);

// .bvh, .amc, .gltf, .glb, .vrm, .vrma (any case).
Result<RawClip> read_capture(const std::filesystem::path& path, const CaptureSource& source = {});

}  // namespace ringcraft
