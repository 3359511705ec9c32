#include "motion/ik.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

namespace {

constexpr float kMostFlexion = radians(155);  // past it forearm and upper arm share their flesh

Quat parent_rotation(const WorldPose& world, Joint joint) {
  const int parent = kParent[index(joint)];
  return parent < 0 ? Quat() : world.rotation[static_cast<std::size_t>(parent)];
}

// Eases a reach near the limb's full length so that it never quite straightens (soft IK).
float softened(float distance, float length, float soft_share) {
  const float soft = soft_share * length;
  if (distance <= soft || soft_share >= 1) return std::min(distance, length * 0.9999f);
  const float room = length - soft;
  return soft + room * (1 - std::exp(-(distance - soft) / room)) * 0.9999f;
}

}  // namespace

Vec3 hinge_axis(const Limb& limb) {
  if (limb.root == Joint::left_upper_arm) return -kUp;
  if (limb.root == Joint::right_upper_arm) return kUp;
  return kLeft;
}

void solve_limb(const Skeleton& skeleton, const Limb& limb, const LimbTarget& target, Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 root = world.position[index(limb.root)];
  const Vec3 upper_offset = skeleton.offset[index(limb.middle)];
  const float upper = glm::length(upper_offset);
  const float lower = glm::length(skeleton.offset[index(limb.end)]);

  // 1. How far to reach: not beyond the limb's length, not closer than its fullest flexion allows.
  const Vec3 toward = target.position - root;
  const float nearest = std::sqrt(std::max(
      0.0f, upper * upper + lower * lower - 2 * upper * lower * std::cos(kPi - kMostFlexion)));
  const float distance =
      std::max(softened(glm::length(toward), upper + lower, target.soft_share), nearest);
  const Vec3 direction =
      normalized_or(toward, world.rotation[index(limb.root)] * normalized_or(upper_offset, -kUp));

  // 2. Where the middle joint goes: in the plane of line and pole, by the law of cosines.
  Vec3 side = target.pole - direction * glm::dot(target.pole, direction);
  if (glm::length(side) < 1e-4f) {
    const Vec3 any = std::abs(direction.y) < 0.9f ? kUp : kForward;
    side = any - direction * glm::dot(any, direction);
  }
  side = glm::normalize(side);
  const float cosine = std::clamp(
      (upper * upper + distance * distance - lower * lower) / (2 * upper * distance), -1.0f, 1.0f);
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  const Vec3 bone = glm::normalize(direction * cosine + side * sine);

  // 3. The root joint's rotation: bone and hinge axis of the rest frame go to those of the world.
  const Vec3 hinge_rest = hinge_axis(limb);
  const Vec3 bone_rest = glm::normalize(upper_offset);
  const Vec3 pole_rest = glm::cross(bone_rest, hinge_rest);
  const Vec3 pole_world = glm::normalize(side - bone * glm::dot(side, bone));
  const Vec3 hinge_world = glm::cross(pole_world, bone);
  const glm::mat3 rest(bone_rest, hinge_rest, pole_rest);
  const glm::mat3 wanted(bone, hinge_world, pole_world);
  const Quat root_world = glm::normalize(glm::quat_cast(wanted * glm::transpose(rest)));

  // 4. The hinge's angle, and the end joint keeps its world rotation.
  const float interior = std::acos(std::clamp(
      (upper * upper + lower * lower - distance * distance) / (2 * upper * lower), -1.0f, 1.0f));
  const Quat flexed = glm::angleAxis(kPi - interior, hinge_rest);
  const Quat end_world = world.rotation[index(limb.end)];
  pose.rotation[index(limb.root)] =
      glm::normalize(glm::inverse(parent_rotation(world, limb.root)) * root_world);
  pose.rotation[index(limb.middle)] = flexed;
  pose.rotation[index(limb.end)] = glm::normalize(glm::inverse(root_world * flexed) * end_world);
}

void move_limb_end(const Skeleton& skeleton, const Limb& limb, Vec3 target, float soft_share,
                   Pose& pose, float straight) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 root = world.position[index(limb.root)], middle = world.position[index(limb.middle)],
             end = world.position[index(limb.end)];
  const float upper = glm::distance(root, middle), lower = glm::distance(middle, end);

  // 1. The plane the limb bends in; a nearly straight one bends in its hinge's.
  const Vec3 u = (middle - root) / upper, l = (end - middle) / lower;
  const Vec3 hinge = world.rotation[index(limb.root)] * hinge_axis(limb);
  const Vec3 across = glm::cross(u, l);
  const float sense = glm::dot(across, hinge) < 0 ? -1.0f : 1.0f;
  const Vec3 hinge_across = normalized_or(hinge - l * glm::dot(hinge, l), hinge);
  const float trust = std::min(1.0f, glm::length(across) / straight);
  const Vec3 axis = normalized_or(
      normalized_or(across, hinge) * (sense * trust) + hinge_across * (1 - trust), hinge_across);
  const float flexed = sense * std::atan2(glm::length(across), glm::dot(u, l));

  // 2. The flexion that gives the wanted reach, by the law of cosines.
  const float nearest =
      std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(kMostFlexion));
  const float reach =
      std::max(softened(glm::distance(root, target), upper + lower, soft_share), nearest);
  const float cosine = (reach * reach - upper * upper - lower * lower) / (2 * upper * lower);
  const float wanted = std::acos(std::clamp(cosine, -1.0f, 1.0f));
  const Quat bend = glm::angleAxis(wanted - flexed, axis);

  // 3. Then the limb turns to the target.
  const Vec3 bent = middle - root + bend * (end - middle);
  const Quat turn = rotation_between(bent, target - root);
  const Quat root_world = turn * world.rotation[index(limb.root)];
  const Quat middle_world = turn * bend * world.rotation[index(limb.middle)];
  pose.rotation[index(limb.root)] =
      glm::normalize(glm::inverse(parent_rotation(world, limb.root)) * root_world);
  pose.rotation[index(limb.middle)] = glm::normalize(glm::inverse(root_world) * middle_world);
  pose.rotation[index(limb.end)] =
      glm::normalize(glm::inverse(middle_world) * world.rotation[index(limb.end)]);
}

float reach_share(const Skeleton& skeleton, const Limb& limb, const WorldPose& world) {
  return glm::distance(world.position[index(limb.root)], world.position[index(limb.end)]) /
         (skeleton.bone(limb.middle) + skeleton.bone(limb.end));
}

void set_world_rotation(const Skeleton& skeleton, Joint joint, Quat rotation, Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  pose.rotation[index(joint)] =
      glm::normalize(glm::inverse(parent_rotation(world, joint)) * rotation);
}

Vec3 present_pole(const WorldPose& world, const Limb& limb, Vec3 fallback) {
  const Vec3 root = world.position[index(limb.root)];
  const Vec3 line = normalized_or(world.position[index(limb.end)] - root, -kUp);
  const Vec3 middle = world.position[index(limb.middle)] - root;
  const Vec3 pole = middle - line * glm::dot(middle, line);
  // A nearly straight limb's bend says little: lean on the fallback the straighter it is.
  const float trust = std::min(1.0f, glm::length(pole) / 0.03f);
  return normalized_or(
      normalized_or(pole, fallback) * trust + normalized_or(fallback, pole) * (1 - trust),
      fallback);
}

}  // namespace ringcraft
