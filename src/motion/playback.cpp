#include "motion/playback.h"

#include <algorithm>
#include <cmath>

#include "motion/ik.h"

namespace ringcraft {

namespace {

// A critically damped spring of this rate falls to about 1 % in `seconds`.
float rate_for(float seconds) {
  return 6.6f / seconds;
}

float smooth(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * t * (10 + t * (6 * t - 15));
}

Vec3 on_ground(Vec3 v) {
  return {v.x, 0, v.z};
}

constexpr float kStraightest = 0.992f;  // of the leg's length: beyond it the hips sink

}  // namespace

void Decay::step(float dt, float rate) {
  // x(t) = (x0 + (v0 + r x0) t) e^(-r t)
  const Vec3 slope = velocity + value * rate;
  const float fade = std::exp(-rate * dt);
  value = (value + slope * dt) * fade;
  velocity = slope * fade - value * rate;
}

Playback::Playback(const Skeleton& body, const PlaybackSettings& settings)
    : skeleton_(body), settings_(settings) {}

void Playback::stitch(const Pose& now, const Pose& after) {
  if (!started_) return;
  // The shown motion carried on by one tick, against the new motion: offset and its velocity.
  const Vec3 hips_velocity = (shown_.hips - before_.hips) / kTickSeconds;
  const Vec3 clip_velocity = (after.hips - now.hips) / kTickSeconds;
  hips_ = {shown_.hips + hips_velocity * kTickSeconds - now.hips, hips_velocity - clip_velocity};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Vec3 spin =
        rotation_vector(shown_.rotation[j] * glm::inverse(before_.rotation[j])) / kTickSeconds;
    const Vec3 clip_spin =
        rotation_vector(after.rotation[j] * glm::inverse(now.rotation[j])) / kTickSeconds;
    const Quat carried = from_rotation_vector(spin * kTickSeconds) * shown_.rotation[j];
    rotation_[j] = {rotation_vector(carried * glm::inverse(now.rotation[j])), spin - clip_spin};
  }
}

const Pose& Playback::next(const Pose& clip_pose, FootContacts contacts) {
  Pose pose = clip_pose;
  pose.hips += hips_.value;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    pose.rotation[j] =
        glm::normalize(from_rotation_vector(rotation_[j].value) * clip_pose.rotation[j]);
  }
  const float rate = rate_for(settings_.blend_seconds);
  hips_.step(kTickSeconds, rate);
  for (Decay& decay : rotation_) decay.step(kTickSeconds, rate);
  place_feet(clip_pose, contacts, pose);
  return show(pose);
}

const Pose& Playback::next_simulated(const Pose& pose) {
  for (Foot& foot : feet_) foot = {};
  return show(pose);
}

const Pose& Playback::show(const Pose& pose) {
  before_ = started_ ? shown_ : pose;
  shown_ = pose;
  started_ = true;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    shown_.rotation[j] = in_hemisphere_of(shown_.rotation[j], before_.rotation[j]);
  }
  return shown_;
}

// Where the ball of the foot goes. `ball`: in the blended pose; `clip_ball`: in the clip.
Vec3 Playback::hold_foot(Side side, bool planted, Vec3 ball, Vec3 clip_ball) {
  Foot& foot = feet_[static_cast<std::size_t>(side)];
  const Foot& other = feet_[static_cast<std::size_t>(ringcraft::other(side))];
  const float floor = skeleton_.toe_height();
  if (planted && !foot.held && !foot.restep) {  // set down where it is shown
    foot.held = true;
    foot.place = on_ground(ball + foot.offset.value);
    foot.offset = {};
  }
  if (!planted && (foot.held || foot.restep)) {  // lifted: the way back to the clip
    foot.held = false;
    foot.restep.reset();
    foot.offset = {foot.place - on_ground(ball), {}};
  }
  if (!planted) {
    const Vec3 wanted = ball + foot.offset.value;
    foot.offset.step(kTickSeconds, rate_for(settings_.unlock_seconds));
    return {wanted.x, std::max(wanted.y, floor), wanted.z};
  }
  if (foot.held && !foot.restep && !other.restep && since_restep_ > 6 &&
      glm::distance(foot.place, on_ground(clip_ball)) > settings_.restep_distance) {
    foot.restep = 0;
    foot.restep_from = foot.place;
  }
  if (foot.restep) {
    const float share =
        static_cast<float>(++*foot.restep) * kTickSeconds / settings_.restep_seconds;
    foot.place = foot.restep_from + (on_ground(clip_ball) - foot.restep_from) * smooth(share);
    const float lift =
        settings_.restep_lift * std::pow(std::sin(kPi * std::min(share, 1.0f)), 1.0f);
    if (share >= 1) foot.restep.reset();
    since_restep_ = 0;
    return {foot.place.x, floor + lift, foot.place.z};
  }
  return {foot.place.x, floor, foot.place.z};
}

void Playback::place_feet(const Pose& clip_pose, FootContacts contacts, Pose& pose) {
  const WorldPose world = world_pose(skeleton_, pose);
  const WorldPose clip_world = world_pose(skeleton_, clip_pose);
  std::array<Vec3, 2> ankle;
  float sink = 0;
  ++since_restep_;
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t ball = index(toes(side)), end = index(leg(side).end),
                      root = index(leg(side).root);
    const Vec3 wanted =
        hold_foot(side, contacts.of(side), world.position[ball], clip_world.position[ball]);
    ankle[static_cast<std::size_t>(side)] = world.position[end] + (wanted - world.position[ball]);
    // The hips sink where a held foot would be out of reach.
    const Vec3 line = world.position[root] - ankle[static_cast<std::size_t>(side)];
    const float across = glm::length(on_ground(line));
    const float reach = kStraightest * skeleton_.leg_length();
    if (contacts.of(side) && across < reach) {
      sink = std::max(sink, line.y - std::sqrt(reach * reach - across * across));
    }
  }
  pose.hips.y -= sink;
  for (const Side side : {Side::left, Side::right}) {
    const Limb limb = leg(side);
    const Vec3 forward = world.rotation[index(limb.root)] * kForward;
    LimbTarget target;
    target.position = ankle[static_cast<std::size_t>(side)];
    target.position.y = std::max(target.position.y, 0.6f * skeleton_.ankle_height());
    target.pole = present_pole(world, limb, forward);
    target.soft_share = 0.997f;
    solve_limb(skeleton_, limb, target, pose);
  }
}

}  // namespace ringcraft
