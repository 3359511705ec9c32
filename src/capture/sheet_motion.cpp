#include "capture/sheet_motion.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/random.h"

namespace ringcraft {

namespace {

constexpr float kH = kCanonicalHeight;

// Keys of the trunk come before those of the hand by the chain's links; the first and the last
// stay.
float chained(const SheetAction& action, float t, float links) {
  if (t <= 0 || t >= action.length - 1e-4f) return t;
  return t - links * action.chain * std::min(1.0f, t / 0.2f);
}

Track track_of(const std::vector<SheetKey>& keys, Channel channel, const SheetAction& action,
               float links = 0) {
  Track track;
  for (const SheetKey& key : keys) {
    const auto& value = key.values[index(channel)];
    if (value) track.add(chained(action, key.t, links), *value);
  }
  return track;
}

bool given(const std::vector<SheetKey>& keys, Channel channel) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const SheetKey& key) { return key.values[index(channel)].has_value(); });
}

std::vector<ProfileWindow> windows_of(const SheetAction& action, Joint joint) {
  std::vector<ProfileWindow> windows;
  for (const SheetStrike& strike : action.strikes) {
    if (tip_of(strike.strike.joint) == joint) {
      windows.push_back({strike.start, strike.contact, speed_profile(strike.profile)});
    }
  }
  std::sort(windows.begin(), windows.end(),
            [](const ProfileWindow& a, const ProfileWindow& b) { return a.start < b.start; });
  return windows;
}

// The part of `point` off the line from `from` to `to`; nothing where it says too little.
std::optional<Vec3> off_line(Vec3 from, Vec3 to, Vec3 point) {
  const Vec3 line = normalized_or(to - from, kUp);
  const Vec3 off = (point - from) - line * glm::dot(point - from, line);
  if (glm::length(off) < 0.02f * kH) return std::nullopt;
  return glm::normalize(off);
}

// Channels that a body turned once about reads 360 degrees on.
bool is_yaw(Channel channel) {
  return channel == Channel::pelvis_yaw || channel == Channel::chest_yaw ||
         channel == Channel::lead_foot_yaw || channel == Channel::rear_foot_yaw;
}

}  // namespace

std::vector<SheetKey> merged_keys(const SheetAction& action) {
  std::vector<SheetKey> keys;
  keys.push_back({0, action.start.values});
  for (const SheetKey& key : action.keys) {
    if (key.t > keys.back().t + 1e-4f) keys.push_back({key.t, {}});
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      if (key.values[i]) keys.back().values[i] = key.values[i];
    }
  }
  if (keys.back().t < action.length - 1e-4f) keys.push_back({action.length, {}});
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (keys.back().values[i]) continue;
    keys.back().values[i] = action.end.values[i];
    if (keys.back().values[i] && is_yaw(static_cast<Channel>(i))) {
      keys.back().values[i]->x += full_turns(action);
    }
  }
  return keys;
}

Placement end_placement(const SheetAction& action) {
  Placement end = action.end_at;
  if (!action.pivot) return end;
  const auto& ball = action.start.ball[*action.pivot == Side::left ? 0 : 1];
  if (!ball) return end;
  const Vec3 stays = Vec3(ball->x, 0, ball->y) * kH;
  const Vec3 turned = yaw_rotation(end.yaw) * stays;
  return {stays.x - turned.x, stays.z - turned.z, end.yaw};
}

std::vector<Placement> root_track(const SheetAction& action, const std::vector<SheetKey>& keys) {
  float begin = 0, finish = action.length;
  if (!action.steps.empty()) {
    begin = action.length;
    finish = 0;
    for (const SheetStep& step : action.steps) {
      begin = std::min(begin, step.lift);
      finish = std::max(finish, step.land.value_or(action.length));
    }
    begin = std::max(0.0f, begin - 0.06f);
    finish = std::min(action.length, finish + 0.04f);
  }
  if (action.root_time) {
    begin = action.root_time->x;
    finish = action.root_time->y;
  }
  const Placement end = end_placement(action);
  Track track;
  track.add(begin, {});
  for (const SheetKey& key : keys) {
    const auto& at = key.values[index(Channel::root)];
    if (at && key.t > begin && key.t < finish) {
      track.add(key.t, {at->x * kH, at->y * kH, radians(at->z)});
    }
  }
  track.add(finish, {end.x, end.z, end.yaw});
  const Tick last = ticks(action.length);
  std::vector<Vec3> values;
  values.reserve(static_cast<std::size_t>(last) + 1);
  for (Tick tick = 0; tick <= last; ++tick) {
    values.push_back(track.at(static_cast<float>(seconds(tick))));
  }
  smooth(values, 4);
  std::vector<Placement> root;
  root.reserve(values.size());
  for (const Vec3& v : values) root.push_back({v.x, v.y, v.z});
  root.front() = {};
  return root;
}

