#include "physics/balance.h"

#include <algorithm>
#include <cmath>

#include "physics/ragdoll.h"

namespace ringcraft {
namespace {

float cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

// Andrew's monotone chain.
std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> chain(2 * points.size());
  std::size_t n = 0;
  const auto add = [&](Vec2 p, std::size_t least) {
    while (n >= least + 2 && cross(chain[n - 1] - chain[n - 2], p - chain[n - 2]) <= 0) --n;
    chain[n++] = p;
  };
  for (const Vec2& p : points) add(p, 0);
  const std::size_t lower = n - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  chain.resize(n - 1);
  return chain;
}

// Per direction of the push (V2, 75 kg and 1.78 m); the third row carries the recursion of Koolen
// 2012 one step on: a_3 = a_2 + .31 (a_2 - a_1). One step sideways: that with which the simulated
// body holds V2's 66 N s on the chest; with the point mass's .157 it holds 61 and leans too little.
struct Allowance {
  float fore, aft, side;  // m
};
constexpr std::array<Allowance, 4> kAllowances = {
    {{0, 0, 0}, {.331f, .241f, .18f}, {.433f, .313f, .201f}, {.465f, .335f, .215f}}};

}  // namespace

float pendulum_rate(const BodyModel& body) {
  const float trochanter = body.skeleton.leg_length() + body.skeleton.ankle_height();
  return std::sqrt(kGravity / (1.2f * trochanter));
}

Vec3 extrapolated(Vec3 center_of_mass, Vec3 velocity, float rate) {
  const Vec3 xi = center_of_mass + velocity / rate;
  return {xi.x, 0, xi.z};
}

Vec3 shed_by_turning(Vec3 angular_momentum, float mass, float rate) {
  // Dumping H moves the centre of mass by (H x up) / (m h w0), h = g / w0^2.
  const Vec3 shed = glm::cross(angular_momentum, kUp) * (rate / (mass * kGravity));
  return {shed.x, 0, shed.z};
}

Base::Base(std::span<const Vec3> points) {
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.emplace_back(p.x, p.z);
  corners_ = hull(std::move(flat));
}

Vec3 Base::middle() const {
  Vec2 sum{};
  for (const Vec2& c : corners_) sum += c / static_cast<float>(corners_.size());
  return {sum.x, 0, sum.y};
}

Base::Beyond Base::beyond(Vec3 point) const {
  if (corners_.empty()) return {};
  const Vec2 p{point.x, point.z};
  bool inside = corners_.size() > 2;
  float least = 0;
  Vec2 nearest{}, outward{};
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()];
    const Vec2 edge = b - a;
    const float t = glm::dot(edge, edge) > 0
                        ? std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0f, 1.0f)
                        : 0.0f;
    const Vec2 foot = a + t * edge;
    const float distance = glm::distance(p, foot);
    if (inside && cross(edge, p - a) < 0) inside = false;
    if (i == 0 || distance < least) {
      least = distance;
      nearest = foot;
      outward = Vec2{edge.y, -edge.x};
    }
  }
  Beyond result;
  result.distance = inside ? -least : least;
  const Vec2 way = inside || least < 1e-6f ? outward : p - nearest;
  result.direction = normalized_or(Vec3{way.x, 0, way.y}, kForward);
  return result;
}

std::array<bool, 6> raised_corners(const std::array<Vec3, 6>& sole) {
  // Ball and tip always carry (the toes bend); a raised heel does not.
  float lowest = sole[0].y;
  for (const Vec3& c : sole) lowest = std::min(lowest, c.y);
  std::array<bool, 6> raised{};
  for (std::size_t i = 0; i < sole.size(); i += 3) raised[i] = sole[i].y >= lowest + .025f;
  return raised;
}

Base base_of(const BodyModel& body, const WorldPose& world, FootContacts contacts) {
  std::vector<Vec3> points;
  for (const Side side : {Side::left, Side::right}) {
    if (!contacts.of(side)) continue;
    const auto corners = sole(body, world, side);
    const auto raised = raised_corners(corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!raised[i]) points.push_back(corners[i]);
    }
  }
  return Base(points);
}

float step_allowance(const BodyModel& body, int steps, float off) {
  const Allowance a = kAllowances[static_cast<std::size_t>(std::clamp(steps, 0, 3))];
  if (steps <= 0) return 0;
  const float along = std::cos(off), across = std::sin(off);
  const float lengthwise = along > 0 ? a.fore : a.aft;
  const float inverse =
      along * along / (lengthwise * lengthwise) + across * across / (a.side * a.side);
  return body.spec.height / 1.78f / std::sqrt(inverse);
}

float stride_to_catch(const BodyModel& body, float beyond) {
  constexpr float kDecided = .1f;
  return std::max(0.0f, beyond) * std::exp(pendulum_rate(body) * (kStepLands - kDecided));
}

}  // namespace ringcraft
