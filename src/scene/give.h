#pragma once
// A guard that holds a blow gives way before it does: the arm that was met is driven back and
// springs into its motion again.

#include "motion/pose.h"
#include "physics/body.h"

namespace ringcraft {

// Where the end of an arm is, off its motion. Critically damped, as braced muscles are: it goes
// farthest after 1/25 s and comes back without swinging over.
class ArmGive {
 public:
  void drive(Vec3 velocity);               // m/s, on top of what it has; it goes 10 cm at most
  void step();                             // one tick
  Vec3 offset() const { return offset_; }  // m
  bool at_rest() const { return offset_ == Vec3{} && velocity_ == Vec3{}; }

 private:
  Vec3 offset_{}, velocity_{};
};

// As much of `offset`, m, as the glove of that arm can go before it meets the own head or trunk.
Vec3 short_of_the_body(const BodyModel& body, const Pose& pose, Side side, Vec3 offset);

// The side of an arm that guards; of a hand or a forearm only.
Side guarding_side(Part part);

}  // namespace ringcraft
