#pragma once
// Legs that brake: a body that was on its way when a blow landed does not go on as if it had not.

#include "physics/impact_frame.h"

namespace ringcraft {

class Braking {
 public:
  Braking(const BodyModel& body, const ImpactFrame& frame);

  // Takes off, over one step of the ragdoll that begins `seconds` after the blow, some of what the
  // body had by itself over the ground, while a foot is on the floor. What goes the way of the blow
  // stays.
  void brake(Ragdoll& ragdoll, float seconds);

  // The same of a body that spins faster than fighters do by themselves: it stays on its feet, and
  // its limbs could not be held so.
  static void brake_spin(Ragdoll& ragdoll, float seconds);

 private:
  const BodyModel& body_;
  Vec3 left_{};  // m/s over the ground, to be taken off
};

}  // namespace ringcraft
