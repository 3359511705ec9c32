#include "physics/limb_room.h"

#include <algorithm>

#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr float kGives = .01f;   // m: flesh and leather give by so much
constexpr float kOwnBody = .5f;  // counts so much of what the floor does

std::array<Part, 3> parts_of(const Limb& limb) {
  const Part root = *part_of(limb.root);
  return {root, part_at(index(root) + 1), part_at(index(root) + 2)};
}

float depth_in_floor(const Capsule& c) {
  return c.radius - std::min(c.a.y, c.b.y);
}

float depth_in_part(const Capsule& a, const Capsule& b) {
  return a.radius + b.radius - segment_distance(a.a, a.b, b.a, b.b).distance;
}

}  // namespace

LimbRoom::LimbRoom(const BodyModel& body, std::initializer_list<Pose> poses) : body_(body) {
  for (const Pose& pose : poses) {
    const BodyCapsules c = capsules(body, world_pose(body.skeleton, pose));
    for (std::size_t i = 0; i < kPartCount; ++i) {
      may_.floor[i] = std::max(may_.floor[i], depth_in_floor(c[i]));
      for (std::size_t j = 0; j < kPartCount; ++j) {
        may_.parts[i][j] = std::max(may_.parts[i][j], depth_in_part(c[i], c[j]));
      }
    }
  }
}

float LimbRoom::lacks(const Limb& limb, const Pose& pose) const {
  const BodyCapsules c = capsules(body_, world_pose(body_.skeleton, pose));
  const auto own = parts_of(limb);
  float sum = 0;
  for (const Part part : own) {
    const std::size_t i = index(part);
    sum += std::max(0.0f, depth_in_floor(c[i]) - may_.floor[i] - kGives);
    if (part == own.front()) continue;  // hangs on the trunk
    for (std::size_t j = 0; j < kPartCount; ++j) {
      if (std::find(own.begin(), own.end(), part_at(j)) != own.end()) continue;
      sum += std::max(0.0f, depth_in_part(c[i], c[j]) - may_.parts[i][j] - kGives) * kOwnBody;
    }
  }
  return sum;
}

}  // namespace ringcraft
