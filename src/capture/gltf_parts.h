#pragma once
// glTF containers, cut down to what concerns motion before anything else reads them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace ringcraft {

struct GltfParts {
  std::string json;         // without meshes, images, materials, extras and extensions
  std::string_view binary;  // the binary chunk; empty where there is none
  // VRM bones and their nodes, as VRM 0, VRM 1 and VRM animations say them; empty elsewhere.
  std::vector<std::pair<std::string, int>> bones;
};

struct GltfChunks {
  std::string_view json, binary;
};
// A .gltf is one chunk of JSON.
Result<GltfChunks> gltf_chunks(std::string_view bytes, const std::string& file);

// Whether what a key names, at its depth, is read.
using GltfKeyFilter = bool (*)(int depth, const std::string& key);
// The JSON of a glTF file, an object of at most 16 MiB that nests 32 deep at most, without what
// `kept` refuses. `file` is only for messages.
Result<nlohmann::json> gltf_json(std::string_view text, const std::string& file,
                                 GltfKeyFilter kept);

Result<GltfParts> gltf_parts(std::string_view bytes, const std::string& file);

}  // namespace ringcraft
