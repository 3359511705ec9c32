#include "io/ring.h"

#include <array>
#include <cmath>

namespace ringcraft {

namespace {

// A box between two corners.
void add_box(RingPart& part, Vec3 low, Vec3 high) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      Vec3 normal{};
      normal[axis] = side == 1 ? 1.0f : -1.0f;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(part.position.size());
      constexpr std::array<std::array<int, 2>, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      for (const auto& corner : kCorners) {
        Vec3 p{};
        p[axis] = side == 1 ? high[axis] : low[axis];
        p[u] = corner[0] == 1 ? high[u] : low[u];
        p[v] = corner[1] == 1 ? high[v] : low[v];
        part.position.push_back(p);
        part.normal.push_back(normal);
      }
      constexpr std::array<std::uint32_t, 6> kOut = {0, 1, 2, 0, 2, 3}, kIn = {0, 2, 1, 0, 3, 2};
      for (const std::uint32_t i : side == 1 ? kOut : kIn) part.triangles.push_back(first + i);
    }
  }
}

// An open tube between two points.
void add_tube(RingPart& part, Vec3 a, Vec3 b, float radius, int segments) {
  const Vec3 along = glm::normalize(b - a);
  const Vec3 side = glm::normalize(glm::cross(along, std::abs(along.y) < 0.9f ? kUp : kForward));
  const Vec3 other = glm::cross(along, side);
  const auto first = static_cast<std::uint32_t>(part.position.size());
  for (int i = 0; i < segments; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(segments);
    const Vec3 out = std::cos(angle) * side + std::sin(angle) * other;
    for (const Vec3& end : {a, b}) {
      part.position.push_back(end + radius * out);
      part.normal.push_back(out);
    }
  }
  const auto count = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t now = first + 2 * i, next = first + 2 * ((i + 1) % count);
    for (const std::uint32_t v : {now, next, now + 1, now + 1, next, next + 1}) {
      part.triangles.push_back(v);
    }
  }
}

}  // namespace

std::vector<RingPart> make_ring(float half) {
  const float edge = half + 0.45f;  // the apron's width outside the ropes
  constexpr std::array<float, 4> kRopeHeights = {0.40f, 0.70f, 1.00f, 1.30f};
  constexpr float kRopeRadius = 0.018f, kPostRadius = 0.055f;

  RingPart canvas{"canvas", {0.33f, 0.36f, 0.40f}, 0.95f, {}, {}, {}};
  add_box(canvas, {-edge, -0.06f, -edge}, {edge, 0, edge});
  RingPart apron{"apron", {0.020f, 0.028f, 0.055f}, 0.9f, {}, {}, {}};
  add_box(apron, {-edge + 0.02f, -0.95f, -edge + 0.02f}, {edge - 0.02f, -0.06f, edge - 0.02f});

  RingPart light{"ropes", {0.70f, 0.70f, 0.68f}, 0.6f, {}, {}, {}};
  RingPart red{"topRope", {0.45f, 0.02f, 0.02f}, 0.6f, {}, {}, {}};
  RingPart posts{"posts", {0.04f, 0.04f, 0.05f}, 0.5f, {}, {}, {}};
  RingPart red_pad{"redCorner", {0.45f, 0.02f, 0.02f}, 0.7f, {}, {}, {}};
  RingPart blue_pad{"blueCorner", {0.02f, 0.06f, 0.40f}, 0.7f, {}, {}, {}};
  RingPart white_pads{"neutralCorners", {0.70f, 0.70f, 0.68f}, 0.7f, {}, {}, {}};
  const std::array<Vec3, 4> corners = {
      {{half, 0, half}, {-half, 0, half}, {-half, 0, -half}, {half, 0, -half}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& here = corners[i];
    const Vec3& next = corners[(i + 1) % 4];
    const Vec3 outside = here * (1.0f + 0.18f / half);
    add_tube(posts, outside - Vec3{0, 0.9f, 0}, outside + Vec3{0, 1.42f, 0}, kPostRadius, 16);
    RingPart& pad = i == 0 ? red_pad : i == 2 ? blue_pad : white_pads;
    add_box(pad, here + Vec3{-0.09f, 0.28f, -0.09f}, here + Vec3{0.09f, 1.40f, 0.09f});
    for (std::size_t r = 0; r < kRopeHeights.size(); ++r) {
      const Vec3 up{0, kRopeHeights[r], 0};
      add_tube(r + 1 == kRopeHeights.size() ? red : light, here + up, next + up, kRopeRadius, 10);
    }
  }
  return {canvas, apron, light, red, posts, red_pad, blue_pad, white_pads};
}

}  // namespace ringcraft
