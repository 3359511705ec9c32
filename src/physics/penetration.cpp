#include "physics/penetration.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {
namespace {

struct Sphere {
  Vec3 center{};
  float radius = 0;
};

using Spheres = std::array<Sphere, kPartCount>;

Spheres spheres_of(const BodyCapsules& body) {
  Spheres out;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Capsule& c = body[i];
    out[i] = {(c.a + c.b) * .5f, glm::length(c.b - c.a) * .5f + c.radius};
  }
  return out;
}

// A sphere around all of them.
Sphere around(const Spheres& spheres) {
  Sphere all;
  for (const Sphere& s : spheres) all.center += s.center / static_cast<float>(kPartCount);
  for (const Sphere& s : spheres) {
    all.radius = std::max(all.radius, glm::distance(all.center, s.center) + s.radius);
  }
  return all;
}

// Whether capsules inside these spheres can overlap by more than `least`.
bool near(const Sphere& a, const Sphere& b, float least) {
  const float reach = a.radius + b.radius - least;
  return reach > 0 && glm::distance2(a.center, b.center) < reach * reach;
}

// Calls found(penetration) for every pair that overlaps by more than the depth found() last
// returned.
template <class Found>
void visit_overlaps(const BodyCapsules& a, const BodyCapsules& b, std::uint32_t excepted_a,
                    std::uint32_t excepted_b, float least, Found found) {
  const Spheres sa = spheres_of(a), sb = spheres_of(b);
  const Sphere all_b = around(sb);
  if (!near(around(sa), all_b, least)) return;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (((excepted_a >> i) & 1u) || !near(sa[i], all_b, least)) continue;
    for (std::size_t j = 0; j < kPartCount; ++j) {
      if (((excepted_b >> j) & 1u) || !near(sa[i], sb[j], least)) continue;
      const float distance = segment_distance(a[i].a, a[i].b, b[j].a, b[j].b).distance;
      const float depth = a[i].radius + b[j].radius - distance;
      if (depth > least) least = found(Penetration{depth, part_at(i), part_at(j)});
    }
  }
}

}  // namespace

SegmentDistance segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) {
  constexpr float kPoint = 1e-12f;  // m2: a segment shorter than a micrometre is a point
  const Vec3 u = a1 - a0, v = b1 - b0, r = a0 - b0;
  const float uu = glm::dot(u, u), vv = glm::dot(v, v), ur = glm::dot(u, r), vr = glm::dot(v, r);
  float s = 0, t = 0;
  if (uu <= kPoint) {
    if (vv > kPoint) t = std::clamp(vr / vv, 0.0f, 1.0f);
  } else if (vv <= kPoint) {
    s = std::clamp(-ur / uu, 0.0f, 1.0f);
  } else {
    const float uv = glm::dot(u, v);
    const float denominator = uu * vv - uv * uv;
    // Of parallel segments any s will do: the clamps below find a nearest pair.
    if (denominator > 1e-7f * uu * vv) {
      s = std::clamp((uv * vr - ur * vv) / denominator, 0.0f, 1.0f);
    }
    t = (uv * s + vr) / vv;
    if (t < 0) {
      t = 0;
      s = std::clamp(-ur / uu, 0.0f, 1.0f);
    } else if (t > 1) {
      t = 1;
      s = std::clamp((uv - ur) / uu, 0.0f, 1.0f);
    }
  }
  SegmentDistance d;
  d.on_first = a0 + s * u;
  d.on_second = b0 + t * v;
  d.distance = glm::distance(d.on_first, d.on_second);
  return d;
}

Penetration deepest_penetration(const BodyCapsules& a, const BodyCapsules& b,
                                std::uint32_t excepted_a, std::uint32_t excepted_b) {
  Penetration best;
  visit_overlaps(a, b, excepted_a, excepted_b, 0, [&](const Penetration& p) {
    best = p;
    return p.depth;
  });
  return best;
}

std::vector<Penetration> penetrations(const BodyCapsules& a, const BodyCapsules& b, float least) {
  std::vector<Penetration> all;
  visit_overlaps(a, b, 0, 0, least, [&](const Penetration& p) {
    all.push_back(p);
    return least;
  });
  return all;
}

}  // namespace ringcraft
