#include "planner/tree.h"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "planner/decision_record.h"

namespace ringcraft {
namespace {

constexpr std::size_t kFullLines = 3;               // first moves whose best line is always shown
constexpr std::uint64_t kMostPerNode = 400'000;     // nodes of a search for one value
constexpr std::uint64_t kMostSearched = 6'000'000;  // of all of them
constexpr int kTableBits = 18;

class Expansion {
 public:
  Expansion(const DuelSetup& setup, const FightState& state, Tick horizon, std::size_t most)
      : setup_(setup),
        library_(setup.side[0].tables->library()),
        game_(setup, state.now + horizon),
        quiet_(setup, state.now + horizon),
        search_(settings()) {
    tree_.fighter = setup.side[0].id;
    tree_.opponent = setup.side[1].id;
    tree_.start = state.now;
    tree_.horizon = horizon;
    tree_.most_nodes = most;
    add({}, Duel::root(setup, state), -1, 0);
  }

  DecisionTree run() {
    expand(0);
    const std::vector<int> first = tree_.nodes[0].children;
    for (std::size_t i = 0; i < std::min(kFullLines, first.size()); ++i) {
      for (int at = first[i]; at >= 0;) {
        if (!expanded(at) && !expand(at)) break;
        const std::vector<int>& children = node(at).children;
        at = children.empty() ? -1 : children.front();
      }
    }
    while (!open_.empty()) {
      const int at = std::get<1>(*open_.begin());
      if (!expanded(at) && !expand(at)) break;
      open_.erase({loss_[static_cast<std::size_t>(at)], at});
    }
    settle();
    return std::move(tree_);
  }

 private:
  static SearchSettings settings() {
    SearchSettings settings;
    settings.table_bits = kTableBits;
    return settings;
  }

  TreeNode& node(int id) { return tree_.nodes[static_cast<std::size_t>(id)]; }
  bool expanded(int id) { return node(id).expanded; }

  void add(TreeEdge edge, const DuelNode& state, int parent, int depth) {
    TreeNode one;
    one.parent = parent;
    one.depth = depth;
    one.tick = state.now;
    one.edge = std::move(edge);
    one.gained = state.gained;
    one.kind = quiet_.terminal(state)                 ? TreeKind::terminal
               : quiet_.actor(state) == Actor::forced ? TreeKind::forced
                                                      : TreeKind::decision;
    if (one.kind != TreeKind::terminal) one.who = id_of(setup_, actor_of(state));
    evaluate(one, state);
    tree_.nodes.push_back(std::move(one));
    states_.push_back(state);
    loss_.push_back(0);
  }

  int actor_of(const DuelNode& state) {
    quiet_.moves(state, moves_);
    return moves_.empty() ? quiet_.next_side(state) : moves_[0].side;
  }

  void evaluate(TreeNode& one, const DuelNode& state) {
    const std::uint64_t left = kMostSearched - std::min(kMostSearched, searched_);
    search_.set_node_limit(std::max<std::uint64_t>(1, std::min(kMostPerNode, left)));
    std::vector<DuelMove> line;
    one.value = search_.run(quiet_, state, kWorst, kBest, line);
    searched_ += search_.counts().nodes;
    one.exact = !search_.aborted();
    if (!one.exact) one.value = one.gained;
  }

  // One move played: the edge with all that happened on it.
  TreeEdge play(const DuelNode& from, const DuelMove& move, Child<DuelNode>& child) {
    TreeEdge edge;
    std::vector<DuelEvent> met;
    game_.record_into(&met);
    game_.record_terms_into(&edge.terms);
    const DuelCounts before = game_.counts();
    child = game_.apply(from, move);
    game_.record_into(nullptr);
    game_.record_terms_into(nullptr);
    edge.kept = reasons_between(before, game_.counts());
    edge.who = id_of(setup_, move.side);
    edge.action = library_.action(move.first()).name;
    edge.forced = move.forced;
    edge.start = from.now;
    edge.end = child.node.now;
    const Launch& launched = game_.duelist(child.node, move.side).flight.launch;
    edge.action_end = launched.end;
    if (move.next != nullptr && !move.next->path.empty()) {
      for (std::size_t i = 1; i < move.next->path.size(); ++i) {
        edge.then.push_back(library_.action(move.next->path[i]).name);
      }
      edge.then.push_back(library_.action(move.action).name);
    }
    for (const DuelEvent& one : met) {
      const Duelist& victim = child.node.side[static_cast<std::size_t>(one.victim)];
      edge.events.push_back({event_of(one, setup_, child.node),
                             one.kind != DuelEvent::Kind::evaded && victim.pending.valid() &&
                                 one.tick == child.node.now});
    }
    std::stable_sort(edge.events.begin(), edge.events.end(),
                     [](const auto& a, const auto& b) { return a.event.tick < b.event.tick; });
    return edge;
  }

  struct Grown {
    TreeEdge edge;
    DuelNode state;
  };

