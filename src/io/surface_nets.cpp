#include "io/surface_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ringcraft {

namespace {

constexpr int kBlock =
    4;  // cells per side of a block that is skipped whole when far from the surface

// Grid lines from `low` to `high` with the spacing of the span they lie in.
std::vector<float> grid_lines(float low, float high, float spacing,
                              const std::vector<GridSpan>& spans) {
  std::vector<float> lines{low};
  while (lines.back() < high) {
    const float at = lines.back();
    float step = spacing;
    for (const GridSpan& span : spans) {
      if (at >= span.begin - 0.5f * step && at < span.end) step = std::min(step, span.spacing);
    }
    lines.push_back(at + step);
  }
  return lines;
}

// The same, symmetric about zero, which lies in the middle of a cell.
std::vector<float> symmetric_lines(float high, float spacing, const std::vector<GridSpan>& spans) {
  float middle = spacing;
  for (const GridSpan& span : spans) {
    if (span.begin <= 0) middle = std::min(middle, span.spacing);
  }
  const std::vector<float> right = grid_lines(0.5f * middle, high, spacing, spans);
  std::vector<float> lines;
  for (auto at = right.rbegin(); at != right.rend(); ++at) lines.push_back(-*at);
  lines.insert(lines.end(), right.begin(), right.end());
  return lines;
}

// The point with the least squared distance to the planes through `points`, held near their mean
// where the planes leave it open.
Vec3 nearest_to_planes(std::span<const Vec3> points, std::span<const Vec3> normals) {
  Vec3 mean{};
  for (const Vec3& point : points) mean += point;
  mean /= static_cast<float>(points.size());
  constexpr float kHold = 0.05f;
  glm::mat3 matrix(kHold);
  Vec3 right{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& n = normals[i];
    matrix += glm::outerProduct(n, n);
    right += n * glm::dot(n, points[i] - mean);
  }
  return mean + glm::inverse(matrix) * right;
}

class Net {
 public:
  Net(const DistanceField& field, const GridPlan& plan) : field_(field) {
    const float margin = 1.5f * plan.spacing;
    lines_[0] = symmetric_lines(field.high().x + margin, plan.spacing, plan.x);
    lines_[1] = grid_lines(field.low().y - margin, field.high().y + margin, plan.spacing, plan.y);
    lines_[2] = grid_lines(field.low().z - margin, field.high().z + margin, plan.spacing, plan.z);
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(lines_[axis].size());
    values_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 1.0f);
    vertex_.assign(values_.size(), -1);
    crossing_.assign(3 * values_.size(), -1);
  }

  SurfaceMesh build() {
    sample();
    for (int z = 0; z + 1 < size_[2]; ++z) {
      for (int y = 0; y + 1 < size_[1]; ++y) {
        for (int x = 0; x + 1 < size_[0]; ++x) place_vertex({x, y, z});
      }
    }
    for (int z = 1; z + 1 < size_[2]; ++z) {
      for (int y = 1; y + 1 < size_[1]; ++y) {
        for (int x = 1; x + 1 < size_[0]; ++x) {
          for (int axis = 0; axis < 3; ++axis) add_quad({x, y, z}, axis);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<int, 3>;

  std::size_t index(Cell c) const {
    return (static_cast<std::size_t>(c[2]) * size_[1] + c[1]) * size_[0] + c[0];
  }
  Vec3 corner(Cell c) const { return {lines_[0][c[0]], lines_[1][c[1]], lines_[2][c[2]]}; }

  // Values at the grid's points. A block whose centre is far from the surface gets the centre's
  // value.
  void sample() {
    for (int axis = 0; axis < 3; ++axis) blocks_[axis] = (size_[axis] + kBlock - 1) / kBlock;
    parts_.resize(static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2]);
    for (int z = 0; z < size_[2]; z += kBlock) {
      for (int y = 0; y < size_[1]; y += kBlock) {
        for (int x = 0; x < size_[0]; x += kBlock) sample_block({x, y, z});
      }
    }
  }
  // The field near the block of a cell.
  DistanceField& part(Cell cell) {
    const auto block = [&](int axis) { return static_cast<std::size_t>(cell[axis] / kBlock); };
    return parts_[(block(2) * blocks_[1] + block(1)) * blocks_[0] + block(0)];
  }

  void sample_block(Cell first) {
    Cell last;
    for (int axis = 0; axis < 3; ++axis) {
      last[axis] = std::min(first[axis] + kBlock - 1, size_[axis] - 1);
    }
    const Vec3 low = corner(first), high = corner(last);
    const float middle = field_.at(0.5f * (low + high));
    // Twice the half diagonal: the field is a bound, and its value may grow faster than the
    // distance.
    const bool near = std::abs(middle) < glm::length(high - low) + 0.01f;
    if (near) part(first) = field_.near(0.5f * (low + high), glm::length(high - low));
    const DistanceField& local = part(first);
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          values_[index({x, y, z})] = near ? local.at(corner({x, y, z})) : middle;
        }
      }
    }
  }

