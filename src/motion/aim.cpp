#include "motion/aim.h"

#include <algorithm>
#include <array>

namespace ringcraft {

namespace {

// On the surface of the canonical body (head 0.10 H deep over the ears, trunk 0.07 H from the
// spine to the front), in the joints' rest axes: x to the own left, y up, z forward.
constexpr std::array<AimPoint, 15> kPoints = {{
    {"chin", TargetZone::head, Joint::head, {0, .022f, .058f}},
    {"nose", TargetZone::head, Joint::head, {0, .052f, .066f}},
    {"left_jaw", TargetZone::head, Joint::head, {.040f, .040f, .038f}},
    {"right_jaw", TargetZone::head, Joint::head, {-.040f, .040f, .038f}},
    {"left_temple", TargetZone::head, Joint::head, {.048f, .068f, .020f}},
    {"right_temple", TargetZone::head, Joint::head, {-.048f, .068f, .020f}},
    {"solar_plexus", TargetZone::body, Joint::chest, {0, .010f, .066f}},
    {"chest", TargetZone::body, Joint::upper_chest, {0, .015f, .068f}},
    {"liver", TargetZone::body, Joint::spine, {-.062f, .050f, .042f}},
    {"left_ribs", TargetZone::body, Joint::spine, {.066f, .050f, .036f}},
    {"belly", TargetZone::body, Joint::spine, {0, .018f, .062f}},
    {"lead_thigh", TargetZone::leg, Joint::left_upper_leg, {.020f, -.155f, .032f}},
    {"lead_inner_thigh", TargetZone::leg, Joint::left_upper_leg, {-.032f, -.140f, .014f}},
    {"lead_calf", TargetZone::leg, Joint::left_lower_leg, {.022f, -.090f, -.008f}},
    {"rear_thigh", TargetZone::leg, Joint::right_upper_leg, {-.020f, -.140f, .032f}},
}};

}  // namespace

const AimPoint* aim_point(std::string_view name) {
  const auto found = std::find_if(kPoints.begin(), kPoints.end(),
                                  [&](const AimPoint& point) { return point.name == name; });
  return found == kPoints.end() ? nullptr : &*found;
}

Vec3 position_of(const AimPoint& point, const WorldPose& world, float height) {
  return world.position[index(point.joint)] +
         world.rotation[index(point.joint)] * (point.offset * height);
}

Vec3 opponent_aim(const AimPoint& point, const WorldPose& guard, float ratio, float distance) {
  return Placement{0, distance, kPi} * (position_of(point, guard, kCanonicalHeight) * ratio);
}

float passes(const Strike& strike, const std::vector<Vec3>& tip, Vec3 aim, Tick* at) {
  const auto begin = static_cast<std::size_t>(strike.active_begin);
  const auto end = std::min(static_cast<std::size_t>(strike.active_end), tip.size() - 1);
  float nearest = 1e9f;
  for (std::size_t i = begin; i + 1 <= end; ++i) {
    const Vec3 way = tip[i + 1] - tip[i];
    const float length2 = glm::dot(way, way);
    const float u = length2 > 0 ? std::clamp(glm::dot(aim - tip[i], way) / length2, 0.0f, 1.0f) : 0;
    const float distance = glm::distance(aim, tip[i] + way * u);
    if (distance >= nearest) continue;
    nearest = distance;
    if (at != nullptr) *at = static_cast<Tick>(i + (u > 0.5f ? 1 : 0));
  }
  return nearest;
}

Vec3 striking_point(const Strike& strike, const Skeleton& skeleton, const WorldPose& world) {
  constexpr float kKnuckles = 0.0515f;  // of standing height, from the wrist
  const auto at = [&](Joint joint) { return world.position[index(joint)]; };
  switch (strike.joint) {
    case Joint::left_hand:
    case Joint::right_hand: {
      const Vec3 along = world.rotation[index(strike.joint)] *
                         glm::normalize(skeleton.offset[index(strike.joint)]);
      return at(strike.joint) + along * (kKnuckles * skeleton.height);
    }
    case Joint::left_foot:
    case Joint::right_foot: {
      const Vec3 ball = at(toes(strike.joint == Joint::left_foot ? Side::left : Side::right));
      const Vec3 ankle = at(strike.joint);
      if (strike.kind == StrikeKind::front_kick) return ball;
      if (strike.kind == StrikeKind::roundhouse) return (ankle + ball) * 0.5f;
      const Vec3 sole = world.rotation[index(strike.joint)] * -kUp;
      return ankle + sole * (0.8f * skeleton.ankle_height());
    }
    default:
      return at(strike.joint);
  }
}

}  // namespace ringcraft
