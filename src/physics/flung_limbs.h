#pragma once
// Limbs that were flung, and a leg that kicks, are caught: what still flew where the clip takes
// over would have to stop or turn round in a frame.

#include "physics/impact_frame.h"

namespace ringcraft {

class FlungLimbs {
 public:
  FlungLimbs(const BodyModel& body, const ImpactFrame& frame);

  // Lets the hips, the arms, and the legs that did not stand when the blow landed, turn no faster
  // in the next pose, one tick later and `seconds` after the blow, than a body that catches itself
  // does.
  void slow(float seconds, Pose& pose);

 private:
  void slow_hips(float most, Pose& pose) const;
  void slow_end(Side side, const Limb& limb, float caught, Pose& pose) const;

  const BodyModel& body_;
  FootContacts stood_;
  Pose last_;
};

}  // namespace ringcraft
