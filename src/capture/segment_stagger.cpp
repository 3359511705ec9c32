// Staggers: the hands sag, the trunk swings over the feet and the feet catch up. Their steps are
// answers to blows (recovery steps).

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_pieces.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSags = 0.05f;   // H the higher wrist hangs under where it is in guard
constexpr Tick kShortest = 216;  // ticks (1.8 s) it hangs at least
constexpr float kSlow = 0.35f;   // s over which its height is smoothed: one duck is no stagger
constexpr Tick kGap = 24;        // ticks between two such stretches that join them
constexpr float kSways =
    radians(15);                   // the trunk swings in it at least, rad off its mean direction
constexpr Tick kLeadsToFall = 60;  // ticks before its end: the last steps may be those of a fall
constexpr Tick kLift = 6;          // ticks a foot is up in a step
constexpr Tick kBefore = 6;        // ticks before lift-off
constexpr Tick kAfter = 12;        // ticks after the last landing
constexpr Tick kNextStep = 48;     // ticks between the steps of one answer
constexpr Tick kFewest = 40;       // ticks of an answer
constexpr Tick kMost = 168;
constexpr float kGoes = 0.05f;  // H the hips go in an answer
constexpr std::size_t kMostSteps = 3;

struct Step {
  Tick lift = 0, land = 0;
};

Vec3 trunk_direction(const Measures& m, Tick t) {
  return normalized_or(m.at(Joint::neck, t) - m.at(Joint::hips, t), kUp);
}

// Largest angle of the trunk off its mean direction, rad.
float swing_of(const Measures& m, Stretch s) {
  Vec3 sum{};
  for (Tick t = s.first; t <= s.last; ++t) sum += trunk_direction(m, t);
  const Vec3 mean = normalized_or(sum, kUp);
  float least = 1;
  for (Tick t = s.first; t <= s.last; ++t)
    least = std::min(least, glm::dot(mean, trunk_direction(m, t)));
  return std::acos(std::clamp(least, -1.0f, 1.0f));
}

std::vector<Step> steps_of(const Clip& capture) {
  std::vector<Step> steps;
  for (const Side side : kSides) {
    Tick lift = -1;
    for (Tick t = 1; t <= capture.length(); ++t) {
      const bool was = capture.contacts_at(t - 1).of(side);
      const bool is = capture.contacts_at(t).of(side);
      if (was && !is) lift = t;
      if (!was && is && lift >= 0 && t - lift >= kLift) steps.push_back({lift, t});
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const Step& a, const Step& b) { return a.lift < b.lift; });
  return steps;
}

}  // namespace

std::vector<Stretch> staggers(const Measures& m, const Guard& guard,
                              const std::vector<bool>& free) {
  if (!guard.fights) return {};
  std::vector<float> height;
  for (Tick t = 0; t <= m.last; ++t) height.push_back(hands_height(m, t));
  const float sagging = guard.hands - kSags * m.height;
  height = smoothed(height, kSlow);
  const auto sags = [&](Tick t) { return free[at(t)] && height[at(t)] <= sagging; };
  std::vector<Stretch> out;
  for (Tick t = 0; t <= m.last; ++t) {
    if (!sags(t)) continue;
    Stretch s{t, t};
    while (s.last < m.last && sags(s.last + 1)) ++s.last;
    t = s.last;
    if (!out.empty() && s.first - out.back().last <= kGap)
      out.back().last = s.last;
    else
      out.push_back(s);
  }
  std::erase_if(out, [&](const Stretch& s) {
    return s.last - s.first < kShortest || swing_of(m, s) < kSways;
  });
  return out;
}

std::vector<FoundAction> stagger_segments(const Found& found, const Clip& capture) {
  const Measures& m = found.measures;
  const std::vector<Step> steps = steps_of(capture);
  std::vector<FoundAction> out;
  for (const Stretch& s : found.staggers) {
    std::array<Tick, kMostSteps> busy{};  // until where answers of so many steps lie already
    for (std::size_t i = 0; i < steps.size(); ++i) {
      Tick lands = steps[i].land;
      for (std::size_t j = i; j < steps.size() && j - i < kMostSteps; ++j) {
        if (steps[i].lift < s.first || steps[j].land > s.last - kLeadsToFall) break;
        if (j > i && steps[j].lift - lands > kNextStep) break;
        lands = std::max(lands, steps[j].land);
        const Tick begin = m.clamped(steps[i].lift - kBefore);
        const Tick end = m.clamped(lands + kAfter);
        const Vec3 way = m.at(Joint::hips, end) - m.at(Joint::hips, begin);
        const float goes = std::hypot(way.x, way.z) / m.height;
        if (end - begin < kFewest || end - begin > kMost || goes < kGoes) continue;
        if (begin < busy[j - i]) continue;
        busy[j - i] = end;
        FoundAction answer;
        answer.cut.kind = Kind::response;
        answer.cut.name = fmt::format("recover_{}_steps", j - i + 1);
        answer.cut.begin = seconds(begin);
        answer.cut.end = seconds(end);
        answer.cut.response =
            Response{ResponseKind::recovery_steps, static_cast<int>(j - i + 1), 0};
        answer.cut.measure_direction = true;
        answer.evidence = fmt::format(
            "hands sag to {:.2f} H and the trunk swings {:.0f} degrees from {:.2f} to {:.2f} s; {} "
            "steps carry the hips {:.2f} H",
            hands_height(m, begin) / m.height, degrees(swing_of(m, s)), seconds(s.first),
            seconds(s.last), j - i + 1, goes);
        out.push_back(std::move(answer));
      }
    }
  }
  return out;
}

}  // namespace ringcraft
