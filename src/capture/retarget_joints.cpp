// Joints brought to what ours can do: see turn_to_hinges and fit_wrists in retarget.h.
#include <algorithm>
#include <cmath>

#include "capture/retarget.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

// Elbows and knees are hinges on our body. The angle by which the upper bone must turn about itself
// so that the lower one flexes about the hinge; `trust` falls to zero for a straight limb.
float hinge_twist(const Quat& lower, Vec3 bone, Vec3 hinge, float& trust) {
  const Vec3 axis = glm::cross(bone, lower * bone);
  const float sine = glm::length(axis);
  const float flexion = std::atan2(sine, glm::dot(bone, lower * bone));
  trust = glm::smoothstep(radians(8), radians(30), flexion);
  if (trust <= 0) return 0;
  const Vec3 unit = axis / sine;
  const float twist = std::atan2(glm::dot(glm::cross(hinge, unit), bone), glm::dot(hinge, unit));
  // An axis that points the other way is a joint bent backwards a little: noise, not a half turn.
  if (std::abs(twist) > radians(120)) {
    trust = 0;
    return 0;
  }
  return twist;
}

}  // namespace

void turn_to_hinges(const Skeleton& target, Clip& clip) {
  for (const Side side : {Side::left, Side::right})
    for (const Limb& limb : {arm(side), leg(side)}) {
      const Vec3 bone = glm::normalize(target.offset[index(limb.middle)]);
      const Vec3 hinge = hinge_axis(limb);
      std::vector<float> twist(clip.frames.size());
      std::vector<float> trust(clip.frames.size());
      for (std::size_t i = 0; i < clip.frames.size(); ++i)
        twist[i] = hinge_twist(clip.frames[i].rotation[index(limb.middle)], bone, hinge, trust[i]);
      // A straight limb goes on with the twist of the moments around it.
      const std::vector<float> smooth = smoothed(twist, trust, 0.03f);
      for (std::size_t i = 0; i < clip.frames.size(); ++i) {
        Pose& pose = clip.frames[i];
        const Quat turn = glm::angleAxis(smooth[i], bone);
        pose.rotation[index(limb.root)] = glm::normalize(pose.rotation[index(limb.root)] * turn);
        pose.rotation[index(limb.middle)] =
            glm::normalize(glm::inverse(turn) * pose.rotation[index(limb.middle)]);
      }
    }
}

namespace {

// Wrist ranges as the left hand's swing, palm down: flexion about -z, ulnar deviation about +y (AMA
// Guides, fifth edition: flexion 60-90, extension 70, deviations 25 and 35-65).
constexpr float kFlexion = radians(85), kExtension = radians(65);
constexpr float kUlnar = radians(60), kRadial = radians(22);
constexpr float kEase = radians(12);  // before its end a range begins to resist

// Within (-low, high), eased over kEase before either end.
float eased_within(float angle, float low, float high) {
  const float limit = angle < 0 ? low : high;
  const float size = std::abs(angle);
  const float free = limit - kEase;
  if (size <= free) return angle;
  return std::copysign(free + kEase * (1 - std::exp(-(size - free) / kEase)), angle);
}

float twist_about_x(Quat q) {
  return wrapped_angle(2 * std::atan2(q.x, q.w));
}

}  // namespace

void fit_wrists(Clip& clip) {
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t fore = index(arm(side).middle);
    const std::size_t hand = index(arm(side).end);
    const float mirror = side == Side::left ? 1.0f : -1.0f;
    // 1. Pronation happens along the forearm: it and the hand share the turn about the bone.
    std::vector<float> share;
    for (const Pose& pose : clip.frames)
      share.push_back(twist_about_x(pose.rotation[hand]) - twist_about_x(pose.rotation[fore]));

    share = smoothed(unwrapped(share), 0.02f);
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
      Pose& pose = clip.frames[i];
      const Quat turn = glm::angleAxis(share[i] / 2, kLeft);
      pose.rotation[fore] = glm::normalize(pose.rotation[fore] * turn);
      const Quat rest = glm::normalize(glm::inverse(turn) * pose.rotation[hand]);
      // 2. The hand bends no further than a wrist does; captures of wrists glitch.
      const Quat twist = glm::angleAxis(twist_about_x(rest), kLeft);
      Vec3 swing = rotation_vector(rest * glm::inverse(twist));
      swing.y = mirror * eased_within(mirror * swing.y, kRadial, kUlnar);
      swing.z = mirror * eased_within(mirror * swing.z, kFlexion, kExtension);
      pose.rotation[hand] = glm::normalize(from_rotation_vector(swing) * twist);
    }
  }
}

}  // namespace ringcraft
