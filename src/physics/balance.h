#pragma once
// Balance: the extrapolated centre of mass against the base of support (Hof 2005).

#include <array>
#include <span>
#include <vector>

#include "motion/clip.h"
#include "physics/body.h"

namespace ringcraft {

// Eigenfrequency of the body as an inverted pendulum, 1/s: sqrt(g / l), l = 1.2 trochanter heights.
float pendulum_rate(const BodyModel& body);

// Extrapolated centre of mass on the ground, m: x + v / w0.
Vec3 extrapolated(Vec3 center_of_mass, Vec3 velocity, float rate);

// By how much the angular momentum about the centre of mass (kg m2/s, `mass` in kg) moves it, m:
// what is shed to the ground pushes the centre of mass as the centroidal moment pivot says
// (Popovic, Goswami, Herr 2005), so a body thrown over by its head is farther out than its velocity
// tells, and one whose legs are swept forward less far.
Vec3 shed_by_turning(Vec3 angular_momentum, float mass, float rate);

// Convex hull of points on the ground (y is ignored), counter-clockwise seen from above (+X to +Z
// is clockwise there: what counts is that `beyond` agrees). Fewer than three corners are allowed.
class Base {
 public:
  Base() = default;
  explicit Base(std::span<const Vec3> points);
  bool empty() const { return corners_.empty(); }
  Vec3 middle() const;

  struct Beyond {
    float distance = 0;  // m; negative inside: depth to the nearest edge
    Vec3 direction{};    // unit, on the ground: outward through the nearest edge
  };
  Beyond beyond(Vec3 point) const;

 private:
  std::vector<Vec2> corners_;
};

// Which corners of a sole (physics/ragdoll.h) do not carry: those of a raised heel.
std::array<bool, 6> raised_corners(const std::array<Vec3, 6>& sole);

// The base under the planted feet of a pose.
Base base_of(const BodyModel& body, const WorldPose& world, FootContacts contacts);

// How far beyond the base the extrapolated centre of mass may be, m, so that `steps` recovery steps
// bring it back: at the instant of the blow, in a direction `off` rad from the own facing.
float step_allowance(const BodyModel& body, int steps, float off);

// Of the centre of mass's height at the blow: a body below has fallen.
inline constexpr float kFallen = .75f;

// When the first recovery step lands, s after the blow: that of `step_allowance`.
inline constexpr float kStepLands = .39f;

// How far the feet have to go to catch the body, m: where its extrapolated centre of mass, `beyond`
// the base (m) at the end of the impulse step, will be when the first step lands (Hof 2008: a
// change of velocity is undone by a foot placed dv / w0 farther). 0 where the body is inside.
float stride_to_catch(const BodyModel& body, float beyond);

}  // namespace ringcraft
