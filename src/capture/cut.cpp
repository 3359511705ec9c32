#include "capture/cut.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/smooth.h"

namespace ringcraft {
namespace {

constexpr float kActiveFrom = 0.65f;    // share of the way out from which a straight can hit
constexpr Tick kActiveAfter = 4;        // ticks after full extension for which it still can
constexpr double kSearchAround = 0.12;  // s about the stated time in which the peak speed is sought
constexpr double kExtensionAfter =
    0.16;  // s after the peak speed within which the limb is at full reach
constexpr double kLongestStartup = 0.45;  // s before full reach in which the way out begins

Vec3 from_hips(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick tick) {
  const WorldPose world = world_pose(skeleton, clip.at(tick));
  return world.position[index(joint)] - world.position[index(Joint::hips)];
}

// m/s relative to the hips, over two ticks.
float speed_at(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick tick) {
  return glm::distance(from_hips(skeleton, clip, joint, tick + 1),
                       from_hips(skeleton, clip, joint, tick - 1)) /
         (2 * kTickSeconds);
}

// The tick of full reach after the peak speed: farthest from the hips over the ground.
Tick full_reach(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick peak) {
  Tick best = peak;
  float farthest = 0;
  const Tick last = std::min(peak + ticks(kExtensionAfter), clip.length() - 1);
  for (Tick t = peak; t <= last; ++t) {
    const Vec3 reach = from_hips(skeleton, clip, joint, t);
    const float ground = std::hypot(reach.x, reach.z);
    if (ground > farthest) {
      farthest = ground;
      best = t;
    }
  }
  return best;
}

bool is_straight(StrikeKind kind) {
  return kind == StrikeKind::straight || kind == StrikeKind::front_kick ||
         kind == StrikeKind::side_kick;
}

// Straights: from 65 % of the way out to just after full reach, measured along the facing.
void straight_window(const Skeleton& skeleton, const Clip& clip, Tick peak, Strike& strike) {
  const Tick reached = full_reach(skeleton, clip, strike.joint, peak);
  const auto out = [&](Tick t) { return from_hips(skeleton, clip, strike.joint, t).z; };
  float least = out(reached);
  for (Tick t = std::max(0, reached - ticks(kLongestStartup)); t < reached; ++t)
    least = std::min(least, out(t));
  const float threshold = least + kActiveFrom * (out(reached) - least);
  Tick begin = reached;
  while (begin > 0 && out(begin - 1) >= threshold) --begin;
  strike.active_begin = begin;
  strike.active_end = reached + kActiveAfter + 1;
}

// Blows on an arc: while the limb moves at more than 65 % of its peak speed, no longer than just
// after.
void arc_window(const Skeleton& skeleton, const Clip& clip, Tick peak, Strike& strike) {
  const float threshold = kActiveFrom * speed_at(skeleton, clip, strike.joint, peak);
  const auto fast = [&](Tick t) { return speed_at(skeleton, clip, strike.joint, t) >= threshold; };
  Tick begin = peak;
  while (begin > 1 && fast(begin - 1)) --begin;
  Tick end = peak + 1;
  while (end < peak + 2 * kActiveAfter && fast(end)) ++end;
  strike.active_begin = begin;
  strike.active_end = end;
}

// Where the opponent of the first straight stands: from the hips to the joint at full reach.
std::optional<float> straight_facing(const Skeleton& skeleton, const Clip& capture,
                                     const ActionCut& cut) {
  for (const StrikeCut& strike : cut.strikes) {
    if (!is_straight(strike.kind)) continue;
    const Tick peak =
        fastest_tick(skeleton, capture, strike.joint, ticks(strike.at - kSearchAround),
                     ticks(strike.at + kSearchAround));
    const Tick reached = full_reach(skeleton, capture, strike.joint, peak);
    return yaw_of(from_hips(skeleton, capture, strike.joint, reached));
  }
  return std::nullopt;
}

// The root track: over the ground as tracked; blows face one way throughout, other actions turn
// evenly from the guard they start in to the one they end in. On the floor there is no guard to
// read.
std::vector<Placement> root_track(const Skeleton& skeleton, const Clip& capture,
                                  const CaptureTracks& tracks, const ActionCut& cut, Tick first,
                                  Tick last) {
  float start = tracks.facing[static_cast<std::size_t>(first)];
  float end = tracks.facing[static_cast<std::size_t>(last)];
  if (cut.starts_lying != Lying::none) start = end;
  if (cut.ends_lying != Lying::none) end = start;
  if (const auto facing = straight_facing(skeleton, capture, cut)) start = end = *facing;
  if (!cut.strikes.empty()) end = start;
  std::vector<Placement> root;
  for (Tick t = first; t <= last; ++t) {
    const Vec3 ground = tracks.ground[static_cast<std::size_t>(t)];
    const float share = glm::smoothstep(
        0.0f, 1.0f, static_cast<float>(t - first) / static_cast<float>(last - first));
    root.push_back({ground.x, ground.z, start + (end - start) * share + cut.turn});
  }
  return root;
}

}  // namespace

CaptureTracks tracks_of(const Clip& capture, float guard_yaw) {
  CaptureTracks tracks;
  std::vector<float> yaw;
  for (const Pose& pose : capture.frames) {
    tracks.ground.emplace_back(pose.hips.x, 0, pose.hips.z);
    yaw.push_back(heading_of(pose.rotation[0]));
  }
  tracks.ground = smoothed(tracks.ground, 0.16f);
  yaw = unwrapped(std::move(yaw));
  // A pelvis that swings with a blow says little about the guard.
  std::vector<float> weight;
  for (std::size_t i = 0; i < yaw.size(); ++i) {
    const std::size_t before = i >= 6 ? i - 6 : 0;
    const std::size_t after = std::min(i + 6, yaw.size() - 1);
    const float rate =
        (yaw[after] - yaw[before]) / (static_cast<float>(after - before) * kTickSeconds);
    weight.push_back(1 / (1 + (rate / radians(90)) * (rate / radians(90))));
  }
  tracks.facing = smoothed(yaw, weight, 0.35f);
  for (float& facing : tracks.facing) facing -= guard_yaw;
  return tracks;
}

Tick fastest_tick(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick first, Tick last) {
  Tick best = first;
  float fastest = -1;
  for (Tick t = first; t <= last; ++t) {
    const float speed = speed_at(skeleton, clip, joint, t);
    if (speed > fastest) {
      fastest = speed;
      best = t;
    }
  }
  return best;
}

Result<Action> cut_action(const Skeleton& skeleton, const Clip& capture,
                          const CaptureTracks& tracks, const ActionCut& cut,
                          const std::string& file, const std::string& place) {
  const Tick first = ticks(cut.begin);
  const Tick last = ticks(cut.end);
  const auto fault = [&](std::string what, std::string remedy) {
    return input_error(file, place, fmt::format("action {}: {}", cut.name, what),
                       std::move(remedy));
  };
  if (last - first < 12) return fault("shorter than 0.1 s", "set end after begin");
  if (last > capture.length())
    return fault(
        fmt::format("ends at {} s, the capture at {:.2f} s", cut.end, seconds(capture.length())),
        "set end within the capture");

  Action action;
  action.name = cut.name;
  action.kind = cut.kind;
  action.starts_lying = cut.starts_lying;
  action.ends_lying = cut.ends_lying;
  const std::vector<Placement> root = root_track(skeleton, capture, tracks, cut, first, last);
  const Placement to_start = inverse(root.front());
  for (Tick t = first; t <= last; ++t) {
    action.clip.frames.push_back(placed(capture.at(t), to_start));
    action.clip.root.push_back(to_start * root[static_cast<std::size_t>(t - first)]);
    action.clip.contacts.push_back(capture.contacts_at(t));
  }
  action.clip.root.front() = {};
  unroll_rotations(action.clip);

  for (const StrikeCut& wanted : cut.strikes) {
    const Tick at = ticks(wanted.at) - first;
    if (at < 6 || at > action.length() - 6)
      return fault(fmt::format("the strike at {} s is not inside it", wanted.at),
                   "widen begin and end");
    Strike strike;
    strike.kind = wanted.kind;
    strike.joint = wanted.joint;
    strike.zone = wanted.zone;
    const Tick around = ticks(kSearchAround);
    const Tick peak = fastest_tick(skeleton, action.clip, wanted.joint, std::max(1, at - around),
                                   std::min(at + around, action.length() - 1));
    if (is_straight(wanted.kind))
      straight_window(skeleton, action.clip, peak, strike);
    else
      arc_window(skeleton, action.clip, peak, strike);
    action.strikes.push_back(strike);
  }
  if (cut.defense) {
    action.defense = cut.defense;
    action.defense->begin = std::clamp<Tick>(cut.defense->begin - first, 0, action.length());
    action.defense->end = std::clamp<Tick>(cut.defense->end - first, 0, action.length());
  }
  if (cut.response) {
    action.response = cut.response;
    const Placement& end = action.clip.root.back();
    if (cut.measure_direction) action.response->direction = yaw_of(end.position());
  }
  action.source = fmt::format("{} {:.2f}-{:.2f} s", file, cut.begin, cut.end);
  return action;
}

}  // namespace ringcraft
