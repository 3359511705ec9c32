#pragma once
// What a fight has done to a fighter: fatigue and injuries, and what they cost its actions (the
// paper's future work: "adjust such parameters ... according to fatigue, and injuries").

#include <array>
#include <optional>
#include <vector>

#include "motion/action.h"
#include "physics/body.h"
#include "planner/style.h"

namespace ringcraft {

inline constexpr std::size_t kLimbs = 4;  // left arm, right arm, left leg, right leg

// Index of the limb that a part belongs to, or nothing for the trunk and the head.
std::optional<std::size_t> limb_of(Part part);

// The speed at which actions are shown at a fatigue of 0 .. 1, share of the clip's; 0.85 at worst.
float pace_at(double fatigue);
// The tone of the muscles in an impulse step then, share of full; 0.65 at worst.
float tone_at(double fatigue);

// Constant inside a search; the fight changes it between decisions.
class Condition {
 public:
  // Fatigue 0 (fresh) .. 1 (the reserve is empty).
  double fatigue() const;
  // Injury of a limb 0 (sound) .. 1.
  double injury(std::size_t limb) const;
  const std::array<double, kLimbs>& injuries() const { return injury_; }

  // The reserve W' of critical power (Monod & Scherrer 1965): work above what a fighter can keep up
  // empties it, less than that fills it again. Called in order of time; `kinetic_J` is the work of
  // an action just launched.
  void rest(double seconds);
  void launched(const Style& style, double kinetic_J);
  // A hit or block: `damage` in points.
  void struck(const Style& style, Part part, double damage);

  float pace() const { return pace_at(fatigue()); }
  float tone() const { return tone_at(fatigue()); }

 private:
  double spent_J_ = 0;
  std::array<double, kLimbs> injury_{};
};

// The work that the muscles do on the body's own motion in an action, J: the sum of all rises of
// the parts' kinetic energy (of their centres of mass) over the poses, one a tick.
double kinetic_work(const BodyModel& body, const std::vector<Pose>& poses);

// What condition costs a launch, points: a tired fighter saves work, an injured one spares the limb
// that strikes, and in part the leg on which it kicks.
double condition_cost(const Condition& condition, const Style& style, const Action& action,
                      double kinetic_J);

}  // namespace ringcraft
