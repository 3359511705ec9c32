#pragma once
// The search core: minimax and alpha-beta over a small Game. It knows no fight.
//
// One side may act several times running, lines may differ in length, and a forced node has one
// edge: so the sign goes by who acts (max or min), never by depth.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/arena.h"
#include "planner/search_cost.h"
#include "planner/search_devices.h"

namespace ringcraft {

enum class Actor : std::uint8_t { maximizer, minimizer, forced };

// What a move leads to. A fault above 0 strikes the child off; where all children are struck off,
// the one with the least fault is kept, so that no node is left without a move.
template <class Node>
struct Child {
  Node node;
  std::int32_t fault = 0;
};

// Which of the struck-off children is kept: of equal faults that of the smallest key, so that the
// order in which moves are tried does not matter.
class LeastFault {
 public:
  // True where this one is less than all before it.
  bool lowered_by(std::int32_t fault, std::uint32_t key) {
    if (fault > fault_ || (fault == fault_ && key >= key_)) return false;
    fault_ = fault, key_ = key;
    return true;
  }

 private:
  std::int32_t fault_ = std::numeric_limits<std::int32_t>::max();
  std::uint32_t key_ = std::numeric_limits<std::uint32_t>::max();
};

// `gained`: the part of the value that the way to the node has settled. value - gained of
// everything below a node depends on the node's hash only, so a table may hold it. `moves`: in the
// order in which they are to be tried; a forced node has exactly one. `key`: a small number that
// names a move wherever it is met, for killers and history.
template <class G>
concept Game = requires(G& game, const typename G::Node& node, const typename G::Move& move,
                        std::vector<typename G::Move>& moves) {
  { game.terminal(node) } -> std::same_as<bool>;
  { game.actor(node) } -> std::same_as<Actor>;
  { game.value(node) } -> std::same_as<std::int32_t>;
  { game.gained(node) } -> std::same_as<std::int32_t>;
  { game.hash(node) } -> std::same_as<std::uint64_t>;
  { game.moves(node, moves) } -> std::same_as<void>;
  { game.apply(node, move) } -> std::same_as<Child<typename G::Node>>;
  { game.key(move) } -> std::same_as<std::uint32_t>;
};
// And, if it likes:
// - range(node), between what the value of a node must lie, known without looking below it;
// - step(node, move) and check(node, move, child), which together are apply(): the part of a fault
//   that costs much is added by check(), and is not asked for where the child cannot matter;
// - resume(node, move, child): the horizon of an earlier search cut the child off; plays it on to
//   this one's, as step() would; check() follows anew. False where it had to begin anew;
// - counts() and count(counts): what it counts, so that what is kept is counted again.

inline constexpr std::int32_t kWorst = std::numeric_limits<std::int32_t>::min() / 4;
inline constexpr std::int32_t kBest = std::numeric_limits<std::int32_t>::max() / 4;

// Both included.
struct ValueRange {
  std::int32_t least = kWorst, most = kBest;
};

// Ends a search from outside: asked for, or late. What it ends is thrown away.
class SearchStop {
 public:
  using Clock = std::chrono::steady_clock;

  void ask() { asked_.store(true, std::memory_order_relaxed); }
  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
  void set_flag(const std::atomic<bool>* flag) { flag_ = flag; }
  bool due() const {
    return asked_.load(std::memory_order_relaxed) ||
           (flag_ != nullptr && flag_->load(std::memory_order_relaxed)) ||
           (deadline_ && Clock::now() >= *deadline_);
  }

 private:
  std::atomic<bool> asked_{false};
  const std::atomic<bool>* flag_ = nullptr;
  std::optional<Clock::time_point> deadline_;
};

struct SearchSettings : SearchDevices {
  int table_bits = 14;               // log2 of the table's size at first
  int most_table_bits = 18;          // and of what it may grow to
  std::uint64_t node_limit = 0;      // 0 is none
  const SearchStop* stop = nullptr;  // looked at every few nodes
  SearchCost* cost = nullptr;        // of one thread
};

struct SearchCounts {
  std::uint64_t nodes = 0;   // all of them
  std::uint64_t leaves = 0;  // terminal, or outside of the window whatever is below
  std::uint64_t forced = 0;

