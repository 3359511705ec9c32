#include "capture/sheet_body.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

namespace {

constexpr float kMostGirdle = radians(20);  // of the shoulder blade
constexpr float kMostNeck = radians(75);    // head against chest
constexpr float kHandLength = 0.17f;        // m, wrist to finger tips
constexpr float kHandThickness = 0.02f;     // m, half of it

constexpr Side side_at(std::size_t i) {
  return i == 0 ? Side::left : Side::right;
}

Quat part_of(Quat rotation, float share) {
  return from_rotation_vector(rotation_vector(rotation) * share);
}

float eased(float from, float to, float x) {
  const float u = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return u * u * (3 - 2 * u);
}

Quat foot_rotation(const FootTarget& foot) {
  return yaw_rotation(foot.yaw) * glm::angleAxis(foot.heel, kLeft);
}

// The shoulder blade follows a far-reaching hand: forward with a straight, up with a raised arm.
void turn_girdle(const Skeleton& skeleton, Side side, Vec3 wrist, Pose& pose) {
  const Joint girdle = side == Side::left ? Joint::left_shoulder : Joint::right_shoulder;
  const WorldPose world = world_pose(skeleton, pose);
  const Quat chest = world.rotation[index(Joint::upper_chest)];
  const Vec3 from = world.position[index(girdle)];
  const Vec3 shoulder = world.position[index(arm(side).root)];
  const float reach = glm::distance(wrist, shoulder) / skeleton.arm_length();
  const Vec3 toward = glm::inverse(chest) * (wrist - from);
  const Vec3 rest = skeleton.offset[index(arm(side).root)];
  Vec3 turn = rotation_vector(rotation_between(rest, toward));
  const float angle = glm::length(turn);
  if (angle < 1e-5f) return;
  const float wanted = std::min(angle * 0.3f, kMostGirdle) * eased(0.45f, 1.0f, reach);
  pose.rotation[index(girdle)] = from_rotation_vector(turn * (wanted / angle));
}

// A hand that would reach through the floor bends back at the wrist and lies on it.
void lay_on_floor(const Skeleton& skeleton, Side side, Pose& pose) {
  const Limb limb = arm(side);
  const WorldPose world = world_pose(skeleton, pose);
  const Quat hand = world.rotation[index(limb.end)];
  const Vec3 along = hand * normalized_or(skeleton.offset[index(limb.end)], kLeft);
  const float wrist = world.position[index(limb.end)].y;
  const float least = std::clamp((kHandThickness - wrist) / kHandLength, -1.0f, 0.9f);
  if (along.y >= least) return;
  const Vec3 chest = world.rotation[index(Joint::upper_chest)] * kForward;
  const Vec3 flat =
      normalized_or(Vec3(along.x + 0.15f * chest.x, 0, along.z + 0.15f * chest.z), kForward);
  const Vec3 lifted = flat * std::sqrt(1 - least * least) + kUp * least;
  const Quat turned = rotation_between(along, lifted) * hand;
  pose.rotation[index(limb.end)] =
      glm::normalize(glm::inverse(world.rotation[index(limb.middle)]) * turned);
}

void set_arm(const Skeleton& skeleton, Side side, const ArmTarget& target, Pose& pose) {
  turn_girdle(skeleton, side, target.wrist, pose);
  const Limb limb = arm(side);
  solve_limb(skeleton, limb, {target.wrist, target.pole, 0.985f}, pose);
  // Either thumb turns inward about the body's left, which the rest pose's forearms lie along.
  pose.rotation[index(limb.end)] = glm::angleAxis(target.palm, kLeft);
  lay_on_floor(skeleton, side, pose);
}

void set_leg(const Skeleton& skeleton, Side side, const FootTarget& foot, Quat pelvis, Pose& pose) {
  const Limb limb = leg(side);
  const Vec3 pelvis_forward = pelvis * kForward;
  Vec3 pole = foot.knee_pole;
  if (glm::length(pole) < 1e-4f) {
    pole =
        normalized_or(pelvis_forward, kForward) * 0.5f + yaw_rotation(foot.yaw) * kForward * 0.5f;
  }
  const bool set = foot.freedom <= 0;
  solve_limb(skeleton, limb, {ankle_of(skeleton, foot), pole, set ? 1.0f : 0.99f}, pose);
  const WorldPose world = world_pose(skeleton, pose);
  const Quat shin = world.rotation[index(limb.middle)];
  const Quat standing = foot_rotation(foot);
  const Quat hanging = shin * glm::angleAxis(foot.point, kLeft);
  const Quat wanted = glm::slerp(standing, in_hemisphere_of(hanging, standing),
                                 std::clamp(foot.freedom, 0.0f, 1.0f));
  pose.rotation[index(limb.end)] = glm::normalize(glm::inverse(shin) * wanted);
  // The toes of a foot on its ball lie flat.
  const float flat = -foot.heel * (1 - std::clamp(foot.freedom, 0.0f, 1.0f));
  pose.rotation[index(toes(side))] = glm::angleAxis(flat, kLeft);
}

}  // namespace

