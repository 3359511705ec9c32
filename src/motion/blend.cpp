#include "motion/blend.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kNothing = 1e-4f;        // a weight that is none
constexpr std::size_t kShortestRun = 6;  // ticks a foot is planted or lifted at least
constexpr float kStraightLeg = 0.985f;   // of a leg's length, unless the repetitions' reach more
constexpr float kSinkSmooth = 0.06f;     // s
constexpr float kThere = 1e-5f;          // m: nearer needs no inverse kinematics
constexpr std::size_t kFeet = 2;

Side side_at(std::size_t i) {
  return i == 0 ? Side::left : Side::right;
}

// A repetition that weighs something, its root's turn without jumps.
struct Source {
  const Action* action = nullptr;
  const std::vector<float>* tick = nullptr;
  float weight = 0;
  std::vector<float> yaw;
};

// Normalized weighed sum in one hemisphere: within 0.5 degrees of the geodesic mean for rotations
// that are less than 60 degrees apart.
struct MeanRotation {
  Quat sum{0, 0, 0, 0};
  Quat first{0, 0, 0, 0};
  void add(Quat q, float weight) {
    if (first == Quat(0, 0, 0, 0)) first = q;
    sum = sum + in_hemisphere_of(q, first) * weight;
  }
  Quat value() const { return glm::normalize(sum); }
};

struct FootSample {
  Vec3 ball{};
  Quat rotation;
  bool planted = false;
  float reach = 0;  // share of the leg's length from hip to ankle
};

// One repetition at a moment between its ticks.
struct Moment {
  Pose local;  // against the root
  Placement root;
  float yaw = 0;  // of the root, without jumps
  std::array<FootSample, kFeet> feet;
};

Moment moment_of(const Skeleton& skeleton, const Source& source, float tick) {
  const Clip& clip = source.action->clip;
  const float at = std::clamp(tick, 0.0f, static_cast<float>(clip.length()));
  const auto before = std::min(static_cast<Tick>(at), clip.length() - 1);
  const float share = at - static_cast<float>(before);
  Moment m;
  const Pose pose = mix(clip.at(before), clip.at(before + 1), share);
  m.root = mix(clip.root_at(before), clip.root_at(before + 1), share);
  m.yaw = glm::mix(source.yaw[static_cast<std::size_t>(before)],
                   source.yaw[static_cast<std::size_t>(before) + 1], share);
  m.local = placed(pose, inverse(m.root));
  const WorldPose world = world_pose(skeleton, pose);
  const FootContacts contacts = clip.contacts_at(share < 0.5f ? before : before + 1);
  for (std::size_t i = 0; i < kFeet; ++i) {
    const Limb limb = leg(side_at(i));
    m.feet[i] = {world.position[index(toes(side_at(i)))], world.rotation[index(limb.end)],
                 contacts.of(side_at(i)),
                 glm::distance(world.position[index(limb.root)], world.position[index(limb.end)]) /
                     skeleton.leg_length()};
  }
  return m;
}

// Where the feet of the blend go, tick by tick.
struct FootTrack {
  std::vector<Vec3> ball, moved;  // m; `moved`: since the tick before, as the planted ones did
  std::vector<Quat> rotation;
  std::vector<float> planted, reach;  // weight of those that are planted; share of the leg's length
  std::vector<bool> stands;
};

// Puts what a foot that stands was moved by others back, and lets that go while it swings.
void hold_plants(FootTrack& foot) {
  const std::size_t count = foot.ball.size();
  std::vector<Vec3> offset(count);
  struct Run {
    std::size_t begin, end;
  };
  std::vector<Run> runs;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin; end < count && foot.stands[end] == foot.stands[begin];) ++end;
    if (foot.stands[begin]) runs.push_back({begin, end});
  }
  for (const Run& run : runs) {
    // Anchored where most agree, the middle of those.
    std::size_t best = run.begin, last = run.begin;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (foot.planted[i] > foot.planted[best] + 1e-3f) best = last = i;
      if (foot.planted[i] >= foot.planted[best] - 1e-3f) last = i;
    }
    const std::size_t anchor = (best + last) / 2;
    Vec3 held = foot.ball[anchor];
    for (std::size_t i = anchor + 1; i < run.end; ++i) {
      held += foot.moved[i];
      offset[i] = held - foot.ball[i];
    }
    held = foot.ball[anchor];
    for (std::size_t i = anchor; i-- > run.begin;) {
      held -= foot.moved[i + 1];
      offset[i] = held - foot.ball[i];
    }
  }
  // Between two plants from the one's offset to the other's; to the ends nothing changes it.
  for (std::size_t r = 0; r <= runs.size() && !runs.empty(); ++r) {
    const std::size_t from = r == 0 ? 0 : runs[r - 1].end;
    const std::size_t to = r == runs.size() ? count : runs[r].begin;
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 a = r == 0 ? offset[runs[0].begin] : offset[runs[r - 1].end - 1];
      const Vec3 b = r == runs.size() ? a : offset[runs[r].begin];
      const float share = glm::smoothstep(
          0.0f, 1.0f, static_cast<float>(i - from + 1) / static_cast<float>(to - from + 1));
      offset[i] = glm::mix(a, b, share);
    }
  }
  for (std::size_t i = 0; i < count; ++i) foot.ball[i] += offset[i];
}

