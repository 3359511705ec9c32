#include "scene/tree_svg.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/markup.h"

namespace ringcraft {
namespace {

// Pixels.
constexpr double kColumn = 30, kStubColumn = 14;
constexpr double kTreeLeft = 70, kTreeTop = 150, kTreeRight = 40;
constexpr double kPerSecond = 330;   // of the time axis, where no edge needs more
constexpr double kLetter = 5.0;      // width of a letter at 9 px
constexpr double kAroundLabel = 30;  // circles and values at both ends of an edge
constexpr double kLeastWidth = 1080;
constexpr double kStub = 16;
constexpr double kBelowLeaf = 60;
constexpr double kBand = 4;  // of the skyline

constexpr const char* kPlannerInk = "#b2501c";
constexpr const char* kOpponentInk = "#2c5282";
constexpr const char* kForcedInk = "#7b3fa0";
constexpr const char* kPrunedInk = "#a3123a";
constexpr const char* kQuietInk = "#77808a";

std::string signed_points(std::int32_t thousandths) {
  return fmt::format("{:+.2f}", std::round(thousandths / 10.0) / 100.0 + 0.0);
}

std::string action_label(const TreeEdge& edge) {
  std::string label = edge.action;
  for (const std::string& next : edge.then) label += " > " + next;
  return label;
}

std::string event_label(const TreeEvent& one) {
  const Event& event = one.event;
  if (event.type == EventType::miss) return "evaded";
  std::string label =
      fmt::format("{} {:.1f}", event.type == EventType::block ? "block" : event.part, event.damage);
  if (event.knockout) return label + " KO";
  if (one.cuts) label += fmt::format(" {}", name_of(event.response));
  return label;
}

std::string stub_label(const TreePruned& pruned) {
  std::string label = pruned.action + ":";
  for (const Pruned reason : pruned.reasons) {
    label += reason == Pruned::unanswered_hit ? " hit unanswered" : " penetration";
  }
  return label;
}

// Moments from top to bottom: edges that take no time still go down.
struct Instant {
  Tick tick = 0;
  int rank = 0;  // edges without duration that lead here
  bool operator<(const Instant& o) const { return tick != o.tick ? tick < o.tick : rank < o.rank; }
};

struct Stub {
  double x = 0;
  std::string label;
  const char* ink = kPrunedInk;
};

struct Drawn {
  double x = 0;
  Instant moment;
  bool shown = false;
  bool opened = false;  // with its children
  std::vector<Stub> stubs;
};

class TreePicture {
 public:
  explicit TreePicture(const SceneTree& of) : of_(of), tree_(of.tree), drawn_(tree_.nodes.size()) {
    select();
    scale();
    skyline_.assign(static_cast<std::size_t>(lowest_ / kBand) + 1, kTreeLeft);
    place(0);
  }

  std::string svg() {
    const double right = std::max(kLeastWidth, next_x_ + kTreeRight);
    const double bottom = lowest_ + 12;
    body_.clear();
    axis(right - kTreeRight);
    for (const Drawn& one : drawn_) stubs(one);
    for (const bool principal : {false, true}) {
      for (std::size_t id = 1; id < drawn_.size(); ++id) {
        if (drawn_[id].shown && at(id).principal == principal) edge(id);
      }
    }
    for (std::size_t id = 0; id < drawn_.size(); ++id) {
      if (drawn_[id].shown) node(id);
    }
    legend();
    return fmt::format(
               "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' "
               "viewBox='0 0 {0:.0f} {1:.0f}' font-family='Helvetica,Arial,sans-serif' "
               "font-size='9'>\n<rect width='100%' height='100%' fill='#ffffff'/>\n",
               right, bottom) +
           body_ + "</svg>\n";
  }

 private:
  const TreeNode& at(std::size_t id) const { return tree_.nodes[id]; }
  double y_of(const Instant& moment) const { return y_.at(moment); }
  const char* ink_of(FighterId who) const {
    return who == tree_.fighter ? kPlannerInk : kOpponentInk;
  }
  const char* fill_of(FighterId who) const { return who == tree_.fighter ? "#ffffff" : "#16181b"; }

