// The clean-up of the feet: see plant_feet in retarget.h.
#include <algorithm>
#include <cmath>

#include "capture/ankle.h"
#include "capture/ease.h"
#include "capture/foot_track.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.985f;  // of a leg's length: beyond it its reach is eased
constexpr float kFoldedShare =
    0.262f;  // of a leg's length: hip to ankle when the knee bends by 150 degrees
constexpr float kLargestShift = 0.12f;        // m by which the hips give way
constexpr float kDorsiflexion = radians(34);  // an ankle under the body's weight
constexpr float kNearFloor =
    0.06f;  // m: a ball of the foot lower than this bends its toes to the floor

constexpr float kFloorEase = 0.03f;  // m over which a foot in the air keeps out of the floor
constexpr float kHeel = -0.04f;      // m of the heel behind the ankle

// The rotation that lays a foot which points up more than flat down to flat.
Quat laid_flat(Vec3 flat, Quat foot) {
  const Vec3 points = foot * flat;
  const float ground = std::hypot(points.x, points.z);
  if (points.y <= flat.y || ground < 1e-3f) return foot;
  const float reach = std::hypot(flat.x, flat.z) / ground;
  const Vec3 laid(points.x * reach, flat.y, points.z * reach);
  return in_hemisphere_of(rotation_between(points, laid) * foot, foot);
}

// The share of laid_flat that a foot needs for its heel not to go under the floor, the ankle at
// `ankle_height`.
float share_laid(const Skeleton& skeleton, Vec3 flat, Quat foot, float ankle_height) {
  const Vec3 heel(0, -skeleton.ankle_height(), kHeel);
  if ((foot * flat).y <= flat.y || ankle_height + (foot * heel).y >= 0) return 0;
  const Quat laid = laid_flat(flat, foot);
  float low = 0, high = 1;
  for (int round = 0; round < 10; ++round) {
    const float share = 0.5f * (low + high);
    (ankle_height + (glm::slerp(foot, laid, share) * heel).y >= 0 ? high : low) = share;
  }
  return high;
}

// By how much ball and ankle leave the way they would go.
struct Correction {
  Vec3 ball{}, ankle{};
};

Correction correction(const Plant& plant, const FootTrack& track, std::size_t i) {
  const Vec3 ball = place_at(plant, i) - track.ball[i];
  return {ball, {ball.x, plant.lift, ball.z}};
}

// Turns the foot to where ball and ankle want it, with its heel out of the floor; where that lays
// it, the ball goes down.
void turn_feet(const Skeleton& skeleton, Side side, FootTrack& track) {
  const std::size_t count = track.ball.size();
  const Vec3 flat = skeleton.offset[index(toes(side))];
  std::vector<float> share(count), ankle(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Quat turn = rotation_between(track.foot[i] * flat, track.ball[i] - track.ankle[i]);
    track.foot[i] = glm::normalize(turn * track.foot[i]);
    track.toe[i] = glm::normalize(turn * track.toe[i]);
    track.ball[i] = glm::mix(track.ankle[i] + track.foot[i] * flat, track.ball[i], track.held[i]);
    ankle[i] = track.ball[i].y - (track.foot[i] * flat).y;
    share[i] = share_laid(skeleton, flat, track.foot[i], ankle[i]) * track.held[i];
  }
  share = smoothed(widened(share, 4), 0.016f);
  std::vector<float> raise(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Quat laid = glm::slerp(track.foot[i], laid_flat(flat, track.foot[i]), share[i]);
    turn_foot(skeleton, side, glm::normalize(laid), i, track);
    track.ball[i].y = std::max(skeleton.toe_height(), ankle[i] + (track.foot[i] * flat).y);
    const Vec3 heel(0, -skeleton.ankle_height(), kHeel);
    const float low = (track.ball[i] + track.foot[i] * (heel - flat)).y;
    raise[i] = eased_up(low, 0, kFloorEase) - low;
  }
  raise = smoothed(raise, 0.02f);
  for (std::size_t i = 0; i < count; ++i) track.ball[i].y += raise[i] * (1 - track.held[i]);
}

