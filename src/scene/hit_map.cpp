#include "scene/hit_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/markup.h"

namespace ringcraft {
namespace {

// From light to dark as the hit does more, so that it reads without colour too.
struct Look {
  const char* name;
  const char* colour;
};
constexpr std::array<Look, 6> kLooks = {{{"absorbs", "#e3eaf0"},
                                         {"1 step", "#fbe08d"},
                                         {"2 steps", "#f6ab4f"},
                                         {"3 steps", "#e2683a"},
                                         {"falls", "#a91f3c"},
                                         {"knocked out", "#34194a"}}};

std::size_t look_of(const ImpactOutcome& outcome) {
  if (outcome.knockout) return 5;
  if (outcome.response == ResponseKind::knockdown) return 4;
  if (outcome.response == ResponseKind::absorb) return 0;
  return static_cast<std::size_t>(std::clamp(outcome.steps, 1, 3));
}

struct Span {
  double from = 0, to = 0;
  double middle() const { return (from + to) / 2; }
};

// What each value stands for: up to halfway to its neighbours.
std::vector<Span> spans_of(const std::vector<double>& values, double step_of_one) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double after = i + 1 < values.size() ? values[i + 1] - values[i]
                         : i > 0               ? values[i] - values[i - 1]
                                               : step_of_one;
    const double before = i > 0 ? values[i] - values[i - 1] : after;
    spans.push_back({values[i] - before / 2, values[i] + after / 2});
  }
  return spans;
}

// A round distance of marks: about `most` of them over `range`.
double mark_step(double range, int most) {
  const double raw = std::max(range, 1e-9) / most;
  const double ten = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double times : {1.0, 2.0, 2.5, 5.0}) {
    if (raw <= ten * times * (1 + 1e-9)) return ten * times;
  }
  return ten * 10;
}

std::string label_of(SweepAxis axis) {
  const std::string_view unit = unit_of(axis);
  return unit.empty() ? std::string(name_of(axis)) : fmt::format("{} ({})", name_of(axis), unit);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    int size = 13) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n", x, y,
      anchor, size, escaped(text));
}

constexpr double kMapPanel = 600, kMapTop = 84, kMapLegend = 60;  // px
constexpr double kSquare = 540, kStrip = 150;                     // px: heights of a panel

// One panel's values over two axes: points[row of `outer`][column of `inner`].
struct MapPanel {
  std::string title;
  SweepRange across, along;  // polar: across is the direction, along the impulse
  std::vector<std::vector<const SweepPoint*>> points;  // [along][across]
};

class Drawing {
 public:
  void panel(const MapPanel& panel, bool polar, double left) {
    left_ = left;
    if (!panel.title.empty())
      svg_ += text_at(left + kMapPanel / 2, kMapTop - 20, "middle", panel.title);
    polar ? draw_polar(panel) : draw_grid(panel);
  }
  const std::string& svg() const { return svg_; }

