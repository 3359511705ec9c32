#include "io/graph_picture.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "base/markup.h"

namespace ringcraft {
namespace {

constexpr int kCell = 6;      // pixels of a field
constexpr int kLabels = 260;  // pixels left of and above the fields
constexpr Tick kSoon = kTicksPerSecond / 4, kLater = kTicksPerSecond;

// Actions by kind, then by name; those that only connect are left out.
std::vector<std::size_t> by_kind(const std::vector<Action>& actions) {
  std::vector<std::size_t> order;
  order.reserve(actions.size());
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (!actions[i].connects) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (actions[a].kind != actions[b].kind) return actions[a].kind < actions[b].kind;
    return actions[a].name < actions[b].name;
  });
  return order;
}

GraphPicture empty_picture(const std::vector<Action>& actions,
                           const std::vector<std::size_t>& order) {
  GraphPicture picture;
  picture.names.reserve(order.size());
  picture.groups.reserve(order.size());
  for (const std::size_t i : order) {
    picture.names.push_back(actions[i].name);
    picture.groups.emplace_back(name_of(actions[i].kind));
  }
  picture.shade.assign(order.size() * order.size(), -1);
  return picture;
}

std::int8_t shade_of_path(const StateMachine& machine, ActionId from, ActionId to) {
  if (machine.edge(from, to) != nullptr) return 0;
  const Path* path = machine.path(from, to);
  if (path == nullptr) return -1;
  if (path->via.empty()) return 0;
  return path->ticks <= kSoon    ? std::int8_t{1}
         : path->ticks <= kLater ? std::int8_t{2}
                                 : std::int8_t{3};
}

std::int8_t shade_of_count(std::uint32_t count) {
  if (count == 0) return -1;
  return count == 1    ? std::int8_t{0}
         : count <= 4  ? std::int8_t{1}
         : count <= 16 ? std::int8_t{2}
                       : std::int8_t{3};
}

std::string text_svg(int x, int y, const char* anchor, int turn, int size,
                     const std::string& text) {
  const std::string turned =
      turn != 0 ? fmt::format(" transform='rotate({} {} {})'", turn, x, y) : "";
  return fmt::format("<text x='{}' y='{}' text-anchor='{}' font-size='{}'{}>{}</text>\n", x, y,
                     anchor, size, turned, escaped(text));
}

// Runs of one shade along each row, one path a shade.
std::string fields_svg(const GraphPicture& picture) {
  const std::size_t count = picture.names.size();
  std::vector<std::string> paths(picture.shades.size());
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      const std::int8_t shade = picture.at(row, begin);
      for (end = begin; end < count && picture.at(row, end) == shade;) ++end;
      if (shade < 0) continue;
      paths[static_cast<std::size_t>(shade)] += fmt::format(
          "M{} {}h{}v{}h-{}z", kLabels + static_cast<int>(begin) * kCell,
          kLabels + static_cast<int>(row) * kCell, static_cast<int>(end - begin) * kCell, kCell - 1,
          static_cast<int>(end - begin) * kCell);
    }
  }
  std::string svg;
  for (std::size_t i = 0; i < paths.size(); ++i)
    svg += fmt::format("<path fill='{}' d='{}'/>\n", picture.shades[i], paths[i]);
  return svg;
}

// Names, and lines with headings around the groups.
std::string frame_svg(const GraphPicture& picture) {
  const int size = static_cast<int>(picture.names.size()) * kCell;
  std::string svg;
  for (std::size_t i = 0; i < picture.names.size(); ++i) {
    const int at = kLabels + static_cast<int>(i) * kCell + kCell - 1;
    svg += text_svg(kLabels - 4, at, "end", 0, kCell, picture.names[i]);
    svg += text_svg(at, kLabels - 4, "start", -90, kCell, picture.names[i]);
  }
  for (std::size_t begin = 0, end = 0; begin < picture.groups.size(); begin = end) {
    for (end = begin; end < picture.groups.size() && picture.groups[end] == picture.groups[begin];)
      ++end;
    const int from = kLabels + static_cast<int>(begin) * kCell;
    const int middle = (from + kLabels + static_cast<int>(end) * kCell) / 2;
    svg += fmt::format("<path stroke='#555' d='M0 {0}H{1}M{0} 0V{1}'/>\n", from, kLabels + size);
    const std::string label = fmt::format("{} {}", picture.groups[begin], end - begin);
    svg += text_svg(12, middle, "middle", -90, 11, label);
    svg += text_svg(middle, 12, "middle", 0, 11, label);
  }
  return svg;
}

}  // namespace

GraphPicture action_graph(const MotionLibrary& library) {
  const std::vector<std::size_t> order = by_kind(library.actions());
  GraphPicture picture = empty_picture(library.actions(), order);
  picture.shades = {"#11623a", "#5fae7b", "#bfe0c9", "#f0d9a8"};
  for (std::size_t row = 0; row < order.size(); ++row)
    for (std::size_t column = 0; column < order.size(); ++column)
      picture.shade[row * order.size() + column] =
          shade_of_path(library.machine(), ActionId(order[row]), ActionId(order[column]));
  return picture;
}

GraphPicture clip_graph(const MotionLibrary& library) {
  const MotionGraph& graph = library.graph();
  std::vector<std::size_t> order = by_kind(library.actions());
  // Clips stand by the names of their actions; one that was dropped since has no row.
  std::vector<std::optional<std::size_t>> row_of(graph.clips.size());
  for (std::size_t clip = 0; clip < graph.clips.size(); ++clip) {
    const ActionId action = library.find(graph.clips[clip].name);
    if (!action.valid()) continue;
    const auto at = std::find(order.begin(), order.end(), action.at());
    if (at != order.end()) row_of[clip] = static_cast<std::size_t>(at - order.begin());
  }
  std::vector<std::uint32_t> count(order.size() * order.size());
  for (const Transition& t : graph.transitions) {
    const auto& row = row_of[static_cast<std::size_t>(t.from_clip)];
    const auto& column = row_of[static_cast<std::size_t>(t.to_clip)];
    if (row && column) ++count[*row * order.size() + *column];
  }
  GraphPicture picture = empty_picture(library.actions(), order);
  picture.shades = {"#cfd9ee", "#8fa9dc", "#4a6fc0", "#1b3a86"};
  std::transform(count.begin(), count.end(), picture.shade.begin(), shade_of_count);
  return picture;
}

std::string picture_svg(const GraphPicture& picture, const std::string& id) {
  const int size = kLabels + static_cast<int>(picture.names.size()) * kCell + 8;
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' class='graph' id='{0}' width='{1}' height='{1}' "
      "data-at='{2}' data-cell='{3}' font-family='sans-serif'>\n"
      "<rect width='{1}' height='{1}' fill='#fff'/>\n{4}{5}</svg>\n",
      id, size, kLabels, kCell, fields_svg(picture), frame_svg(picture));
}

}  // namespace ringcraft