// Moves the path of one foot: the ball, planted, stands still on the floor; between plants the
// correction goes over smoothly from one to the next. The foot turns about its ball to where the
// ankle goes its own way.
void pin(const Skeleton& skeleton, Side side, const RetargetSettings& settings,
         const std::vector<Plant>& plants, FootTrack& track) {
  const std::size_t count = track.ball.size();
  std::vector<Correction> moved(count);
  const auto blend = static_cast<float>(ticks(static_cast<double>(settings.blend_seconds)));
  for (std::size_t p = 0; p <= plants.size(); ++p) {
    const std::size_t from = p == 0 ? 0 : plants[p - 1].end;
    const std::size_t to = p == plants.size() ? count : plants[p].begin;
    for (std::size_t i = from; i < to; ++i) {
      // Out of the last plant and into the next, each over the blend or half of the way between.
      const auto swing = static_cast<float>(to - from);
      const float reach =
          p == 0 || p == plants.size() ? blend : std::max(std::min(blend, swing), 1.0f);
      Correction shift;
      float weight = 0;
      const auto add = [&](const Correction& by, float w, float away) {
        const float down = 1 - glm::smoothstep(0.0f, std::min(reach, kTouchTicks), away);
        shift.ball += by.ball * Vec3(w, down, w);
        shift.ankle += by.ankle * w;
        weight += w;
      };
      if (p > 0)
        add(correction(plants[p - 1], track, plants[p - 1].end - 1),
            1 - glm::smoothstep(0.0f, reach, static_cast<float>(i - from) + 1),
            static_cast<float>(i - from) + 1);
      if (p < plants.size())
        add(correction(plants[p], track, plants[p].begin),
            1 - glm::smoothstep(0.0f, reach, static_cast<float>(to - i)),
            static_cast<float>(to - i));
      const float most = std::max(weight, 1.0f);
      moved[i] = {shift.ball / most, shift.ankle / most};
    }
    if (p < plants.size())
      for (std::size_t i = plants[p].begin; i < plants[p].end; ++i)
        moved[i] = correction(plants[p], track, i);
  }
  for (std::size_t i = 0; i < count; ++i) {
    track.ball[i] += moved[i].ball;
    track.ball[i].y = std::max(track.ball[i].y, skeleton.toe_height());
    track.ankle[i] += moved[i].ankle;
  }
  turn_feet(skeleton, side, track);
  for (std::size_t i = 0; i < count; ++i) {
    const float above = track.ball[i].y - skeleton.toe_height();
    const float share = 1 - glm::smoothstep(0.0f, kNearFloor, above);
    // Toes bend up and down; a foot on its edge keeps them there.
    const Vec3 points = track.foot[i] * kForward;
    const Quat laid =
        rotation_between(points, yaw_rotation(yaw_of(points)) * kForward) * track.foot[i];
    track.toe[i] = glm::slerp(track.toe[i], in_hemisphere_of(laid, track.toe[i]), share);
  }
}

// Moves the hips up or down, smoothly, where a planted leg is too short for its place, or folded
// further than its knee goes. They sink for longer than one step, so that a walk is not made to
// bob, and rise as briefly as the fold lasts.
void fit_hips(const Skeleton& skeleton, const std::array<FootTrack, 2>& feet, Clip& clip) {
  const std::size_t count = clip.frames.size();
  std::vector<float> sink(count), rise(count);
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
        sink[i] = std::max(std::min(sink[i], highest + line.y), -kLargestShift);
      if (-line.y < lowest && sink[i] >= 0)
        rise[i] = std::min(std::max(rise[i], lowest + line.y), kLargestShift);
    }
  }
  sink = smoothed(widened(sink, 40), 0.15f);
  rise = smoothed(widened(rise, 8), 0.04f);
  for (std::size_t i = 0; i < count; ++i) clip.frames[i].hips.y += sink[i] + rise[i];
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
        turn_foot(skeleton, side, track.foot[i] * glm::angleAxis(bend - kDorsiflexion, kLeft), i,
                  track);
      }
    }
  }
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
        turn_foot(skeleton, side, glm::normalize(shin * ankle_within_range(ankle)), i, track);
      }
    }
  }
}

