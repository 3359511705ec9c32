#include "scene/tree_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "default_library.h"

namespace ringcraft {
namespace {

SceneFile duel() {
  auto scene =
      read_scene("duel", {"duration_s=3", "fighter.0.horizon_s=1.25", "fighter.1.horizon_s=1.25"});
  if (!scene) throw std::runtime_error(to_string(scene.error()));
  return std::move(*scene);
}

constexpr std::size_t kNodes = 90;

SceneTree tree_of(double at_s, std::size_t nodes = kNodes) {
  auto tree = tree_at(default_library(), duel(), at_s, nodes);
  if (!tree) throw std::runtime_error(to_string(tree.error()));
  return std::move(*tree);
}

TEST(TreeOfScene, IsThatOfTheFirstDecisionFromThatTime) {
  const FightRecord fight = simulate_fight(default_library(), duel());
  const auto decision = std::find_if(
      fight.timeline.events.begin(), fight.timeline.events.end(), [](const Event& event) {
        return event.type == EventType::decision && event.tick >= ticks(1.5);
      });
  ASSERT_NE(decision, fight.timeline.events.end());
  const SceneTree tree = tree_of(1.5);
  EXPECT_EQ(tree.tree.start, decision->tick);
  EXPECT_EQ(tree.tree.fighter, decision->who);
  EXPECT_EQ(tree.planned.nodes, decision->decision.nodes);
  // The planner's lines are those of the tree: exact, or an upper bound where the draw of its soft
  // choice left a move behind, be it the best.
  const std::vector<TreeNode>& nodes = tree.tree.nodes;
  std::int32_t best = decision->decision.lines[0].score;
  for (const Line& line : decision->decision.lines) {
    const auto is_of = [&](int id) {
      const TreeNode& node = nodes[static_cast<std::size_t>(id)];
      return node.edge.action == line.actions[0] &&
             (line.at_most ? node.value <= line.score : node.value == line.score);
    };
    EXPECT_TRUE(std::any_of(nodes[0].children.begin(), nodes[0].children.end(), is_of))
        << line.actions[0] << " " << line.score;
    best = std::max(best, line.score);
  }
  EXPECT_GE(nodes[0].value, decision->decision.lines[0].score);
  EXPECT_LE(nodes[0].value, best);
  int chosen = 0;
  for (const TreeNode& node : tree.tree.nodes) {
    if (!node.chosen) continue;
    ++chosen;
    EXPECT_EQ(node.edge.action, decision->action);
  }
  EXPECT_EQ(chosen, 1);
}

TEST(TreeOfScene, SameBytesTwiceAndForTwoThreads) {
  const SceneTree a = tree_of(1), b = tree_of(1);
  FightOptions two;
  two.threads = 2;
  const auto c = tree_at(default_library(), duel(), 1, kNodes, two);
  ASSERT_TRUE(c);
  for (const SceneTree* other : {&b, &*c}) {
    EXPECT_EQ(tree_json(a), tree_json(*other));
    EXPECT_EQ(tree_svg(a), tree_svg(*other));
    EXPECT_EQ(tree_text(a), tree_text(*other));
  }
}

TEST(TreeOfScene, JsonHoldsEveryNodeOnceWithItsParent) {
  const SceneTree tree = tree_of(1);
  const auto json = nlohmann::json::parse(tree_json(tree));
  const auto& nodes = json.at("nodes");
  ASSERT_EQ(nodes.size(), tree.tree.nodes.size());
  EXPECT_LE(nodes.size(), kNodes);
  EXPECT_EQ(json.at("left_out").at("unexpanded").get<std::size_t>(), tree.tree.unexpanded);
  EXPECT_GT(tree.tree.unexpanded, 0u);
  std::size_t children = 0, principal = 0;
  for (std::size_t id = 0; id < nodes.size(); ++id) {
    EXPECT_EQ(nodes[id].at("id").get<std::size_t>(), id);
    children += nodes[id].at("children").size();
    principal += nodes[id].at("principal").get<bool>() ? 1 : 0;
    if (id == 0) continue;
    const auto parent = nodes[id].at("parent").get<std::size_t>();
    EXPECT_LT(parent, id);
    EXPECT_EQ(nodes[id].at("edge").at("start_tick"), nodes[parent].at("tick"));
    double sum = 0;
    for (const auto& [name, terms] : nodes[id].at("edge").at("terms").items()) {
      sum += terms.at("credited").get<double>();
    }
    EXPECT_NEAR(nodes[id].at("gained").get<double>() - nodes[parent].at("gained").get<double>(),
                sum, 1e-9);
  }
  EXPECT_EQ(children, nodes.size() - 1);
  EXPECT_EQ(principal, line_from(tree.tree, 0).size());
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(TreeOfScene, PictureDrawsEveryNodeAndNoMoreThanItSays) {
  const SceneTree small = tree_of(1);
  std::size_t terminals = 0;
  for (const TreeNode& node : small.tree.nodes) {
    terminals += node.kind == TreeKind::terminal ? 1 : 0;
  }
  const std::string svg = tree_svg(small);
  EXPECT_EQ(count_of(svg, "<circle cx"), small.tree.nodes.size() - terminals);
  EXPECT_EQ(count_of(svg, "<rect x='") - 1, terminals);  // one is the legend's
  for (const char* no_number : {"'nan", "'-nan", "'inf", "Mnan", ",nan"}) {
    EXPECT_EQ(svg.find(no_number), std::string::npos) << no_number;
  }
  const SceneTree large = tree_of(1, 500);
  ASSERT_GT(large.tree.nodes.size(), kMostDrawn);
  const std::string cut = tree_svg(large);
  const std::size_t drawn = count_of(cut, "<circle cx") + count_of(cut, "<rect x='") - 1;
  EXPECT_LE(drawn, kMostDrawn);
  EXPECT_NE(cut.find("Drawn: " + std::to_string(drawn) + " of the "), std::string::npos);
}

TEST(TreeOfScene, NamesInThePictureAreEscaped) {
  SceneTree tree = tree_of(1);
  tree.names[0] = "a<b>&c";
  const std::string svg = tree_svg(tree);
  EXPECT_NE(svg.find("a&lt;b&gt;&amp;c"), std::string::npos);
  EXPECT_EQ(svg.find("a<b"), std::string::npos);
}

TEST(TreeOfScene, TimesOutsideAreUsageErrors) {
  for (const double at_s : {-0.5, 3.0, 99.0, std::nan(""), 1e300}) {
    const auto tree = tree_at(default_library(), duel(), at_s, kNodes);
    ASSERT_FALSE(tree) << at_s;
    EXPECT_EQ(tree.error().kind, ErrorKind::usage);
    EXPECT_EQ(tree.error().place, "--at");
  }
  // The last decision is past: the fight goes on, but nobody chooses any more.
  SceneFile scene = duel();
  Tick last = 0;
  do {  // a fight that does not end with a decision
    scene.duration -= 12;
    last = 0;
    for (const Event& event : simulate_fight(default_library(), scene).timeline.events) {
      if (event.type == EventType::decision) last = event.tick;
    }
  } while (last + 1 >= scene.duration);
  const auto late = tree_at(default_library(), scene, seconds(last + 1), kNodes);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, ErrorKind::usage);
  EXPECT_NE(late.error().what.find("last decision"), std::string::npos);
  const double named = std::stod(late.error().remedy.substr(late.error().remedy.rfind(" to ") + 4));
  EXPECT_NEAR(named, seconds(last), 0.001);
  EXPECT_TRUE(tree_at(default_library(), scene, named, kNodes));
  // One that is over before anybody chooses.
  scene.duration = 12;
  const auto none = tree_at(default_library(), scene, 0.05, kNodes);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("nobody decides"), std::string::npos);
}

}  // namespace
}  // namespace ringcraft
