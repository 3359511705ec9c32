#include "capture/gltf_bind.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {
namespace {

WorldNode below(const WorldNode& parent, const GltfTransform& local) {
  WorldNode out;
  out.position = parent.position + parent.axes * local.translation;
  out.rotation = glm::normalize(parent.rotation * local.rotation);
  out.axes = parent.axes * glm::mat3_cast(local.rotation);
  for (int i = 0; i < 3; ++i) out.axes[i] *= local.scale[i];
  return out;
}

// The rotation among the 24 of a cube's symmetry that is nearest.
Quat along_axes(const Quat& rotation) {
  Quat best(1, 0, 0, 0);
  float best_cosine = -1;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      if (x / 2 == y / 2) continue;
      glm::mat3 axes(0);
      axes[0][x / 2] = x % 2 == 0 ? 1.0f : -1.0f;
      axes[1][y / 2] = y % 2 == 0 ? 1.0f : -1.0f;
      axes[2] = glm::cross(axes[0], axes[1]);
      const Quat turn = glm::normalize(glm::quat_cast(axes));
      const float cosine = std::abs(glm::dot(turn, rotation));
      if (cosine > best_cosine) {
        best_cosine = cosine;
        best = turn;
      }
    }
  return best;
}

Quat rotation_of(const glm::mat3& axes) {
  const Vec3 x = normalized_or(axes[0], kLeft);
  const Vec3 y = normalized_or(axes[1] - x * glm::dot(x, axes[1]), kUp);
  return glm::normalize(glm::quat_cast(glm::mat3(x, y, glm::cross(x, y))));
}

}  // namespace

std::vector<WorldNode> worlds(const GltfFile& gltf, const std::vector<GltfTransform>& local) {
  std::vector<WorldNode> out(gltf.nodes.size());
  for (const int i : gltf.order) {
    const auto node = static_cast<std::size_t>(i);
    const int parent = gltf.nodes[node].parent;
    out[node] =
        below(parent < 0 ? WorldNode{} : out[static_cast<std::size_t>(parent)], local[node]);
  }
  return out;
}

MeshSpace mesh_space(const GltfFile& gltf, const std::vector<WorldNode>& rest, int skin) {
  for (const int i : gltf.order) {
    const GltfNode& node = gltf.nodes[static_cast<std::size_t>(i)];
    if (!node.bound || node.skin != skin) continue;
    const WorldNode& world = rest[static_cast<std::size_t>(i)];
    const glm::mat3 bind(node.bind);
    MeshSpace space;
    space.scale = glm::length(world.axes[1]) / glm::length(bind[1]);
    space.rotation = along_axes(world.rotation * glm::inverse(rotation_of(bind)));
    space.position = world.position - space.rotation * (Vec3(node.bind[3]) * space.scale);
    return space;
  }
  return {};
}

std::vector<WorldNode> bind_pose(const GltfFile& gltf, const std::vector<WorldNode>& rest,
                                 bool has_vrm_bones) {
  if (has_vrm_bones) return rest;
  std::vector<WorldNode> out = rest;
  std::vector<std::pair<int, MeshSpace>> spaces;
  for (const int i : gltf.order) {
    const auto at = static_cast<std::size_t>(i);
    const GltfNode& node = gltf.nodes[at];
    if (!node.bound) {
      if (node.parent >= 0) out[at] = below(out[static_cast<std::size_t>(node.parent)], node.rest);
      continue;
    }
    auto known = std::find_if(spaces.begin(), spaces.end(),
                              [&](const auto& space) { return space.first == node.skin; });
    if (known == spaces.end()) {
      spaces.emplace_back(node.skin, mesh_space(gltf, rest, node.skin));
      known = spaces.end() - 1;
    }
    const MeshSpace& space = known->second;
    const glm::mat3 bind(node.bind);
    out[at].position = space.position + space.rotation * (Vec3(node.bind[3]) * space.scale);
    out[at].rotation = glm::normalize(space.rotation * rotation_of(bind));
    out[at].axes = glm::mat3_cast(space.rotation) * bind * space.scale;
  }
  return out;
}

}  // namespace ringcraft
