#pragma once
// The ring: canvas, apron, posts and ropes as plain boxes and tubes.

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace ringcraft {

struct RingPart {
  const char* name = "";
  Vec3 colour{};  // linear RGB
  float roughness = 0.9f;
  std::vector<Vec3> position;            // m
  std::vector<Vec3> normal;              // unit
  std::vector<std::uint32_t> triangles;  // counterclockwise from outside
};

// A square ring whose ropes stand `half` metres from the middle; the canvas lies at y = 0.
std::vector<RingPart> make_ring(float half);

}  // namespace ringcraft
