#include "capture/segment.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "capture/segment_pieces.h"

namespace ringcraft {
namespace {

constexpr double kArmsBeforeKick = 0.3;  // s before lift-off from which swinging arms do not strike
constexpr Tick kLongestRise = 480;       // ticks of a get-up
constexpr Tick kStillLying = 24;         // ticks of lying before a get-up that begins in it
constexpr Tick kRested = 12;             // ticks after landing that belong to the fall

// Lower case letters, digits and underscores.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (upper)
      out += static_cast<char>(c - 'A' + 'a');
    else if (kept)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "capture" : out;
}

// "13_17_jab_left_2": the capture, what it is, which of them.
void name_them(const std::string& capture, std::vector<FoundAction>& segments) {
  std::map<std::string, int> count;
  for (FoundAction& segment : segments) {
    const std::string what = segment.cut.name;
    segment.cut.name = fmt::format("{}_{}_{}", plain(capture), what, ++count[what]);
  }
}

FoundAction fall_of(const Found& found, const Descent& d) {
  FoundAction fall;
  fall.cut.kind = Kind::response;
  fall.cut.name = fmt::format("knockdown_{}", name_of(d.lying));
  fall.cut.begin = seconds(d.begin);
  fall.cut.end = seconds(found.measures.clamped(d.down + kRested));
  fall.cut.response = Response{ResponseKind::knockdown, 0, 0};
  fall.cut.measure_direction = true;
  fall.cut.ends_lying = d.lying;
  fall.evidence = d.evidence_down;
  return fall;
}

FoundAction rise_of(const Descent& d) {
  FoundAction rise;
  // A body that changes how it lies on the way up gets up from how it lay first.
  Tick begin = d.rise;
  Lying from = d.rests;
  if (d.starts_down && d.rise <= kLongestRise) {
    begin = 0;
    from = d.lying;
  } else if (d.rests != d.lying && d.rise - d.left_lying <= kLongestRise) {
    begin = std::max(d.down, d.left_lying - kStillLying);
    from = d.lying;
  }
  rise.cut.kind = Kind::get_up;
  rise.cut.name = fmt::format("get_up_{}", name_of(from));
  rise.cut.begin = seconds(begin);
  rise.cut.end = seconds(d.up);
  rise.cut.starts_lying = from;
  rise.evidence = d.evidence_up;
  return rise;
}

}  // namespace

std::vector<FoundBlow> all_blows(const Measures& m, const std::vector<Descent>& falls,
                                 const SegmentSettings& settings) {
  std::vector<FoundBlow> blows = kicks(m, settings);
  const std::size_t kick_count = blows.size();
  for (FoundBlow& blow : hand_blows(m, settings)) {
    const bool swings = std::any_of(
        blows.begin(), blows.begin() + static_cast<long>(kick_count), [&](const FoundBlow& kick) {
          const bool thrown = blow.strike.kind == StrikeKind::straight && !blow.blocks;
          const double from = kick.begin - (thrown ? 0 : kArmsBeforeKick);
          return blow.strike.at > from && blow.strike.at < kick.end;
        });
    const bool falls_down = std::any_of(falls.begin(), falls.end(), [&](const Descent& d) {
      const Tick peak = ticks(blow.strike.at);
      return peak >= d.begin && (d.up < 0 || peak <= d.up);
    });
    if (!swings && !falls_down) blows.push_back(std::move(blow));
  }
  std::stable_sort(blows.begin(), blows.end(), [](const FoundBlow& a, const FoundBlow& b) {
    return a.strike.at < b.strike.at;
  });
  return blows;
}

std::vector<FoundAction> fall_segments(const Found& found, std::vector<std::string>& notes) {
  std::vector<FoundAction> out;
  for (const Descent& d : found.descents) {
    if (d.rolls) {
      notes.push_back(fmt::format("{:.2f}-{:.2f} s: rolls over its head, no fall ({})",
                                  seconds(d.begin), seconds(d.up < 0 ? d.down : d.up),
                                  d.evidence_down));
      continue;
    }
    if (!d.starts_down && d.controlled)
      notes.push_back(fmt::format("{:.2f}-{:.2f} s: lies down under control, no knockdown ({})",
                                  seconds(d.begin), seconds(d.down), d.evidence_down));
    else if (!d.starts_down)
      out.push_back(fall_of(found, d));
    if (d.rise >= 0) out.push_back(rise_of(d));
  }
  return out;
}

Segmentation segment(const Skeleton& skeleton, const Clip& capture, const std::string& name,
                     const SegmentSettings& settings) {
  Segmentation out;
  if (capture.length() < kShortestCapture) {
    out.notes.push_back(
        fmt::format("{}: shorter than {:.2f} s, nothing to find", name, seconds(kShortestCapture)));
    return out;
  }
  const Measures m = measured(skeleton, capture);
  const std::vector<Descent> falls = descents(m);
  out.blows = all_blows(m, falls, settings);
  const Guard guard = guard_of(skeleton, capture, m, out.blows, falls);
  out.guard_at = seconds(guard.at);
  out.guard_yaw = guard.yaw;
  out.southpaw = guard.southpaw;
  out.notes.push_back(guard.evidence);
  const Found found{m, guard, out.blows, falls,
                    staggers(m, guard, free_ticks(m, out.blows, falls))};
  for (std::vector<FoundAction>& part : std::array<std::vector<FoundAction>, 6>{
           attack_segments(found), block_segments(found), fall_segments(found, out.notes),
           quiet_segments(found), stagger_segments(found, capture), parry_segments(found)})
    for (FoundAction& segment : part) out.segments.push_back(std::move(segment));
  std::stable_sort(
      out.segments.begin(), out.segments.end(),
      [](const FoundAction& a, const FoundAction& b) { return a.cut.begin < b.cut.begin; });
  name_them(name, out.segments);
  return out;
}

std::vector<FoundAction> not_listed(std::vector<FoundAction> found,
                                    const std::vector<ActionCut>& listed) {
  std::erase_if(found, [&](const FoundAction& action) {
    return std::any_of(listed.begin(), listed.end(), [&](const ActionCut& cut) {
      const double shared =
          std::min(action.cut.end, cut.end) - std::max(action.cut.begin, cut.begin);
      return shared > 0.5 * std::min(action.cut.end - action.cut.begin, cut.end - cut.begin);
    });
  });
  return found;
}

Segmentation segment(const Skeleton& skeleton, const Clip& capture, const std::string& name) {
  return segment(skeleton, capture, name, SegmentSettings{});
}

}  // namespace ringcraft
