#pragma once
// Contact sheets of actions, for looking: one row an action, poses from the side and from the
// front.

#include <string>
#include <vector>

#include "motion/library.h"

namespace ringcraft {

struct FilmstripSettings {
  int poses = 10;  // across each row, spread evenly over the action
  float pixels_per_metre = 78;
  std::string only;  // only actions whose name contains it; empty for all
};

// SVG: left limbs blue, right limbs red, trunk grey, what is nearer drawn over what is farther.
// Upper strip: seen from the fighter's right, the opponent to the right. Lower strip: seen by the
// opponent, from a little to the side. Black bars under the floor line are planted feet; a red
// frame marks poses at which a strike can hit, a green one those at which a defense protects.
std::string filmstrip_svg(const Skeleton& skeleton, const std::vector<Action>& actions,
                          const FilmstripSettings& settings = {});
std::string filmstrip_svg(const MotionLibrary& library, const FilmstripSettings& settings = {});

}  // namespace ringcraft