  SearchCounts& operator+=(const SearchCounts& o) {
    nodes += o.nodes, leaves += o.leaves, forced += o.forced;
    return *this;
  }
};

// Plain minimax: the definition, and what alpha-beta is tested against.
template <Game G>
std::int32_t minimax(G& game, const typename G::Node& node, SearchCounts& counts) {
  ++counts.nodes;
  if (game.terminal(node)) {
    ++counts.leaves;
    return game.value(node);
  }
  const Actor actor = game.actor(node);
  if (actor == Actor::forced) ++counts.forced;
  std::vector<typename G::Move> moves;
  game.moves(node, moves);
  if (moves.empty()) {
    ++counts.leaves;
    return game.value(node);
  }
  const bool max = actor != Actor::minimizer;
  std::int32_t best = max ? kWorst : kBest;
  bool any = false;
  LeastFault least_fault;
  typename G::Node spare{};
  const auto weigh = [&](const typename G::Node& child) {
    const std::int32_t value = minimax(game, child, counts);
    best = max ? std::max(best, value) : std::min(best, value);
  };
  for (const auto& move : moves) {
    const Child<typename G::Node> child = game.apply(node, move);
    if (child.fault > 0) {
      if (least_fault.lowered_by(child.fault, game.key(move))) spare = child.node;
      continue;
    }
    any = true;
    weigh(child.node);
  }
  if (!any) weigh(spare);
  return best;
}

// What a game counts, where it does.
template <class G>
struct CountsOf {
  struct Type {};
};
template <class G>
requires requires(G& game) {
  game.count(game.counts());
}
struct CountsOf<G> {
  using Type = std::remove_cvref_t<decltype(std::declval<G&>().counts())>;
};

// Alpha-beta with its memory: table, killers, history, and the tree that was walked, so that no
// longer horizon makes a step again. One object per task; nothing is shared.
template <Game G>
class Search {
 public:
  using Node = typename G::Node;
  using Move = typename G::Move;

  explicit Search(const SearchSettings& settings) { forget(settings); }

  // As if made anew; what it has taken from the heap stays with it.
  void forget(const SearchSettings& settings) {
    settings_ = settings;
    counts_ = {};
    first_generation_ = ++generation_;
    table_.resize(settings.table ? std::size_t{1} << settings.table_bits : 0);
    stored_ = 0;
    for (const auto& one : levels_) one->killers = {kNoMove, kNoMove};
    history_ = {};
    history_most_ = {};
    forget_tree();
    root_ = {};
  }

  // The value of `node` if it lies in (alpha, beta); else a bound on it (fail-soft). `line` is the
  // principal variation from the node on. Search again with a longer horizon keeps the memory of
  // moves and steps but not the values: say so by next_horizon().
  std::int32_t run(G& game, const Node& node, std::int32_t alpha, std::int32_t beta,
                   std::vector<Move>& line) {
    aborted_ = false;
    counts_ = {};
    const std::pair<std::uint64_t, std::int32_t> root{game.hash(node), game.gained(node)};
    if (root != root_) forget_tree();
    root_ = root;
    return visit(game, node, alpha, beta, 0, root_spot_, line);
  }

  void set_node_limit(std::uint64_t limit) { settings_.node_limit = limit; }
  void next_horizon() { ++generation_; }
  bool aborted() const { return aborted_; }  // the node limit ended the last run: its value is void
  const SearchCounts& counts() const { return counts_; }  // of the last run

 private:
  enum class Bound : std::uint8_t { exact, lower, upper };
  struct Entry {
    std::uint64_t hash = 0;
    std::int32_t value = 0;  // less what was gained on the way
    std::uint32_t best = kNoMove;
    std::uint32_t generation = 0;
    Bound bound = Bound::exact;
  };
  static constexpr std::uint32_t kNoMove = std::numeric_limits<std::uint32_t>::max();

  using Counts = typename CountsOf<G>::Type;
  struct Spot;
  // One way out of a node, as far as it was looked at.
  struct Edge {
    Move move;
    Child<Node> child;       // its fault is step()'s
    std::int32_t found = 0;  // what check() added
    bool stepped = false, checked = false;
    bool cut_off = false;  // by the horizon of `generation`
    std::uint32_t generation = 0;
    Counts by_step, by_check;
    Spot* below = nullptr;  // of the child, where it was expanded