Vec3 ankle_of(const Skeleton& skeleton, const FootTrack& foot, Side side, std::size_t i) {
  return foot.ball[i] - foot.rotation[i] * skeleton.offset[index(toes(side))];
}

// How far the hips sink at each tick so that no leg has to reach farther than those it is made of.
std::vector<float> sinks(const Skeleton& skeleton, const Clip& clip,
                         const std::array<FootTrack, kFeet>& feet) {
  std::vector<float> sink(clip.frames.size(), 0.0f);
  for (std::size_t i = 0; i < sink.size(); ++i) {
    const WorldPose world = world_pose(skeleton, clip.frames[i]);
    for (std::size_t f = 0; f < kFeet; ++f) {
      if (!feet[f].stands[i]) continue;
      const Limb limb = leg(side_at(f));
      const Vec3 hip = world.position[index(limb.root)];
      const Vec3 down = hip - ankle_of(skeleton, feet[f], side_at(f), i);
      const float length =
          skeleton.leg_length() * std::max(kStraightLeg, feet[f].reach[i] + kThere);
      const float flat = std::min(length, std::hypot(down.x, down.z));
      sink[i] = std::max(sink[i], down.y - std::sqrt(length * length - flat * flat));
    }
  }
  if (*std::max_element(sink.begin(), sink.end()) < 1e-4f) return {};
  const auto around = static_cast<std::size_t>(ticks(2.0 * static_cast<double>(kSinkSmooth)));
  return smoothed(widened(sink, around), kSinkSmooth);
}

void place_feet(const Skeleton& skeleton, std::array<FootTrack, kFeet>& feet, Clip& clip) {
  for (FootTrack& foot : feet) hold_plants(foot);
  const std::vector<float> sink = sinks(skeleton, clip, feet);
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    Pose& pose = clip.frames[i];
    if (!sink.empty()) pose.hips.y -= sink[i];
    for (std::size_t f = 0; f < kFeet; ++f) {
      const Limb limb = leg(side_at(f));
      const Vec3 ankle = ankle_of(skeleton, feet[f], side_at(f), i);
      const Vec3 there = world_pose(skeleton, pose).position[index(limb.end)];
      if (glm::distance(there, ankle) > kThere)
        move_limb_end(skeleton, limb, ankle, std::max(kStraightLeg, feet[f].reach[i]), pose);
      set_world_rotation(skeleton, limb.end, feet[f].rotation[i], pose);
    }
  }
}

// Where the blend is in the reference's ticks, at each of its own.
std::vector<float> pace(const std::vector<Source>& sources) {
  const std::size_t count = sources.front().tick->size();
  std::vector<float> time(count, 0.0f);  // own time at each tick of the reference
  for (const Source& source : sources)
    for (std::size_t u = 0; u < count; ++u) time[u] += source.weight * (*source.tick)[u];
  const float stretch = std::max(2.0f, std::round(time.back())) / time.back();
  for (float& t : time) t *= stretch;
  std::vector<float> at;
  std::size_t u = 0;
  for (float t = 0; t < time.back() + 0.5f; t += 1) {
    while (u + 2 < count && time[u + 1] <= t) ++u;
    const float share = std::clamp((t - time[u]) / (time[u + 1] - time[u]), 0.0f, 1.0f);
    at.push_back(static_cast<float>(u) + share);
  }
  return at;
}

float tick_at(const Source& source, float reference) {
  const std::vector<float>& tick = *source.tick;
  const auto u = std::min(static_cast<std::size_t>(reference), tick.size() - 2);
  return glm::mix(tick[u], tick[u + 1], reference - static_cast<float>(u));
}

// Weighed mean of a moment of the action's phases, in the blend's ticks.
template <class Get>
Tick mean_tick(const std::vector<Source>& sources, Tick length, Get get) {
  float sum = 0;
  for (const Source& source : sources)
    sum += source.weight * static_cast<float>(get(*source.action));
  return std::clamp(static_cast<Tick>(std::lround(sum)), 0, length + 1);
}

