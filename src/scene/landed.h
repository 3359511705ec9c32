#pragma once
// A limb that has landed a blow goes no farther into what it struck.

#include "motion/decay.h"
#include "physics/contact.h"
#include "scene/keep_out.h"

namespace ringcraft {

// The plane, across the line of the blow, that the end of a striking limb does not pass: where it
// was at the contact. In the 12 ms of a blow the glove gives its momentum away; what the clip has
// left of the way, through an opponent who was not there at its capture, is not gone. Its clip
// takes it along again as it comes back, gradually: a limb that waited for it would be snatched
// away. Where the clip stays beyond, as a kick that steps through does, the limb goes there all the
// same, between 0.15 and 0.4 s after the blow.
class LandedLimb {
 public:
  LandedLimb() = default;
  // `limb`: which one struck. `before` and `after`: the attacker's shown poses around the contact,
  // world.
  LandedLimb(const BodyModel& body, const Limb& limb, const Pose& before, const Pose& after,
             const Contact& contact);

  void step();  // one tick
  // The offset, m, that keeps the end there, or what is left of it once the limb is free.
  Vec3 hold_back(Vec3 end);
  bool holds() const { return age_ >= 0; }
  void let_go();  // it carries: what is left of the offset goes

 private:
  Vec3 line_{};        // of the blow, a unit vector
  float most_ = 0;     // m along the line from the origin
  float deepest_ = 0;  // m beyond it that the clip was, up to kGradual
  float past_ = 0;     // m beyond it that the clip was last
  Vec3 offset_{};      // that was last
  Tick age_ = -1;      // since the contact; below 0: holds nothing
  Decay left_;
};

}  // namespace ringcraft
