#pragma once
// The critically damped spring that whatever follows softly hangs on.

#include <cmath>

#include "base/ticks.h"

namespace ringcraft {

// One tick on, exactly: what is `off` its rest, m, at a `velocity`, m/s, comes back at a `rate`,
// 1/s, as fast as it can without going past.
template <class T>
void settle(T& off, T& velocity, float rate) {
  const T slope = velocity + off * rate;
  const float fade = std::exp(-rate * kTickSeconds);
  off = (off + slope * kTickSeconds) * fade;
  velocity = slope * fade - off * rate;
}

}  // namespace ringcraft