TrunkMotion::TrunkMotion(const SheetAction& action, const std::vector<SheetKey>& keys)
    : pelvis_(track_of(keys, Channel::pelvis, action, 2)),
      pelvis_yaw_(track_of(keys, Channel::pelvis_yaw, action, 2)),
      chest_yaw_(track_of(keys, Channel::chest_yaw, action, 1)),
      lean_(track_of(keys, Channel::lean, action, 1)),
      bounce_hz_(action.bounce_hz),
      bounce_(action.bounce) {
  // Where a key says nothing of them, the pelvis takes a part of the lean and the head follows.
  if (given(keys, Channel::pelvis_lean)) {
    for (const SheetKey& key : keys) {
      const bool edge = key.t <= 0 || key.t >= action.length - 1e-4f;
      const auto& value = key.values[index(Channel::pelvis_lean)];
      const float t = chained(action, key.t, 2);
      if (value) pelvis_lean_.add(t, *value);
      if (!value && edge) pelvis_lean_.add(t, *key.values[index(Channel::lean)] * 0.35f);
    }
  }
  if (given(keys, Channel::head) || action.turns != 0) {
    for (const SheetKey& key : keys) {
      const bool edge = key.t <= 0 || key.t >= action.length - 1e-4f;
      const auto& value = key.values[index(Channel::head)];
      if (value) head_.add(key.t, *value);
      if (!value && edge) {
        const Vec3 turned(key.t > 0 ? full_turns(action) : 0, 0, 0);
        const float chest_yaw = key.values[index(Channel::chest_yaw)]->x - turned.x;
        head_.add(key.t, turned + head_angles(key.t, *key.values[index(Channel::lean)], chest_yaw));
      }
    }
  }
}

// Measured: the head's yaw changes a third of the shoulders', the chin sinks with the lean forward.
Vec3 TrunkMotion::head_angles(float t, Vec3 lean, float chest_yaw) const {
  if (!head_.empty() && t <= head_.last_time()) return head_.at(t);
  const float yaw = -23.0f + 0.36f * (chest_yaw + 48.0f);
  return {yaw, std::clamp(-16.0f - 0.8f * lean.x, -36.0f, 0.0f), 0};
}

void TrunkMotion::fill(float t, BodyTargets& targets) const {
  targets.pelvis = pelvis_.at(t) * kH;
  const Vec3 lean = lean_.at(t);
  const float nod = bounce_ * std::sin(2 * kPi * bounce_hz_ * t);
  targets.pelvis.y += nod * kH;
  const Vec3 pelvis_lean = pelvis_lean_.empty() ? lean * 0.35f : pelvis_lean_.at(t);
  const float chest_yaw = chest_yaw_.at(t).x;
  targets.pelvis_rotation =
      leaning(radians(pelvis_lean.x), radians(pelvis_lean.y), radians(pelvis_yaw_.at(t).x));
  // The trunk nods with the bounce, so that the head moves more than the pelvis.
  targets.chest_rotation = leaning(radians(lean.x) - nod * 3, radians(lean.y), radians(chest_yaw));
  const Vec3 look = head_angles(t, lean, chest_yaw);
  const Quat upright =
      leaning(0, radians(lean.y) * 0.5f, radians(look.x)) * glm::angleAxis(-radians(look.y), kLeft);
  // A body that lies takes its head along.
  const float lying = glm::smoothstep(40.0f, 75.0f, glm::length(Vec2(lean.x, lean.y)));
  // (on its side the neck gives way to the floor)
  const Quat along = leaning(radians(lean.x), radians(lean.y) * 1.2f, radians(chest_yaw)) *
                     glm::angleAxis(radians(12), kLeft);
  targets.head_rotation = glm::slerp(upright, in_hemisphere_of(along, upright), lying);
}

namespace {

struct ChestFrame {
  Vec3 position{};
  Quat rotation;
  Vec3 shoulder{};
};

ChestFrame chest_frame(const Skeleton& skeleton, const BodyTargets& trunk, Side side) {
  const WorldPose world = world_pose(skeleton, torso_pose(skeleton, trunk));
  return {world.position[index(Joint::upper_chest)], world.rotation[index(Joint::upper_chest)],
          world.position[index(arm(side).root)]};
}

}  // namespace

