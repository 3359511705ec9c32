#pragma once
// What each defense is good for against each kind of blow: the offense/defense table (Shum and
// Komura 2006, section 3.2) as candidates are weighed by it.

#include <cstddef>
#include <span>
#include <vector>

#include "planner/motion_tables.h"

namespace ringcraft {

class Protection {
 public:
  // From sparring of a library with itself, coarser than `ringcraft sparring`: a tenth of a second.
  explicit Protection(const MotionTables& tables);

  // By number of the action: the share, 0 .. 1, of the blows of this one's kind, zone and limb that
  // a defense answers at its best timing; 0 where it is none. Where no such blow lands on who only
  // stands, the mean over the others. `strike`: its number among those of the library
  // (ActionTable::first_strike).
  std::span<const float> against(std::size_t strike) const {
    return std::span(shares_).subspan(sort_[strike] * actions_, actions_);
  }

 private:
  std::size_t actions_ = 0;
  std::vector<std::size_t> sort_;  // of blow, by strike
  std::vector<float> shares_;      // by sort and action
};

}  // namespace ringcraft
