#include "capture/foot_track.h"

#include <algorithm>
#include <cmath>

#include "capture/ease.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kLayTicks = 6;   // over which a foot comes to lie on its ball
constexpr float kCreep = 0.06f;  // m/s at which a planted ball of the foot moves to its next rest
constexpr float kSwaySigma = 0.06f;  // s over which the body takes up what its feet do

// 1 in contacts, falling to 0 over `around` ticks on both sides of them.
std::vector<float> near_contacts(const Clip& clip, Side side, float around) {
  const std::size_t count = clip.frames.size();
  std::vector<float> near(count);
  float away = around;
  const auto pass = [&](std::size_t i) {
    away = clip.contacts[i].of(side) ? 0 : away + 1;
    near[i] = std::max(near[i], 1 - glm::smoothstep(0.0f, around, away));
  };
  for (std::size_t i = 0; i < count; ++i) pass(i);
  away = around;
  for (std::size_t i = count; i-- > 0;) pass(i);
  return near;
}

// Turns feet about their ankles until their balls lie on the floor where they stand, and not under
// it elsewhere.
void lay_balls(const Skeleton& skeleton, const Clip& clip, Side side, FootTrack& track) {
  const std::vector<float> stands = near_contacts(clip, side, kLayTicks);
  const Vec3 flat = skeleton.offset[index(toes(side))];
  const float steepest = 0.95f * glm::length(flat);
  for (std::size_t i = 0; i < track.ball.size(); ++i) {
    const Vec3 points = track.foot[i] * flat;
    const float floor = skeleton.toe_height() - track.ankle[i].y;
    const float down = std::clamp(glm::mix(eased_up(points.y, floor, kFloorEase), floor, stands[i]),
                                  -steepest, steepest);
    const float reach = std::sqrt(glm::length2(flat) - down * down);
    // Where a foot that hangs from its ankle points is told by its axis, not by its tip.
    const Vec3 ground = normalized_or(glm::cross(track.foot[i] * kLeft, kUp), kForward);
    const Quat turn = rotation_between(points, ground * reach + kUp * down);
    track.foot[i] = glm::normalize(turn * track.foot[i]);
    track.ball[i] = track.ankle[i] + track.foot[i] * flat;
  }
}

FootTrack foot_track(const Skeleton& skeleton, const Clip& clip, Side side) {
  FootTrack track;
  for (const Pose& pose : clip.frames) {
    const WorldPose world = world_pose(skeleton, pose);
    track.foot.push_back(world.rotation[index(leg(side).end)]);
    track.toe.push_back(world.rotation[index(toes(side))]);
    track.ball.push_back(world.position[index(toes(side))]);
    track.ankle.push_back(world.position[index(leg(side).end)]);
  }
  track.held = near_contacts(clip, side, kTouchTicks);
  return track;
}

// Lengthens the ways between rests, at the cost of the rests, until the ball creeps no faster than
// kCreep.
void slow_down(std::vector<Rest>& rests) {
  for (std::size_t r = 1; r < rests.size(); ++r) {
    Rest& from = rests[r - 1];
    Rest& to = rests[r];
    const float needs = glm::distance(from.place, to.place) / (kCreep * kTickSeconds);
    const float gap = static_cast<float>(to.begin - from.end);
    const auto more = static_cast<std::size_t>(std::max(0.0f, needs - gap) / 2);
    from.end -= std::min(more, (from.end - from.begin) / 2);
    to.begin += std::min(more, (to.end - to.begin) / 2);
  }
}

float lift_of(const Skeleton& skeleton, const RetargetSettings& settings, const FootTrack& track,
              const Plant& plant) {
  std::vector<float> heights;
  heights.reserve(plant.end - plant.begin);
  for (std::size_t i = plant.begin; i < plant.end; ++i) heights.push_back(track.ball[i].y);
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return std::clamp(skeleton.toe_height() - *middle, -settings.floor_play, settings.floor_play);
}

}  // namespace

std::array<FootTrack, 2> foot_tracks(const Skeleton& skeleton, const Clip& clip,
                                     const RetargetSettings& settings) {
  std::array<FootTrack, 2> feet;
  for (const Side side : {Side::left, Side::right}) {
    FootTrack& track = feet[static_cast<std::size_t>(side)];
    track = foot_track(skeleton, clip, side);
    if (settings.guessed_balls) lay_balls(skeleton, clip, side, track);
  }
  return feet;
}

