#include "capture/cut.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/retarget.h"
#include "motion/smooth.h"
#include "motion/state_machine.h"

namespace ringcraft {
namespace {

constexpr float kLargestReturn = radians(40);  // to which a body is turned back to its guard
constexpr float kActiveFrom = 0.65f;           // share of the way out from which a straight can hit
constexpr Tick kActiveAfter = 4;               // ticks after full extension for which it still can
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

// The tick of a strike's peak speed, near where it is stated to be; both inside the clip.
Tick peak_near(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick at) {
  const Tick around = ticks(kSearchAround);
  return fastest_tick(skeleton, clip, joint, std::max(1, at - around),
                      std::min(at + around, clip.length() - 1));
}

// A straight's moment of full reach and where it goes then, in the clip's space.
struct Aim {
  Tick tick = 0;
  float yaw = 0;  // rad
};

std::vector<Aim> aims_of(const Skeleton& skeleton, const Clip& clip, const ActionCut& cut,
                         Tick first) {
  std::vector<Aim> aims;
  for (const StrikeCut& strike : cut.strikes) {
    if (!goes_straight(strike.kind)) continue;
    const Tick peak = peak_near(skeleton, clip, strike.joint, ticks(strike.at) - first);
    const Tick reached = full_reach(skeleton, clip, strike.joint, peak);
    aims.push_back({reached, yaw_of(from_hips(skeleton, clip, strike.joint, reached))});
  }
  return aims;
}

bool has_straight(const ActionCut& cut) {
  return std::any_of(cut.strikes.begin(), cut.strikes.end(),
                     [](const StrikeCut& strike) { return goes_straight(strike.kind); });
}

// The root track: over the ground as tracked, facing as the guard at the start does and turning
// evenly to the guard at the end. On the floor there is no guard to read.
std::vector<Placement> root_track(const Skeleton& skeleton, const Clip& capture,
                                  const CaptureTracks& tracks, const ActionCut& cut, Tick first,
                                  Tick last) {
  const auto facing = [&](std::optional<float> known, Tick tick) {
    return known ? *known : facing_at(skeleton, capture, tracks, tick);
  };
  float start = facing(cut.facing_begin, first);
  float end = start + wrapped_angle(facing(cut.facing_end, last) - start);
  if (cut.starts_lying != Lying::none) start = end;
  if (cut.ends_lying != Lying::none || has_straight(cut)) end = start;
  std::vector<Placement> root;
  for (Tick t = first; t <= last; ++t) {
    const Vec3 ground = tracks.ground[static_cast<std::size_t>(t)];
    const float share = glm::smoothstep(
        0.0f, 1.0f, static_cast<float>(t - first) / static_cast<float>(last - first));
    root.push_back({ground.x, ground.z, start + (end - start) * share + cut.turn});
  }
  return root;
}

// How far the clip is turned back at a moment: a turn between two knots goes smoothly.
struct Knot {
  Tick tick = 0;
  float turn = 0;  // rad
};

float turn_at(const std::vector<Knot>& knots, Tick tick) {
  std::size_t next = 1;
  while (next + 1 < knots.size() && tick > knots[next].tick) ++next;
  const Knot& a = knots[next - 1];
  const Knot& b = knots[next];
  const float span = static_cast<float>(std::max(1, b.tick - a.tick));
  return glm::mix(a.turn, b.turn,
                  glm::smoothstep(0.0f, 1.0f, static_cast<float>(tick - a.tick) / span));
}

// Turns the clip about the body's axis so that every straight goes along +Z at its full reach and
// the body comes back to its guard; feet that stand at the start stay where they are, turning on
// their balls. What the end still faces past +Z goes into the root track. `faces`: where the end
// faces in the clip's space, found on the guard without it.
void turn_to_opponent(const Skeleton& skeleton, const CaptureTracks& tracks,
                      const std::vector<Aim>& aims, std::optional<float> faces, Clip& clip) {
  const Tick last = clip.length();
  std::vector<Knot> knots = {{0, 0.0f}};
  for (const Aim& aim : aims) knots.push_back({aim.tick, -aim.yaw});
  const float end = wrapped_angle(faces ? *faces : facing_at(skeleton, clip, tracks, last));
  const float back = std::clamp(-end, -kLargestReturn, kLargestReturn);
  knots.push_back({last, back});
  for (Tick t = 0; t <= last; ++t) {
    Quat& hips = clip.frames[static_cast<std::size_t>(t)].rotation[0];
    hips = glm::normalize(yaw_rotation(turn_at(knots, t)) * hips);
  }
  RetargetSettings settings;
  settings.keep_first_plants = true;
  plant_feet(skeleton, clip, settings);
  const float left_over =
      wrapped_angle(faces ? end + back : facing_at(skeleton, clip, tracks, last));
  const Tick from = aims.back().tick;
  for (Tick t = from; t <= last; ++t)
    clip.root[static_cast<std::size_t>(t)].yaw +=
        left_over *
        glm::smoothstep(0.0f, 1.0f, static_cast<float>(t - from) / static_cast<float>(last - from));
}

}  // namespace

Clip window_about(const Clip& capture, Tick tick) {
  Clip window;
  for (Tick t = tick - 2; t <= tick + 2; ++t) {
    window.frames.push_back(capture.at(t));
    window.root.emplace_back();
    window.contacts.push_back(capture.contacts_at(t));
  }
  return window;
}

CaptureTracks tracks_of(const Clip& capture, double guard_at, float guard_yaw) {
  CaptureTracks tracks;
  for (const Pose& pose : capture.frames) tracks.ground.emplace_back(pose.hips.x, 0, pose.hips.z);
  tracks.ground = smoothed(tracks.ground, 0.16f);
  const Tick at = std::clamp(ticks(guard_at), 0, capture.length());
  tracks.guard = window_about(capture, at);
  // The pelvis wanders: its mean heading over half a second.
  Vec3 forward{};
  for (Tick t = at - 30; t <= at + 30; ++t) {
    const Vec3 ahead = capture.at(t).rotation[0] * kForward;
    forward += Vec3(ahead.x, 0, ahead.z);
  }
  tracks.guard_facing = yaw_of(forward) - guard_yaw;
  return tracks;
}

float facing_at(const Skeleton& skeleton, const Clip& capture, const CaptureTracks& tracks,
                Tick tick) {
  return tracks.guard_facing -
         aligned(skeleton, tracks.guard, window_about(capture, tick)).placement.yaw;
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
  for (const StrikeCut& strike : cut.strikes) {
    const Tick at = ticks(strike.at);
    if (at < first + 6 || at > last - 6)
      return fault(fmt::format("the strike at {} s is not inside it", strike.at),
                   "widen begin and end");
  }

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
  const std::vector<Aim> aims = aims_of(skeleton, action.clip, cut, first);
  std::optional<float> faces;
  if (cut.facing_end) faces = *cut.facing_end - root.front().yaw;
  if (!aims.empty()) turn_to_opponent(skeleton, tracks, aims, faces, action.clip);
  unroll_rotations(action.clip);

  for (const StrikeCut& wanted : cut.strikes) {
    Strike strike;
    strike.kind = wanted.kind;
    strike.joint = wanted.joint;
    strike.zone = wanted.zone;
    strike.aim = wanted.aim;
    const Tick peak = peak_near(skeleton, action.clip, wanted.joint, ticks(wanted.at) - first);
    if (goes_straight(wanted.kind))
      straight_window(skeleton, action.clip, peak, strike);
    else
      arc_window(skeleton, action.clip, peak, strike);
    strike.active_end = std::min(strike.active_end, action.length() + 1);
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
