// The clean-up of the feet: see plant_feet in retarget.h.
#include <algorithm>
#include <cmath>

#include "capture/retarget.h"
#include "motion/smooth.h"
#include "motion/ik.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.97f;  // of a leg's length: beyond it its reach is eased
constexpr float kFoldedShare =
    0.262f;  // of a leg's length: hip to ankle when the knee bends by 150 degrees
constexpr float kLargestShift = 0.12f;        // m by which the hips give way
constexpr float kDorsiflexion = radians(34);  // an ankle under the body's weight
constexpr float kNearFloor =
    0.06f;  // m: a ball of the foot lower than this bends its toes to the floor

struct FootTrack {
  std::vector<Quat> foot, toe;  // world rotations, laid flat near the floor
  std::vector<Vec3> ball;       // where the ball of the foot goes
};

// The foot's rotation with its heel not under the floor: where it points up more than flat, it is
// flat.
Quat with_heel_up(const Skeleton& skeleton, Side side, Quat foot, float share) {
  const Vec3 flat = skeleton.offset[index(toes(side))];
  const Vec3 points = foot * flat;
  if (share <= 0 || points.y <= flat.y) return foot;
  const float ground = std::hypot(points.x, points.z);
  if (ground < 1e-3f) return foot;
  const float reach = std::hypot(flat.x, flat.z) / ground;
  const Vec3 laid(points.x * reach, flat.y, points.z * reach);
  return glm::normalize(
      glm::slerp(foot, in_hemisphere_of(rotation_between(points, laid) * foot, foot), share));
}

FootTrack foot_track(const Skeleton& skeleton, const Clip& clip, Side side) {
  FootTrack track;
  for (const Pose& pose : clip.frames) {
    const WorldPose world = world_pose(skeleton, pose);
    const Vec3 ball = world.position[index(toes(side))];
    const float share = 1 - glm::smoothstep(0.0f, kNearFloor, ball.y - skeleton.toe_height());
    const Quat foot = with_heel_up(skeleton, side, world.rotation[index(leg(side).end)], share);
    const Quat toe = world.rotation[index(toes(side))];
    const Quat flat = yaw_rotation(yaw_of(foot * kForward));
    track.foot.push_back(foot);
    track.toe.push_back(glm::slerp(toe, in_hemisphere_of(flat, toe), share));
    track.ball.push_back(ball);
  }
  return track;
}

// Moves the path of one ball of the foot: planted it stands at the mean of its path on the floor;
// between, the correction goes over smoothly from one plant to the next.
void pin(const Skeleton& skeleton, const Clip& clip, Side side, const RetargetSettings& settings,
         FootTrack& track) {
  const std::size_t count = track.ball.size();
  struct Plant {
    std::size_t begin, end;
    Vec3 place;
  };
  std::vector<Plant> plants;
  for (std::size_t i = 0; i < count;) {
    std::size_t end = i;
    Vec3 sum{};
    while (end < count && clip.contacts[end].of(side)) sum += track.ball[end++];
    if (end == i) {
      ++i;
      continue;
    }
    Vec3 place = sum / static_cast<float>(end - i);
    if (i == 0 && settings.keep_first_plants) place = track.ball.front();
    place.y = skeleton.toe_height();
    plants.push_back({i, end, place});
    i = end;
  }
  std::vector<Vec3> moved = track.ball;
  const auto correction = [&](const Plant& plant, std::size_t at) {
    return plant.place - track.ball[at];
  };
  const auto blend = static_cast<float>(ticks(static_cast<double>(settings.blend_seconds)));
  for (std::size_t p = 0; p <= plants.size(); ++p) {
    const std::size_t from = p == 0 ? 0 : plants[p - 1].end;
    const std::size_t to = p == plants.size() ? count : plants[p].begin;
    for (std::size_t i = from; i < to; ++i) {
      // Out of the last plant and into the next, each over the blend or half of the way between.
      const auto swing = static_cast<float>(to - from);
      const float reach =
          p == 0 || p == plants.size() ? blend : std::max(std::min(blend, swing), 1.0f);
      Vec3 shift{};
      float weight = 0;
      if (p > 0) {
        const float w = 1 - glm::smoothstep(0.0f, reach, static_cast<float>(i - from) + 1);
        shift += correction(plants[p - 1], plants[p - 1].end - 1) * w;
        weight += w;
      }
      if (p < plants.size()) {
        const float w = 1 - glm::smoothstep(0.0f, reach, static_cast<float>(to - i));
        shift += correction(plants[p], plants[p].begin) * w;
        weight += w;
      }
      moved[i] += weight > 1 ? shift / weight : shift;
      moved[i].y = std::max(moved[i].y, skeleton.toe_height());
    }
    if (p < plants.size())
      for (std::size_t i = plants[p].begin; i < plants[p].end; ++i) moved[i] = plants[p].place;
  }
  track.ball = std::move(moved);
}

Vec3 ankle_at(const Skeleton& skeleton, Side side, const FootTrack& track, std::size_t i) {
  return track.ball[i] - track.foot[i] * skeleton.offset[index(toes(side))];
}

// The least within `around` ticks where it is below zero, the most where it is above: a smoothed
// track then still gives each moment what it needs.
std::vector<float> widened(const std::vector<float>& needs, std::size_t around) {
  const std::size_t count = needs.size();
  std::vector<float> out(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i >= around ? i - around : 0; k <= std::min(count - 1, i + around); ++k)
      if (std::abs(needs[k]) > std::abs(out[i])) out[i] = needs[k];
  return out;
}

