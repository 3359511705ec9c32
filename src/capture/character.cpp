#include "capture/character.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/file.h"
#include "capture/gltf_bind.h"
#include "capture/gltf_mesh.h"
#include "capture/profile.h"

namespace ringcraft {
namespace {

constexpr float kFarthest = 100;  // m

// The canonical bone of every node: its own or that of the nearest node above it; the hips for
// what hangs on none.
std::vector<Joint> bones_of(const GltfFile& gltf, const GltfRest& rest, const JointMap& map) {
  std::vector<int> own(gltf.nodes.size(), -1);
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (map.source.at(j) >= 0)
      own[rest.node_of[static_cast<std::size_t>(map.source.at(j))]] = static_cast<int>(j);
  std::vector<Joint> bones(gltf.nodes.size(), Joint::hips);
  for (const int i : gltf.order) {
    const auto at = static_cast<std::size_t>(i);
    const int parent = gltf.nodes[at].parent;
    if (own[at] >= 0)
      bones[at] = joint_at(static_cast<std::size_t>(own[at]));
    else if (parent >= 0)
      bones[at] = bones[static_cast<std::size_t>(parent)];
  }
  return bones;
}

// Several joints may be one bone here: their shares are added.
CharacterWeights weights_of(const GltfSurface& surface, std::size_t vertex,
                            const std::vector<Joint>& bones) {
  CharacterWeights out;
  std::size_t used = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const float share = surface.share[vertex].at(k);
    if (share == 0) continue;
    const int node = surface.joints[surface.which[vertex].at(k)].node;
    const Joint joint = bones[static_cast<std::size_t>(node)];
    std::size_t slot = 0;
    while (slot < used && out.joint.at(slot) != joint) ++slot;
    if (slot == used) out.joint.at(used++) = joint;
    out.share.at(slot) += share;
  }
  return out;
}

// The surface as its joints carry it in the bind pose, in the file's world.
void bind(const std::vector<WorldNode>& world, GltfSurface& surface) {
  std::vector<glm::mat4> carried;
  carried.reserve(surface.joints.size());
  for (const GltfSkinJoint& joint : surface.joints) {
    const WorldNode& node = world[static_cast<std::size_t>(joint.node)];
    glm::mat4 matrix(node.axes);
    matrix[3] = glm::vec4(node.position, 1);
    carried.push_back(matrix * joint.inverse_bind);
  }
  CharacterPiece& piece = surface.piece;
  for (std::size_t v = 0; v < piece.position.size(); ++v) {
    glm::mat4 blend(0);
    for (std::size_t k = 0; k < 4; ++k)
      if (surface.share[v].at(k) > 0)
        blend += surface.share[v].at(k) * carried[surface.which[v].at(k)];
    piece.position[v] = Vec3(blend * glm::vec4(piece.position[v], 1));
    piece.normal[v] = glm::mat3(blend) * piece.normal[v];
  }
}

}  // namespace

Result<Character> parse_character(std::string_view bytes, const std::string& file,
                                  const std::filesystem::path& profile_folder) {
  const CaptureLimits limits;
  auto looks = read_gltf_looks(bytes, file);
  if (!looks) return tl::unexpected(looks.error());
  const auto gltf = read_gltf_skeleton(bytes, file, limits);
  if (!gltf) return tl::unexpected(gltf.error());
  const auto rest = rest_of(*gltf, file, limits);
  if (!rest) return tl::unexpected(rest.error());
  const auto profiles = read_profiles(profile_folder);
  if (!profiles) return tl::unexpected(profiles.error());
  const auto profile = best_profile(*profiles, rest->clip);
  if (!profile) return tl::unexpected(profile.error());
  const auto map = map_joints(*profile, rest->clip);
  if (!map) return tl::unexpected(map.error());

  Character character;
  character.file = file;
  character.materials = std::move(looks->materials);
  character.images = std::move(looks->images);
  character.notes = std::move(looks->notes);
  const auto ours = [&](Vec3 raw) { return map->rest * raw * map->metres_per_unit; };
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (map->source.at(j) >= 0)
      character.joint.at(j) =
          ours(rest->bind[rest->node_of[static_cast<std::size_t>(map->source.at(j))]].position);

  const std::vector<Joint> bones = bones_of(*gltf, *rest, *map);
  for (GltfSurface& surface : looks->surfaces) {
    bind(rest->bind, surface);
    CharacterPiece& piece = surface.piece;
    piece.weights.reserve(piece.position.size());
    for (std::size_t v = 0; v < piece.position.size(); ++v) {
      piece.position[v] = ours(piece.position[v]);
      piece.normal[v] = normalized_or(map->rest * piece.normal[v], kUp);
      if (!(glm::length(piece.position[v]) <= kFarthest))
        return input_error(file, "", "a vertex lies far from the body", "export it again");
      piece.weights.push_back(weights_of(surface, v, bones));
    }
    character.pieces.push_back(std::move(piece));
  }
  return character;
}

Result<Character> read_character(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_character(*bytes, path.string(), assets_folder() / "profiles");
}

}  // namespace ringcraft
