// The picture of a study: panels beside each other, each with its axes, series and intervals.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/markup.h"
#include "scene/study.h"

namespace ringcraft {
namespace {

// Pixels.
constexpr double kPanel = 440, kPanelHeight = 320, kGap = 30;
constexpr double kLeft = 62, kTop = 54, kRight = 14, kBottom = 52;
constexpr double kTitleHeight = 40, kLegendLine = 15;
constexpr std::size_t kPanelsARow = 2;
constexpr std::array<const char*, 6> kInks{"#1c6fb2", "#b2501c", "#2f855a",
                                           "#7b3fa0", "#a3123a", "#77808a"};

// A step of 1, 2 or 5 times a power of ten that cuts `span` into about `parts`.
double round_step(double span, int parts) {
  const double rough = std::max(span, 1e-9) / parts;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * power) return factor * power;
  }
  return 10 * power;
}

struct Range {
  double low = 0, high = 1;
};

// What holds every value, widened to whole steps; zero belongs to it.
Range range_of(const StudyChart& chart, bool of_x) {
  Range range{0, 0};
  bool first = of_x;
  const auto take = [&](double value) {
    if (!std::isfinite(value)) return;
    if (first) range = {value, value};
    first = false;
    range = {std::min(range.low, value), std::max(range.high, value)};
  };
  for (const StudySeries& series : chart.series) {
    for (const StudyPoint& point : series.points) {
      take(of_x ? point.x : point.y);
      if (!of_x && point.low) take(*point.low);
      if (!of_x && point.high) take(*point.high);
    }
  }
  if (!of_x && chart.bar) take(*chart.bar);
  if (of_x && !chart.ticks.empty()) {
    return {-0.5, static_cast<double>(chart.ticks.size()) - 0.5};
  }
  if (range.high - range.low < 1e-9) range.high = range.low + 1;
  if (of_x) {
    const double margin = 0.04 * (range.high - range.low);
    return {range.low - margin, range.high + margin};
  }
  const double step = round_step(range.high - range.low, 5);
  return {std::floor(range.low / step) * step, std::ceil(range.high / step) * step};
}

class Panel {
 public:
  Panel(const StudyChart& chart, double left, double top)
      : chart_(chart),
        left_(left),
        top_(top),
        x_(range_of(chart, true)),
        y_(range_of(chart, false)) {}

  std::string svg() const {
    std::string out = fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"14\" font-weight=\"600\">{}</text>\n",
        left_ + kLeft, top_ + 16, escaped(chart_.title));
    out += axes();
    for (std::size_t i = 0; i < chart_.series.size(); ++i) out += series(i);
    return out;
  }

 private:
  double at_x(double x) const {
    return left_ + kLeft + (x - x_.low) / (x_.high - x_.low) * (kPanel - kLeft - kRight);
  }
  double at_y(double y) const {
    return top_ + kPanelHeight - kBottom -
           (y - y_.low) / (y_.high - y_.low) * (kPanelHeight - kTop - kBottom);
  }

  std::string axes() const {
    std::string out;
    const double right = left_ + kPanel - kRight, bottom = top_ + kPanelHeight - kBottom;
    const double step = round_step(y_.high - y_.low, 5);
    for (double y = y_.low; y < y_.high + step / 2; y += step) {
      out += fmt::format(
          "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#e2e6ea\"/>"
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" fill=\"#555\">{:.4g}</text>\n",
          left_ + kLeft, at_y(y), right, left_ + kLeft - 6, at_y(y) + 4,
          std::abs(y) < step / 1000 ? 0.0 : y);
    }
    const auto tick = [&](double x, const std::string& text) {
      out += fmt::format(
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#555\">{}</text>\n",
          at_x(x), bottom + 16, escaped(text));
    };
    if (!chart_.ticks.empty()) {
      for (std::size_t i = 0; i < chart_.ticks.size(); ++i) {
        tick(static_cast<double>(i), chart_.ticks[i]);
      }
    } else {
      const double x_step = round_step(x_.high - x_.low, 6);
      for (double x = std::ceil(x_.low / x_step) * x_step; x <= x_.high; x += x_step) {
        tick(x, fmt::format("{:.4g}", std::abs(x) < x_step / 1000 ? 0.0 : x));
      }
    }
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#555\"/>\n", left_ + kLeft,
                       bottom, right);
    if (chart_.bar) {
      out += fmt::format(
          "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#333\" stroke-dasharray=\"5 4\"/>\n",
          left_ + kLeft, at_y(*chart_.bar), right);
    }
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       (left_ + kLeft + right) / 2, bottom + 36, escaped(chart_.x));
    out += fmt::format(
        "<text x=\"{0:.1f}\" y=\"{1:.1f}\" transform=\"rotate(-90 {0:.1f} {1:.1f})\" "
        "text-anchor=\"middle\">{2}</text>\n",
        left_ + 16, (top_ + kTop + bottom) / 2, escaped(chart_.y));
    return out;
  }

  std::string series(std::size_t i) const {
    const StudySeries& one = chart_.series[i];
    const char* ink = kInks[i % kInks.size()];
    std::string out, path;
    for (const StudyPoint& point : one.points) {
      if (!std::isfinite(point.y)) continue;
      const double x = at_x(point.x) + nudge(i), y = at_y(point.y);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
      if (point.low && point.high) {
        out += fmt::format(
            "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}m-4 0h8M{3:.1f} {1:.1f}h8\" stroke=\"{4}\" "
            "fill=\"none\"/>\n",
            x, at_y(*point.low), at_y(*point.high), x - 4, ink);
      }
      if (!chart_.dots) continue;
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x, y, ink);
    }
    if (chart_.joined && !path.empty()) {
      out += fmt::format("<path d=\"{}\" stroke=\"{}\" fill=\"none\" stroke-width=\"1.5\"/>\n",
                         path, ink);
    }
    if (one.name.empty()) return out;
    const double across = (kPanel - kLeft - kRight) / 3;
    const double x = left_ + kLeft + static_cast<double>(i % 3) * across;
    const auto row = i / 3;
    const double y = top_ + 32 + static_cast<double>(row) * kLegendLine;
    return out + fmt::format(
                     "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>"
                     "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                     x + 4, y - 4, ink, x + 12, y, escaped(one.name));
  }

  // Keeps the intervals of several series apart where x are names.
  double nudge(std::size_t i) const {
    if (chart_.ticks.empty()) return 0;
    return 9 * (static_cast<double>(i) - 0.5 * static_cast<double>(chart_.series.size() - 1));
  }

  const StudyChart& chart_;
  double left_, top_;
  Range x_, y_;
};

}  // namespace

std::string study_svg(const Study& study) {
  const std::size_t panels = std::max<std::size_t>(1, study.charts.size());
  const std::size_t across = std::min(panels, kPanelsARow), down = (panels + across - 1) / across;
  const double width = static_cast<double>(across) * (kPanel + kGap) + kGap;
  const double height = kTitleHeight + static_cast<double>(down) * (kPanelHeight + kGap);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"system-ui,sans-serif\" font-size=\"11\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{2:.0f}\" y=\"28\" font-size=\"17\" font-weight=\"600\">{3}</text>\n",
      width, height, kGap, escaped(study.title));
  for (std::size_t i = 0; i < study.charts.size(); ++i) {
    const double left = kGap + static_cast<double>(i % across) * (kPanel + kGap);
    const auto row = i / across;
    const double top = kTitleHeight + static_cast<double>(row) * (kPanelHeight + kGap);
    out += Panel(study.charts[i], left, top).svg();
  }
  return out + "</svg>\n";
}

}  // namespace ringcraft
