#pragma once
// Pictures of the graphs of a library, for looking: which action leads where, and between which
// clips the motion graph has transitions. Rows and columns stand by kind, then by name.

#include <string>
#include <vector>

#include "motion/library.h"

namespace ringcraft {

// A square picture of fields, one row and one column an entry.
struct GraphPicture {
  std::vector<std::string> names;   // of rows and columns
  std::vector<std::string> groups;  // of the same, equal ones side by side
  std::vector<std::string> shades;  // colours that fields may have
  std::vector<std::int8_t> shade;   // row by row: which of them, -1 for none
  std::int8_t at(std::size_t row, std::size_t column) const {
    return shade[row * names.size() + column];
  }
};

// From the end of the row's action to the start of the column's: 0 directly, 1 in up to 0.25 s on
// the way, 2 in up to 1 s, 3 later, -1 not at all. Actions that only connect are left out.
GraphPicture action_graph(const MotionLibrary& library);

// Transitions of the motion graph out of the row's clip into the column's: 0 for 1, 1 for up to
// 4, 2 for up to 16, 3 for more.
GraphPicture clip_graph(const MotionLibrary& library);

// SVG of class `graph`; a page can say what is under the pointer: fields begin data-at pixels from
// the left and the top and are data-cell wide.
std::string picture_svg(const GraphPicture& picture, const std::string& id);

}  // namespace ringcraft
