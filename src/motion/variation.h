#pragma once
// Small differences between repetitions of one action, and breath: what is shown of a clip.
//
// Captured repetitions of one technique by one boxer differ by 0.045-0.08 of standing height at
// the wrists, 0.045 at the head and 10 degrees of shoulder yaw. Shown are a quarter to a half of
// that: offsets that begin with the launch and drift under 1.3 Hz. Feet and pelvis are the clip's,
// a striking limb comes back to the clip while it can hit.

#include "motion/action.h"

namespace ringcraft {

class Variation {
 public:
  Variation() = default;  // none
  explicit Variation(std::uint64_t seed);

  // The pose of `action` at `age` ticks after its launch, varied; `tick` runs through the fight and
  // is the breath's. Placed in the world or not. Lying poses and a variation of none stay.
  Pose of(const Skeleton& skeleton, const Action& action, Pose pose, Tick age, Tick tick) const;

 private:
  struct Drift {  // one figure: a part that stays for the launch and a slow wave
    float fixed = 0, wave = 0, hz = 0, phase = 0;
    float at(float seconds) const;
  };
  std::array<Drift, 6> hands_;                   // left x y z, right x y z; of height
  Drift yaw_, forward_, sideways_, look_, nod_;  // rad
  float breath_hz_ = 0, breath_phase_ = 0;
};

}  // namespace ringcraft
