#pragma once
// The picture of a sweep: the map of what falls, steps or stands, as SVG.

#include "scene/hit_sweep.h"

namespace ringcraft {

// Direction and impulse: a map around the body seen from above, one a tone. Any other axes: a grid.
// What was not done stays empty.
std::string sweep_svg(const HitSweep& sweep);

}  // namespace ringcraft
