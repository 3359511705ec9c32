#pragma once
// The tree of one decision, written out: what the search weighed, for people to read.
//
// A plain expansion of the same game (planner/duel.h) down to the same horizon, without alpha-beta
// cuts. It is as large as it may be and no larger: the best line of the three best first moves goes
// down to the horizon first, then whatever departs least from best play. What is not expanded still
// has its exact value, by search.

#include <string>
#include <vector>

#include "planner/duel.h"

namespace ringcraft {

// Why a child was not followed. Candidates beyond the best k are only counted.
enum class Pruned : std::uint8_t { unanswered_hit, back_turned, penetration };
std::string_view name_of(Pruned reason);

// The rules that counted something in between.
std::vector<Pruned> reasons_between(const DuelCounts& before, const DuelCounts& after);

struct TreePruned {
  std::string action;  // the last one, where a path leads to it
  std::vector<Pruned> reasons;
};

// The candidates of a node, without those that show the back: they are `pruned`.
struct Sifted {
  std::vector<DuelMove> moves;
  std::vector<TreePruned> pruned;
};
Sifted sift(Duel& game, const DuelNode& node, const MotionLibrary& library);

struct TreeEvent {
  Event event;
  bool cuts = false;  // the struck action ends here; the next node is forced
};

enum class TreeKind : std::uint8_t { decision, forced, terminal };
std::string_view name_of(TreeKind kind);

// What is launched on the way into a node, and what happened until then.
struct TreeEdge {
  FighterId who;
  std::string action;
  std::vector<std::string> then;  // the rest of a path, played without a new decision
  bool forced = false;
  Tick start = 0, end = 0;        // of the edge
  Tick action_end = 0;            // of the action, cut where it was cut; kNever: it lies
  DuelTerms terms{};              // side 0 is the planning fighter
  std::vector<TreeEvent> events;  // in order of tick
  std::vector<Pruned> kept;       // what it is blamed for: kept as the least fault of all
};

struct TreeNode {
  int parent = -1;  // -1: the root
  int depth = 0;
  Tick tick = 0;
  TreeKind kind = TreeKind::decision;
  FighterId who;              // acts here; invalid at a terminal
  TreeEdge edge;              // into this node; empty at the root
  std::int32_t gained = 0;    // f so far, thousandths
  std::int32_t value = 0;     // f of the best line through here, thousandths
  bool exact = true;          // else the search's limit was reached and `value` is a guess
  bool expanded = false;      // its children are written out
  bool principal = false;     // on the principal variation
  bool chosen = false;        // the first move that the fighter took
  std::vector<int> children;  // best first for who acts
  std::vector<TreePruned> pruned;
  std::uint64_t beyond = 0;  // candidates beyond the best k
};

struct DecisionTree {
  FighterId fighter, opponent;
  Tick start = 0, horizon = 0;  // ticks; the horizon as a length
  std::vector<TreeNode> nodes;  // a parent comes before its children; [0] is the root
  std::size_t most_nodes = 0;
  std::size_t unexpanded = 0;  // nodes before the horizon whose children were left out
  bool complete() const { return unexpanded == 0; }
};

// The tree in which side 0 of `setup` decides at state.now, to `horizon` ticks from there. The
// root's children are there even where they are more than `most_nodes`.
DecisionTree expand_tree(const DuelSetup& setup, const FightState& state, Tick horizon,
                         std::size_t most_nodes);

// The line of best play from a node on: ids, the node's own first.
std::vector<int> line_from(const DecisionTree& tree, int node);

// Marks the first move that `plan` took.
void mark_chosen(DecisionTree& tree, const Plan& plan, const MotionLibrary& library);

}  // namespace ringcraft
