#include "planner/tally.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/random.h"
#include "planner/horizon_search.h"

namespace ringcraft {
namespace {

// The children that count: those without a fault, else the one with the least.
std::vector<DuelNode> children_of(Duel& game, const DuelNode& node) {
  std::vector<DuelMove> moves;
  game.moves(node, moves);
  std::vector<DuelNode> sound;
  LeastFault least;
  std::optional<DuelNode> spare;
  for (const DuelMove& move : moves) {
    const Child<DuelNode> child = game.apply(node, move);
    if (child.fault == 0) {
      sound.push_back(child.node);
    } else if (least.lowered_by(child.fault, game.key(move))) {
      spare = child.node;
    }
  }
  if (sound.empty() && spare) sound.push_back(*spare);
  return sound;
}

}  // namespace

TreeShape shape_of(const DuelSetup& setup, const FightState& state, Tick horizon, int dives,
                   std::uint64_t seed) {
  Duel game(setup, state.now + horizon);
  const DuelNode root = Duel::root(setup, state);
  Random random(seed);
  double leaves = 0, depths = 0, from_below = 0, from_above = 0;
  for (int i = 0; i < dives; ++i) {
    double all = 1, maximizer = 1, minimizer = 1, depth = 0;
    DuelNode node = root;
    while (!game.terminal(node)) {
      const Actor actor = game.actor(node);
      const std::vector<DuelNode> children = children_of(game, node);
      if (children.empty()) break;
      if (actor != Actor::forced) {
        const auto count = static_cast<double>(children.size());
        all *= count;
        (actor == Actor::maximizer ? maximizer : minimizer) *= count;
        ++depth;
      }
      node = children[static_cast<std::size_t>(random.below(static_cast<int>(children.size())))];
    }
    leaves += all;
    depths += all * depth;
    from_below += minimizer;
    from_above += maximizer;
  }
  TreeShape shape;
  shape.leaves = leaves / dives;
  shape.depth = leaves > 0 ? depths / leaves : 0;
  shape.branching = shape.depth > 0 ? std::pow(shape.leaves, 1 / shape.depth) : 1;
  shape.proof = (from_below + from_above) / dives - 1;
  return shape;
}

SearchTally tally_of(const DuelSetup& setup, const FightState& state, Tick horizon,
                     const SearchTrial& trial, const SoftChoice& preference) {
  SearchPool<Duel> pool;
  RootSearch<Duel> search(SearchSettings{trial.devices}, 1, true, pool);
  const DuelNode root = Duel::root(setup, state);
  SearchTally tally;
  for (Tick at = trial.deepening ? std::min(kFirstHorizon, horizon) : horizon;;) {
    Duel game(setup, state.now + at);
    const auto roots = search.run(game, root, preference, 0);
    if (!roots.empty()) tally.value = roots.front().value;
    for (const RootMove<Duel>& one : roots) tally.counts += one.counts;
    if (at >= horizon) break;
    at = std::min(horizon, at + kHorizonStep);
  }
  return tally;
}

double knuth_moore_leaves(double branching, double depth) {
  const auto at = [&](double whole) {
    return std::pow(branching, std::ceil(whole / 2)) + std::pow(branching, std::floor(whole / 2)) -
           1;
  };
  const double below = std::floor(depth), share = depth - below;
  return std::exp((1 - share) * std::log(at(below)) + share * std::log(at(below + 1)));
}

}  // namespace ringcraft
