#pragma once
// The root of the search: every move is a task of its own, so that values, counts and lines are the
// same for any number of threads.
//
// Each move has a preference that is added to its value; the search finds the largest sum. The
// first move is searched with an open window; the others, with a window that begins at what they
// must exceed to be preferred to it, do not hear of each other. So the best and all that were
// preferred to the first have exact values, the others upper bounds.

#include <atomic>

#include "base/tasks.h"
#include "planner/search.h"

namespace ringcraft {

template <Game G>
struct RootMove {
  typename G::Move move;
  Child<typename G::Node> child;
  std::int32_t value = 0;
  std::int32_t preference = 0;         // added to the value where moves are compared
  bool exact = false;                  // else the value is an upper bound
  std::vector<typename G::Move> line;  // after `move`
  SearchCounts counts;
  G game;  // the task's own: holds what it counted

  std::int32_t sum() const { return value + preference; }
  // The largest sum first; of equal sums the exact one, then the smallest key.
  bool better_than(const RootMove& o) const {
    if (sum() != o.sum()) return sum() > o.sum();
    return exact != o.exact ? exact : game.key(move) < o.game.key(o.move);
  }
};

// The moves of `root` that no rule strikes off, else the one with the least fault. `game` counts
// what was struck off; the moves' own games count from 0 on.
template <Game G>
std::vector<RootMove<G>> root_moves(G& game, const typename G::Node& root) {
  const G clean = game;
  std::vector<typename G::Move> list;
  game.moves(root, list);
  std::vector<RootMove<G>> sound, struck;
  for (const auto& move : list) {
    RootMove<G> one{move, game.apply(root, move), 0, 0, false, {}, {}, clean};
    (one.child.fault > 0 ? struck : sound).push_back(std::move(one));
  }
  if (sound.empty() && !struck.empty()) {
    sound.push_back(
        *std::min_element(struck.begin(), struck.end(), [](const auto& a, const auto& b) {
          if (a.child.fault != b.child.fault) return a.child.fault < b.child.fault;
          return a.game.key(a.move) < b.game.key(b.move);
        }));
  }
  return sound;
}

// The memory of one root move from horizon to horizon.
template <Game G>
struct RootMemory {
  std::uint32_t key = 0;
  std::int32_t last = kWorst;  // value at the last horizon
  std::unique_ptr<Search<G>> search;
};

template <Game G>
class RootSearch {
 public:
  using Node = typename G::Node;

  // Takes its searches from `pool` and gives them back.
  RootSearch(const SearchSettings& settings, int threads, bool alpha_beta, SearchPool<G>& pool)
      : settings_(settings), threads_(threads), alpha_beta_(alpha_beta), pool_(pool) {}
  RootSearch(const RootSearch&) = delete;
  ~RootSearch() {
    for (RootMemory<G>& memory : memory_) pool_.give_back(std::move(memory.search));
  }

  // Searches every move of `root`, where the maximizer acts; `preference` of a move's key is added
  // to its value. The best first. Empty when the node limit (over all moves; 0 is none) was not
  // enough. `root_game` counts what was struck off at the root.
  template <class Preference>
  std::vector<RootMove<G>> run(G& root_game, const Node& root, const Preference& preference,
                               std::uint64_t node_limit) {
    std::vector<RootMove<G>> moves = root_moves(root_game, root);
    if (moves.empty()) return moves;
    for (RootMove<G>& one : moves) {
      one.preference = preference(one.game.key(one.move));
      memory_of(one.game, one.move);  // all of them now: tasks only look theirs up
    }
    const auto hoped = [&](const RootMove<G>& one) {  // from the last horizon, where there was one
      const std::int32_t last = memory_of(one.game, one.move).last;
      return last == kWorst ? kWorst : last + one.preference;
    };
    std::stable_sort(moves.begin(), moves.end(),
                     [&](const auto& a, const auto& b) { return hoped(a) > hoped(b); });
    std::atomic<bool> aborted{false};
    const auto task = [&](std::size_t i, std::int32_t alpha, std::uint64_t limit) {
      if (!search_move(moves[i], alpha, limit)) aborted = true;
    };
    task(0, kWorst, node_limit);
    spent_ = moves[0].counts.nodes;
    const auto key = [](const RootMove<G>& one) { return one.game.key(one.move); };
    const auto alpha = [&](const RootMove<G>& one) {
      return moves[0].sum() - one.preference - (key(one) < key(moves[0]) ? 1 : 0);
    };
    const std::size_t others = moves.size() - 1;
    if (others > 0 && !aborted) {
      std::uint64_t share = 0;
      if (node_limit != 0) {
        share = (node_limit - std::min(node_limit, moves[0].counts.nodes)) / others;
        if (share == 0) aborted = true;
      }
      if (!aborted) {
        run_tasks(others, threads_,
                  [&](std::size_t i) { task(i + 1, alpha(moves[i + 1]), share); });
        for (std::size_t i = 1; i < moves.size(); ++i) spent_ += moves[i].counts.nodes;
      }
    }
    for (RootMemory<G>& memory : memory_) memory.search->next_horizon();
    if (aborted) return {};
    for (const RootMove<G>& move : moves) memory_of(move.game, move.move).last = move.value;
    std::stable_sort(moves.begin(), moves.end(),
                     [](const auto& a, const auto& b) { return a.better_than(b); });
    return moves;
  }

  // Nodes of the last run, also of one that was aborted.
  std::uint64_t spent() const { return spent_; }

 private:
  RootMemory<G>& memory_of(const G& game, const typename G::Move& move) {
    const std::uint32_t key = game.key(move);
    for (RootMemory<G>& memory : memory_) {
      if (memory.key == key) return memory;
    }
    memory_.push_back({key, kWorst, pool_.take(settings_)});
    return memory_.back();
  }

  // False when the node limit ended it.
  bool search_move(RootMove<G>& one, std::int32_t alpha, std::uint64_t limit) {
    if (!alpha_beta_) {
      one.value = minimax(one.game, one.child.node, one.counts);
      one.exact = true;
      return limit == 0 || one.counts.nodes <= limit;
    }
    Search<G>& search = *memory_of(one.game, one.move).search;
    search.set_node_limit(limit);
    one.value = search.run(one.game, one.child.node, alpha, kBest, one.line);
    one.counts = search.counts();
    one.exact = one.value > alpha;
    return !search.aborted();
  }

  SearchSettings settings_;
  int threads_;
  bool alpha_beta_;
  SearchPool<G>& pool_;
  std::uint64_t spent_ = 0;
  std::vector<RootMemory<G>> memory_;
};

}  // namespace ringcraft
