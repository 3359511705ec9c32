#include "scene/give.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ticks.h"
#include "motion/spring.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr float kSpringRate = 25;  // 1/s
constexpr float kMost = .10f;      // m
constexpr float kSoft = .01f;      // m: so far a glove is pressed in
constexpr float kRests = 1e-4f;    // m, and m a tick: less is not seen

// How deep the glove, moved by `offset`, is in the head or the trunk, m.
float depth_in_body(const BodyCapsules& parts, Part glove, Vec3 offset) {
  const Capsule& hand = parts[index(glove)];
  float depth = 0;
  for (const Part part : {Part::head, Part::neck, Part::chest, Part::abdomen}) {
    const Capsule& other = parts[index(part)];
    const float apart =
        segment_distance(hand.a + offset, hand.b + offset, other.a, other.b).distance;
    depth = std::max(depth, hand.radius + other.radius - apart);
  }
  return depth;
}

}  // namespace

void ArmGive::drive(Vec3 velocity) {
  constexpr float kMostSpeed = kMost * kSpringRate * std::numbers::e_v<float>;
  velocity_ += velocity;
  const float speed = glm::length(velocity_);
  if (speed > kMostSpeed) velocity_ *= kMostSpeed / speed;
}

void ArmGive::step() {
  if (at_rest()) return;
  settle(offset_, velocity_, kSpringRate);
  if (glm::length(offset_) < kRests && glm::length(velocity_) * kTickSeconds < kRests) *this = {};
}

Vec3 short_of_the_body(const BodyModel& body, const Pose& pose, Side side, Vec3 offset) {
  constexpr int kHalvings = 6;
  const Part glove = side == Side::left ? Part::left_hand : Part::right_hand;
  const BodyCapsules parts = capsules(body, world_pose(body.skeleton, pose));
  const float allowed = std::max(kSoft, depth_in_body(parts, glove, {}));
  if (depth_in_body(parts, glove, offset) <= allowed) return offset;
  float free = 0, blocked = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const float share = (free + blocked) / 2;
    (depth_in_body(parts, glove, offset * share) <= allowed ? free : blocked) = share;
  }
  return offset * free;
}

Side guarding_side(Part part) {
  return part == Part::left_hand || part == Part::left_forearm ? Side::left : Side::right;
}

}  // namespace ringcraft
