#pragma once
// The anatomical shapes of a fighter in the T-pose, grown from height, mass and sex.

#include <vector>

#include "io/distance_field.h"
#include "io/mannequin.h"

namespace ringcraft {

// Widths and lengths of one body. Lengths in the shapes are given for the canonical height.
struct Build {
  WorldPose rest;   // joints in the T-pose, m
  float scale = 1;  // height over the canonical height
  float girth = 1;  // thickness of trunk and limbs over that of the reference body
  float belly = 0;  // m: how far a heavy body's belly stands out
  bool female = false;
};
Build build_of(const BodyModel& body);

DistanceField skin_field(const Build& build);
DistanceField shorts_field(const Build& build);
DistanceField waistband_field(const Build& build);
DistanceField top_field(const Build& build);  // a woman's sports top; empty for a man
DistanceField glove_field(const Build& build);
DistanceField cuff_field(const Build& build);
DistanceField anklet_field(const Build& build);
DistanceField hair_field(const Build& build);
// Brows, lashes and the line between the lips, laid on the face of `skin`.
DistanceField line_field(const Build& build, const DistanceField& skin);

// Centre and radius of the left eye's ball, m.
struct Eye {
  Vec3 center{};
  float radius = 0;
};
Eye eye_of(const Build& build, const DistanceField& skin);

}  // namespace ringcraft
