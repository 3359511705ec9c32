#pragma once
// The meshes, materials and pictures of a glTF file, checked: every index is in range, every number
// finite, every view inside its buffer.

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "motion/character.h"

namespace ringcraft {

// A joint of a skin: its node, and from the mesh's space to its own where the mesh was bound.
struct GltfSkinJoint {
  int node = 0;
  glm::mat4 inverse_bind{1};
};

// One skinned primitive as the file has it.
struct GltfSurface {
  CharacterPiece piece;  // without weights; in the space of its mesh
  std::vector<GltfSkinJoint> joints;
  // Per vertex four of the joints and their shares, which add up to 1.
  std::vector<std::array<std::size_t, 4>> which;
  std::vector<std::array<float, 4>> share;
};

struct GltfLooks {
  std::vector<GltfSurface> surfaces;
  std::vector<CharacterMaterial> materials;  // the last is glTF's default
  std::vector<CharacterImage> images;
  std::vector<std::string> notes;
};

// `file` is only for messages.
Result<GltfLooks> read_gltf_looks(std::string_view bytes, const std::string& file);

}  // namespace ringcraft
