#pragma once
// Penetration between two bodies: capsules per part, closed-form segment distance, bounding spheres
// first.

#include "physics/body.h"

namespace ringcraft {

struct Penetration {
  float depth = 0;  // m; 0 where nothing touches
  Part a = Part::pelvis, b = Part::pelvis;
};

// Distance between two segments, m, and the nearest points (Ericson 2005, section 5.1.9).
struct SegmentDistance {
  float distance = 0;
  Vec3 on_first{}, on_second{};
};
SegmentDistance segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);

// Deepest penetration of any pair of parts. Parts whose bit is set in `excepted_a` / `excepted_b`
// (bit index(part)) are left out: a strike's intended contact.
Penetration deepest_penetration(const BodyCapsules& a, const BodyCapsules& b,
                                std::uint32_t excepted_a = 0, std::uint32_t excepted_b = 0);

// Every pair deeper than `least`.
std::vector<Penetration> penetrations(const BodyCapsules& a, const BodyCapsules& b, float least);

}  // namespace ringcraft
