#include "scene/keep_out.h"

#include <algorithm>

#include "base/ticks.h"
#include "motion/ik.h"
#include "motion/joint_turns.h"
#include "physics/penetration.h"

namespace ringcraft {

namespace {

// Of each limb, the parts that keep out, the end first.
constexpr std::array kLeftArm = {Part::left_hand, Part::left_forearm};
constexpr std::array kRightArm = {Part::right_hand, Part::right_forearm};
constexpr std::array kLeftLeg = {Part::left_foot, Part::left_shin, Part::left_thigh};
constexpr std::array kRightLeg = {Part::right_foot, Part::right_shin, Part::right_thigh};
constexpr std::array<std::span<const Part>, 4> kParts = {kLeftArm, kRightArm, kLeftLeg, kRightLeg};
constexpr float kLow = .1f;  // m: a limb's end that is lower is not pressed down
constexpr int kRounds = 3;   // the way out of one part may lead the other into something else

Vec3 shortened(Vec3 way, float most) {
  const float length = glm::length(way);
  return length > most ? way * (most / length) : way;
}

// Of a thigh the half at the knee: the other hardly goes anywhere when the leg turns.
Capsule keeps_out(const BodyCapsules& own, Part part) {
  Capsule capsule = own[index(part)];
  if (part == Part::left_thigh || part == Part::right_thigh) {
    capsule.a = (capsule.a + capsule.b) * .5f;
  }
  return capsule;
}

// How far, and which way, the part must move to clear the bodies. Zero where it touches nothing.
Vec3 way_out(const Capsule& part, std::span<const BodyCapsules> others, Vec3 away) {
  Vec3 way{};
  for (int pass = 0; pass < 2; ++pass) {  // the way out of one part may lead into its neighbour
    float deepest = 0;
    Vec3 step{};
    for (const BodyCapsules& other : others) {
      for (const Capsule& obstacle : other) {
        const SegmentDistance nearest =
            segment_distance(part.a + way, part.b + way, obstacle.a, obstacle.b);
        const float depth = part.radius + obstacle.radius - nearest.distance;
        if (depth <= deepest) continue;
        deepest = depth;
        step = normalized_or(nearest.on_first - nearest.on_second, away) * depth;
      }
    }
    if (deepest <= 0) break;
    way += step;
  }
  return way;
}

// m/s: how fast the limb may be held off farther. A folded one comes round before its end is fast.
float going_out(const WorldPose& world, const Limb& limb, Vec3 offset) {
  const Vec3 end = world.position[index(limb.end)] + offset;
  return std::min(kGoingOut, kTurningOut * glm::distance(end, world.position[index(limb.root)]));
}

// As little of the limb turns as that takes: a folded one does not turn over, nor does one that is
// held far back while its clip straightens it.
void move_end(const BodyModel& body, std::size_t mover, Vec3 way, Pose& pose) {
  const Limb& limb = kArmsAndLegs[mover];
  const Vec3 end = world_pose(body.skeleton, pose).position[index(limb.end)];
  constexpr float kStraight = .5f;  // 30 degrees
  move_limb_end(body.skeleton, limb, end + way, 1.0f, pose, kStraight);
}

}  // namespace

LimbOffsets kept_out(const BodyModel& body, const Pose& pose, FootContacts held,
                     std::span<const BodyCapsules> others, const LimbOffsets& now,
                     const std::function<Pose(const Pose&)>& as_shown, std::uint32_t spared) {
  LimbOffsets offsets;
  const Vec3 away = pose.rotation[0] * -kForward;
  const WorldPose world = world_pose(body.skeleton, pose);
  for (std::size_t m = 0; m < kParts.size(); ++m) {
    Vec3& offset = offsets[m];
    offset = now[m] - shortened(now[m], kComingFree * kTickSeconds);
    if (others.empty() || (m == 2 && held.left) || (m == 3 && held.right)) continue;
    Pose moved = pose;
    if (offset != Vec3{}) move_end(body, m, offset, moved);
    const float fastest = going_out(world, kArmsAndLegs[m], now[m]);
    bool clear = false;
    for (int round = 0; round < kRounds && !clear; ++round) {
      clear = true;
      for (const Part part : kParts[m]) {
        if ((spared >> index(part) & 1u) != 0) continue;
        const Pose shown = is_leg(kArmsAndLegs[m]) ? as_shown(moved) : moved;
        const BodyCapsules own = capsules(body, world_pose(body.skeleton, shown));
        const Vec3 way = way_out(keeps_out(own, part), others, away);
        if (way == Vec3{}) continue;
        clear = false;
        offset = shortened(offset + way, kMostKeptOut[m]);
        const float height = world.position[index(kArmsAndLegs[m].end)].y;
        offset.y = std::max(offset.y, std::min(0.0f, kLow - height));
        offset = now[m] + shortened(offset - now[m], fastest * kTickSeconds);
        moved = pose;
        move_end(body, m, offset, moved);
      }
    }
  }
  return offsets;
}

float wedge(const BodyCapsules& own, const LimbOffsets& offsets, const BodyCapsules& other) {
  constexpr float kTouches = .01f;  // m
  float most = 0;
  for (std::size_t m = 0; m < kParts.size(); ++m) {
    const float far = glm::length(offsets[m]) - kMostKeptOut[m] / 2;
    if (far <= most) continue;
    for (const Part part : kParts[m]) {
      const Capsule limb = keeps_out(own, part);
      const bool touches = std::any_of(other.begin(), other.end(), [&](const Capsule& one) {
        return segment_distance(limb.a, limb.b, one.a, one.b).distance <
               limb.radius + one.radius + kTouches;
      });
      if (touches) most = far;
    }
  }
  return most;
}

Vec3 way_beside(const Capsule& foot, std::span<const BodyCapsules> others, Vec3 away) {
  constexpr int kSteps = 8;
  constexpr float kSteepest = .4f;  // share along the ground of a way out that is followed
  Vec3 way{};
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 out = way_out({foot.a + way, foot.b + way, foot.radius}, others, away);
    if (out == Vec3{}) break;
    const Vec3 flat{out.x, 0, out.z};
    const float length = glm::length(out);
    const Vec3 aside = glm::length(flat) > kSteepest * length ? flat : away;
    way += normalized_or(Vec3{aside.x, 0, aside.z}, kForward) * length;
  }
  return shortened(way, kMostKeptOut.back());
}

Pose with_offsets(const BodyModel& body, const Pose& pose, const LimbOffsets& offsets) {
  Pose moved = pose;
  for (std::size_t m = 0; m < offsets.size(); ++m) {
    if (offsets[m] != Vec3{}) move_end(body, m, offsets[m], moved);
  }
  return moved;
}

}  // namespace ringcraft