 private:
  void draw_polar(const MapPanel& panel) {
    constexpr double kRadius = 215;  // px
    const double cx = left_ + kMapPanel / 2, cy = kMapTop + kSquare / 2 - 10;
    const std::vector<Span> ways = spans_of(panel.across.values, 30);
    const std::vector<Span> sizes = spans_of(panel.along.values, 10);
    const double most = sizes.back().to;
    const auto radius = [&](double impulse) { return kRadius * std::max(0.0, impulse) / most; };
    const auto point = [&](double r, double way) {
      const double a = way * static_cast<double>(kPi) / 180;
      return fmt::format("{:.2f},{:.2f}", cx - r * std::sin(a), cy - r * std::cos(a));
    };
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (std::size_t j = 0; j < ways.size(); ++j) {
        const SweepPoint& p = *panel.points[i][j];
        if (!p.done) continue;
        const double inner = radius(sizes[i].from), outer = radius(sizes[i].to);
        std::string corners;
        constexpr int kPieces = 4;  // of an arc
        for (int k = 0; k <= kPieces; ++k) {
          const double way = ways[j].from + (ways[j].to - ways[j].from) * k / kPieces;
          corners += point(outer, way) + " ";
        }
        for (int k = kPieces; k >= 0; --k) {
          const double way = ways[j].from + (ways[j].to - ways[j].from) * k / kPieces;
          corners += point(inner, way) + " ";
        }
        const char* colour = kLooks[look_of(p.outcome)].colour;
        svg_ +=
            fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"0.6\"/>\n",
                        corners, colour, colour);
      }
    }
    const double step = mark_step(most, 5);
    for (double mark = step; mark <= most; mark += step) {
      svg_ += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.2f}\" fill=\"none\" stroke=\"#000\" "
          "stroke-opacity=\"0.35\" stroke-dasharray=\"2 3\"/>\n",
          cx, cy, radius(mark));
      svg_ += ring_label(cx, cy, radius(mark), fmt::format("{:g}", mark));
    }
    for (int way = 0; way < 360; way += 45) {
      static constexpr std::array<const char*, 8> kWays = {"fore", "", "own left",  "",
                                                           "back", "", "own right", ""};
      const double a = way * static_cast<double>(kPi) / 180;
      const double x = cx - (kRadius + 10) * std::sin(a);
      const double y = cy - (kRadius + 18) * std::cos(a) + 4;
      const char* anchor = way % 180 == 0 ? "middle" : way < 180 ? "end" : "start";
      const std::string name = kWays[static_cast<std::size_t>(way / 45)];
      const std::string degrees = fmt::format("{}°", way);
      const bool beside = way % 180 != 0;
      svg_ += text_at(x, y, anchor,
                      beside || name.empty() ? degrees : fmt::format("{} {}", name, degrees), 12);
      if (beside && !name.empty()) svg_ += text_at(x, y - 15, anchor, name, 12);
    }
    svg_ += text_at(cx, cy + kRadius + 46, "middle",
                    "seen from above; outward: impulse (N s), around: where it pushes");
  }

  // White behind, so that it can be read on every colour.
  static std::string ring_label(double cx, double cy, double r, const std::string& text) {
    const double a = 22.5 * static_cast<double>(kPi) / 180;
    const double x = cx + r * std::sin(a), y = cy - r * std::cos(a) + 4;
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"11\" stroke=\"#fff\" "
        "stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>\n",
        x, y, text);
  }

  void draw_grid(const MapPanel& panel) {
    constexpr double kLeft = 70, kRight = 20, kBelow = 60;
    const double x0 = left_ + kLeft, x1 = left_ + kMapPanel - kRight;
    const bool line = panel.along.values.size() == 1;  // one axis only: a strip
    const double y0 = kMapTop, y1 = kMapTop + (line ? kStrip : kSquare) - kBelow;
    const std::vector<Span> xs = spans_of(panel.across.values, 1);
    const std::vector<Span> ys = spans_of(panel.along.values, 1);
    const auto x = [&](double v) {
      return x0 + (x1 - x0) * (v - xs.front().from) / (xs.back().to - xs.front().from);
    };
    const auto y = [&](double v) {
      return y1 - (y1 - y0) * (v - ys.front().from) / (ys.back().to - ys.front().from);
    };
    for (std::size_t i = 0; i < ys.size(); ++i) {
      for (std::size_t j = 0; j < xs.size(); ++j) {
        const SweepPoint& p = *panel.points[i][j];
        if (!p.done) continue;
        const char* colour = kLooks[look_of(p.outcome)].colour;
        svg_ += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
            "stroke=\"{}\" stroke-width=\"0.6\"/>\n",
            x(xs[j].from), y(ys[i].to), x(xs[j].to) - x(xs[j].from), y(ys[i].from) - y(ys[i].to),
            colour, colour);
      }
    }
    svg_ += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#000\"/>\n",
        x0, y0, x1 - x0, y1 - y0);
    const auto marks = [&](const std::vector<Span>& spans, const auto& draw) {
      const double from = spans.front().from, to = spans.back().to;
      const double step = mark_step(to - from, 8);
      for (double v = std::ceil(from / step) * step; v <= to + 1e-9; v += step) {
        draw(v, fmt::format("{:g}", std::abs(v) < 1e-12 ? 0.0 : v));
      }
    };
    marks(xs, [&](double v, const std::string& text) {
      svg_ += fmt::format("<path d=\"M{:.1f} {:.1f}v5\" stroke=\"#000\"/>\n", x(v), y1);
      svg_ += text_at(x(v), y1 + 20, "middle", text, 12);
    });
    svg_ += text_at((x0 + x1) / 2, y1 + 44, "middle", label_of(panel.across.axis));
    if (line) return;
    marks(ys, [&](double v, const std::string& text) {
      svg_ += fmt::format("<path d=\"M{:.1f} {:.1f}h-5\" stroke=\"#000\"/>\n", x0, y(v));
      svg_ += text_at(x0 - 8, y(v) + 4, "end", text, 12);
    });
    svg_ += fmt::format(
        "<text transform=\"translate({:.1f},{:.1f}) rotate(-90)\" text-anchor=\"middle\" "
        "font-size=\"13\">{}</text>\n",
        left_ + 18, (y0 + y1) / 2, label_of(panel.along.axis));
  }

  double left_ = 0;
  std::string svg_;
};