    void begin(const Move& way) {  // whatever the child was is made anew by the step
      move = way;
      stepped = checked = cut_off = false;
      found = 0, generation = 0, below = nullptr;
    }
  };
  // A node that was expanded: its ways out, in the game's order.
  struct Spot {
    Edge* edges = nullptr;
    std::size_t count = 0;
    std::uint64_t hash = 0;
    bool expanded = false;
    Counts by_moves;
  };
  // Buffers of one depth, kept between visits so that nothing is allocated in the inner loop.
  struct Level {
    std::vector<std::uint32_t> order;
    std::vector<Move> line;
    std::array<std::uint32_t, 2> killers{kNoMove, kNoMove};
    Spot spot;                // where the tree has no room
    std::vector<Edge> edges;  // of it
  };
  static constexpr std::size_t kMostSpots = 4096;

  void forget_tree() {
    edges_.clear();
    spots_.clear();
    root_spot_ = nullptr;
  }

  Level& level(std::size_t depth) {
    while (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
    return *levels_[depth];
  }

  Entry* entry_of(std::uint64_t hash) {
    return settings_.table ? &table_[hash & (table_.size() - 1)] : nullptr;
  }

  void grow_table() {
    if (4 * table_.size() > std::size_t{1} << settings_.most_table_bits) return;
    std::vector<Entry> larger(4 * table_.size());
    std::swap(table_, larger);
    stored_ = 0;
    for (const Entry& entry : larger) {
      if (entry.generation < first_generation_) continue;
      Entry* place = entry_of(entry.hash);
      stored_ += place->generation < first_generation_ ? 1 : 0;
      *place = entry;
    }
  }

  // What is replaced in a table is a move that is tried late, so it grows before that happens much.
  void store(const Entry& entry) {
    Entry* place = entry_of(entry.hash);
    if (place->generation < first_generation_ && ++stored_ > table_.size() / 16) {
      grow_table();
      place = entry_of(entry.hash);
    }
    *place = entry;
  }

  // The node's place in the tree, at `kept` from then on; with no room left a passing one.
  Spot& spot_of(G& game, const Node& node, std::size_t depth, Spot*& kept) {
    if (kept != nullptr) return *kept;
    Spot* spot = &level(depth).spot;
    if (spots_.size() < kMostSpots) {
      kept = spot = spots_.take(1);
    }
    *spot = {};
    spot->hash = settings_.table ? game.hash(node) : 0;
    return *spot;
  }

  void expand(G& game, const Node& node, std::size_t depth, Spot& spot) {
    if (spot.expanded) return count(game, spot.by_moves);
    counted(game, spot.by_moves, [&] {
      moves_.clear();
      game.moves(node, moves_);
    });
    Level& here = level(depth);
    spot.count = moves_.size();
    if (&spot == &here.spot) {
      here.edges.resize(std::max(here.edges.size(), moves_.size()));
      spot.edges = here.edges.data();
    } else {
      spot.edges = edges_.take(moves_.size());
    }
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      spot.edges[i].begin(moves_[i]);
    }
    spot.expanded = true;
  }

  // The child as this horizon knows it.
  const Child<Node>& step(G& game, const Node& node, Edge& edge) {
    const bool again = edge.cut_off && edge.generation != generation_;
    if (edge.stepped && !again) {
      count(game, edge.by_step);
      return edge.child;
    }
    Counts more{};
    counted(game, more, [&] {
      if constexpr (requires { game.resume(node, edge.move, edge.child); }) {
        if (edge.stepped && game.resume(node, edge.move, edge.child)) {
          count(game, edge.by_step);
          edge.checked = false;
          return;
        }
      }
      edge.checked = false, edge.found = 0, edge.by_check = {};
      if constexpr (requires { game.step(node, edge.move); }) {
        edge.child = game.step(node, edge.move);
      } else {
        edge.child = game.apply(node, edge.move);
      }
    });
    edge.by_step = more;
    edge.stepped = true;
    edge.cut_off = game.terminal(edge.child.node);
    edge.generation = generation_;
    return edge.child;
  }

  // The whole fault of a child that was stepped to.
  std::int32_t fault(G& game, const Node& node, Edge& edge) {
    if constexpr (requires { game.check(node, edge.move, edge.child); }) {
      if (edge.checked) {
        count(game, edge.by_check);
      } else {
        const std::int32_t before = edge.child.fault;
        counted(game, edge.by_check, [&] { game.check(node, edge.move, edge.child); });
        edge.found = edge.child.fault - before;
        edge.child.fault = before;
        edge.checked = true;
      }
    }
    return edge.child.fault + edge.found;
  }

