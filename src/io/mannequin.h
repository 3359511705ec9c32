#pragma once
// The mannequin: a skinned mesh of a fighter grown from the body model.
//
// In the T-pose of the body's skeleton, anatomical shapes are joined smoothly into distance fields
// and meshed by surface nets. Height sets lengths, mass sets girth. Same body, same mesh.

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "physics/body.h"

namespace ringcraft {

// What a part of the surface is made of; each has its own colour.
enum class Region : std::uint8_t { skin, shorts, gloves, trim, hair, eye_white, iris };
inline constexpr std::size_t kRegionCount = 7;
std::string_view name_of(Region region);

// Up to four joints that move a vertex. Shares are in 1/65535 and sum to 65535 exactly; unused ones
// are zero, the largest stands first.
struct SkinWeights {
  std::array<std::uint8_t, 4> joint{};
  std::array<std::uint16_t, 4> share{};
};

// One closed surface, T-pose, metres.
struct MannequinPiece {
  Region region = Region::skin;
  std::vector<Vec3> position;
  std::vector<Vec3> normal;  // unit, outward
  std::vector<std::array<std::uint8_t, 4>>
      shade;  // RGBA in 1/255 that multiplies the colour: crevices, lips
  std::vector<SkinWeights> weights;
  std::vector<std::uint32_t> triangles;  // counterclockwise from outside
};

struct Mannequin {
  std::vector<MannequinPiece> pieces;  // skin first
};

// The mannequin of a body, made once per process and body (height, mass, sex).
std::shared_ptr<const Mannequin> mannequin_of(const BodyModel& body);

// Made afresh, without the cache.
Mannequin make_mannequin(const BodyModel& body);

}  // namespace ringcraft
