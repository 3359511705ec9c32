#pragma once
// What glTF files (.gltf, .glb, .vrm, .vrma) hold of motion, read and checked: every index is in
// range, every number finite, nodes hang on each other as a forest.

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft {

struct GltfTransform {
  Vec3 translation{};
  Quat rotation{1, 0, 0, 0};
  Vec3 scale{1};
};

struct GltfNode {
  std::string name;
  int parent = -1;
  GltfTransform rest;
  bool mesh = false;
  bool joint = false;  // of a skin
  std::string bone;    // VRM bone name where the file says it
  bool bound = false;  // a skin says where it stood when the mesh was bound
  glm::mat4 bind{1};   // then: its place in the mesh's space
  int skin = -1;       // that skin, for what its joints share
};

enum class GltfInterpolation : std::uint8_t { step, linear, cubic };
enum class GltfPath : std::uint8_t { translation, rotation, scale };

// One animated property of one node. Values are x y z (w); a cubic key has three: tangent in,
// value, tangent out.
struct GltfTrack {
  int node = 0;
  GltfPath path = GltfPath::translation;
  GltfInterpolation interpolation = GltfInterpolation::linear;
  std::vector<float> times;  // s, never falling
  std::vector<glm::vec4> values;
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfTrack> tracks;  // at most one per node and property
};

struct GltfFile {
  std::vector<GltfNode> nodes;  // as in the file
  std::vector<int> order;       // parents before children
  std::vector<std::string> clips;
  GltfAnimation animation;  // the one that was asked for
};

// A file that has been opened and checked once, for all its clips.
class GltfModel {
 public:
  // Buffers in files of their own are read from `folder` and below; without it they are refused.
  static Result<GltfModel> open(std::string_view bytes, const std::string& file,
                                const std::filesystem::path& folder, const CaptureLimits& limits);
  GltfModel(GltfModel&&) noexcept;
  GltfModel& operator=(GltfModel&&) noexcept;
  ~GltfModel();

  // The animation called `clip` (whole, or after its last '|'), the first when it is empty.
  Result<GltfFile> read(const std::string& clip);

 private:
  struct Impl;
  explicit GltfModel(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Nodes and skins alone, whether or not anything moves them; buffers must lie in the file.
Result<GltfFile> read_gltf_skeleton(std::string_view bytes, const std::string& file,
                                    const CaptureLimits& limits);

}  // namespace ringcraft