// Moves the hips up or down, smoothly, where a planted leg is too short for its place, or folded
// further than its knee goes.
void fit_hips(const Skeleton& skeleton, const std::array<FootTrack, 2>& feet, Clip& clip) {
  const std::size_t count = clip.frames.size();
  std::vector<float> rise(count);
  const float most = kSoftShare * skeleton.leg_length();
  const float least = kFoldedShare * skeleton.leg_length();
  for (std::size_t i = 0; i < count; ++i) {
    const WorldPose world = world_pose(skeleton, clip.frames[i]);
    for (const Side side : {Side::left, Side::right}) {
      if (!clip.contacts[i].of(side)) continue;
      const Vec3 ankle = ankle_at(skeleton, side, feet[static_cast<std::size_t>(side)], i);
      const Vec3 line = ankle - world.position[index(leg(side).root)];
      const float ground = std::min(std::hypot(line.x, line.z), 0.95f * most);
      const float lowest = ground < least ? std::sqrt(least * least - ground * ground) : -1.0f;
      const float highest = std::sqrt(most * most - ground * ground);
      if (-line.y > highest)
        rise[i] = std::max(std::min(rise[i], highest + line.y), -kLargestShift);
      if (-line.y < lowest && rise[i] >= 0)
        rise[i] = std::min(std::max(rise[i], lowest + line.y), kLargestShift);
    }
  }
  const std::vector<float> smooth = smoothed(widened(rise, 8), 0.04f);
  for (std::size_t i = 0; i < count; ++i) clip.frames[i].hips.y += smooth[i];
}

void place_leg(const Skeleton& skeleton, Side side, const FootTrack& track, std::size_t i,
               Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  LimbTarget target;
  target.position = ankle_at(skeleton, side, track, i);
  target.pole = present_pole(world, leg(side), world.rotation[index(leg(side).root)] * kForward);
  target.soft_share = kSoftShare;
  solve_limb(skeleton, leg(side), target, pose);
  set_world_rotation(skeleton, leg(side).end, track.foot[i], pose);
}

// A shin that leans farther than the ankle bends lifts the heel; that moves the ankle in turn.
void lift_heels(const Skeleton& skeleton, const Clip& clip, std::array<FootTrack, 2>& feet) {
  constexpr int kRounds = 4;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    for (const Side side : {Side::left, Side::right}) {
      FootTrack& track = feet[static_cast<std::size_t>(side)];
      Pose pose = clip.frames[i];
      for (int round = 0; round < kRounds; ++round) {
        place_leg(skeleton, side, track, i, pose);
        const Quat ankle = pose.rotation[index(leg(side).end)];
        const float bend = -wrapped_angle(2 * std::atan2(ankle.x, ankle.w));
        if (bend <= kDorsiflexion) break;
        track.foot[i] = track.foot[i] * glm::angleAxis(bend - kDorsiflexion, kLeft);
      }
    }
  }
}

// Ankle ranges (physics/limits.cpp), rad, and how long before its end a range begins to resist.
constexpr float kPlantar = radians(60), kDorsal = radians(35), kSideways = radians(35);
constexpr float kAnkleEase = radians(6);

// Nearer to zero where `angle` comes close to `limit`, which it never passes.
float held_within(float angle, float limit) {
  const float free = limit - kAnkleEase, over = std::abs(angle) - free;
  if (over <= 0) return angle;
  return std::copysign(free + kAnkleEase * (1 - std::exp(-over / kAnkleEase)), angle);
}

Quat ankle_within_range(Quat ankle) {
  const float bend = wrapped_angle(2 * std::atan2(ankle.x, ankle.w));
  Vec3 swing = rotation_vector(ankle * glm::angleAxis(-bend, kLeft));
  swing.y = held_within(swing.y, kSideways);
  swing.z = held_within(swing.z, kSideways);
  const float kept = held_within(bend, bend < 0 ? kDorsal : kPlantar);
  return glm::normalize(from_rotation_vector(swing) * glm::angleAxis(kept, kLeft));
}

// Turns feet on their balls to where the ankle can hold them; that moves the shin in turn.
void fit_ankles(const Skeleton& skeleton, const Clip& clip, std::array<FootTrack, 2>& feet) {
  constexpr int kRounds = 4;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    for (const Side side : {Side::left, Side::right}) {
      FootTrack& track = feet[static_cast<std::size_t>(side)];
      const Quat asked = track.foot[i];
      Pose pose = clip.frames[i];
      for (int round = 0; round < kRounds; ++round) {
        place_leg(skeleton, side, track, i, pose);
        const Quat shin = world_pose(skeleton, pose).rotation[index(leg(side).middle)];
        const Quat ankle = glm::inverse(shin) * asked;
        track.foot[i] = glm::normalize(shin * ankle_within_range(ankle));
      }
    }
  }
}

}  // namespace

void plant_feet(const Skeleton& skeleton, Clip& clip, const RetargetSettings& settings) {
  std::array<FootTrack, 2> feet;
  for (const Side side : {Side::left, Side::right}) {
    FootTrack& track = feet[static_cast<std::size_t>(side)];
    track = foot_track(skeleton, clip, side);
    pin(skeleton, clip, side, settings, track);
  }
  lift_heels(skeleton, clip, feet);
  fit_hips(skeleton, feet, clip);
  fit_ankles(skeleton, clip, feet);
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    for (const Side side : {Side::left, Side::right}) {
      const FootTrack& track = feet[static_cast<std::size_t>(side)];
      place_leg(skeleton, side, track, i, clip.frames[i]);
      set_world_rotation(skeleton, toes(side), track.toe[i], clip.frames[i]);
    }
  }
}

}  // namespace ringcraft
