#include "motion/joint_turns.h"

#include <algorithm>
#include <cmath>

#include "motion/ik.h"

namespace ringcraft {
namespace {

Quat as_left(Side side, Quat q) {
  return side == Side::left ? q : Quat(q.w, q.x, -q.y, -q.z);
}

// Turns a thigh onto the line from hip to ankle.
Quat onto_line(const Skeleton& skeleton, const Limb& limb, const Pose& pose) {
  const float upper = skeleton.bone(limb.middle), lower = skeleton.bone(limb.end);
  const float bent = flexion(skeleton, limb, pose.rotation[index(limb.middle)]);
  return glm::angleAxis(std::atan2(lower * std::sin(bent), upper + lower * std::cos(bent)),
                        hinge_axis(limb));
}

}  // namespace

bool is_leg(const Limb& limb) {
  return limb.root == leg(Side::left).root || limb.root == leg(Side::right).root;
}

// The humerus: forward, out and down. The thigh: 45 degrees of flexion and 7 of abduction.
BallJoint ball_joint(const Limb& limb) {
  if (is_leg(limb)) {
    return {glm::angleAxis(radians(7), kForward) * glm::angleAxis(radians(-45), kLeft), kUp};
  }
  return {rotation_between(kLeft, Vec3{.55f, -.35f, .75f}), kLeft};
}

// The turn along the limb's axis, the swing across it.
Vec3 ball_turns(const BallJoint& joint, Side side, Quat rotation) {
  const Quat q = glm::conjugate(joint.middle) * as_left(side, rotation);
  const float turn = wrapped_angle(2 * std::atan2(glm::dot({q.x, q.y, q.z}, joint.along), q.w));
  const Vec3 swing = rotation_vector(q * glm::conjugate(glm::angleAxis(turn, joint.along)));
  return swing + joint.along * (turn - glm::dot(swing, joint.along));
}

Quat ball_rotation(const BallJoint& joint, Side side, Vec3 turns) {
  const float turn = glm::dot(turns, joint.along);
  const Quat swing = from_rotation_vector(turns - joint.along * turn);
  return as_left(side, glm::normalize(joint.middle * swing * glm::angleAxis(turn, joint.along)));
}

Quat mix_root(Side side, const Limb& limb, Quat a, Quat b, float share) {
  const BallJoint joint = ball_joint(limb);
  return ball_rotation(joint, side,
                       glm::mix(ball_turns(joint, side, a), ball_turns(joint, side, b), share));
}

float flexion(const Skeleton& skeleton, const Limb& limb, Quat rotation) {
  const Vec3 rest = skeleton.offset[index(limb.end)], bone = rotation * rest;
  return std::atan2(glm::dot(glm::cross(rest, bone), hinge_axis(limb)), glm::dot(rest, bone));
}

float reach_of(const Skeleton& skeleton, const Limb& limb, float flexion) {
  const float upper = skeleton.bone(limb.middle), lower = skeleton.bone(limb.end);
  return std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(flexion));
}

float flexion_for(const Skeleton& skeleton, const Limb& limb, float reach) {
  const float upper = skeleton.bone(limb.middle), lower = skeleton.bone(limb.end);
  const float cosine = (reach * reach - upper * upper - lower * lower) / (2 * upper * lower);
  return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

Vec3 root_turns(const Skeleton& skeleton, Side side, const Limb& limb, const Pose& pose) {
  Quat root = pose.rotation[index(limb.root)];
  if (is_leg(limb)) root = root * onto_line(skeleton, limb, pose);
  return ball_turns(ball_joint(limb), side, root);
}

void set_root_turns(const Skeleton& skeleton, Side side, const Limb& limb, Vec3 turns, Pose& pose) {
  Quat root = ball_rotation(ball_joint(limb), side, turns);
  if (is_leg(limb)) root = root * glm::conjugate(onto_line(skeleton, limb, pose));
  pose.rotation[index(limb.root)] = glm::normalize(root);
}

float slowed(float angle, const Free& free, float from, float most) {
  constexpr float kLeastRoom = radians(4);
  const float fading =
      glm::mix(std::max(free.seam, from), from, glm::smoothstep(0.0f, 1.0f, free.gone));
  const float start = std::max(free.own, fading);
  if (angle <= start) return angle;
  const float room = std::max(most - start, kLeastRoom);
  return start + room * (1 - std::exp((start - angle) / room));
}

Vec3 shoulder_slowed(const BallJoint& joint, Vec3 turns, Vec3 own, Vec3 seam, float gone) {
  const auto turn = [&](Vec3 v) { return glm::dot(v, joint.along); };
  const auto swing = [&](Vec3 v) { return v - joint.along * turn(v); };
  const float far = glm::length(swing(turns));
  const Free cone{glm::length(swing(own)), glm::length(swing(seam)), gone};
  const float kept = slowed(far, cone, radians(95), radians(117));
  float about = turn(turns);
  about = slowed(about, {turn(own), turn(seam), gone}, radians(85), radians(120));
  about = -slowed(-about, {-turn(own), -turn(seam), gone}, radians(85), radians(120));
  return swing(turns) * (kept < far ? kept / far : 1.0f) + joint.along * about;
}

}  // namespace ringcraft
