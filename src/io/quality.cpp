#include "io/quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/quality.h"
#include "physics/contact.h"
#include "physics/penetration.h"

namespace ringcraft {

namespace {

// The striking limb: what lands, and the forearm or shin behind it.
std::uint32_t striking_limb(const Strike& strike) {
  std::uint32_t parts = striking_parts(strike);
  for (const Part tip : {Part::left_hand, Part::right_hand, Part::left_foot, Part::right_foot}) {
    if ((parts >> index(tip) & 1u) != 0) parts |= 1u << static_cast<unsigned>(parent_of(tip));
  }
  return parts;
}

// For each tick, the parts of one fighter that are on their way to an intended contact.
std::vector<std::uint32_t> intended_by_tick(const FighterTrack& track,
                                            const MotionLibrary& library) {
  std::vector<std::uint32_t> parts(track.frames.size(), 0);
  const auto last_tick = static_cast<Tick>(parts.size());
  for (const Segment& segment : track.segments) {
    const Launch& launch = segment.launch;
    if (!launch.action.valid() || launch.action.at() >= library.actions().size()) continue;
    for (const Strike& strike : library.action(launch.action).strikes) {
      const Tick begin = std::max(launch.when(strike.active_begin), 0);
      if (begin > launch.end) continue;  // cut before it came to that
      const Tick end = std::min(launch.when(strike.active_end), launch.end) + kIntendedContact;
      for (Tick tick = begin; tick < std::min(end, last_tick); ++tick) {
        parts[static_cast<std::size_t>(tick)] |= striking_limb(strike);
      }
    }
  }
  return parts;
}

constexpr Tick kSpeedTicks = 2;  // to both sides: passes what the captures' 15-20 Hz filters pass

// Nearest rank: the smallest value that 99 % do not exceed; 0 of none.
double percentile_99(std::vector<float>& values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t rank = (99 * values.size() + 99) / 100;
  return values[std::max<std::size_t>(rank, 1) - 1];
}

void add_penetration(std::vector<float>& depths, FightQuality& quality) {
  if (depths.empty()) return;
  const auto deepest = std::max_element(depths.begin(), depths.end());
  quality.penetration_max_m = *deepest;
  if (*deepest > 0) {
    quality.penetration_max_at_s = seconds(static_cast<Tick>(deepest - depths.begin()));
  }
  Tick longest = 0, current = 0;
  for (const float depth : depths) {
    current = depth > kDeep ? current + 1 : 0;
    longest = std::max(longest, current);
  }
  quality.penetration_longest_s = seconds(longest);
  quality.penetration_p99_m = percentile_99(depths);  // sorts
}

// Which ticks a fighter spends in actions that it chose.
std::vector<bool> chosen_ticks(const FighterTrack& track) {
  std::vector<bool> chosen(track.frames.size(), false);
  const auto last = static_cast<Tick>(chosen.size());
  for (const Segment& segment : track.segments) {
    const Tick end = std::min(segment.launch.end, last);
    for (Tick tick = std::max(segment.launch.start, 0); tick < end; ++tick) {
      chosen[static_cast<std::size_t>(tick)] = !segment.launch.forced;
    }
  }
  return chosen;
}

void add_wrist_speeds(const Skeleton& skeleton, const FighterTrack& track,
                      std::vector<float>& speeds) {
  constexpr auto kAside = static_cast<std::size_t>(kSpeedTicks);
  const std::vector<bool> chosen = chosen_ticks(track);
  std::vector<std::array<Vec3, 2>> wrists;
  wrists.reserve(track.frames.size());
  for (const Pose& frame : track.frames) {
    const WorldPose world = world_pose(skeleton, frame);
    wrists.push_back(
        {world.position[index(Joint::left_hand)], world.position[index(Joint::right_hand)]});
  }
  for (std::size_t i = kAside; i + kAside < wrists.size(); ++i) {
    if (!chosen[i]) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const float way = glm::distance(wrists[i + kAside][side], wrists[i - kAside][side]);
      speeds.push_back(way * kTicksPerSecond / (2.0f * kSpeedTicks));
    }
  }
}

}  // namespace

std::vector<float> penetration_by_tick(const Timeline& timeline,
                                       const std::vector<BodyModel>& bodies,
                                       const MotionLibrary& library) {
  const std::size_t count = std::min(timeline.tracks.size(), bodies.size());
  std::size_t ticks = 0;
  std::vector<std::vector<std::uint32_t>> intended;
  for (std::size_t i = 0; i < count; ++i) {
    ticks = std::max(ticks, timeline.tracks[i].frames.size());
    intended.push_back(intended_by_tick(timeline.tracks[i], library));
  }
  std::vector<float> depths(ticks, 0.0f);
  std::vector<BodyCapsules> shown(count);
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<Pose>& frames = timeline.tracks[i].frames;
      if (tick >= frames.size()) continue;
      shown[i] = capsules(bodies[i], world_pose(bodies[i].skeleton, frames[tick]));
      for (std::size_t j = 0; j < i; ++j) {
        if (tick >= timeline.tracks[j].frames.size()) continue;
        const Penetration deepest =
            deepest_penetration(shown[j], shown[i], intended[j][tick], intended[i][tick]);
        depths[tick] = std::max(depths[tick], deepest.depth);
      }
    }
  }
  return depths;
}

FightQuality quality_of(const Timeline& timeline, const std::vector<BodyModel>& bodies,
                        const MotionLibrary& library) {
  FightQuality quality;
  std::vector<float> depths = penetration_by_tick(timeline, bodies, library);
  add_penetration(depths, quality);
  std::vector<float> wrist_speeds;
  const std::size_t count = std::min(timeline.tracks.size(), bodies.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<Pose>& frames = timeline.tracks[i].frames;
    if (frames.size() < 2) continue;
    quality.foot_skate_ratio +=
        foot_skate_ratio(bodies[i].skeleton, frames, kTicksPerSecond) / static_cast<double>(count);
    add_wrist_speeds(bodies[i].skeleton, timeline.tracks[i], wrist_speeds);
    for (const Pose& frame : frames) {
      quality.joint_limit_violations += limit_violations(bodies[i], frame, kJointTolerance).size();
    }
  }
  quality.wrist_speed_p99_mps = percentile_99(wrist_speeds);
  return quality;
}

}  // namespace ringcraft