Quat leaning(float forward, float left, float yaw) {
  return from_rotation_vector({forward, 0, -left}) * yaw_rotation(yaw);
}

Vec3 ankle_of(const Skeleton& skeleton, const FootTarget& foot) {
  const Vec3 set = foot.ball - foot_rotation(foot) * skeleton.offset[index(Joint::left_toes)];
  return foot.freedom <= 0 ? set : set + (foot.ankle - set) * std::min(1.0f, foot.freedom);
}

Pose torso_pose(const Skeleton& skeleton, const BodyTargets& targets) {
  Pose pose = rest_pose(skeleton);
  pose.hips = targets.pelvis;
  pose.rotation[index(Joint::hips)] = targets.pelvis_rotation;
  const Quat twist = glm::inverse(targets.pelvis_rotation) * targets.chest_rotation;
  pose.rotation[index(Joint::spine)] = part_of(twist, 0.30f);
  pose.rotation[index(Joint::chest)] = part_of(twist, 0.36f);
  pose.rotation[index(Joint::upper_chest)] = part_of(twist, 0.34f);
  Vec3 look = rotation_vector(glm::inverse(targets.chest_rotation) * targets.head_rotation);
  const float angle = glm::length(look);
  if (angle > kMostNeck) look *= kMostNeck / angle;
  pose.rotation[index(Joint::neck)] = from_rotation_vector(look * 0.5f);
  pose.rotation[index(Joint::head)] = from_rotation_vector(look * 0.5f);
  return pose;
}

Pose body_pose(const Skeleton& skeleton, const BodyTargets& targets) {
  Pose pose = torso_pose(skeleton, targets);
  for (std::size_t i = 0; i < 2; ++i) {
    set_arm(skeleton, side_at(i), targets.arms[i], pose);
    set_leg(skeleton, side_at(i), targets.feet[i], targets.pelvis_rotation, pose);
  }
  return pose;
}

float missing_reach(const Skeleton& skeleton, const BodyTargets& targets, float share) {
  float missing = 0;
  const float longest = share * skeleton.leg_length();
  for (std::size_t i = 0; i < 2; ++i) {
    const FootTarget& foot = targets.feet[i];
    if (foot.freedom > 0) continue;
    const Vec3 hip =
        targets.pelvis + targets.pelvis_rotation * skeleton.offset[index(leg(side_at(i)).root)];
    const Vec3 ankle = ankle_of(skeleton, foot);
    const float across = glm::length(Vec2(hip.x - ankle.x, hip.z - ankle.z));
    const float most = std::sqrt(std::max(0.0f, longest * longest - across * across));
    missing = std::max(missing, hip.y - ankle.y - most);
  }
  return missing;
}

}  // namespace ringcraft