  // What was written first is drawn: with all children of a node, or none.
  void select() {
    drawn_[0].shown = true;
    for (std::size_t id = 0; id < drawn_.size(); ++id) {
      if (!drawn_[id].shown || at(id).children.empty()) continue;
      const std::vector<int>& children = at(id).children;
      const int last = *std::max_element(children.begin(), children.end());
      if (id != 0 && last >= static_cast<int>(kMostDrawn)) continue;
      drawn_[id].opened = true;
      for (const int child : children) drawn_[static_cast<std::size_t>(child)].shown = true;
    }
    for (std::size_t id = 0; id < drawn_.size(); ++id) {
      if (!drawn_[id].shown) continue;
      ++shown_;
      drawn_[id].moment = {at(id).tick, 0};
      if (id == 0) continue;
      const Instant& from = drawn_[static_cast<std::size_t>(at(id).parent)].moment;
      if (from.tick == at(id).tick) drawn_[id].moment.rank = from.rank + 1;
    }
  }

  std::size_t band(double y) {
    const auto i = static_cast<std::size_t>(std::max(0.0, y) / kBand);
    if (i >= skyline_.size()) skyline_.resize(i + 1, kTreeLeft);
    return i;
  }
  // The left end of a strip `width` wide, right of all that stands between y0 and y1.
  double take(double y0, double y1, double width) {
    const std::size_t first = band(y0), last = band(y1);
    double x = 0;
    for (std::size_t i = first; i <= last; ++i) x = std::max(x, skyline_[i]);
    for (std::size_t i = first; i <= last; ++i) skyline_[i] = x + width;
    next_x_ = std::max(next_x_, x + width);
    lowest_ = std::max(lowest_, y1);
    return x;
  }

  void add_stub(Drawn& here, std::string label, const char* ink) {
    const double y = y_of(here.moment);
    const double below = kLetter * static_cast<double>(label.size()) + kStub + 12;
    const double x = take(y, y + below, kStubColumn) + kStubColumn / 2;
    here.stubs.push_back({x, std::move(label), ink});
  }

  // The best line from a node stands as one spine, what departs from it to the right of it: so no
  // bar crosses a spine, and the columns beside a short branch are free below it.
  void place(std::size_t id) {
    std::vector<std::size_t> spine{id};
    while (drawn_[spine.back()].opened) {
      spine.push_back(static_cast<std::size_t>(at(spine.back()).children.front()));
    }
    const double top = y_of(drawn_[id == 0 ? 0 : static_cast<std::size_t>(at(id).parent)].moment);
    const double foot = y_of(drawn_[spine.back()].moment) + kBelowLeaf;
    const double x = take(top, foot, kColumn) + kColumn / 2;
    for (const std::size_t one : spine) drawn_[one].x = x;
    for (std::size_t i = spine.size(); i-- > 0;) {
      if (drawn_[spine[i]].opened) branch(spine[i]);
    }
  }

  void branch(std::size_t id) {
    Drawn& here = drawn_[id];
    const std::vector<int>& children = at(id).children;
    for (std::size_t i = 1; i < children.size(); ++i) place(static_cast<std::size_t>(children[i]));
    std::size_t turned = 0;
    for (const TreePruned& one : at(id).pruned) {
      if (one.reasons.front() == Pruned::back_turned) {
        ++turned;
      } else {
        add_stub(here, stub_label(one), kPrunedInk);
      }
    }
    if (turned > 0) add_stub(here, fmt::format("{} turn the back", turned), kPrunedInk);
    if (at(id).beyond > 0) {
      add_stub(here, fmt::format("{} not among the best", at(id).beyond), kQuietInk);
    }
  }

