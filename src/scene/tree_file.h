#pragma once
// The tree of one decision of a fight: run the scene up to it, write it out, tell its best lines.

#include "planner/tree.h"
#include "scene/fight.h"

namespace ringcraft {

struct SceneTree {
  std::string scene;
  std::uint64_t seed = 0;
  double asked_s = 0;              // the time that was asked for
  std::vector<std::string> names;  // of the fighters
  std::string style;               // of the one that decides
  LeafValue leaf = LeafValue::weighted;
  DecisionRecord planned;  // what the planner itself says of this decision
  DecisionTree tree;

  const std::string& name(FighterId id) const { return names[id.at()]; }
};

// The first decision at or after `at_s` seconds. Errors: a time outside the scene, a fight that
// ends before.
Result<SceneTree> tree_at(const MotionLibrary& library, const SceneFile& scene, double at_s,
                          std::size_t most_nodes, const FightOptions& options = {});

// tree.json: one node a line. Times in s beside ticks, values in points for the deciding fighter.
std::string tree_json(const SceneTree& scene_tree);

// The best three lines with every term of the evaluation.
std::string tree_text(const SceneTree& scene_tree);

}  // namespace ringcraft
