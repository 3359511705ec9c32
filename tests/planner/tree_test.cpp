#include "planner/tree.h"

#include <gtest/gtest.h>

#include "planner/duel_fixture.h"

namespace ringcraft {
namespace {

class TreeTest : public DuelFixture {
 protected:
  TreeTest() {
    Style style;
    style.candidates = 4;
    set_style(style);
  }
  static constexpr Tick kHorizon = 140;
  static constexpr std::size_t kPlenty = 50'000;

  // Minimax of the game itself, which knows nothing of the written tree.
  std::int32_t value_of(const FightState& state) {
    Duel game(setup_, state.now + kHorizon);
    SearchCounts counts;
    return minimax(game, Duel::root(setup_, state), counts);
  }
  // Minimax over the written tree, from what its terminals gained.
  static std::int32_t backed_up(const DecisionTree& tree, int id) {
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(id)];
    if (node.children.empty()) return node.gained;
    std::int32_t best = backed_up(tree, node.children.front());
    for (const int child : node.children) {
      const std::int32_t value = backed_up(tree, child);
      best = node.who == tree.fighter ? std::max(best, value) : std::min(best, value);
    }
    return best;
  }
};

TEST_F(TreeTest, CompleteTreeHasTheValueOfTheGame) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const FightState state = random_state(seed);
    const DecisionTree tree = expand_tree(setup_, state, kHorizon, kPlenty);
    ASSERT_TRUE(tree.complete()) << tree.nodes.size();
    EXPECT_EQ(backed_up(tree, 0), value_of(state)) << seed;
    EXPECT_EQ(tree.nodes[0].value, value_of(state)) << seed;
  }
}

TEST_F(TreeTest, SmallTreeHasTheSameValueAndSaysWhatItLeavesOut) {
  int cut = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const FightState state = random_state(seed);
    const DecisionTree tree = expand_tree(setup_, state, kHorizon, 40);
    EXPECT_LE(tree.nodes.size(), 40u);
    const bool small = expand_tree(setup_, state, kHorizon, kPlenty).nodes.size() <= 40;
    EXPECT_EQ(tree.unexpanded > 0, !small) << seed;
    cut += small ? 0 : 1;
    EXPECT_TRUE(tree.nodes[0].exact);
    EXPECT_EQ(tree.nodes[0].value, value_of(state)) << seed;
    // The principal variation reaches the horizon all the same.
    const TreeNode& last = tree.nodes[static_cast<std::size_t>(line_from(tree, 0).back())];
    EXPECT_EQ(last.kind, TreeKind::terminal);
    EXPECT_EQ(last.tick, state.now + kHorizon);
    EXPECT_EQ(last.gained, tree.nodes[0].value);
  }
  EXPECT_GT(cut, 3);
}

TEST_F(TreeTest, AgreesWithThePlanner) {
  Style style;
  style.candidates = 4;
  style.horizon_s = seconds(kHorizon);
  style.temperature = 0;
  Planner planner(library(), contenders(2, style), {}, 1);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const FightState state = random_state(seed);
    const Plan plan = planner.plan(state, FighterId(0));
    DecisionTree tree = planner.tree(state, FighterId(0), plan.record.horizon, kPlenty);
    mark_chosen(tree, plan, library());
    ASSERT_TRUE(tree.complete());
    EXPECT_EQ(tree.nodes[0].value, plan.record.lines[0].score) << seed;
    const int first = tree.nodes[0].children.front();
    EXPECT_EQ(tree.nodes[static_cast<std::size_t>(first)].value, tree.nodes[0].value);
    int chosen = 0;
    for (const TreeNode& node : tree.nodes) {
      if (!node.chosen) continue;
      ++chosen;
      EXPECT_EQ(node.parent, 0);
      EXPECT_EQ(node.value, plan.record.lines[0].score) << seed;
      EXPECT_EQ(node.edge.action, library().action(plan.launch.action).name);
    }
    EXPECT_EQ(chosen, 1);
  }
}

