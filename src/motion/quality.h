#pragma once
// Measures of what people see in a motion.

#include <array>
#include <span>
#include <vector>

#include "motion/pose.h"

namespace ringcraft {

// Paths of one foot, m, +Y up, one entry a frame.
struct FootPath {
  std::vector<Vec3> ankle, toes;
};

struct FootSkateSettings {
  float height = 0.03f;    // m over its own standing height within which ankle and toes are low
  float slowest = 0.15f;   // m/s over the ground: slower is standing
  float fastest = 0.8f;    // m/s: faster is a step
  float shortest = 0.15f;  // s on end
  float hips_up = 0.8f;    // share of the hips' usual height under which nobody stands
};

// Foot skate: the share of all time of both feet in which a foot slides. A foot slides when ankle
// and toes both lie within 3 cm of their own standing height (the 5 % quantile while the hips are
// up) and the slower of the two moves over the ground at 0.15 to 0.8 m/s, for at least 0.15 s on
// end. The common measure (a foot under 5 cm faster than 0.5 m/s) calls a boxer's shuffle a skate;
// this one counts what the eye calls sliding. Frames are taken at about 60 Hz whatever
// `frames_per_second` is.
double foot_skate_ratio(const std::array<FootPath, 2>& feet, std::span<const float> hips_height,
                        double frames_per_second, const FootSkateSettings& settings = {});
double foot_skate_ratio(const Skeleton& skeleton, std::span<const Pose> frames,
                        double frames_per_second, const FootSkateSettings& settings = {});

}  // namespace ringcraft
