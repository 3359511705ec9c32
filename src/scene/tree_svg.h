#pragma once
// The picture of a decision's tree, in the manner of the paper's figure: time downward, white and
// black circles, squares at the horizon.

#include <string>

#include "scene/tree_file.h"

namespace ringcraft {

inline constexpr std::size_t kMostDrawn = 140;  // nodes in the picture; tree.json has them all

std::string tree_svg(const SceneTree& scene_tree);

}  // namespace ringcraft