  template <class Work>
  static void counted(G& game, Counts& counts, const Work& work) {
    if constexpr (requires { game.count(game.counts()); }) {
      const Counts before = game.counts();
      work();
      counts = game.counts() - before;
    } else {
      work();
    }
  }
  static void count(G& game, const Counts& counts) {
    if constexpr (requires { game.count(counts); }) game.count(counts);
  }

  std::int32_t visit(G& game, const Node& node, std::int32_t alpha, std::int32_t beta,
                     std::size_t depth, Spot*& kept, std::vector<Move>& line) {
    line.clear();
    ++counts_.nodes;
    if (settings_.node_limit != 0 && counts_.nodes > settings_.node_limit) aborted_ = true;
    if (settings_.stop != nullptr && counts_.nodes % 4 == 0 && settings_.stop->due()) {
      aborted_ = true;
    }
    if (aborted_) return 0;
    if (game.terminal(node)) {
      ++counts_.leaves;
      return game.value(node);
    }
    if constexpr (requires { game.range(node); }) {
      const ValueRange range = game.range(node);
      if (range.least >= beta || range.most <= alpha) {
        ++counts_.leaves;
        return range.least >= beta ? range.least : range.most;
      }
    }
    const Actor actor = game.actor(node);
    Spot& spot = spot_of(game, node, depth, kept);
    if (actor == Actor::forced) return visit_forced(game, node, alpha, beta, depth, spot, line);

    const std::int32_t gained = game.gained(node);
    const std::uint64_t hash = spot.hash;
    const Entry* entry = entry_of(hash);
    std::uint32_t first = kNoMove;
    if (entry != nullptr && entry->generation >= first_generation_ && entry->hash == hash) {
      first = entry->best;
      const std::int32_t value = entry->value + gained;
      if (entry->generation == generation_ &&
          (entry->bound == Bound::exact || (entry->bound == Bound::lower && value >= beta) ||
           (entry->bound == Bound::upper && value <= alpha))) {
        return value;
      }
    }
    const Found found = visit_children(game, node, actor, alpha, beta, depth, first, spot, line);
    if (!aborted_ && settings_.table) {
      const Bound bound = found.value <= alpha  ? Bound::upper
                          : found.value >= beta ? Bound::lower
                                                : Bound::exact;
      store({hash, found.value - gained, found.best, generation_, bound});
    }
    return found.value;
  }

  // A forced node spends time, not a ply: the window passes through it.
  std::int32_t visit_forced(G& game, const Node& node, std::int32_t alpha, std::int32_t beta,
                            std::size_t depth, Spot& spot, std::vector<Move>& line) {
    ++counts_.forced;
    expand(game, node, depth, spot);
    Edge& edge = spot.edges[0];
    Level& here = level(depth);
    const Child<Node>& child = step(game, node, edge);
    const std::int32_t value =
        visit(game, child.node, alpha, beta, depth + 1, edge.below, here.line);
    line.push_back(edge.move);
    line.insert(line.end(), here.line.begin(), here.line.end());
    return value;
  }

  struct Found {
    std::int32_t value = 0;
    std::uint32_t best = kNoMove;
  };

  Found visit_children(G& game, const Node& node, Actor actor, std::int32_t alpha,
                       std::int32_t beta, std::size_t depth, std::uint32_t first, Spot& spot,
                       std::vector<Move>& line) {
    Level& here = level(depth);
    expand(game, node, depth, spot);
    if (spot.count == 0) {
      ++counts_.leaves;
      return {game.value(node), kNoMove};
    }
    order(game, here, spot, actor, first);
    const bool max = actor == Actor::maximizer;
    Found found{max ? kWorst : kBest, kNoMove};
    bool any = false;
    LeastFault least_fault;
    Edge* spare = nullptr;
    // True when the window is closed and the rest need not be looked at.
    const auto weigh = [&](Edge& edge) {
      const Node& child = edge.child.node;
      const std::int32_t value = visit(game, child, alpha, beta, depth + 1, edge.below, here.line);
      if (aborted_) return true;
      if (max ? value > found.value : value < found.value) {
        found = {value, game.key(edge.move)};
        line.assign(1, edge.move);
        line.insert(line.end(), here.line.begin(), here.line.end());
      }
      if (max) {
        alpha = std::max(alpha, value);
      } else {
        beta = std::min(beta, value);
      }
      return alpha >= beta;
    };
    for (const std::uint32_t i : here.order) {
      Edge& edge = spot.edges[i];
      const Child<Node>& child = step(game, node, edge);
      if (any && child.fault == 0 && game.terminal(child.node)) {
        // An end outside of the window, beside a sound child: whether it is struck off is the same.
        const std::int32_t value = game.value(child.node);
        if (max ? value <= alpha : value >= beta) {
          ++counts_.nodes, ++counts_.leaves;
          found.value = max ? std::max(found.value, value) : std::min(found.value, value);
          continue;
        }
      }
      if (const std::int32_t whole = fault(game, node, edge); whole > 0) {
        if (least_fault.lowered_by(whole, game.key(edge.move))) spare = &edge;
        continue;
      }
      any = true;
      if (weigh(edge)) {
        if (!aborted_) note_cutoff(here, actor, game.key(edge.move));
        return found;
      }
    }
    if (!any) weigh(*spare);
    return found;
  }

