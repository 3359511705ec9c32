#include "scene/study_slowed.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ringcraft {
namespace {

constexpr float kBeforeBlow = 2, kRamp = 3;  // ticks of the source

// Source ticks per shown tick at source time `t`: 1 around a blow, 1 / factor elsewhere.
float rate_at(const Action& action, float factor, float t) {
  float away = kRamp;  // ticks to the nearest window in which time runs as it did
  for (const Strike& strike : action.strikes) {
    const float begin = static_cast<float>(strike.active_begin) - kBeforeBlow;
    const auto end = static_cast<float>(strike.active_end);
    away = std::min(away, std::max({begin - t, t - end, 0.0f}));
  }
  const float share = away / kRamp;
  return 1 / (1 + (factor - 1) * share);
}

}  // namespace

Action slowed(const Action& action, float factor) {
  const auto length = static_cast<float>(action.length());
  std::vector<float> times{0};  // source time of each shown tick
  while (times.back() < length) {
    const float rate = rate_at(action, factor, times.back());
    const float next =
        rate < 1 ? times.back() + rate : std::floor(times.back()) + 1;  // its own poses
    times.push_back(std::min(length, next));
  }
  if (times.size() < 2) return action;
  Action out = action;
  out.clip = retimed(action.clip, times);
  const auto shown = [&](Tick source) {  // the first shown tick at or after a source tick
    const auto at = std::lower_bound(times.begin(), times.end(), static_cast<float>(source));
    return static_cast<Tick>(at - times.begin());
  };
  for (Strike& strike : out.strikes) {
    strike.active_begin = shown(strike.active_begin);
    strike.active_end = shown(strike.active_end);
  }
  if (out.defense) {
    out.defense->begin = shown(out.defense->begin);
    out.defense->end = shown(out.defense->end);
  }
  return out;
}

MotionLibrary slowed_library(const MotionLibrary& library, float factor) {
  std::vector<Action> actions;
  actions.reserve(library.actions().size());
  for (const Action& action : library.actions()) {
    actions.push_back(action.forced() ? action : slowed(action, factor));
  }
  return MotionLibrary(fmt::format("{} x {:.1f}", library.name(), factor), std::move(actions));
}

double share_longer(const MotionLibrary& library, double length_s) {
  const auto& all = library.launchable();
  const auto longer = std::count_if(all.begin(), all.end(), [&](ActionId id) {
    return seconds(library.action(id).length()) > length_s;
  });
  return all.empty() ? 0 : static_cast<double>(longer) / static_cast<double>(all.size());
}

double mean_choice_seconds(const MotionLibrary& library) {
  double sum = 0;
  for (const ActionId id : library.launchable()) sum += seconds(library.action(id).length());
  return library.launchable().empty() ? 0 : sum / static_cast<double>(library.launchable().size());
}

}  // namespace ringcraft
