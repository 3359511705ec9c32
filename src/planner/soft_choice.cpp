#include "planner/soft_choice.h"

#include <cmath>

#include "base/random.h"
#include "planner/evaluation.h"

namespace ringcraft {
namespace {

constexpr double kLeast = -1.5;  // temperatures

double gumbel_below(double x) {
  return std::exp(-std::exp(-x));
}

}  // namespace

std::int32_t SoftChoice::operator()(std::uint32_t move) const {
  if (temperature_ <= 0) return 0;
  static const double low = gumbel_below(kLeast), high = gumbel_below(kLeast + kMostBelow);
  Random random(seed_, move);
  const double share = low + static_cast<double>(random.uniform()) * (high - low);
  return thousandths(-std::log(-std::log(share)) * temperature_);
}

}  // namespace ringcraft
