#pragma once
// A skinned character of the user's own, as it is shown in place of the mannequin.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "motion/skeleton.h"

namespace ringcraft {

struct CharacterImage {
  std::string mime_type;  // image/png or image/jpeg
  std::string bytes;
};

struct CharacterMaterial {
  std::string name;
  std::array<float, 4> colour{1, 1, 1, 1};  // linear RGBA, multiplies the picture
  float metallic = 0, roughness = 0.8f;
  std::optional<std::size_t> image;  // of its colour, index into Character::images
  bool double_sided = false;
  std::string alpha_mode = "OPAQUE";
  float alpha_cutoff = 0.5f;  // of MASK
};

// Up to four canonical joints that move a vertex; the shares add up to 1.
struct CharacterWeights {
  std::array<Joint, 4> joint{};
  std::array<float, 4> share{};
};

// One surface as it was bound, in our axes, metres.
struct CharacterPiece {
  std::size_t material = 0;
  std::vector<Vec3> position;
  std::vector<Vec3> normal;  // unit
  std::vector<Vec2> uv;      // empty, or one a vertex
  std::vector<CharacterWeights> weights;
  std::vector<std::uint32_t> triangles;
};

struct Character {
  std::string file;
  std::vector<CharacterPiece> pieces;
  std::vector<CharacterMaterial> materials;  // at least one
  std::vector<CharacterImage> images;
  // Where its joints stood when it was bound; nothing for bones it does not have.
  std::array<std::optional<Vec3>, kJointCount> joint{};
  std::vector<std::string> notes;  // what was left out and why
};

// The character in the T-pose of `skeleton`: arms and legs laid along its bones, every bone as long
// as its own, thickness by the character's height. What is shown is then what is hit.
std::vector<CharacterPiece> conformed(const Character& character, const Skeleton& skeleton);

}  // namespace ringcraft