// Every point of f is accounted for by a term of one of the two.
TEST_F(TreeTest, TermsAddUpToWhatWasGained) {
  for (const LeafValue leaf : {LeafValue::weighted, LeafValue::paper}) {
    style_.leaf = leaf;
    set_style(style_);
    double theirs = 0;
    bool hit = false;
    for (const std::uint64_t seed : {3, 4, 5, 6}) {
      const DecisionTree tree = expand_tree(setup_, random_state(seed), kHorizon, 400);
      for (std::size_t id = 1; id < tree.nodes.size(); ++id) {
        const TreeNode& node = tree.nodes[id];
        const TreeNode& parent = tree.nodes[static_cast<std::size_t>(node.parent)];
        std::int32_t sum = 0;
        for (const auto& side : node.edge.terms) {
          for (const TermSum& term : side) sum += term.credited;
        }
        EXPECT_EQ(node.gained - parent.gained, sum) << id;
        theirs += std::abs(node.edge.terms[1][static_cast<std::size_t>(Term::location)].points);
        for (const TreeEvent& one : node.edge.events) {
          hit = hit || one.event.type == EventType::hit;
          EXPECT_GE(one.event.tick, node.edge.start);
          EXPECT_LE(one.event.tick, node.edge.end);
          if (one.cuts) {
            EXPECT_NE(node.kind, TreeKind::decision);
          }
        }
      }
    }
    EXPECT_TRUE(hit);
    EXPECT_GT(theirs, 0);  // written down although it may weigh nothing
  }
}

TEST_F(TreeTest, EdgesLastFromParentToChildAndForcedNodesHaveOne) {
  const DecisionTree tree = expand_tree(setup_, random_state(3), kHorizon, kPlenty);
  int forced = 0;
  for (std::size_t id = 1; id < tree.nodes.size(); ++id) {
    const TreeNode& node = tree.nodes[id];
    const TreeNode& parent = tree.nodes[static_cast<std::size_t>(node.parent)];
    EXPECT_EQ(node.edge.start, parent.tick);
    EXPECT_EQ(node.edge.end, node.tick);
    EXPECT_EQ(node.edge.who, parent.who);
    EXPECT_EQ(node.edge.forced, parent.kind == TreeKind::forced);
    EXPECT_LE(node.tick, tree.start + tree.horizon);
    if (node.kind != TreeKind::forced) continue;
    ++forced;
    EXPECT_EQ(node.children.size(), 1u);
    EXPECT_TRUE(node.pruned.empty());
  }
  EXPECT_GT(forced, 0);
}

TEST_F(TreeTest, PrunedChildrenAreAsManyAsTheGameCounts) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const FightState state = random_state(seed);
    const DecisionTree tree = expand_tree(setup_, state, kHorizon, kPlenty);
    Duel game(setup_, state.now + kHorizon);
    SearchCounts counts;
    minimax(game, Duel::root(setup_, state), counts);
    std::uint64_t beyond = 0, hits = 0, deep = 0, turned = 0;
    for (const TreeNode& node : tree.nodes) {
      beyond += node.beyond;
      const auto count = [&](const std::vector<Pruned>& reasons) {
        for (const Pruned reason : reasons) {
          hits += reason == Pruned::unanswered_hit ? 1 : 0;
          deep += reason == Pruned::penetration ? 1 : 0;
          turned += reason == Pruned::back_turned ? 1 : 0;
        }
      };
      for (const TreePruned& one : node.pruned) count(one.reasons);
      count(node.edge.kept);
    }
    EXPECT_EQ(counts.nodes, tree.nodes.size());
    EXPECT_EQ(beyond, game.counts().candidates);
    EXPECT_EQ(deep, game.counts().penetration);
    EXPECT_LE(hits, game.counts().unanswered_hit);  // two blows of one move are one reason
    EXPECT_LE(turned, game.counts().back_turned);   // less those that were kept
    EXPECT_EQ(hits > 0, game.counts().unanswered_hit > 0);
  }
}

}  // namespace
}  // namespace ringcraft
