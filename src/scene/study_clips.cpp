#include "scene/study_clips.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/quality.h"
#include "physics/contact.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr std::size_t kDrawnPairs = 6;

// The motion in the world: the first where it stands, the second before it.
class Shown {
 public:
  Shown(const PlacedClip& of, const Placement& at, Tick begin)
      : of_(of), at_(at), begin_(begin), scale_(of.body->scale) {}

  Tick end() const { return begin_ + of_.action->length(); }

  BodyCapsules at(Tick tick) const {
    const Clip& clip = of_.action->clip;
    const Pose pose = placed(scaled(clip.at(tick - begin_), scale_), at_);
    return capsules(*of_.body, world_pose(of_.body->skeleton, pose));
  }

  // Parts that are about to touch, or just have, as their strike means them to.
  std::uint32_t intended(Tick tick) const {
    std::uint32_t parts = 0;
    for (const Strike& strike : of_.action->strikes) {
      const Tick age = tick - begin_;
      if (age < strike.active_begin || age >= strike.active_end + kIntendedContact) continue;
      parts |= striking_parts(strike);
    }
    return parts;
  }

 private:
  const PlacedClip& of_;
  Placement at_;
  Tick begin_;
  float scale_;
};

}  // namespace

Clip from_origin(const Skeleton& skeleton, const Clip& clip) {
  Clip moved = clip;
  if (clip.frames.empty()) return moved;
  const WorldPose first = world_pose(skeleton, clip.frames.front());
  const Vec3 hips = first.position[index(Joint::hips)];
  const float yaw = heading_of(first.rotation[index(Joint::upper_chest)]);
  const Placement back = inverse(Placement{hips.x, hips.z, yaw});
  for (Pose& pose : moved.frames) pose = placed(pose, back);
  return moved;
}

ClipDepths clip_depths(const PlacedClip& a, const PlacedClip& b, const ClipPlacement& placement) {
  const Shown first(a, {}, 0), second(b, {0, placement.distance, kPi}, placement.later);
  const Tick end = std::max(first.end(), second.end());
  ClipDepths found;
  std::vector<int> row(kPartCount * kPartCount, -1);
  for (Tick tick = 0; tick <= end; ++tick) {
    found.deepest.push_back(0);
    const std::uint32_t left_out_a = placement.intended ? first.intended(tick) : 0;
    const std::uint32_t left_out_b = placement.intended ? second.intended(tick) : 0;
    for (const Penetration& one : penetrations(first.at(tick), second.at(tick), 0)) {
      if (((left_out_a >> index(one.a)) & 1u) != 0 || ((left_out_b >> index(one.b)) & 1u) != 0) {
        continue;
      }
      int& at = row[index(one.a) * kPartCount + index(one.b)];
      if (at < 0) {
        at = static_cast<int>(found.pairs.size());
        found.pairs.push_back({one.a, one.b, tick, tick, 0, 0});
        found.by_pair.emplace_back(static_cast<std::size_t>(end) + 1, 0.0f);
      }
      PairDepth& pair = found.pairs[static_cast<std::size_t>(at)];
      ++pair.ticks;
      if (one.depth > pair.depth) pair.depth = one.depth, pair.worst = tick;
      found.by_pair[static_cast<std::size_t>(at)][static_cast<std::size_t>(tick)] = one.depth;
      found.deepest.back() = std::max(found.deepest.back(), one.depth);
    }
  }
  std::vector<std::size_t> order(found.pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return found.pairs[i].depth > found.pairs[j].depth;
  });
  ClipDepths sorted;
  sorted.deepest = std::move(found.deepest);
  for (const std::size_t i : order) {
    sorted.pairs.push_back(found.pairs[i]);
    sorted.by_pair.push_back(std::move(found.by_pair[i]));
  }
  return sorted;
}

Study clips_study(const PlacedClip& a, const PlacedClip& b, const ClipPlacement& placement,
                  float limit) {
  const ClipDepths found = clip_depths(a, b, placement);
  Study study;
  study.name = "clips";
  study.title = fmt::format("{} before {}, {:.2f} m apart", a.name, b.name, placement.distance);
  study.said = {fmt::format("{} begins at 0 s, {} at {:.3f} s; roots {:.2f} m apart, facing each "
                            "other; depth of capsules, every tick of 1/120 s.",
                            a.name, b.name, seconds(placement.later), placement.distance),
                placement.intended ? "The part that a strike lands with is left out while the "
                                     "strike is active and 0.1 s after."
                                   : "Strikes' own contacts are counted.",
                fmt::format("Limit {:.3f} m.", limit)};
  study.table.columns = {"part_a",     "part_b",  "depth_max_m", "first_tick",  "first_s",
                         "worst_tick", "worst_s", "ticks",       "beyond_limit"};
  StudyChart chart{"Depth of each pair of parts", "time, s", "depth, m", {}, {}, true, limit};
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    const PairDepth& pair = found.pairs[i];
    study.table.rows.push_back({std::string(name_of(pair.a)), std::string(name_of(pair.b)),
                                static_cast<double>(pair.depth), std::int64_t{pair.first},
                                static_cast<double>(seconds(pair.first)), std::int64_t{pair.worst},
                                static_cast<double>(seconds(pair.worst)), std::int64_t{pair.ticks},
                                std::int64_t{pair.depth > limit ? 1 : 0}});
    if (i >= kDrawnPairs) continue;
    StudySeries series{fmt::format("{}-{}", name_of(pair.a), name_of(pair.b)), {}};
    for (std::size_t tick = 0; tick < found.by_pair[i].size(); ++tick) {
      series.points.push_back({static_cast<double>(seconds(static_cast<Tick>(tick))),
                               static_cast<double>(found.by_pair[i][tick]),
                               {},
                               {}});
    }
    chart.series.push_back(std::move(series));
  }
  chart.dots = false;
  study.charts.push_back(std::move(chart));
  return study;
}

}  // namespace ringcraft
