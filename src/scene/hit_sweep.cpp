#include "scene/hit_sweep.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/tasks.h"
#include "io/events.h"
#include "physics/response.h"

namespace ringcraft {
namespace {

constexpr std::array<SweepAxis, 3> kAxes{SweepAxis::impulse, SweepAxis::direction, SweepAxis::tone};

struct Bounds {
  double least, most;
};
Bounds bounds_of(SweepAxis axis) {
  switch (axis) {
    case SweepAxis::impulse:
      return {0, 2000};
    case SweepAxis::direction:
      return {-360, 360};
    case SweepAxis::tone:
      return {0, 1};
  }
  return {0, 0};
}

tl::unexpected<Error> fault(const std::string& text, const std::string& what) {
  return usage_error("", "--sweep", fmt::format("'{}' {}", text, what),
                     "as in impulse=0:200:5, direction=0:360:15 or tone=0.2:1:0.2");
}

std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(':', from), text.size());
    const std::string part = text.substr(from, end - from);
    char* rest = nullptr;
    const double number = std::strtod(part.c_str(), &rest);
    if (part.empty() || rest != part.c_str() + part.size() || !std::isfinite(number)) {
      return std::nullopt;
    }
    numbers.push_back(number);
    from = end + 1;
  }
  return numbers;
}

void set(SweepPoint& point, SweepAxis axis, double value) {
  switch (axis) {
    case SweepAxis::impulse:
      point.impulse = value;
      return;
    case SweepAxis::direction:
      point.direction = value;
      return;
    case SweepAxis::tone:
      point.tone = value;
      return;
  }
}

std::vector<SweepPoint> points_of(const std::vector<SweepRange>& ranges, const SweepPoint& fixed) {
  std::vector<SweepPoint> points{fixed};
  for (const SweepRange& range : ranges) {
    std::vector<SweepPoint> all;
    for (const SweepPoint& point : points) {
      for (const double value : range.values) {
        all.push_back(point);
        set(all.back(), range.axis, value);
      }
    }
    points = std::move(all);
  }
  return points;
}

// ", tone 1" of an axis that no range varies.
std::string fixed_text(const HitSweep& sweep, SweepAxis axis, const SweepPoint& fixed) {
  for (const SweepRange& range : sweep.ranges) {
    if (range.axis == axis) return "";
  }
  const double value = axis == SweepAxis::impulse     ? fixed.impulse
                       : axis == SweepAxis::direction ? fixed.direction
                                                      : fixed.tone;
  return fmt::format(", {} {:g}{}{}", name_of(axis), value, unit_of(axis).empty() ? "" : " ",
                     unit_of(axis));
}

nlohmann::json json_of(const HitSweep& sweep, const SweepPoint& point) {
  const ImpactOutcome& outcome = point.outcome;
  const double way = static_cast<double>(degrees(wrapped_angle(outcome.direction - sweep.facing)));
  return {{"impulse_Ns", rounded(point.impulse, 6)},
          {"direction_deg", rounded(point.direction, 6)},
          {"tone", rounded(point.tone, 6)},
          {"response", name_of(outcome.response)},
          {"steps", outcome.steps},
          {"knockout", outcome.knockout},
          {"goes_deg", rounded(way, 2)},
          {"margin_m", rounded(outcome.margin, 4)},
          {"head_spin_radps", rounded(outcome.head_spin, 3)}};
}

constexpr std::array<const char*, 9> kColumns = {"impulse_Ns", "direction_deg", "tone",
                                                 "response",   "steps",         "knockout",
                                                 "goes_deg",   "margin_m",      "head_spin_radps"};

}  // namespace

std::string_view name_of(SweepAxis axis) {
  switch (axis) {
    case SweepAxis::impulse:
      return "impulse";
    case SweepAxis::direction:
      return "direction";
    case SweepAxis::tone:
      return "tone";
  }
  return "";
}

std::string_view unit_of(SweepAxis axis) {
  switch (axis) {
    case SweepAxis::impulse:
      return "N s";
    case SweepAxis::direction:
      return "deg";
    case SweepAxis::tone:
      return "";
  }
  return "";
}

Result<SweepRange> sweep_range(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto axis = std::find_if(kAxes.begin(), kAxes.end(),
                                 [&](SweepAxis known) { return name_of(known) == name; });
  if (equals == std::string::npos || axis == kAxes.end()) {
    return fault(text, "names no axis: impulse, direction or tone");
  }
  const auto numbers = numbers_of(text.substr(equals + 1));
  if (!numbers || (numbers->size() != 1 && numbers->size() != 3)) {
    return fault(text, "is not AXIS=FROM:TO:STEP");
  }
  const double from = numbers->front();
  const double to = numbers->size() == 3 ? (*numbers)[1] : from;
  const double step = numbers->size() == 3 ? (*numbers)[2] : 1;
  const Bounds bounds = bounds_of(*axis);
  if (!(from >= bounds.least && to <= bounds.most && from <= to)) {
    return fault(text, fmt::format("does not ascend within {} to {}", bounds.least, bounds.most));
  }
  if (!(step > 0)) return fault(text, "has a step that is not above 0");
  const double count = std::floor((to - from) / step + 1e-9) + 1;
  if (count > static_cast<double>(kMostSweepPoints)) {
    return fault(text, fmt::format("has {:g} points, at most {}", count, kMostSweepPoints));
  }
  SweepRange range{*axis, {}};
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double value = from + step * i;
    if (*axis == SweepAxis::direction && value >= from + 360 - 1e-9) break;
    range.values.push_back(value);
  }
  return range;
}