  // The time axis, stretched where an edge is shorter than what is written beside it.
  void scale() {
    struct Span {
      Instant from, to;
      double least;
    };
    std::vector<Span> spans;
    for (std::size_t id = 0; id < drawn_.size(); ++id) {
      if (!drawn_[id].shown) continue;
      y_[drawn_[id].moment] = kTreeTop;
      if (id == 0) continue;
      const TreeEdge& edge = at(id).edge;
      std::size_t letters = action_label(edge).size();
      for (const TreeEvent& one : edge.events) letters = std::max(letters, event_label(one).size());
      spans.push_back({drawn_[static_cast<std::size_t>(at(id).parent)].moment, drawn_[id].moment,
                       kLetter * static_cast<double>(letters) + kAroundLabel});
    }
    double y = kTreeTop;
    const Instant* before = nullptr;
    for (auto& [moment, place] : y_) {
      if (before != nullptr) y += kPerSecond * seconds(moment.tick - before->tick);
      for (const Span& span : spans) {
        const bool ends_here = !(span.to < moment) && !(moment < span.to);
        if (ends_here) y = std::max(y, y_.at(span.from) + span.least);
      }
      place = y;
      before = &moment;
    }
    lowest_ = y + kBelowLeaf;
  }

  double y_at(Tick tick) const {
    auto after = y_.upper_bound({tick, 1 << 20});
    if (after == y_.begin()) return kTreeTop;
    const auto before = std::prev(after);
    if (after == y_.end() || before->first.tick == tick) {
      return y_.lower_bound({std::min(tick, before->first.tick), 0})->second;
    }
    const double share =
        static_cast<double>(tick - before->first.tick) / (after->first.tick - before->first.tick);
    return before->second + share * (after->second - before->second);
  }

  void text(double x, double y, const std::string& what, const std::string& style) {
    body_ += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' paint-order='stroke' stroke='#fff' stroke-width='2.5' "
        "{}>{}</text>\n",
        x, y, style, escaped(what));
  }
  // Reads downward; `x` is the left side of the letters.
  void down(double x, double y, const std::string& what, const std::string& style) {
    text(x, y, what, fmt::format("transform='rotate(90 {:.1f} {:.1f})' {}", x, y, style));
  }

  void axis(double right) {
    const Tick end = tree_.start + tree_.horizon;
    const double foot = y_.rbegin()->second;
    body_ += fmt::format("<path d='M{0:.1f},{1:.1f}V{2:.1f}' stroke='#444' fill='none'/>\n",
                         kTreeLeft - 14, kTreeTop, foot);
    constexpr Tick kEvery = 30;
    const Tick first = (tree_.start + kEvery - 1) / kEvery * kEvery;
    std::vector<Tick> marks;
    for (Tick tick = first; tick < end; tick += kEvery) marks.push_back(tick);
    for (const Tick tick : marks) {
      const double y = y_at(tick);
      body_ += fmt::format("<path d='M{:.1f},{:.1f}H{:.1f}' stroke='#e4e7ea' fill='none'/>\n",
                           kTreeLeft - 18, y, right);
      if (y - kTreeTop < 12 || foot - y < 12) continue;
      text(kTreeLeft - 22, y + 3, fmt::format("{:.2f} s", seconds(tick)), "text-anchor='end'");
    }
    const auto bold = "text-anchor='end' font-weight='bold'";
    text(kTreeLeft - 22, kTreeTop + 3, fmt::format("{:.3f} s", seconds(tree_.start)), bold);
    text(kTreeLeft - 22, foot + 3, fmt::format("{:.3f} s", seconds(end)), bold);
    body_ += fmt::format(
        "<path d='M{:.1f},{:.1f}H{:.1f}' stroke='#444' stroke-dasharray='2,3' fill='none'/>\n",
        kTreeLeft - 18, foot, right);
  }

  void event(const TreeEvent& one, double x, double y0, double y1, const TreeEdge& edge) {
    const Tick length = std::max(1, edge.end - edge.start);
    const double share = std::min(1.0, static_cast<double>(one.event.tick - edge.start) / length);
    const double y = std::min(y0 + share * (y1 - y0), y1 - 9);
    const bool evaded = one.event.type == EventType::miss;
    const char* ink = evaded                               ? "#2f855a"
                      : one.event.type == EventType::block ? "#b7791f"
                                                           : "#d11a2a";
    body_ += fmt::format("<path d='M{:.1f},{:.1f}l4,4l-4,4l-4,-4z' fill='{}'/>\n", x, y - 4, ink);
    const std::string label = event_label(one);
    const double long_enough = kLetter * static_cast<double>(label.size());
    down(x - 12, std::max(y0 + 4, y - 6 - long_enough), label, fmt::format("fill='{}'", ink));
  }

