#pragma once
// glTF captures (.gltf, .glb, .vrm, .vrma): a skeleton of nodes and one of its animations, sampled
// at 60 Hz. The rest pose is the one in which the skin was bound, for VRM that of the nodes; VRM
// bones go by their VRM names. Meshes are not read.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft {

// `clip` is the animation's name, whole or after its last '|'; empty for the first. `file` is only
// for messages. For bytes that are no file: tests of what io writes, and the fuzzer.
Result<RawClip> parse_gltf(std::string_view bytes, const std::string& file,
                           const std::string& clip = "", const CaptureLimits& limits = {});

// Buffers of their own are read from the file's folder and below.
Result<RawClip> read_gltf(const std::filesystem::path& path, const std::string& clip = "");

// Reads the clip it is given with.
using GltfClipVisitor =
    std::function<void(const std::string& name, const std::function<Result<RawClip>()>& read)>;

// Every animation in the file's order; the file is opened once.
Result<void> each_gltf_clip(const std::filesystem::path& path, const GltfClipVisitor& visit);

}  // namespace ringcraft
