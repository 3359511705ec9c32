#pragma once
// Two-link inverse kinematics for arms and legs, in closed form.

#include "motion/pose.h"

namespace ringcraft {

struct LimbTarget {
  Vec3 position{};  // where the end joint (wrist, ankle) goes, m
  Vec3 pole{};      // direction the middle joint (elbow, knee) points, from the limb's line
  float soft_share = 0.985f;  // of the limb's length: beyond it the reach is eased, so that no
                              // joint pops when the target moves out of reach
};

// The axis about which a limb's middle joint flexes by a positive angle, in the rest pose: knees
// bend backwards, elbows forwards.
Vec3 hinge_axis(const Limb& limb);

// Turns the limb's root and middle joints so that its end reaches the target; the end joint keeps
// its world rotation. Targets out of reach are approached along the line. The middle joint bends
// about one axis only (x of the lower leg, y of the lower arm in the rest pose), as a hinge does.
void solve_limb(const Skeleton& skeleton, const Limb& limb, const LimbTarget& target, Pose& pose);

inline constexpr float kStraightSine = 0.05f;  // of the flexion of a nearly straight limb

// Moves the limb's end to `target` with as little change as that takes: the middle joint flexes in
// the plane it bends in, then the whole limb turns. A limb that is there already stays as it is,
// bends off the hinge's axis included; one that bends backwards is set right. The end joint keeps
// its world rotation. Beyond `soft_share` of the limb's length the reach is eased. The plane of a
// limb whose flexion has a sine below `straight` is more and more its hinge's: its own says little
// then, and turns fast.
void move_limb_end(const Skeleton& skeleton, const Limb& limb, Vec3 target, float soft_share,
                   Pose& pose, float straight = kStraightSine);

// How far a limb reaches, as a share of its length.
float reach_share(const Skeleton& skeleton, const Limb& limb, const WorldPose& world);

// Sets the world rotation of one joint.
void set_world_rotation(const Skeleton& skeleton, Joint joint, Quat rotation, Pose& pose);

// Pole direction that keeps the limb's present bend: from the root-end line to the middle joint. A
// straight limb answers with `fallback`.
Vec3 present_pole(const WorldPose& world, const Limb& limb, Vec3 fallback);

}  // namespace ringcraft