HandMotion::HandMotion(const Skeleton& skeleton, const SheetAction& action,
                       const std::vector<SheetKey>& keys, const TrunkMotion& trunk, Side side)
    : skeleton_(skeleton), side_(side) {
  const Channel wrist = of_side(Channel::lead_wrist, side);
  const auto windows = windows_of(action, arm(side).end);
  for (const SheetStrike& strike : action.strikes) {
    if (strike.strike.joint != arm(side).end || strike.snap <= 0) continue;
    snaps_.push_back({strike.start, strike.contact, radians(strike.snap)});
  }
  std::vector<float> times;
  std::vector<Vec3> points;
  for (const SheetKey& key : keys) {
    const auto& value = key.values[index(wrist)];
    if (!value) continue;
    BodyTargets body;
    trunk.fill(key.t, body);
    const ChestFrame chest = chest_frame(skeleton, body, side);
    times.push_back(key.t);
    points.push_back(*value * kH);
    in_chest_.add(key.t, glm::inverse(chest.rotation) * (*value * kH - chest.position));
  }
  if (!windows.empty()) path_.emplace(times, points, windows);
  for (const SheetKey& key : keys) {
    const auto& elbow = key.values[index(of_side(Channel::lead_elbow, side))];
    if (!elbow) continue;
    BodyTargets body;
    trunk.fill(key.t, body);
    const ChestFrame chest = chest_frame(skeleton, body, side);
    const Vec3 hand =
        path_ ? path_->at(key.t) : chest.position + chest.rotation * in_chest_.at(key.t);
    const auto pole = off_line(chest.shoulder, hand, *elbow * kH);
    if (pole) pole_.add(key.t, glm::inverse(chest.rotation) * *pole);
  }
  palm_ = track_of(keys, of_side(Channel::lead_palm, side), action);
  // Two waves in common and two of its own, so that the hands are neither locked nor independent.
  const std::uint64_t seed = hash_text(action.action.name);
  for (int wave = 0; wave < 4; ++wave) {
    const char* purpose = wave < 2 ? "sway" : side == Side::left ? "sway left" : "sway right";
    Random random(derived_seed(seed, purpose, static_cast<std::uint64_t>(wave)));
    const float amount = action.sway * kH / std::sqrt(2.0f);
    Wave w;
    w.hz = random.uniform(0.6f, 1.9f);
    w.phase = random.uniform(0, 2 * kPi);
    for (int c = 0; c < 3; ++c) w.amount[c] = amount * random.uniform(-1.0f, 1.0f);
    waves_.push_back(w);
  }
}

// Cocked as the hand leaves; straightens fastest when the wrist is fastest, at 0.7 of its way.
float HandMotion::Snap::at(float t) const {
  constexpr float kCocked = 0.2f, kLetsGo = 0.42f;  // shares of the hand's time
  const float u = (t - start) / (contact - start);
  return lag * glm::smoothstep(-0.4f, kCocked, u) * (1 - glm::smoothstep(kLetsGo, 1.0f, u));
}

Vec3 HandMotion::sway(float t) const {
  Vec3 sum{};
  for (const Wave& wave : waves_) sum += wave.amount * std::sin(2 * kPi * wave.hz * t + wave.phase);
  return sum;
}

ArmTarget HandMotion::at(float t, const BodyTargets& trunk) const {
  const ChestFrame chest = chest_frame(skeleton_, trunk, side_);
  ArmTarget target;
  target.wrist = path_ ? path_->at(t) : chest.position + chest.rotation * in_chest_.at(t);
  // A hand on the floor stays there.
  const float above = glm::smoothstep(0.10f * kH, 0.30f * kH, target.wrist.y);
  target.wrist += sway(t) * (above * (path_ ? 0.5f : 1.0f));
  const Vec3 hanging = glm::normalize(Vec3(side_ == Side::left ? 0.5f : -0.5f, -0.8f, -0.3f));
  const Vec3 pole = pole_.empty() ? hanging : pole_.at(t);
  target.pole = chest.rotation * normalized_or(pole, hanging);
  target.palm = palm_.empty() ? 0 : radians(palm_.at(t).x);
  for (const Snap& snap : snaps_) target.lag += snap.at(t);
  return target;
}

}  // namespace ringcraft
