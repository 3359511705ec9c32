#pragma once
// One hit on a test pose that stands still.

#include <vector>

#include "physics/impact.h"
#include "physics/stance.h"

namespace ringcraft::stance {

struct Hit {
  std::vector<Pose> continued;
  ImpactInput input;

  // `part` is struck at the middle of its capsule, moved by `offset` (world).
  Hit(const BodyModel& body, const Pose& pose, Part part, Vec3 impulse, Vec3 offset = {})
      : continued(kImpulseStepTicks + 1, pose) {
    const Capsule c = capsules(body, world_pose(body.skeleton, pose))[index(part)];
    input.pose = input.pose_before = pose;
    input.continued = continued;
    input.contacts = {true, true};
    input.blow.part = part;
    input.blow.point = (c.a + c.b) * .5f + offset;
    input.blow.impulse = impulse;
    input.blow.effective_mass = 3;
  }
  Hit(const Hit&) = delete;
  Hit& operator=(const Hit&) = delete;
};

inline ImpactOutcome outcome_of(const BodyModel& body, const Pose& pose, Part part, Vec3 impulse,
                                Vec3 offset = {}, float tone = 1) {
  Hit hit(body, pose, part, impulse, offset);
  hit.input.tone = tone;
  return impulse_step(body, hit.input);
}

// 0 absorb, 1..3 steps, 4 knockdown.
inline int severity(const ImpactOutcome& o) {
  if (o.response == ResponseKind::knockdown) return 4;
  return o.response == ResponseKind::recovery_steps ? o.steps : 0;
}

}  // namespace ringcraft::stance
