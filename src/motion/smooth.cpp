#include "motion/smooth.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"

namespace ringcraft {
namespace {

// Weights at 0, 1, 2 ... ticks, out to three sigma.
std::vector<float> gaussian(float sigma) {
  const float width = sigma * static_cast<float>(kTicksPerSecond);
  const auto reach = static_cast<int>(std::ceil(3 * width));
  std::vector<float> kernel;
  for (int k = 0; k <= reach; ++k) {
    const float x = static_cast<float>(k) / std::max(width, 1e-6f);
    kernel.push_back(std::exp(-0.5f * x * x));
  }
  return kernel;
}

template <class T>
std::vector<T> gaussian_mean(const std::vector<T>& values, float sigma) {
  const std::vector<float> kernel = gaussian(sigma);
  const auto reach = static_cast<long>(kernel.size()) - 1;
  const auto last = static_cast<long>(values.size()) - 1;
  std::vector<T> out(values.size());
  for (long i = 0; i <= last; ++i) {
    T sum = values[static_cast<std::size_t>(i)] * 0.0f;
    float total = 0;
    // The same reach on both sides, so that the ends keep their values and a ramp stays a ramp.
    const long side = std::min({reach, i, last - i});
    for (long k = -side; k <= side; ++k) {
      const float w = kernel[static_cast<std::size_t>(std::abs(k))];
      sum += values[static_cast<std::size_t>(i + k)] * w;
      total += w;
    }
    out[static_cast<std::size_t>(i)] = sum / total;
  }
  return out;
}

}  // namespace

std::vector<float> smoothed(const std::vector<float>& values, const std::vector<float>& weights,
                            float sigma) {
  const std::vector<float> kernel = gaussian(sigma);
  const auto reach = static_cast<long>(kernel.size()) - 1;
  const auto count = static_cast<long>(values.size());
  std::vector<float> out(values.size(), 0.0f);
  std::vector<long> known;
  for (long i = 0; i < count; ++i) {
    float sum = 0;
    float total = 0;
    for (long k = std::max(0l, i - reach); k <= std::min(count - 1, i + reach); ++k) {
      const float w =
          kernel[static_cast<std::size_t>(std::abs(k - i))] * weights[static_cast<std::size_t>(k)];
      sum += w * values[static_cast<std::size_t>(k)];
      total += w;
    }
    if (total < 1e-3f) continue;
    out[static_cast<std::size_t>(i)] = sum / total;
    known.push_back(i);
  }
  for (std::size_t k = 0; k < known.size(); ++k) {
    const long from = known[k];
    const long to = k + 1 < known.size() ? known[k + 1] : count;
    for (long i = from + 1; i < to; ++i) {
      const float share =
          to == count ? 0.0f : static_cast<float>(i - from) / static_cast<float>(to - from);
      const float end = to == count ? 0.0f : out[static_cast<std::size_t>(to)];
      out[static_cast<std::size_t>(i)] =
          out[static_cast<std::size_t>(from)] * (1 - share) + end * share;
    }
  }
  if (!known.empty())
    for (long i = 0; i < known.front(); ++i)
      out[static_cast<std::size_t>(i)] = out[static_cast<std::size_t>(known.front())];
  return out;
}

std::vector<float> smoothed(const std::vector<float>& values, float sigma) {
  return gaussian_mean(values, sigma);
}
std::vector<Vec3> smoothed(const std::vector<Vec3>& values, float sigma) {
  return gaussian_mean(values, sigma);
}

std::vector<float> widened(const std::vector<float>& needs, std::size_t around) {
  const std::size_t count = needs.size();
  std::vector<float> out(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i >= around ? i - around : 0; k <= std::min(count - 1, i + around); ++k)
      if (std::abs(needs[k]) > std::abs(out[i])) out[i] = needs[k];
  return out;
}

std::vector<float> unwrapped(std::vector<float> angles) {
  for (std::size_t i = 1; i < angles.size(); ++i)
    angles[i] = angles[i - 1] + wrapped_angle(angles[i] - angles[i - 1]);
  return angles;
}

void close_short_runs(std::vector<bool>& flags, bool value, std::size_t ticks) {
  std::size_t begin = 0;
  while (begin < flags.size()) {
    std::size_t end = begin;
    while (end < flags.size() && flags[end] == flags[begin]) ++end;
    const bool inner = begin > 0 && end < flags.size();
    if (flags[begin] == value && inner && end - begin < ticks)
      std::fill(flags.begin() + static_cast<std::ptrdiff_t>(begin),
                flags.begin() + static_cast<std::ptrdiff_t>(end), !value);
    begin = end;
  }
}

}  // namespace ringcraft
