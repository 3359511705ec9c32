#include "io/quality.h"

#include <algorithm>
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
      const Tick begin = std::max(launch.start + strike.active_begin, 0);
      if (begin > launch.end) continue;  // cut before it came to that
      const Tick end = std::min(launch.start + strike.active_end, launch.end) + kIntendedContact;
      for (Tick tick = begin; tick < std::min(end, last_tick); ++tick) {
        parts[static_cast<std::size_t>(tick)] |= striking_limb(strike);
      }
    }
  }
  return parts;
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
  if (!depths.empty()) {
    std::sort(depths.begin(), depths.end());
    // Nearest rank: the smallest depth that 99 % of the ticks do not exceed.
    const std::size_t rank = (99 * depths.size() + 99) / 100;
    quality.penetration_p99_m = depths[std::max<std::size_t>(rank, 1) - 1];
    quality.penetration_max_m = depths.back();
  }
  const std::size_t count = std::min(timeline.tracks.size(), bodies.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<Pose>& frames = timeline.tracks[i].frames;
    if (frames.size() < 2) continue;
    quality.foot_skate_ratio +=
        foot_skate_ratio(bodies[i].skeleton, frames, kTicksPerSecond) / static_cast<double>(count);
    for (const Pose& frame : frames) {
      quality.joint_limit_violations += limit_violations(bodies[i], frame, kJointTolerance).size();
    }
  }
  return quality;
}

}  // namespace ringcraft
