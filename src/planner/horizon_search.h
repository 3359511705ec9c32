#pragma once
// How far a decision looks ahead: a short horizon first, then farther as the limits allow.

#include "planner/duel.h"
#include "planner/root_search.h"
#include "planner/soft_choice.h"

namespace ringcraft {

using Roots = std::vector<RootMove<Duel>>;

struct Searched {
  Roots roots;       // the chosen first; empty where nothing can follow
  Tick horizon = 0;  // ticks looked ahead
  DuelCounts root_counts;
  SearchCounts counts;  // of the horizon that was finished
};

inline constexpr Tick kLongestHorizon = 10 * kTicksPerSecond;
inline constexpr Tick kFirstHorizon = 90;  // 0.75 s
inline constexpr Tick kHorizonStep = 30;   // 0.25 s

// The decision of side 0 of `setup` at state.now, to its style's horizon or as far as the node
// limit of the settings and `limits` carry.
Searched search_ahead(const DuelSetup& setup, const FightState& state, const SoftChoice& preference,
                      const PlanLimits& limits, SearchPool<Duel>& pool);

}  // namespace ringcraft
