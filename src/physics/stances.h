#pragma once
// Stances made by inverse kinematics, for what is measured on a body without a library: those of
// the tables of docs/sources.md, R.

#include "physics/body.h"

namespace ringcraft {

// Feet 22 cm apart, the centre of mass 5 cm before the ankles, hands in guard; faces +Z.
Pose square_stance(const BodyModel& body);

// 45 cm of stagger, 24 cm wide, lead (left) foot turned 15 degrees in, rear 50 out, pelvis yawed 30
// and 8 cm lower: orthodox, faces +Z.
Pose fighting_stance(const BodyModel& body);

}  // namespace ringcraft
