#include "io/distance_field.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

namespace {

// Quadratic smooth minimum (Quilez): exact where the two differ by more than `k`.
float smooth_min(float a, float b, float k) {
  if (k <= 0) return std::min(a, b);
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * k * 0.25f;
}

float smooth_max(float a, float b, float k) {
  return -smooth_min(-a, -b, k);
}

// Distance to a tapered capsule (Quilez, "round cone").
float tapered_capsule(Vec3 p, Vec3 a, Vec3 b, float ra, float rb) {
  const Vec3 ba = b - a;
  const float l2 = glm::dot(ba, ba);
  const float rr = ra - rb;
  const float a2 = l2 - rr * rr;
  if (a2 <= 0) {  // one end holds the other
    return ra > rb ? glm::length(p - a) - ra : glm::length(p - b) - rb;
  }
  const float il2 = 1.0f / l2;
  const Vec3 pa = p - a;
  const float y = glm::dot(pa, ba);
  const float z = y - l2;
  const Vec3 across = pa * l2 - ba * y;
  const float x2 = glm::dot(across, across);
  const float y2 = y * y * l2;
  const float z2 = z * z * l2;
  const float k = (rr > 0 ? 1.0f : rr < 0 ? -1.0f : 0.0f) * rr * rr * x2;
  if ((z > 0 ? 1.0f : -1.0f) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - rb;
  if ((y > 0 ? 1.0f : -1.0f) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - ra;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - ra;
}

// First-order distance to an ellipsoid about the origin (Quilez).
float ellipsoid(Vec3 p, Vec3 radii) {
  const float k0 = glm::length(p / radii);
  const float k1 = glm::length(p / (radii * radii));
  if (k1 < 1e-6f) return -std::min({radii.x, radii.y, radii.z});
  return k0 * (k0 - 1.0f) / k1;
}

}  // namespace

void DistanceField::add(const Shape& shape) {
  Prepared prepared;
  prepared.shape = shape;
  if (shape.ellipsoid) {
    prepared.center = shape.a;
    prepared.bound = std::max({shape.stretch.x, shape.stretch.y, shape.stretch.z});
  } else {
    // The stretch is applied about the middle of the axis, and the axis keeps its ends.
    prepared.center = 0.5f * (shape.a + shape.b);
    const float widest = std::max({shape.stretch.x, shape.stretch.y, shape.stretch.z});
    prepared.shrink = std::min({shape.stretch.x, shape.stretch.y, shape.stretch.z});
    prepared.bound =
        0.5f * glm::length(shape.b - shape.a) + widest * std::max(shape.radius_a, shape.radius_b);
    const Quat back = glm::conjugate(shape.turn);
    prepared.shape.a = (back * (shape.a - prepared.center)) / shape.stretch;
    prepared.shape.b = (back * (shape.b - prepared.center)) / shape.stretch;
  }
  if (!shape.carve) {
    const Vec3 reach = Vec3(prepared.bound + 0.25f * shape.blend);
    if (shapes_.empty()) low_ = high_ = prepared.center;
    low_ = glm::min(low_, prepared.center - reach);
    high_ = glm::max(high_, prepared.center + reach);
    const float out = std::max(std::abs(low_.x), std::abs(high_.x));
    low_.x = -out;
    high_.x = out;
  }
  shapes_.push_back(prepared);
}

void DistanceField::grow(float by) {
  grown_ += by;
  low_ -= Vec3(by);
  high_ += Vec3(by);
}

float DistanceField::distance(const Prepared& prepared, Vec3 point) {
  const Shape& shape = prepared.shape;
  const Vec3 local = glm::conjugate(shape.turn) * (point - prepared.center);
  if (shape.ellipsoid) return ellipsoid(local, shape.stretch);
  return prepared.shrink *
         tapered_capsule(local / shape.stretch, shape.a, shape.b, shape.radius_a, shape.radius_b);
}

float DistanceField::at(Vec3 point) const {
  const Vec3 p{std::abs(point.x), point.y, point.z};
  float field = 1e3f;
  for (const Prepared& prepared : shapes_) {
    const float k = prepared.shape.blend;
    const float least = glm::length(p - prepared.center) - prepared.bound;
    if (prepared.shape.carve) {
      if (field + least >= k) continue;
      field = smooth_max(field, -distance(prepared, p), k);
    } else {
      if (least >= field + k) continue;
      field = smooth_min(field, distance(prepared, p), k);
    }
  }
  field -= grown_;
  for (const Cut& cut : cuts_) {
    field = smooth_max(field, glm::dot(p - cut.point, cut.normal), cut.blend);
  }
  return field;
}

DistanceField DistanceField::near(Vec3 center, float radius) const {
  DistanceField part;
  part.cuts_ = cuts_;
  part.grown_ = grown_;
  part.low_ = low_;
  part.high_ = high_;
  const Vec3 p{std::abs(center.x), center.y, center.z};
  // The field before the cuts is nowhere in the ball above this.
  float highest = 1e3f;
  for (const Prepared& prepared : shapes_) {
    if (!prepared.shape.carve) highest = std::min(highest, distance(prepared, p) + radius);
  }
  for (const Prepared& prepared : shapes_) {
    const float least = glm::length(p - prepared.center) - prepared.bound - radius;
    const float reach = prepared.shape.carve ? 2.0f * radius : highest;
    if (least < reach + prepared.shape.blend) part.shapes_.push_back(prepared);
  }
  return part;
}

Vec3 DistanceField::normal(Vec3 p, float step) const {
  const Vec3 gradient{at(p + Vec3{step, 0, 0}) - at(p - Vec3{step, 0, 0}),
                      at(p + Vec3{0, step, 0}) - at(p - Vec3{0, step, 0}),
                      at(p + Vec3{0, 0, step}) - at(p - Vec3{0, 0, step})};
  return normalized_or(gradient, kUp);
}

}  // namespace ringcraft