void set_phases(const std::vector<Source>& sources, Action& action) {
  const Tick length = action.length();
  for (std::size_t i = 0; i < action.strikes.size(); ++i) {
    Strike& strike = action.strikes[i];
    strike.active_begin =
        mean_tick(sources, length, [i](const Action& a) { return a.strikes[i].active_begin; });
    strike.active_end =
        mean_tick(sources, length, [i](const Action& a) { return a.strikes[i].active_end; });
    strike.active_end = std::max(strike.active_end, strike.active_begin + 1);
    strike.nearest = strike.farthest = 0;
    float most = 0;
    bool same = true;
    for (const Source& source : sources) {
      const Strike& of = source.action->strikes[i];
      same = same && of.aim == sources.front().action->strikes[i].aim;
      strike.nearest += source.weight * of.nearest;
      strike.farthest += source.weight * of.farthest;
      if (source.weight <= most) continue;
      most = source.weight;
      strike.zone = of.zone;
      strike.aim = of.aim;
    }
    if (!same) {
      strike.aim.clear();
      strike.nearest = strike.farthest = 0;
    }
  }
  if (!action.defense) return;
  action.defense->begin =
      mean_tick(sources, length, [](const Action& a) { return a.defense->begin; });
  action.defense->end = mean_tick(sources, length, [](const Action& a) { return a.defense->end; });
}

// One tick of the blend; the feet's tracks grow by it.
void add_frame(const Skeleton& skeleton, const std::vector<Source>& sources, float at,
               std::vector<Moment>& before, std::array<FootTrack, kFeet>& feet, Clip& clip) {
  std::vector<Moment> now;
  now.reserve(sources.size());
  for (const Source& source : sources)
    now.push_back(moment_of(skeleton, source, tick_at(source, at)));
  Pose local;
  Placement root;
  std::array<MeanRotation, kJointCount> rotation;
  std::array<MeanRotation, kFeet> foot_rotation;
  std::array<Vec3, kFeet> ball{}, moved{};
  std::array<float, kFeet> planted{}, reach{};
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const float w = sources[s].weight;
    local.hips += now[s].local.hips * w;
    root.x += now[s].root.x * w;
    root.z += now[s].root.z * w;
    root.yaw += now[s].yaw * w;
    for (std::size_t j = 0; j < kJointCount; ++j) rotation[j].add(now[s].local.rotation[j], w);
    for (std::size_t f = 0; f < kFeet; ++f) {
      const FootSample& foot = now[s].feet[f];
      ball[f] += foot.ball * w;
      foot_rotation[f].add(foot.rotation, w);
      reach[f] = std::max(reach[f], foot.reach);
      if (!foot.planted) continue;
      planted[f] += w;
      if (!before.empty()) moved[f] += (foot.ball - before[s].feet[f].ball) * w;
    }
  }
  for (std::size_t j = 0; j < kJointCount; ++j) local.rotation[j] = rotation[j].value();
  root.yaw = wrapped_angle(root.yaw);
  clip.root.push_back(clip.root.empty() ? Placement{} : root);
  clip.frames.push_back(placed(local, root));
  clip.contacts.emplace_back();
  for (std::size_t f = 0; f < kFeet; ++f) {
    feet[f].ball.push_back(ball[f]);
    feet[f].moved.push_back(planted[f] > 0 ? moved[f] / planted[f] : Vec3{});
    feet[f].rotation.push_back(foot_rotation[f].value());
    feet[f].planted.push_back(planted[f]);
    feet[f].reach.push_back(reach[f]);
    feet[f].stands.push_back(planted[f] > 0.5f);
  }
  before = std::move(now);
}

}  // namespace

Action blended(const Skeleton& skeleton, std::span<const Variant> variants,
               std::span<const float> weights) {
  assert(!variants.empty() && variants.size() == weights.size());
  std::vector<Source> sources;
  float total = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (weights[i] < kNothing) continue;
    Source source{variants[i].action, &variants[i].tick, weights[i], {}};
    source.yaw.reserve(source.action->clip.root.size());
    for (const Placement& root : source.action->clip.root) source.yaw.push_back(root.yaw);
    source.yaw = unwrapped(std::move(source.yaw));
    sources.push_back(std::move(source));
    total += weights[i];
  }
  assert(!sources.empty());
  for (Source& source : sources) source.weight /= total;
  Action result = *variants.front().action;
  if (sources.size() == 1) {
    const Action& only = *sources.front().action;
    result.clip = only.clip;
    result.strikes = only.strikes;
    result.defense = only.defense;
    return result;
  }
  result.clip = {};
  std::array<FootTrack, kFeet> feet;
  std::vector<Moment> before;
  for (const float at : pace(sources)) add_frame(skeleton, sources, at, before, feet, result.clip);
  for (FootTrack& foot : feet) {
    close_short_runs(foot.stands, false, kShortestRun);
    close_short_runs(foot.stands, true, kShortestRun);
  }
  for (std::size_t i = 0; i < result.clip.frames.size(); ++i)
    result.clip.contacts[i] = {feet[0].stands[i], feet[1].stands[i]};
  place_feet(skeleton, feet, result.clip);
  unroll_rotations(result.clip);
  set_phases(sources, result);
  return result;
}

}  // namespace ringcraft
