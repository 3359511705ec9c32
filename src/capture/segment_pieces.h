#pragma once
// Actions from what the finders measured: strikes and combinations, blocks, falls and get-ups, and
// what lies between them (idle, guard, steps, turns, slips, ducks, sways, staggers).

#include "capture/segment_measure.h"

namespace ringcraft {

struct Stretch {
  Tick first = 0, last = 0;
};

struct Found {
  const Measures& measures;
  const Guard& guard;
  const std::vector<FoundBlow>& blows;  // in order of time
  const std::vector<Descent>& descents;
  std::vector<Stretch> staggers;
};

// Ticks that belong to no blow and no fall.
std::vector<bool> free_ticks(const Measures& measures, const std::vector<FoundBlow>& blows,
                             const std::vector<Descent>& descents);

// Stretches in which a fighter reels.
std::vector<Stretch> staggers(const Measures& measures, const Guard& guard,
                              const std::vector<bool>& free);

// The tick of [first, last] at which the body is nearest to its guard, rather near `wanted`.
Tick nearest_to_guard(const Found& found, Tick first, Tick last, Tick wanted);

std::vector<FoundAction> attack_segments(const Found& found);
std::vector<FoundAction> block_segments(const Found& found);
std::vector<FoundAction> fall_segments(const Found& found, std::vector<std::string>& notes);
std::vector<FoundAction> quiet_segments(const Found& found);
std::vector<FoundAction> parry_segments(const Found& found);
std::vector<FoundAction> stagger_segments(const Found& found, const Clip& capture);

}  // namespace ringcraft
