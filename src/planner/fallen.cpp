#include "planner/fallen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/evaluation.h"

namespace ringcraft {

Fallen::Fallen(const InFlight& fall) {
  const Tick then = fall.launch.end;
  const BodyCapsules& lies = fall.table->capsules_at(fall.age(then));
  const Frame frame = fall.frame_at(then);
  const auto seen = [&](Vec3 point) {
    const Vec3 p = frame.to_outer(point);
    return Vec2(p.x, p.z);
  };
  const auto middle = [&](Part part) {
    const Capsule& c = lies[index(part)];
    return seen((c.a + c.b) * 0.5f);
  };
  const auto line = [](Vec2 from, Vec2 to) {
    return Line{from, to - from, glm::dot(to - from, to - from)};
  };
  const auto along = [&](Part part) {
    const Capsule& c = lies[index(part)];
    return line(seen(c.a), seen(c.b));
  };
  lines_ = {line(middle(Part::head), middle(Part::pelvis)), along(Part::left_thigh),
            along(Part::right_thigh), along(Part::left_shin), along(Part::right_shin)};
  middle_ = middle(Part::pelvis);
  for (const Line& one : lines_) {
    radius_ = std::max(
        {radius_, glm::distance(middle_, one.from), glm::distance(middle_, one.from + one.way)});
  }
}

float Fallen::distance(float x, float z) const {
  float nearest = std::numeric_limits<float>::max();
  for (const Line& one : lines_) {
    const Vec2 to = Vec2(x, z) - one.from;
    const float t =
        one.length2 > 1e-9f ? std::clamp(glm::dot(to, one.way) / one.length2, 0.0f, 1.0f) : 0.0f;
    const Vec2 off = to - one.way * t;
    nearest = std::min(nearest, glm::dot(off, off));
  }
  return std::sqrt(nearest);
}

double Fallen::overlap(float x, float z) const {
  constexpr auto kRoom = static_cast<float>(kOverlapDistance);
  const Vec2 off = Vec2(x, z) - middle_;
  const float far = radius_ + kRoom;
  if (glm::dot(off, off) >= far * far) return 0;
  return static_cast<double>(std::max(0.0f, kRoom - distance(x, z)));
}

double overlap(std::span<const Fallen> fallen, float x, float z) {
  double sum = 0;
  for (const Fallen& one : fallen) sum += one.overlap(x, z);
  return sum;
}

}  // namespace ringcraft