Result<HitSweep> sweep_hits(const MotionLibrary& library, const HitQuery& query,
                            std::vector<SweepRange> ranges, const SweepOptions& options) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (ranges[i].axis == ranges[j].axis) {
        return usage_error("", "--sweep", fmt::format("{} twice", name_of(ranges[i].axis)),
                           "give each axis once");
      }
    }
    count *= ranges[i].values.size();
    if (count > kMostSweepPoints) {
      return usage_error("", "--sweep", fmt::format("more than {} points", kMostSweepPoints),
                         "take larger steps");
    }
  }
  const bool turned = std::ranges::any_of(
      ranges, [](const SweepRange& range) { return range.axis == SweepAxis::direction; });
  if (turned && query.impulse.x == 0 && query.impulse.z == 0 && query.impulse.y != 0) {
    return usage_error("", "--impulse",
                       "it is vertical, and has no direction for --sweep to go over",
                       "give it an X or a Z, or sweep the impulse or the tone");
  }
  const auto posed = posed_body(library, query);
  if (!posed) return tl::unexpected(posed.error());
  SweepPoint fixed;
  // The axes vary the impulse's size and its way over the ground; how steep it is stays.
  const float size = glm::length(query.impulse);
  const bool steep = query.impulse.y != 0;
  const float level = steep ? std::hypot(query.impulse.x, query.impulse.z) / size : 1;
  const float rise = steep ? query.impulse.y / size : 0;
  fixed.impulse = static_cast<double>(size);
  fixed.direction = static_cast<double>(degrees(yaw_of(query.impulse)));
  fixed.tone = static_cast<double>(query.tone);
  HitSweep sweep;
  sweep.facing = posed->facing;
  sweep.points = points_of(ranges, fixed);
  sweep.ranges = std::move(ranges);
  sweep.title =
      fmt::format("{}, {:.2f} m, {:.0f} kg", query.body.name, query.body.height, query.body.mass);
  sweep.what = fmt::format("{} at {:.2f} s, pushed at the {}", query.action, query.at_s,
                           name_of(query.part));
  for (const SweepAxis axis : kAxes) sweep.what += fixed_text(sweep, axis, fixed);
  if (steep) {
    sweep.what += fmt::format(", {:.1f} deg {}", degrees(std::abs(std::atan2(rise, level))),
                              rise > 0 ? "upward" : "downward");
  }
  std::atomic<std::size_t> done = 0;
  run_tasks(sweep.points.size(), options.threads, [&](std::size_t i) {
    if (options.interrupted != nullptr && options.interrupted->load(std::memory_order_relaxed)) {
      return;
    }
    SweepPoint& point = sweep.points[i];
    const Vec3 over_ground = yaw_rotation(radians(static_cast<float>(point.direction))) * kForward;
    const Vec3 way = over_ground * level + kUp * rise;
    const ImpactInput input =
        with_impulse(*posed, query.part, way * static_cast<float>(point.impulse),
                     static_cast<float>(point.tone));
    const ImpactOutcome outcome = impulse_step(posed->body, input);
    const bool cuts = interrupts(input.blow.blocked, static_cast<float>(point.impulse), outcome);
    point.outcome = answered(cuts, outcome);
    point.done = true;
    const std::size_t so_far = ++done;
    if (options.progress) options.progress(so_far, sweep.points.size());
  });
  sweep.interrupted = done < sweep.points.size();
  return sweep;
}

std::string sweep_csv(const HitSweep& sweep) {
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const SweepPoint& point : sweep.points) {
    if (!point.done) continue;
    const nlohmann::json values = json_of(sweep, point);
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const nlohmann::json& value = values.at(kColumns[i]);
      text += (i > 0 ? "," : "") + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    text += '\n';
  }
  return text;
}

std::string sweep_json(const HitSweep& sweep) {
  nlohmann::json json = {{"body", sweep.title},
                         {"what", sweep.what},
                         {"interrupted", sweep.interrupted},
                         {"axes", nlohmann::json::array()},
                         {"points", nlohmann::json::array()}};
  for (const SweepRange& range : sweep.ranges) json["axes"].push_back(name_of(range.axis));
  for (const SweepPoint& point : sweep.points) {
    if (point.done) json["points"].push_back(json_of(sweep, point));
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ringcraft
