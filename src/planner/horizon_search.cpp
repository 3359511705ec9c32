#include "planner/horizon_search.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {
namespace {

constexpr Tick kGrowthStep = 60;        // 0.5 s
constexpr Tick kFirstLiveHorizon = 60;  // under a time limit
constexpr double kFirstGrowth = 8;      // of the nodes per half second, before it is measured

// One step of every move: what is left when the node limit does not pay for the shortest horizon.
Searched weighed_by_first_step(const DuelSetup& setup, const DuelNode& root,
                               const SoftChoice& preference) {
  Searched result;
  result.horizon = kHorizonStep;
  Duel game(setup, root.now + kHorizonStep);
  result.roots = root_moves(game, root);
  result.root_counts = game.counts();
  for (RootMove<Duel>& one : result.roots) {
    one.value = game.value(one.child.node);
    one.preference = preference(game.key(one.move));
    one.exact = true;
    one.counts.nodes = one.counts.leaves = 1;
    result.counts += one.counts;
  }
  std::stable_sort(result.roots.begin(), result.roots.end(),
                   [](const auto& a, const auto& b) { return a.better_than(b); });
  return result;
}

}  // namespace

// Iterative deepening by time: a short horizon first, whose best moves order the next and whose
// growth tells how far a limit will carry.
Searched search_ahead(const DuelSetup& setup, const FightState& state, const SoftChoice& preference,
                      const PlanLimits& limits, SearchPool<Duel>& pool) {
  const Style& style = *setup.side[0].style;
  const Tick wanted = std::clamp<Tick>(ticks(style.horizon_s), 1, kLongestHorizon);
  const DuelNode root = Duel::root(setup, state);
  SearchSettings search_settings;
  search_settings.cost = setup.cost;
  SearchStop stop;
  stop.set_flag(limits.stop);
  const auto begin = SearchStop::Clock::now();
  if (limits.seconds > 0) {
    stop.set_deadline(begin + std::chrono::duration_cast<SearchStop::Clock::duration>(
                                  std::chrono::duration<double>(limits.seconds)));
  }
  if (limits.any()) search_settings.stop = &stop;
  RootSearch<Duel> search(search_settings, setup.settings.threads, setup.settings.alpha_beta, pool);
  const std::uint64_t limit = setup.settings.node_limit;
  Searched best;
  Tick horizon = std::min(wanted, limits.seconds > 0 ? kFirstLiveHorizon : kFirstHorizon);
  double growth = kFirstGrowth;
  std::uint64_t nodes_before = 0;
  while (true) {
    Duel game(setup, state.now + horizon);
    Roots roots = search.run(game, root, preference, limit);
    if (roots.empty()) break;
    const Tick before = best.horizon;
    best.roots = std::move(roots);
    best.horizon = horizon;
    best.root_counts = game.counts();
    best.counts = {};
    for (const RootMove<Duel>& move : best.roots) best.counts += move.counts;
    if (horizon >= wanted) break;
    const auto nodes = static_cast<double>(std::max<std::uint64_t>(1, search.spent()));
    if (before > 0 && nodes_before > 0) {
      const double half_seconds = 2 * seconds(horizon - before);
      growth = std::max(2.0, std::pow(nodes / static_cast<double>(nodes_before), 1 / half_seconds));
    }
    nodes_before = search.spent();
    // The next step, where what is left should pay for it.
    const double after =
        std::pow(growth, static_cast<double>(kHorizonStep) / static_cast<double>(kGrowthStep));
    if (limit != 0 && after > static_cast<double>(limit) / nodes) break;
    if (limits.seconds > 0) {
      const std::chrono::duration<double> spent = SearchStop::Clock::now() - begin;
      if (spent.count() * (1 + after) > limits.seconds) break;
    }
    horizon = std::min(wanted, horizon + kHorizonStep);
  }
  return best.roots.empty() ? weighed_by_first_step(setup, root, preference) : std::move(best);
}

}  // namespace ringcraft
