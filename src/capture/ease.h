#pragma once
// Limits that are approached without a corner.

namespace ringcraft {

// At least `least`, without a corner: equals `value` from `least + ease` on, `least` up to
// `least - ease`.
inline float eased_up(float value, float least, float ease) {
  const float room = value - least;
  if (room >= ease) return value;
  if (room <= -ease) return least;
  return least + (room + ease) * (room + ease) / (4 * ease);
}

}  // namespace ringcraft
