#include "io/mannequin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "io/anatomy.h"
#include "io/skin_weights.h"
#include "io/surface_nets.h"

namespace ringcraft {

namespace {

using Shade = std::array<std::uint8_t, 4>;

Shade grey(float light) {
  const auto level = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(light, 0.0f, 1.0f)));
  return {level, level, level, 255};
}

// How open a surface point is: the field a little way out over that way. Crevices come out dark.
float openness(const DistanceField& field, Vec3 point, Vec3 normal, float reach) {
  const float near = field.at(point + 0.4f * reach * normal) / (0.4f * reach);
  const float far = field.at(point + reach * normal) / reach;
  const float open = std::clamp(0.5f * (near + far), 0.0f, 1.0f);
  return 0.58f + 0.42f * open;
}

MannequinPiece grown(const Build& build, const DistanceField& field, const GridPlan& plan,
                     Region region) {
  SurfaceMesh mesh = surface_nets(field, plan);
  MannequinPiece piece;
  piece.region = region;
  piece.position = std::move(mesh.position);
  piece.normal = std::move(mesh.normal);
  piece.triangles = std::move(mesh.triangles);
  for (std::size_t i = 0; i < piece.position.size(); ++i) {
    piece.weights.push_back(skin_weights(build, piece.position[i]));
    piece.shade.push_back(
        grey(openness(field, piece.position[i], piece.normal[i], 0.035f * build.scale)));
  }
  return piece;
}

// Lips and nipples are redder than the skin around them.
void tint_skin(const Build& build, MannequinPiece& skin) {
  struct Spot {
    Vec3 center, radii;
    std::array<float, 3> colour;
  };
  const Vec3 head = build.rest.position[index(Joint::head)];
  const Vec3 chest = build.rest.position[index(Joint::upper_chest)];
  const float s = build.scale;
  std::vector<Spot> spots = {{head + s * Vec3{0, 0.048f, 0.092f},
                              s * Vec3{0.026f, 0.011f, 0.025f},
                              {0.86f, 0.62f, 0.60f}}};
  if (!build.female) {
    spots.push_back({chest + s * Vec3{0.096f * build.girth, 0.012f, 0.100f * build.girth},
                     s * Vec3{0.016f, 0.016f, 0.040f},
                     {0.72f, 0.58f, 0.55f}});
  }
  for (std::size_t i = 0; i < skin.position.size(); ++i) {
    const Vec3 p = skin.position[i];
    for (const Spot& spot : spots) {
      const Vec3 from = (Vec3{std::abs(p.x), p.y, p.z} - spot.center) / spot.radii;
      const float share = std::clamp(1.6f * (1.0f - glm::length(from)), 0.0f, 1.0f);
      for (std::size_t c = 0; c < 3; ++c) {
        const float factor = 1.0f + share * (spot.colour[c] - 1.0f);
        skin.shade[i][c] =
            static_cast<std::uint8_t>(std::lround(factor * static_cast<float>(skin.shade[i][c])));
      }
    }
  }
}

// Draws the skin in under what it wears, so that nothing shines through in a bent pose.
void draw_in(MannequinPiece& skin, const DistanceField& worn, float depth) {
  for (std::size_t i = 0; i < skin.position.size(); ++i) {
    const float under = std::clamp(-worn.at(skin.position[i]) / depth, 0.0f, 1.0f);
    skin.position[i] -= under * depth * skin.normal[i];
  }
}

// A ball of `rings` by twice as many segments, with a radius along each axis.
void add_ball(MannequinPiece& piece, Vec3 center, Vec3 radii, int rings, Joint joint) {
  const auto first = static_cast<std::uint32_t>(piece.position.size());
  const int segments = 2 * rings;
  const auto add = [&](Vec3 normal) {
    piece.position.push_back(center + radii * normal);
    piece.normal.push_back(glm::normalize(normal / radii));
    piece.shade.push_back(grey(1));
    piece.weights.push_back(rigid_weights(joint));
  };
  add({0, 0, 1});
  for (int r = 1; r < rings; ++r) {
    const float down = kPi * static_cast<float>(r) / static_cast<float>(rings);
    for (int i = 0; i < segments; ++i) {
      const float around = 2 * kPi * static_cast<float>(i) / static_cast<float>(segments);
      add({std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)});
    }
  }
  add({0, 0, -1});
  const auto at = [&](int ring, int i) {
    if (ring == 0) return first;
    if (ring == rings) return first + 1 + static_cast<std::uint32_t>((rings - 1) * segments);
    return first + 1 + static_cast<std::uint32_t>((ring - 1) * segments + i % segments);
  };
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < segments; ++i) {
      if (r > 0) {
        for (const auto v : {at(r, i), at(r + 1, i), at(r, i + 1)}) piece.triangles.push_back(v);
      }
      if (r + 1 < rings) {
        for (const auto v : {at(r, i + 1), at(r + 1, i), at(r + 1, i + 1)}) {
          piece.triangles.push_back(v);
        }
      }
    }
  }
}

