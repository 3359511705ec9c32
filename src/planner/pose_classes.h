#pragma once
// Pose classes: moments of actions in which a struck body would do the same. The impulse step is
// made for one moment of a class and holds for all of them.

#include <vector>

#include "planner/motion_tables.h"

namespace ringcraft {

// Two moments are alike where the joints, seen from the root, are on the average no farther apart,
// now and 100 ms on, and the same feet carry. m rms
inline constexpr float kAlike = 0.03f;

struct PoseMoment {
  ActionId action;
  Tick age = 0;
  bool operator==(const PoseMoment&) const = default;
};

class PoseClasses {
 public:
  // Moments lie `every` ticks apart. Each joins the nearest class that is alike, else begins one:
  // in order of action and age, so that the same tables give the same classes.
  PoseClasses(const MotionTables& tables, Tick every, float alike = kAlike);

  // The moment that stands for the one nearest below `age`.
  PoseMoment of(ActionId action, Tick age) const;
  std::size_t count() const { return count_; }
  std::size_t moments() const { return moments_; }

 private:
  Tick every_;
  std::size_t count_ = 0, moments_ = 0;
  std::vector<std::vector<PoseMoment>> stands_for_;  // by action and step
};

}  // namespace ringcraft
