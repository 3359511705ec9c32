#pragma once
// Muscles: torque limits and stiffness of every joint (docs/sources.md, R1), scaled with the mass.
// Trunk and hips are a little stronger than there: with them 39 of the 40 impulses that a body just
// holds are within a quarter of the table in R3 (`ringcraft study hits --only balance`).

#include <array>

#include "physics/body.h"

namespace ringcraft {

struct Muscle {
  float torque = 0;                                 // N m: the most it can give at full tone
  float stiffness = 0;                              // N m/rad at full tone
  float damping() const { return stiffness / 10; }  // N m s/rad
};

// The muscle between a part and its parent; none for the pelvis.
Muscle muscle_of(const BodyModel& body, Part child);

// Share of full tone, 0 limp .. 1, of the joint that carries each part.
using Tone = std::array<float, kPartCount>;

Tone whole_body(float tone);

// Elbows and knees turn about one axis only.
bool is_hinge(Part child);

}  // namespace ringcraft