  // False where the children would be more than there is room for.
  bool expand(int at) {
    if (node(at).kind == TreeKind::terminal) return true;
    const DuelNode from = states_[static_cast<std::size_t>(at)];
    const std::uint64_t beyond = game_.counts().candidates;
    auto [moves, pruned] = sift(game_, from, library_);
    std::vector<Grown> grown;
    Grown spare;
    LeastFault least_fault;
    std::optional<std::size_t> spare_place;
    for (const DuelMove& move : moves) {
      Child<DuelNode> child;
      TreeEdge edge = play(from, move, child);
      if (child.fault > 0) {
        if (least_fault.lowered_by(child.fault, game_.key(move))) {
          spare = {edge, child.node}, spare_place = pruned.size();
        }
        pruned.push_back({library_.action(move.action).name, edge.kept});
        continue;
      }
      edge.kept.clear();
      grown.push_back({std::move(edge), child.node});
    }
    if (grown.empty() && spare_place) {
      pruned.erase(pruned.begin() + static_cast<std::ptrdiff_t>(*spare_place));
      grown.push_back(std::move(spare));
    }
    if (at != 0 && tree_.nodes.size() + grown.size() > tree_.most_nodes) return false;
    adopt(at, std::move(grown));
    TreeNode& here = node(at);
    here.pruned = std::move(pruned);
    here.beyond = game_.counts().candidates - beyond;
    here.expanded = true;
    if (here.children.empty()) here.kind = TreeKind::terminal, here.who = {};
    return true;
  }

  void adopt(int at, std::vector<Grown> grown) {
    const int depth = node(at).depth + 1;
    std::vector<int> ids;
    for (Grown& one : grown) {
      ids.push_back(static_cast<int>(tree_.nodes.size()));
      add(std::move(one.edge), one.state, at, depth);
    }
    node(at).children = ids;
    sort_children(at);
    if (ids.empty()) return;
    const std::int32_t best = node(node(at).children.front()).value;
    for (const int id : ids) {
      const auto i = static_cast<std::size_t>(id);
      loss_[i] = loss_[static_cast<std::size_t>(at)] + std::abs(node(id).value - best);
      if (node(id).kind != TreeKind::terminal) open_.insert({loss_[i], id});
    }
  }

  void sort_children(int at) {
    const bool max = node(at).who == tree_.fighter;
    std::vector<int>& children = node(at).children;
    std::stable_sort(children.begin(), children.end(), [&](int a, int b) {
      return max ? node(a).value > node(b).value : node(a).value < node(b).value;
    });
  }

  // Values from the bottom up by minimax over what is there, then the principal variation.
  void settle() {
    for (auto at = static_cast<int>(tree_.nodes.size()) - 1; at >= 0; --at) {
      TreeNode& here = node(at);
      if (here.kind == TreeKind::terminal) {
        here.value = here.gained;
        here.exact = true;
      } else if (!here.expanded) {
        ++tree_.unexpanded;
      } else {
        sort_children(at);
        here.value = node(here.children.front()).value;
        here.exact = std::all_of(here.children.begin(), here.children.end(),
                                 [&](int child) { return node(child).exact; });
      }
    }
    for (const int at : line_from(tree_, 0)) node(at).principal = true;
  }

  const DuelSetup& setup_;
  const MotionLibrary& library_;
  Duel game_;   // plays the moves that are written down
  Duel quiet_;  // the search's own
  Search<Duel> search_;
  std::uint64_t searched_ = 0;
  DecisionTree tree_;
  std::vector<DuelNode> states_;
  std::vector<std::int64_t> loss_;                // what the way to a node gives away, thousandths
  std::set<std::tuple<std::int64_t, int>> open_;  // by loss
  std::vector<DuelMove> moves_;
};

}  // namespace

Sifted sift(Duel& game, const DuelNode& node, const MotionLibrary& library) {
  Sifted sifted;
  std::vector<ActionId> turned;
  game.record_turned_into(&turned);
  game.moves(node, sifted.moves);
  game.record_turned_into(nullptr);
  for (const ActionId one : turned) {
    // The least turned is kept where all are.
    const bool kept = std::any_of(sifted.moves.begin(), sifted.moves.end(),
                                  [&](const DuelMove& move) { return move.action == one; });
    if (!kept) sifted.pruned.push_back({library.action(one).name, {Pruned::back_turned}});
  }
  return sifted;
}

std::vector<Pruned> reasons_between(const DuelCounts& before, const DuelCounts& after) {
  std::vector<Pruned> reasons;
  if (after.unanswered_hit > before.unanswered_hit) reasons.push_back(Pruned::unanswered_hit);
  if (after.penetration > before.penetration) reasons.push_back(Pruned::penetration);
  return reasons;
}

std::string_view name_of(Pruned reason) {
  switch (reason) {
    case Pruned::unanswered_hit:
      return "unanswered_hit";
    case Pruned::back_turned:
      return "back_turned";
    case Pruned::penetration:
      break;
  }
  return "penetration";
}

std::string_view name_of(TreeKind kind) {
  switch (kind) {
    case TreeKind::decision:
      return "decision";
    case TreeKind::forced:
      return "forced";
    case TreeKind::terminal:
      break;
  }
  return "terminal";
}

DecisionTree expand_tree(const DuelSetup& setup, const FightState& state, Tick horizon,
                         std::size_t most_nodes) {
  return Expansion(setup, state, horizon, most_nodes).run();
}

std::vector<int> line_from(const DecisionTree& tree, int node) {
  std::vector<int> line{node};
  while (true) {
    const TreeNode& last = tree.nodes[static_cast<std::size_t>(line.back())];
    if (last.children.empty()) return line;
    line.push_back(last.children.front());
  }
}

void mark_chosen(DecisionTree& tree, const Plan& plan, const MotionLibrary& library) {
  if (tree.nodes.empty()) return;
  const std::string& action = library.action(plan.launch.action).name;
  std::vector<std::string> then;
  for (const ActionId id : plan.then) then.push_back(library.action(id).name);
  TreeNode* found = nullptr;
  for (const int id : tree.nodes[0].children) {
    TreeNode& child = tree.nodes[static_cast<std::size_t>(id)];
    if (child.edge.action != action) continue;
    if (found == nullptr || child.edge.then == then) found = &child;
    if (child.edge.then == then) break;
  }
  if (found != nullptr) found->chosen = true;
}

}  // namespace ringcraft
