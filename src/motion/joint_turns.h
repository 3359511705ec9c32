#pragma once
// Joints of limbs by the numbers in which their ranges are told: shoulders and hips by swing and
// turn, knees and elbows by flexion.

#include "motion/pose.h"

namespace ringcraft {

// A ball joint about the middle of its range: its swing across the limb, and its turn about it.
// What lies between two turns inside the joint's range is inside it in these numbers, which is not
// so along the shortest turn.
struct BallJoint {
  Quat middle;
  Vec3 along;  // the limb, at the joint's middle: a unit axis
};
BallJoint ball_joint(const Limb& limb);
Vec3 ball_turns(const BallJoint& joint, Side side, Quat rotation);  // rotation vector, rad
Quat ball_rotation(const BallJoint& joint, Side side, Vec3 turns);

// Between two turns of a limb's root, inside its range where both are; share 0 is a.
Quat mix_root(Side side, const Limb& limb, Quat a, Quat b, float share);

// Flexion of a limb's middle joint, rad, about its hinge; negative where it is bent backwards.
float flexion(const Skeleton& skeleton, const Limb& limb, Quat rotation);

// How far, m, a limb reaches that is bent so, and the flexion, rad, with which it reaches so far.
float reach_of(const Skeleton& skeleton, const Limb& limb, float flexion);
float flexion_for(const Skeleton& skeleton, const Limb& limb, float reach);

// The turns of a humerus, or of the line from hip to ankle: the thigh of a leg that is nearly
// straight goes far where its foot goes little.
bool is_leg(const Limb& limb);
Vec3 root_turns(const Skeleton& skeleton, Side side, const Limb& limb, const Pose& pose);
// Turns the limb's root so; its middle joint is bent already.
void set_root_turns(const Skeleton& skeleton, Side side, const Limb& limb, Vec3 turns, Pose& pose);

// What lets a joint go on freely: what its clip has, and, fading, what the seam had.
struct Free {
  float own, seam;  // rad; of a leg's reach m
  float gone;       // of the blend, 0 .. 1
};

// An angle, or a reach, that comes near to `most`, slower and slower from `from` on.
float slowed(float angle, const Free& free, float from, float most);

// A humerus inside its cone and its turn (limits.cpp of physics), which it comes near to slowly.
Vec3 shoulder_slowed(const BallJoint& joint, Vec3 turns, Vec3 own, Vec3 seam, float gone);

}  // namespace ringcraft
