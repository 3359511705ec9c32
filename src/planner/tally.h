#pragma once
// What a search visits, and what the tree it searches looks like: for studies of the search.

#include "planner/duel.h"
#include "planner/soft_choice.h"

namespace ringcraft {

// The whole tree, by random dives (Knuth 1975, Estimating the efficiency of backtrack programs).
struct TreeShape {
  double leaves = 0;     // of the whole tree
  double depth = 0;      // decisions above a leaf, mean over the leaves; forced nodes are none
  double branching = 0;  // leaves^(1 / depth)
  double proof = 0;      // leaves of two proof trees, for value >= v and value <= v, less one: no
                         // search of this tree can look at much fewer (Knuth & Moore 1975)
};

TreeShape shape_of(const DuelSetup& setup, const FightState& state, Tick horizon, int dives,
                   std::uint64_t seed);

// Leaves of the minimal tree of a uniform tree: w^ceil(d/2) + w^floor(d/2) - 1 (Knuth & Moore 1975,
// An analysis of alpha-beta pruning); between whole depths on a straight line of the logarithm.
double knuth_moore_leaves(double branching, double depth);

// How to search: the planner's own way, or another to be compared with it.
struct SearchTrial {
  SearchDevices devices;
  bool deepening = true;  // shorter horizons first, whose best moves are tried first
};

// One search of the whole horizon, without a limit, on one thread.
struct SearchTally {
  std::int32_t value = 0;  // of the best move, thousandths
  SearchCounts counts;     // of all horizons
};

SearchTally tally_of(const DuelSetup& setup, const FightState& state, Tick horizon,
                     const SearchTrial& trial, const SoftChoice& preference);

}  // namespace ringcraft