// Which of the sweep's axes lie across and along a panel; the rest makes panels.
struct Order {
  std::size_t across = 0;
  std::optional<std::size_t> along;
  bool polar = false;
};

Order order_of(const HitSweep& sweep) {
  std::optional<std::size_t> way, size;
  std::vector<std::size_t> wide;
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    const SweepRange& range = sweep.ranges[i];
    if (range.values.size() < 2) continue;
    wide.push_back(i);
    if (range.axis == SweepAxis::direction) way = i;
    if (range.axis == SweepAxis::impulse) size = i;
  }
  if (way && size) return {*way, size, true};
  if (wide.empty()) return {};
  return {wide[0], wide.size() > 1 ? std::optional(wide[1]) : std::nullopt, false};
}

std::vector<MapPanel> panels_of(const HitSweep& sweep, const Order& order) {
  std::vector<std::size_t> stride(sweep.ranges.size(), 1);
  for (std::size_t i = sweep.ranges.size(); i-- > 1;) {
    stride[i - 1] = stride[i] * sweep.ranges[i].values.size();
  }
  std::optional<std::size_t> rest;
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    if (i != order.across && i != order.along && sweep.ranges[i].values.size() > 1) rest = i;
  }
  std::vector<MapPanel> panels;
  const std::size_t count = rest ? sweep.ranges[*rest].values.size() : 1;
  for (std::size_t k = 0; k < count; ++k) {
    MapPanel panel;
    panel.across = sweep.ranges[order.across];
    if (order.along) {
      panel.along = sweep.ranges[*order.along];
    } else {
      panel.along.values = {0};
    }
    const std::size_t base = rest ? k * stride[*rest] : 0;
    if (rest) {
      panel.title =
          fmt::format("{} {:g}", label_of(sweep.ranges[*rest].axis), sweep.ranges[*rest].values[k]);
    }
    for (std::size_t i = 0; i < panel.along.values.size(); ++i) {
      std::vector<const SweepPoint*> row;
      for (std::size_t j = 0; j < panel.across.values.size(); ++j) {
        const std::size_t up = order.along ? i * stride[*order.along] : 0;
        row.push_back(&sweep.points[base + up + j * stride[order.across]]);
      }
      panel.points.push_back(std::move(row));
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

std::string legend(const HitSweep& sweep, double width, double y) {
  std::array<std::size_t, kLooks.size()> counts{};
  for (const SweepPoint& point : sweep.points) {
    if (point.done) ++counts[look_of(point.outcome)];
  }
  std::string svg;
  const double each = 92;
  double x = std::max(8.0, (width - each * static_cast<double>(kLooks.size())) / 2);
  for (std::size_t i = 0; i < kLooks.size(); ++i, x += each) {
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"14\" fill=\"{}\" "
        "stroke=\"#555\"/>\n",
        x, y, kLooks[i].colour);
    svg += text_at(x + 19, y + 12, "start", kLooks[i].name, 12);
    svg += text_at(x + 19, y + 27, "start", fmt::format("{} of {}", counts[i], sweep.points.size()),
                   10);
  }
  return svg;
}

}  // namespace

std::string sweep_svg(const HitSweep& sweep) {
  const Order order = order_of(sweep);
  const std::vector<MapPanel> panels = panels_of(sweep, order);
  const double width = kMapPanel * static_cast<double>(panels.size());
  const double tall = order.along ? kSquare : kStrip;
  const double height = kMapTop + tall + kMapLegend;
  Drawing drawing;
  double left = 0;
  for (const MapPanel& panel : panels) {
    drawing.panel(panel, order.polar, left);
    left += kMapPanel;
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  svg += text_at(width / 2, 24, "middle", sweep.title, 14);
  svg += text_at(width / 2, 43, "middle", sweep.what, 13);
  return svg + drawing.svg() + legend(sweep, width, kMapTop + tall + 16) + "</svg>\n";
}

}  // namespace ringcraft
