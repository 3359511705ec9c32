#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ringcraft {

// The value below which `share` (0..1) of the values lie, linear between neighbours; 0 of none.
template <class Number>
Number quantile(std::vector<Number> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] +
         (values[high] - values[low]) * static_cast<Number>(at - static_cast<double>(low));
}

template <class Number>
Number median(std::vector<Number> values) {
  return quantile(std::move(values), 0.5);
}

}  // namespace ringcraft
