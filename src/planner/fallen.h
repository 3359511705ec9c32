#pragma once
// A body that lies where others fight, as an obstacle on the ground.

#include <array>
#include <span>

#include "planner/motion_tables.h"

namespace ringcraft {

class Fallen {
 public:
  // As it lies when its fall is over.
  explicit Fallen(const InFlight& fall);

  // m: from the point to the line from its head to its hips and on to its feet.
  float distance(float x, float z) const;
  // m: how much that lacks of kOverlapDistance.
  double overlap(float x, float z) const;

 private:
  struct Line {
    Vec2 from{}, way{};
    float length2 = 0;
  };
  std::array<Line, 5> lines_;  // trunk, thighs, shins
  Vec2 middle_{};
  float radius_ = 0;  // m: of a circle around them
};

// The same of several together.
double overlap(std::span<const Fallen> fallen, float x, float z);

}  // namespace ringcraft
