#pragma once
// A lead that turns a corner, and what follows it without one.

#include <cmath>

#include "base/ticks.h"
#include "motion/pose.h"
#include "motion/spring.h"

namespace ringcraft {

// T: float or Vec3, m. A lead may change its speed by so much, `acceleration`, m/s2, more than the
// clip's does. What is shown is left behind a faster change at that, and catches up as a critically
// damped spring of the `rate`, 1/s, lets it.
template <class T>
class Easing {
 public:
  Easing() = default;
  // Two ticks of what is shown, and of the clip's, up to now.
  Easing(T shown, T shown_before, T clip, T clip_before)
      : wanted_(shown), wanted_before_(shown_before), clip_(clip), clip_before_(clip_before) {}

  // One tick on.
  void follow(T wants, T clip_wants, float acceleration, float rate) {
    const float most =
        acceleration * kTickSeconds * kTickSeconds + size(clip_wants - 2.0f * clip_ + clip_before_);
    const T change = wants - 2.0f * wanted_ + wanted_before_;
    const float far = size(change);
    if (far > most) velocity_ -= change * ((1 - most / far) / kTickSeconds);
    settle(eased_, velocity_, rate);
    wanted_before_ = wanted_;
    wanted_ = wants;
    clip_before_ = clip_;
    clip_ = clip_wants;
  }

  // What is led is led `by` so much off where it was from now on, and so it is shown: no corner.
  void set_aside(T by) {
    wanted_ += by;
    wanted_before_ += by;
  }

  T wanted() const { return wanted_; }
  T eased() const { return eased_; }  // by how much it is shown off that

 private:
  static float size(float x) { return std::abs(x); }
  static float size(Vec3 v) { return glm::length(v); }

  T wanted_{}, wanted_before_{}, clip_{}, clip_before_{};
  T eased_{}, velocity_{};
};

}  // namespace ringcraft