// What of an ankle's height its range takes, the hips rise by half: a body whose ankles bend less
// crouches less.
void rise_on_ankles(const Skeleton& skeleton, const std::array<FootTrack, 2>& pinned,
                    const std::array<FootTrack, 2>& feet, Clip& clip) {
  constexpr float kShare = 0.5f;
  constexpr float kHighest = 0.03f;  // m
  const std::size_t count = clip.frames.size();
  std::vector<float> rise(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const Side side : {Side::left, Side::right}) {
      if (!clip.contacts[i].of(side)) continue;
      const auto s = static_cast<std::size_t>(side);
      const float over = ankle_at(skeleton, side, feet[s], i).y - pinned[s].captured[i].y;
      rise[i] = std::max(rise[i], kShare * over);
    }
  rise = smoothed(widened(rise, 8), 0.2f);
  for (std::size_t i = 0; i < count; ++i) clip.frames[i].hips.y += std::min(rise[i], kHighest);
}

// What plants lift an ankle by over its captured height goes over smoothly from each to the next,
// through the swings between them.
void swing_as_planted(const Skeleton& skeleton, const Clip& clip, Side side, FootTrack& track) {
  const std::size_t count = clip.frames.size();
  std::vector<float> higher(count), planted(count);
  for (std::size_t i = 0; i < count; ++i) {
    planted[i] = clip.contacts[i].of(side) ? 1.0f : 0.0f;
    higher[i] = ankle_at(skeleton, side, track, i).y - track.captured[i].y;
  }
  const std::vector<float> carried = smoothed(higher, planted, 0.1f);
  for (std::size_t i = 0; i < count; ++i)
    track.ball[i].y += (1 - track.held[i]) * std::max(0.0f, carried[i] - higher[i]);
}

}  // namespace

void plant_feet(const Skeleton& skeleton, Clip& clip, const RetargetSettings& settings) {
  std::array<FootTrack, 2> feet = foot_tracks(skeleton, clip, settings);
  // A cut clip has been through this before, and stays where it was.
  const bool first = !settings.keep_first_plants;
  std::array<std::vector<Plant>, 2> plants;
  for (const Side side : {Side::left, Side::right})
    plants[static_cast<std::size_t>(side)] =
        plants_of(skeleton, clip, side, settings, feet[static_cast<std::size_t>(side)]);
  if (first) sway_with_plants(skeleton, settings, plants, feet, clip);
  for (const Side side : {Side::left, Side::right}) {
    FootTrack& track = feet[static_cast<std::size_t>(side)];
    track.captured = track.ankle;
    pin(skeleton, side, settings, plants[static_cast<std::size_t>(side)], track);
  }
  const std::array<FootTrack, 2> pinned = feet;
  lift_heels(skeleton, clip, feet);
  fit_hips(skeleton, feet, clip);
  fit_ankles(skeleton, clip, feet);
  if (first) {
    rise_on_ankles(skeleton, pinned, feet, clip);
    feet = pinned;
    lift_heels(skeleton, clip, feet);
    fit_ankles(skeleton, clip, feet);
    for (const Side side : {Side::left, Side::right})
      swing_as_planted(skeleton, clip, side, feet[static_cast<std::size_t>(side)]);
    fit_ankles(skeleton, clip, feet);
  }
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    for (const Side side : {Side::left, Side::right}) {
      const FootTrack& track = feet[static_cast<std::size_t>(side)];
      place_leg(skeleton, side, track, i, clip.frames[i]);
      set_world_rotation(skeleton, toes(side), track.toe[i], clip.frames[i]);
    }
  }
}

}  // namespace ringcraft