  void edge(std::size_t id) {
    const TreeNode& child = at(id);
    const Drawn& to = drawn_[id];
    const Drawn& from = drawn_[static_cast<std::size_t>(child.parent)];
    const double y0 = y_of(from.moment), y1 = y_of(to.moment);
    const std::string path = fmt::format("M{:.1f},{:.1f}H{:.1f}V{:.1f}", from.x, y0, to.x, y1);
    if (child.chosen) {
      body_ += fmt::format("<path d='{}' stroke='#ffe08a' stroke-width='10' fill='none'/>\n", path);
    }
    const char* ink = child.edge.forced ? kForcedInk : ink_of(child.edge.who);
    body_ += fmt::format("<path d='{}' stroke='{}' stroke-width='{}' fill='none'{}/>\n", path, ink,
                         child.principal ? "3.6" : "1.3",
                         child.edge.forced ? " stroke-dasharray='5,3'" : "");
    down(to.x + (child.principal ? 5.5 : 4.5), y0 + 9, action_label(child.edge),
         fmt::format("fill='{}'{}", ink, child.principal ? " font-weight='bold'" : ""));
    for (const TreeEvent& one : child.edge.events) event(one, to.x, y0, y1, child.edge);
  }

  void stubs(const Drawn& drawn) {
    if (drawn.stubs.empty()) return;
    const double x = drawn.x, y = y_of(drawn.moment);
    for (const Stub& stub : drawn.stubs) {
      body_ += fmt::format(
          "<path d='M{:.1f},{:.1f}H{:.1f}v{:.1f}' stroke='{}' fill='none' "
          "stroke-width='0.8'/><path d='M{:.1f},{:.1f}h6' stroke='{}'/>\n",
          x, y, stub.x, kStub, stub.ink, stub.x - 3, y + kStub, stub.ink);
      down(stub.x - 3, y + kStub + 5, stub.label, fmt::format("fill='{}'", stub.ink));
    }
  }

  void node(std::size_t id) {
    const TreeNode& here = at(id);
    const Drawn& drawn = drawn_[id];
    const double x = drawn.x, y = y_of(drawn.moment);
    const std::string value = signed_points(here.value) + (here.exact ? "" : "?");
    const char* weight = here.principal ? "font-weight='bold'" : "";
    if (here.kind == TreeKind::terminal) {
      body_ += fmt::format(
          "<rect x='{:.1f}' y='{:.1f}' width='9' height='9' fill='{}' stroke='#16181b'/>\n",
          x - 4.5, y - 4.5, fill_of(here.edge.who));
      down(x - 3, y + 9, value, weight);
      return;
    }
    body_ +=
        fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='5.5' fill='{}' stroke='{}'{}/>\n", x, y,
                    fill_of(here.who), here.kind == TreeKind::forced ? kForcedInk : "#16181b",
                    here.kind == TreeKind::forced ? " stroke-width='2.4' stroke-dasharray='3,2'"
                                                  : " stroke-width='1.2'");
    if (drawn.opened) {
      text(x + 7, y - 4, value, weight);
      return;
    }
    body_ += fmt::format(
        "<path d='M{0:.1f},{1:.1f}v9l-4,8h8l-4,-8' stroke='{2}' fill='{2}' "
        "stroke-width='0.8'/>\n",
        x, y + 6, kQuietInk);
    down(x - 3, y + 28, value, fmt::format("fill='{}'", kQuietInk));
  }