  // A vertex where the surface crosses the cell: nearest to the tangent planes of all edge
  // crossings, so that hems stay straight (dual contouring, Ju 2002), kept inside the cell.
  void place_vertex(Cell cell) {
    const DistanceField& local = part(cell);
    std::array<Vec3, 12> points, normals;
    std::size_t count = 0;
    for (int edge = 0; edge < 12; ++edge) {
      const int axis = edge / 4;
      Cell a = cell;
      a[(axis + 1) % 3] += edge & 1;
      a[(axis + 2) % 3] += (edge >> 1) & 1;
      Cell b = a;
      ++b[axis];
      if ((values_[index(a)] < 0) == (values_[index(b)] < 0)) continue;
      const Crossing& crossing = crossing_of(local, a, b, axis);
      points[count] = crossing.point;
      normals[count] = crossing.normal;
      ++count;
    }
    if (count == 0) return;
    const Vec3 low = corner(cell), high = corner({cell[0] + 1, cell[1] + 1, cell[2] + 1});
    const Vec3 point =
        glm::clamp(nearest_to_planes({points.data(), count}, {normals.data(), count}), low, high);
    vertex_[index(cell)] = static_cast<int>(mesh_.position.size());
    mesh_.position.push_back(point);
    mesh_.normal.push_back(local.normal(point, 0.003f));
  }

  struct Crossing {
    Vec3 point{}, normal{};
  };

  // Where the surface crosses the grid edge; four cells share it.
  const Crossing& crossing_of(const DistanceField& local, Cell a, Cell b, int axis) {
    int& known = crossing_[3 * index(a) + axis];
    if (known < 0) {
      known = static_cast<int>(crossings_.size());
      const Vec3 point = on_surface(local, a, b);
      crossings_.push_back({point, local.normal(point, 0.0005f)});
    }
    return crossings_[known];
  }

  // Two steps of the false position.
  Vec3 on_surface(const DistanceField& local, Cell from, Cell to) const {
    Vec3 a = corner(from), b = corner(to);
    float va = values_[index(from)], vb = values_[index(to)];
    for (int i = 0; i < 2; ++i) {
      const Vec3 middle = a + va / (va - vb) * (b - a);
      const float value = local.at(middle);
      if (value == 0) return middle;
      ((value < 0) == (va < 0) ? a : b) = middle;
      ((value < 0) == (va < 0) ? va : vb) = value;
    }
    return a + va / (va - vb) * (b - a);
  }

  // The quad around the grid edge from `point` along `axis`, when the surface crosses it.
  void add_quad(Cell point, int axis) {
    Cell beyond = point;
    ++beyond[axis];
    const bool inside = values_[index(point)] < 0;
    if (inside == (values_[index(beyond)] < 0)) return;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corners{};
    constexpr std::array<std::array<int, 2>, 4> kAround = {{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
      Cell cell = point;
      cell[u] += kAround[i][0];
      cell[v] += kAround[i][1];
      corners[i] = static_cast<std::uint32_t>(vertex_[index(cell)]);
    }
    if (!inside) std::swap(corners[1], corners[3]);
    const auto& p = mesh_.position;
    const bool first_diagonal = glm::distance2(p[corners[0]], p[corners[2]]) <=
                                glm::distance2(p[corners[1]], p[corners[3]]);
    const std::array<std::size_t, 6> order = first_diagonal
                                                 ? std::array<std::size_t, 6>{0, 1, 2, 0, 2, 3}
                                                 : std::array<std::size_t, 6>{1, 2, 3, 1, 3, 0};
    for (const std::size_t i : order) mesh_.triangles.push_back(corners[i]);
  }

  const DistanceField& field_;
  std::array<std::vector<float>, 3> lines_;
  std::array<int, 3> size_{};
  std::vector<float> values_;
  std::array<int, 3> blocks_{};
  std::vector<DistanceField> parts_;  // of the field, one a block that the surface crosses
  std::vector<int> vertex_;           // by cell; -1 where the surface is not
  std::vector<int> crossing_;         // by edge: 3 a grid point
  std::vector<Crossing> crossings_;
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh surface_nets(const DistanceField& field, const GridPlan& plan) {
  if (field.empty()) return {};
  return Net(field, plan).build();
}

}  // namespace ringcraft
