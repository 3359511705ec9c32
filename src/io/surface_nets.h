#pragma once
// Surface nets (Gibson 1998): a closed triangle mesh of a distance field, one vertex in every grid
// cell that the surface crosses.

#include <cstdint>
#include <vector>

#include "io/distance_field.h"

namespace ringcraft {

// A stretch of an axis with its own grid spacing.
struct GridSpan {
  float begin = 0, end = 0;  // m
  float spacing = 0;         // m
};

// Where a grid is finer than its usual spacing, per axis; spans of x are mirrored.
struct GridPlan {
  float spacing = 0.015f;  // m
  std::vector<GridSpan> x, y, z;
};

struct SurfaceMesh {
  std::vector<Vec3> position;            // m
  std::vector<Vec3> normal;              // unit
  std::vector<std::uint32_t> triangles;  // three indices each, counterclockwise from outside
};

SurfaceMesh surface_nets(const DistanceField& field, const GridPlan& plan);

}  // namespace ringcraft
