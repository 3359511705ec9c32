#pragma once
// Signed distance fields of anatomical shapes: ellipsoids and tapered capsules, smoothly joined.

#include <vector>

#include "base/vec.h"

namespace ringcraft {

// One shape: a tapered capsule from `a` to `b`, or an ellipsoid where `ellipsoid` is set (then `a`
// is its centre and `stretch` its radii, m).
struct Shape {
  Vec3 a{}, b{};          // m
  float radius_a = 0;     // m
  float radius_b = 0;     // m
  Vec3 stretch{1, 1, 1};  // how many times as wide along the axes of `turn`, or the radii
  Quat turn{1, 0, 0, 0};  // of the shape's axes
  float blend = 0;        // m: width over which it melts into the shapes before it
  bool ellipsoid = false;
  bool carve = false;  // taken away instead of added
};

// A flat end: what lies on the side of the normal is cut off.
struct Cut {
  Vec3 point{};     // m
  Vec3 normal{};    // unit
  float blend = 0;  // m: roundness of the edge
};

// The field of a body that is symmetric about the plane x = 0: only its left half (x >= 0) is
// modelled.
class DistanceField {
 public:
  void add(const Shape& shape);
  void cut(const Cut& cut) { cuts_.push_back(cut); }
  // Moves the surface of all shapes out by so many metres; cuts stay where they are.
  void grow(float by);

  // Signed distance, m, negative inside. Exact on the surface, a bound elsewhere.
  float at(Vec3 point) const;
  // The same field within `radius` metres of `center`, without the shapes that do not reach there.
  DistanceField near(Vec3 center, float radius) const;
  // Unit normal from central differences over `step` metres.
  Vec3 normal(Vec3 point, float step) const;
  bool empty() const { return shapes_.empty(); }
  Vec3 low() const { return low_; }  // corners of a box that holds the surface, m
  Vec3 high() const { return high_; }

 private:
  struct Prepared {
    Shape shape;
    Vec3 center{};
    float bound = 0;   // radius of a sphere around it, m
    float shrink = 1;  // smallest stretch: keeps the distance a bound
  };
  static float distance(const Prepared& prepared, Vec3 point);

  std::vector<Prepared> shapes_;
  std::vector<Cut> cuts_;
  float grown_ = 0;  // m
  Vec3 low_{}, high_{};
};

}  // namespace ringcraft