// Both eyes: the white between the lids, and the iris that stands a little out of it.
void add_eyes(const Eye& eye, Mannequin& mannequin) {
  MannequinPiece white, iris;
  white.region = Region::eye_white;
  iris.region = Region::iris;
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 center{side * eye.center.x, eye.center.y, eye.center.z};
    add_ball(white, center, eye.radius * Vec3{1, 0.50f, 0.62f}, 8, Joint::head);
    const Vec3 front = center + eye.radius * Vec3{-0.04f * side, 0.04f, 0.32f};
    add_ball(iris, front, eye.radius * Vec3{0.46f, 0.47f, 0.36f}, 6, Joint::head);
  }
  mannequin.pieces.push_back(std::move(white));
  mannequin.pieces.push_back(std::move(iris));
}

// Adds a piece, to the one of the same region where there is one.
void add_piece(Mannequin& mannequin, MannequinPiece piece) {
  if (piece.position.empty()) return;
  for (MannequinPiece& present : mannequin.pieces) {
    if (present.region != piece.region) continue;
    const auto first = static_cast<std::uint32_t>(present.position.size());
    present.position.insert(present.position.end(), piece.position.begin(), piece.position.end());
    present.normal.insert(present.normal.end(), piece.normal.begin(), piece.normal.end());
    present.shade.insert(present.shade.end(), piece.shade.begin(), piece.shade.end());
    present.weights.insert(present.weights.end(), piece.weights.begin(), piece.weights.end());
    for (const std::uint32_t v : piece.triangles) present.triangles.push_back(first + v);
    return;
  }
  mannequin.pieces.push_back(std::move(piece));
}

// Fine over the face and the feet, coarse over the rest.
GridPlan skin_plan(const Build& build) {
  const float s = build.scale;
  const Vec3 head = build.rest.position[index(Joint::head)];
  const Vec3 ankle = build.rest.position[index(Joint::left_foot)];
  GridPlan plan;
  plan.spacing = 0.0155f * s;
  plan.x = {{0, 0.06f * s, 0.0085f * s}, {0.06f * s, ankle.x + 0.06f * s, 0.0115f * s}};
  plan.y = {{-1, ankle.y - 0.020f * s, 0.010f * s},
            {head.y + 0.005f * s, head.y + 0.150f * s, 0.008f * s},
            {head.y + 0.150f * s, 3, 0.012f * s}};
  plan.z = {{head.z + 0.05f * s, head.z + 0.115f * s, 0.010f * s}};
  return plan;
}

}  // namespace

std::string_view name_of(Region region) {
  constexpr std::array<std::string_view, kRegionCount> kNames = {
      "skin", "shorts", "gloves", "trim", "hair", "eyeWhite", "iris"};
  return kNames[static_cast<std::size_t>(region)];
}

Mannequin make_mannequin(const BodyModel& body) {
  const Build build = build_of(body);
  const float s = build.scale;
  const auto even = [&](float spacing) {
    GridPlan plan;
    plan.spacing = spacing * s;
    return plan;
  };
  Mannequin mannequin;
  const DistanceField body_field = skin_field(build);
  MannequinPiece skin = grown(build, body_field, skin_plan(build), Region::skin);
  tint_skin(build, skin);
  draw_in(skin, shorts_field(build), 0.010f * s);
  draw_in(skin, hair_field(build), 0.004f * s);
  draw_in(skin, anklet_field(build), 0.004f * s);
  add_piece(mannequin, std::move(skin));
  add_piece(mannequin, grown(build, shorts_field(build), even(0.015f), Region::shorts));
  add_piece(mannequin, grown(build, top_field(build), even(0.014f), Region::shorts));
  add_piece(mannequin, grown(build, glove_field(build), even(0.011f), Region::gloves));
  add_piece(mannequin, grown(build, waistband_field(build), even(0.011f), Region::trim));
  add_piece(mannequin, grown(build, cuff_field(build), even(0.012f), Region::trim));
  add_piece(mannequin, grown(build, anklet_field(build), even(0.011f), Region::trim));
  add_piece(mannequin, grown(build, hair_field(build), even(0.0095f), Region::hair));
  add_piece(mannequin, grown(build, line_field(build, body_field), even(0.0025f), Region::hair));
  add_eyes(eye_of(build, body_field), mannequin);
  return mannequin;
}

std::shared_ptr<const Mannequin> mannequin_of(const BodyModel& body) {
  static std::mutex mutex;
  static std::map<std::tuple<float, float, Sex>, std::shared_ptr<const Mannequin>> made;
  const std::lock_guard lock(mutex);
  auto& mannequin = made[{body.spec.height, body.spec.mass, body.spec.sex}];
  if (!mannequin) mannequin = std::make_shared<const Mannequin>(make_mannequin(body));
  return mannequin;
}

}  // namespace ringcraft
