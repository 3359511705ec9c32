#pragma once
// Feet that stand when a blow lands stay where they are: the engine's soles creep under a body that
// is struck (docs/sources.md, R7).

#include <array>

#include "physics/impact_frame.h"

namespace ringcraft {

class StandingFeet {
 public:
  StandingFeet(const BodyModel& body, const ImpactFrame& frame);

  // Puts the feet of the next simulated pose, one tick later, back to where they stood, by their
  // legs. One that is swept, or that its leg cannot hold inside of its ranges, comes off the
  // floor and goes along, one that is lifted comes back to the simulated place.
  void hold(Pose& pose);

 private:
  struct Foot {
    void rise_to(float height);
    bool stands = false;
    Vec3 off{};                  // m over the ground: where it is shown from where it is simulated
    float down = 1;              // of its height over the floor, how much it is kept down
    Vec3 ball{};                 // simulated, one tick ago
    float rise = 0, rising = 0;  // m, m/s: above where it is simulated, while it is dragged
    float reach = 0;  // how straight the leg was when the blow landed, as a share of its length
  };
  const BodyModel& body_;
  std::array<Foot, 2> feet_;
};

}  // namespace ringcraft
