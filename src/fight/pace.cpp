#include "fight/pace.h"

#include <algorithm>

namespace ringcraft {
namespace {

constexpr float kEase = 24;         // ticks in which a pace goes over into the clip's
constexpr Tick kAfterLastBlow = 6;  // ticks for which a pace still holds after the last blow
constexpr float kSlowest = 0.5f, kFastest = 1.5f;

}  // namespace

Pace::Pace(const Action& action, float factor) : factor_(std::clamp(factor, kSlowest, kFastest)) {
  Tick until = action.length();
  if (!action.strikes.empty()) {
    until = 0;
    for (const Strike& strike : action.strikes) until = std::max(until, strike.active_end);
    until += kAfterLastBlow;
  }
  held_ = static_cast<float>(until) / factor_;
}

float Pace::age(Tick ticks) const {
  const auto t = static_cast<float>(ticks);
  if (factor_ == 1) return t;
  if (t <= held_) return factor_ * t;
  // The rate is factor + (1 - factor) smoothstep(x): its integral over x is x^3 - x^4 / 2.
  const float after = t - held_, x = std::min(1.0f, after / kEase);
  const float gained = kEase * (x * x * x - 0.5f * x * x * x * x) + std::max(0.0f, after - kEase);
  return factor_ * t + (1 - factor_) * gained;
}

Tick Pace::reached(Tick clip) const {
  if (factor_ == 1) return clip;
  Tick ticks = 0;
  while (age(ticks) < static_cast<float>(clip) - 1e-3f) ++ticks;
  return ticks;
}

}  // namespace ringcraft
