#pragma once
// Trials: the ragdoll of an impulse step simulated on, to see what the decision foretold. For
// studies and tests; a fight never waits for one.

#include <optional>

#include "physics/impact.h"

namespace ringcraft {

struct Standing {
  bool fell = false;  // the centre of mass sank below 75 % of its height at the start
};

// The body holds its balance over the feet that it stands on, without a step.
Standing simulate_standing(const BodyModel& body, const ImpactInput& input, float seconds = 2.5f);

// The centre of mass's change of velocity after the blow, without ground, gravity and muscles, m/s.
Vec3 change_in_free_flight(const BodyModel& body, const ImpactInput& input);

// Where every part is 100 ms after the blow, at a step of the
// simulation of `step` s, m.
std::array<Vec3, kPartCount> parts_after(const BodyModel& body, const ImpactInput& input,
                                         float step);

// A bare loop of the engine: the same ragdoll set up, with every constraint row, and 24 steps.
// Returns the height of its centre of mass, m.
float bare_loop(const BodyModel& body, const ImpactInput& input);

}  // namespace ringcraft
