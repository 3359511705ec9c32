#pragma once
// The cones of the ragdoll's ball joints.

#include "physics/body.h"

namespace ringcraft {

// A joint's cone, a little inside the ranges of limits.cpp: its middle (child in parent) and its
// spans about the frame's y and z and the twist about x, the limb's axis. The middle of the human
// range is the cone's middle, or a symmetric cone cannot hold a range like 120/20 degrees.
struct Cone {
  Quat middle;
  Vec3 axis{};    // the limb's axis in the child's rest frame: the cone frame's x
  Vec3 across{};  // the cone frame's y: flexion turns about it
  float flexion = 0, side = 0, twist = 0;  // half spans, rad
};

// Of the joint between a part and its parent; hinges have none.
Cone cone_of(Part part);

// A limit lies at least this far beyond the start pose.
inline constexpr float kWidening = radians(5);

// The cone widened so that `relative` (child in parent) lies inside it.
Cone widened(Cone cone, Quat relative);

}  // namespace ringcraft
