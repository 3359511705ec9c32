#include "io/surface_nets.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace ringcraft {
namespace {

DistanceField ball(float radius) {
  DistanceField field;
  Shape shape;
  shape.radius_a = shape.radius_b = radius;
  field.add(shape);
  return field;
}

// Every edge is walked as often one way as the other.
bool closed(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walks;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[i + k], b = mesh.triangles[i + (k + 1) % 3];
      walks[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, balance] : walks) {
    if (balance != 0) return false;
  }
  return true;
}

double volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3 a = mesh.position[mesh.triangles[i]], b = mesh.position[mesh.triangles[i + 1]],
               c = mesh.position[mesh.triangles[i + 2]];
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

TEST(SurfaceNets, ABallIsRoundClosedAndTurnedOutward) {
  const SurfaceMesh mesh = surface_nets(ball(0.10f), {0.01f, {}, {}, {}});
  ASSERT_GT(mesh.position.size(), 500u);
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    EXPECT_NEAR(glm::length(mesh.position[i]), 0.10f, 0.0005f);
    EXPECT_GT(glm::dot(mesh.normal[i], glm::normalize(mesh.position[i])), 0.99f);
  }
  EXPECT_TRUE(closed(mesh));
  EXPECT_NEAR(volume(mesh), 4.0 / 3.0 * 3.14159265 * 0.001, 0.00006);
}

TEST(SurfaceNets, AFinerSpanHasMoreVerticesAndStaysClosed) {
  const SurfaceMesh coarse = surface_nets(ball(0.10f), {0.02f, {}, {}, {}});
  const SurfaceMesh fine = surface_nets(ball(0.10f), {0.02f, {{0, 0.04f, 0.006f}}, {}, {}});
  EXPECT_GT(fine.position.size(), coarse.position.size());
  EXPECT_TRUE(closed(fine));
}

TEST(SurfaceNets, ACutIsFlatToItsEdge) {
  DistanceField field = ball(0.10f);
  field.cut({{0, 0.03f, 0}, {0, 1, 0}, 0});
  const SurfaceMesh mesh = surface_nets(field, {0.013f, {}, {}, {}});
  float highest = 0;
  int on_top = 0;
  for (const Vec3& p : mesh.position) {
    highest = std::max(highest, p.y);
    if (std::abs(p.y - 0.03f) < 1e-4f) ++on_top;
  }
  EXPECT_NEAR(highest, 0.03f, 3e-4f);
  EXPECT_GT(on_top, 100);
  EXPECT_TRUE(closed(mesh));
}

TEST(DistanceField, NearbyPartAgreesWithTheWhole) {
  DistanceField field;
  for (int i = 0; i < 20; ++i) {
    Shape shape;
    shape.a = Vec3{0.05f * static_cast<float>(i), 0.02f * static_cast<float>(i % 3), 0};
    shape.b = shape.a + Vec3{0.04f, 0.03f, 0.01f};
    shape.radius_a = 0.03f;
    shape.radius_b = 0.02f;
    shape.blend = 0.02f;
    shape.carve = i % 7 == 3;
    field.add(shape);
  }
  for (int i = 0; i < 40; ++i) {
    const Vec3 center{0.025f * static_cast<float>(i), 0.03f, 0.015f};
    const DistanceField part = field.near(center, 0.03f);
    for (const Vec3& off : {Vec3{0.02f, 0, 0}, Vec3{0, -0.02f, 0.01f}, Vec3{}}) {
      EXPECT_FLOAT_EQ(part.at(center + off), field.at(center + off));
    }
  }
}

TEST(DistanceField, ATaperedCapsuleWithinItselfIsABall) {
  DistanceField field;
  Shape shape;
  shape.b = {0.01f, 0, 0};
  shape.radius_a = 0.10f;
  shape.radius_b = 0.02f;
  field.add(shape);
  EXPECT_NEAR(field.at({0, 0.20f, 0}), 0.10f, 1e-5f);
}

}  // namespace
}  // namespace ringcraft