  void legend() {
    const TreeNode& root = at(0);
    const std::string planner = of_.name(tree_.fighter), other = of_.name(tree_.opponent);
    text(kTreeLeft - 14, 24,
         fmt::format("{}: {} decides at {:.3f} s, {:.2f} s ahead, value {} points", of_.scene,
                     planner, seconds(tree_.start), seconds(tree_.horizon),
                     signed_points(root.value)),
         "font-size='15' font-weight='bold'");
    text(kTreeLeft - 14, 41,
         fmt::format("Style {}, leaf {}. Values: points for {} on the best line, by minimax. Time "
                     "runs downward, stretched where an edge is shorter than its name.",
                     of_.style, of_.leaf == LeafValue::paper ? "S_A - S_B" : "weighted", planner),
         "font-size='11'");
    std::string left = "The whole tree.";
    if (!tree_.complete() || shown_ < drawn_.size()) {
      left = fmt::format(
          "Drawn: {} of the {} nodes of tree.json, the best lines first; {} of those nodes are not "
          "expanded further, but have the value of a search to the horizon.",
          shown_, drawn_.size(), tree_.unexpanded);
    }
    text(kTreeLeft - 14, 57, left, "font-size='11'");
    const double y = 80;
    double x = kTreeLeft - 8;
    const auto entry = [&](const std::string& shape, double width, const std::string& what) {
      body_ += fmt::format("<g transform='translate({:.1f} {:.1f})'>{}</g>\n", x, row_, shape);
      text(x + width, row_ + 3.5, what, "font-size='10.5'");
      x += width + 5.6 * static_cast<double>(what.size()) + 16;
    };
    row_ = y;
    const auto line = [](const char* ink, const char* more) {
      return fmt::format("<path d='M-4,0H18' stroke='{}' stroke-width='1.3' fill='none' {}/>", ink,
                         more);
    };
    entry("<circle r='5.5' fill='#fff' stroke='#16181b'/>", 10, planner + " acts");
    entry("<circle r='5.5' fill='#16181b'/>", 10, other + " acts");
    entry(fmt::format("<circle r='5.5' fill='#fff' stroke='{}' stroke-width='2.4' "
                      "stroke-dasharray='3,2'/>",
                      kForcedInk),
          10, "forced: one edge");
    entry("<rect x='-4.5' y='-4.5' width='9' height='9' fill='#fff' stroke='#16181b'/>", 10,
          "end of the route, t_f");
    entry(fmt::format("<path d='M0,-7v5l-4,8h8l-4,-8' fill='{0}' stroke='{0}'/>", kQuietInk), 10,
          "not expanded further");
    entry("<path d='M0,-5l5,5l-5,5l-5,-5z' fill='#d11a2a'/>", 9, "hit");
    entry("<path d='M0,-5l5,5l-5,5l-5,-5z' fill='#b7791f'/>", 9, "block");
    entry("<path d='M0,-5l5,5l-5,5l-5,-5z' fill='#2f855a'/>", 9, "evaded");
    row_ = y + 20;
    x = kTreeLeft - 8;
    entry(line(kPlannerInk, ""), 23, "action of " + planner);
    entry(line(kOpponentInk, ""), 23, "of " + other);
    entry(line(kForcedInk, "stroke-dasharray='5,3'"), 23, "response, get-up or rest of a path");
    entry("<path d='M-4,0H18' stroke='#444' stroke-width='3.6'/>", 23, "principal variation");
    entry("<path d='M-4,0H18' stroke='#ffe08a' stroke-width='10'/>", 23, "taken in the fight");
    entry(line(kPrunedInk, ""), 23, "pruned, with its reason");
  }

  const SceneTree& of_;
  const DecisionTree& tree_;
  std::vector<Drawn> drawn_;
  std::map<Instant, double> y_;
  std::vector<double> skyline_;  // by bands of y: where the next column may begin
  std::size_t shown_ = 0;
  double next_x_ = kTreeLeft, lowest_ = 0, row_ = 0;
  std::string body_;
};

}  // namespace

std::string tree_svg(const SceneTree& scene_tree) {
  return TreePicture(scene_tree).svg();
}

}  // namespace ringcraft