Vec3 ankle_at(const Skeleton& skeleton, Side side, const FootTrack& track, std::size_t i) {
  return track.ball[i] - track.foot[i] * skeleton.offset[index(toes(side))];
}

void turn_foot(const Skeleton& skeleton, Side side, Quat to, std::size_t i, FootTrack& track) {
  const Vec3 flat = skeleton.offset[index(toes(side))];
  track.ball[i] += (1 - track.held[i]) * (to * flat - track.foot[i] * flat);
  track.ball[i].y = std::max(track.ball[i].y, skeleton.toe_height());
  track.foot[i] = to;
}

Vec3 place_at(const Plant& plant, std::size_t i) {
  const std::vector<Rest>& rests = plant.rests;
  std::size_t next = 0;
  while (next < rests.size() && rests[next].begin <= i) ++next;
  if (next == 0) return rests.front().place;
  const Rest& last = rests[next - 1];
  if (next == rests.size() || i < last.end) return last.place;
  const float share = (static_cast<float>(i - last.end) + 1) /
                      (static_cast<float>(rests[next].begin - last.end) + 1);
  return glm::mix(last.place, rests[next].place, glm::smoothstep(0.0f, 1.0f, share));
}

std::vector<Plant> plants_of(const Skeleton& skeleton, const Clip& clip, Side side,
                             const RetargetSettings& settings, const FootTrack& track) {
  const std::size_t count = track.ball.size();
  std::vector<Plant> plants;
  for (std::size_t i = 0; i < count;) {
    std::size_t end = i;
    Vec3 sum{};
    while (end < count && clip.contacts[end].of(side)) {
      sum += track.ball[end++];
    }
    if (end == i) {
      ++i;
      continue;
    }
    Plant plant{i, end, {}, 0};
    if (!settings.keep_first_plants) plant.rests = rests_of(track.ball, i, end);
    if (plant.rests.empty()) plant.rests.push_back({i, end, sum / static_cast<float>(end - i)});
    if (i == 0 && settings.keep_first_plants) plant.rests.front().place = track.ball.front();
    for (Rest& rest : plant.rests) rest.place.y = skeleton.toe_height();
    slow_down(plant.rests);
    plant.lift = lift_of(skeleton, settings, track, plant);
    plants.push_back(std::move(plant));
    i = end;
  }
  return plants;
}

void sway_with_plants(const Skeleton& skeleton, const RetargetSettings& settings,
                      std::array<std::vector<Plant>, 2>& plants, std::array<FootTrack, 2>& feet,
                      Clip& clip) {
  const std::size_t count = clip.frames.size();
  std::vector<float> x(count), y(count), z(count), planted(count);
  for (std::size_t side = 0; side < 2; ++side)
    for (const Plant& plant : plants[side])
      for (std::size_t i = plant.begin; i < plant.end; ++i) {
        const Vec3 off = place_at(plant, i) - feet[side].ball[i];
        x[i] = (planted[i] * x[i] + off.x) / (planted[i] + 1);
        y[i] = (planted[i] * y[i] + plant.lift) / (planted[i] + 1);
        z[i] = (planted[i] * z[i] + off.z) / (planted[i] + 1);
        ++planted[i];
      }
  x = smoothed(x, planted, kSwaySigma);
  // The height that all plants share is the floor's.
  float share = 0, mean = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (planted[i] > 0) mean += y[i], ++share;
  for (float& height : y) height -= share > 0 ? mean / share : 0;
  y = smoothed(y, planted, kSwaySigma);
  z = smoothed(z, planted, kSwaySigma);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 sway(x[i], y[i], z[i]);
    clip.frames[i].hips += sway;
    for (FootTrack& track : feet) {
      track.ball[i] += sway;
      track.ankle[i] += sway;
    }
  }
  for (std::size_t side = 0; side < 2; ++side)
    for (Plant& plant : plants[side]) plant.lift = lift_of(skeleton, settings, feet[side], plant);
}

}  // namespace ringcraft