  // Table move, killers, then the game's own order, in which history moves a candidate up by at
  // most two places. Stable: the same moves in the same state always come in the same order.
  void order(G& game, Level& here, const Spot& spot, Actor actor, std::uint32_t first) {
    const CostSpan span(settings_.cost, CostPart::ordering);
    std::vector<Rank>& ranks = ranks_;
    ranks.clear();
    const auto& history = history_[actor == Actor::maximizer ? 0 : 1];
    const std::uint64_t most = history_most_[actor == Actor::maximizer ? 0 : 1];
    for (std::size_t i = 0; i < spot.count; ++i) {
      const std::uint32_t key = game.key(spot.edges[i].move);
      std::int64_t place = static_cast<std::int64_t>(settings_.own_order ? i : key) * 1024;
      if (settings_.history && key < history.size()) {
        place -= static_cast<std::int64_t>(2048 * history[key] / (most + 1));
      }
      if (settings_.killers && (key == here.killers[0] || key == here.killers[1])) place -= 1 << 20;
      if (key == first) place -= 1 << 21;
      ranks.push_back({place, static_cast<std::uint32_t>(i)});
    }
    for (std::size_t i = 1; i < ranks.size(); ++i) {  // insertion: few, and stable
      for (std::size_t j = i; j > 0 && ranks[j].place < ranks[j - 1].place; --j) {
        std::swap(ranks[j], ranks[j - 1]);
      }
    }
    here.order.clear();
    for (const Rank& rank : ranks) here.order.push_back(rank.index);
  }

  void note_cutoff(Level& here, Actor actor, std::uint32_t key) {
    if (here.killers[0] != key) here.killers = {key, here.killers[0]};
    const std::size_t side = actor == Actor::maximizer ? 0 : 1;
    if (history_[side].size() <= key) history_[side].resize(key + 1);
    history_most_[side] = std::max(history_most_[side], ++history_[side][key]);
  }

  struct Rank {
    std::int64_t place;
    std::uint32_t index;
  };

  SearchSettings settings_;
  SearchCounts counts_;
  bool aborted_ = false;
  std::uint32_t generation_ = 0, first_generation_ = 0;  // what an older one wrote is forgotten
  std::vector<Entry> table_;
  std::size_t stored_ = 0;  // in it
  std::vector<std::unique_ptr<Level>> levels_;
  std::array<std::vector<std::uint64_t>, 2> history_;
  std::array<std::uint64_t, 2> history_most_{};
  std::vector<Rank> ranks_;  // of order()
  std::vector<Move> moves_;  // of expand()
  Arena<Edge> edges_;        // the tree that was walked
  Arena<Spot> spots_;
  Spot* root_spot_ = nullptr;
  std::pair<std::uint64_t, std::int32_t> root_{};  // hash and gain of its root
};

// Searches that have done their work, with their tables and trees on the heap, for the next ones.
template <Game G>
class SearchPool {
 public:
  std::unique_ptr<Search<G>> take(const SearchSettings& settings) {
    if (idle_.empty()) return std::make_unique<Search<G>>(settings);
    std::unique_ptr<Search<G>> search = std::move(idle_.back());
    idle_.pop_back();
    search->forget(settings);
    return search;
  }
  void give_back(std::unique_ptr<Search<G>> search) { idle_.push_back(std::move(search)); }

 private:
  std::vector<std::unique_ptr<Search<G>>> idle_;
};

}  // namespace ringcraft
