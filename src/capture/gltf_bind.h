#pragma once
// The pose in which the skins of a glTF file were bound.

#include <vector>

#include "capture/gltf_reader.h"

namespace ringcraft {

// A node's place in the world; `axes` hold scale and shear.
struct WorldNode {
  Vec3 position{};
  Quat rotation{1, 0, 0, 0};
  glm::mat3 axes{1};
};

// From the space of a skin's mesh to the world, which the file does not say: by the skin's topmost
// joint, which stands where it was bound. Meshes are bound upright: a turn of that joint in the
// nodes' rest pose is none of the mesh.
struct MeshSpace {
  Vec3 position{};
  Quat rotation{1, 0, 0, 0};
  float scale = 1;
};

MeshSpace mesh_space(const GltfFile& gltf, const std::vector<WorldNode>& rest, int skin);

// Where every node stands, each at its local transform.
std::vector<WorldNode> worlds(const GltfFile& gltf, const std::vector<GltfTransform>& local);

// Where every node stands in the pose that retargeting takes for the rest pose; `rest`: with every
// node at its own rest transform.
std::vector<WorldNode> bind_pose(const GltfFile& gltf, const std::vector<WorldNode>& rest,
                                 bool has_vrm_bones);

// A file's skeleton as a capture of no frames, for profiles to be laid on.
struct GltfRest {
  RawClip clip;
  std::vector<std::size_t> node_of;  // per joint of the clip
  std::vector<WorldNode> bind;       // per node
};
Result<GltfRest> rest_of(const GltfFile& gltf, const std::string& file,
                         const CaptureLimits& limits);

}  // namespace ringcraft
