#include "motion/playback.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "motion/ik.h"
#include "motion/joint_turns.h"

namespace ringcraft {

namespace {

constexpr float kLongestArm = 0.9995f;  // of its length: where nothing is eased any more
constexpr float kSoftReach = 0.97f;     // of the arm's length: beyond it a blended reach is eased
constexpr float kSoftLeg = 0.91f;       // of the leg's

constexpr std::array<Side, 2> kSides = {Side::left, Side::right};

}  // namespace

Playback::Playback(const Skeleton& body, const PlaybackSettings& settings)
    : skeleton_(body), settings_(settings), feet_(body, settings) {}

// A clip that is stitched to a clip is near it by construction; a body that was simulated may lie
// or fly anywhere, and takes the longer the more it has to change.
float Playback::blend_of(const Pose& now, const Pose& after,
                         const std::array<bool, 2>& arms_by_joints) const {
  // m/s2: of a limb that goes where it should be; a body that lies has the time, and between two
  // clips nothing is to be caught up with
  const float most_acceleration = feet_.lies() ? 10.0f : catches_up_ ? 17.0f : 14.0f;
  float seconds = settings_.blend_seconds;
  for (const Side side : kSides) {
    if (arms_by_joints[static_cast<std::size_t>(side)]) {
      seconds = std::max(seconds, swing_seconds(side, arm(side), now, most_acceleration));
    }
    if (catches_up_ && feet_.lies()) {
      seconds = std::max(seconds, swing_seconds(side, leg(side), now, most_acceleration));
    }
  }
  if (!catches_up_) return seconds;
  const WorldPose shown = world_pose(skeleton_, shown_), before = world_pose(skeleton_, before_);
  const WorldPose clip = world_pose(skeleton_, now), clip_next = world_pose(skeleton_, after);
  const float heads = heading_of(shown_.rotation[0]), clip_heads = heading_of(now.rotation[0]);
  const float turn = feet_.lies() ? 0.0f : wrapped_angle(clip_heads - heads);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Vec3 moved = shown.position[j] - before.position[j];
    // Round with the body, and straight from there.
    const Vec3 out = shown.position[j] - shown_.hips;
    const Vec3 turned = shown_.hips + yaw_rotation(turn) * out + moved;
    const float far =
        std::abs(turn) * std::hypot(out.x, out.z) + glm::distance(turned, clip.position[j]);
    const float fast =
        glm::distance(moved, clip_next.position[j] - clip.position[j]) / kTickSeconds;
    seconds = std::max({seconds, seconds_to_move(far, most_acceleration),
                        seconds_to_stop(fast, 2 * most_acceleration)});
  }
  return std::min(seconds, settings_.longest_blend);
}

// The same of the trunk of a body that is up, by how far it leans off the clip's: no one is upright
// again as soon as a foot is down.
float Playback::trunk_seconds(const WorldPose& now) const {
  constexpr float kMostAcceleration = 3.5f;  // m/s2: of the head over the hips
  const WorldPose shown = world_pose(skeleton_, shown_);
  const auto head = [](const WorldPose& world) {
    return world.position[index(Joint::head)] - world.position[index(Joint::hips)];
  };
  const float seconds = seconds_to_move(glm::distance(head(shown), head(now)), kMostAcceleration);
  return std::clamp(seconds, blend_seconds_, settings_.longest_blend);
}

// The same of a limb that goes by its joints: what it carries goes the length of the arc.
float Playback::swing_seconds(Side side, const Limb& limb, const Pose& now,
                              float most_acceleration) const {
  const std::size_t j = index(limb.root);
  const BallJoint joint = ball_joint(limb);
  const Vec3 turns =
      ball_turns(joint, side, shown_.rotation[j]) - ball_turns(joint, side, now.rotation[j]);
  const float twist = glm::dot(turns, joint.along);
  const Vec3 swing = turns - joint.along * twist;
  const float bent = flexion(skeleton_, limb, shown_.rotation[index(limb.middle)]),
              bent_now = flexion(skeleton_, limb, now.rotation[index(limb.middle)]);
  const float bends = bent - bent_now;
  const float lower = skeleton_.bone(limb.end);
  // A bent limb that lay turned about its upper half is carried round by that.
  const float round =
      feet_.lies() ? std::abs(twist) * std::max(std::sin(bent), std::sin(bent_now)) : 0.0f;
  const float arc = glm::length(swing) * reach_share(skeleton_, limb, world_pose(skeleton_, now)) *
                        (skeleton_.bone(limb.middle) + lower) +
                    (std::abs(bends) + round) * lower;
  return seconds_to_move(arc, most_acceleration);
}

// The hips of a body that is up are back sooner than its farthest limb: legs that go where the clip
// has them, from hips that lag behind, would be pulled straight.
Decay Playback::hips_decay(Vec3 offset, Vec3 velocity) const {
  if (!catches_up_) return {offset, velocity, blend_seconds_};
  float seconds = blend_seconds_;
  if (!feet_.lies()) {
    constexpr float kMostAcceleration = 8;  // m/s2
    const float needed = std::max(seconds_to_move(glm::length(offset), kMostAcceleration),
                                  seconds_to_stop(glm::length(velocity), 2 * kMostAcceleration));
    seconds = std::min(seconds, std::max(settings_.blend_seconds, needed));
  }
  return {offset, velocity, seconds, std::min(stopping_seconds(velocity), seconds)};
}

void Playback::stitch(const Pose& now, const Pose& after) {
  if (!started_) return;
  // What has more left than a blend takes, as after a simulation, goes on as from one.
  const float left = rotation_[index(Joint::spine)].seconds_left();  // no less than the hips have
  catches_up_ = simulated_ || left > settings_.blend_seconds;
  const std::array<bool, 2> arms_by_joints = {arm_by_joints(Side::left, now),
                                              arm_by_joints(Side::right, now)};
  const float seconds = blend_seconds_ = blend_of(now, after, arms_by_joints);
  const Vec3 moved = shown_.hips - before_.hips;
  const Vec3 clip_moved = after.hips - now.hips;
  const Vec3 hips_velocity = (moved - clip_moved) / kTickSeconds;
  hips_ = hips_decay(shown_.hips + moved - now.hips, hips_velocity);
  const bool lies = catches_up_ && feet_.lies();
  const float trunk = catches_up_ && !lies ? trunk_seconds(world_pose(skeleton_, now)) : seconds;
  turn_ = lies ? lying_turn(before_, shown_, now, after, seconds)
               : body_turn(before_, shown_, now, after, seconds,
                           catches_up_ ? std::optional(settings_.longest_blend) : std::nullopt);
  for (std::size_t j = 1; j < kJointCount; ++j) {
    const bool of_trunk = j <= index(Joint::head);
    rotation_[j] = rotation_decay(before_.rotation[j], shown_.rotation[j], now.rotation[j],
                                  after.rotation[j], of_trunk ? trunk : seconds,
                                  catches_up_ ? lever_of(skeleton_, joint_at(j)) : 0.0f);
  }
  hinges_.fill({});
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    if (arms_by_joints[i]) stitch_hinge(arm(side), now, after);
    if (catches_up_) stitch_hinge(leg(side), now, after);
  }
  const WorldPose world_now = world_pose(skeleton_, now);
  const WorldPose world_after = world_pose(skeleton_, after);
  const WorldPose shown = world_pose(skeleton_, shown_), before = world_pose(skeleton_, before_);
  feet_.stitch({shown, world_now, world_after, seconds, turn_.seconds_left(), simulated_,
                catches_up_, turn_.left()});
  for (const Side side : kSides) {
    const std::size_t hand = index(arm(side).end);
    const Vec3 hand_moved = shown.position[hand] - before.position[hand];
    const Vec3 clip_hand_moved = world_after.position[hand] - world_now.position[hand];
    arm_reach_[static_cast<std::size_t>(side)] =
        std::min(reach_share(skeleton_, arm(side), shown), 0.995f);
    const auto i = static_cast<std::size_t>(side);
    hands_[i] = shoulders_[i] = hip_joints_[i] = {};
    shoulders_aside_[i] = hip_joints_aside_[i] = {};
    if (feet_.by_joints(side)) {
      hip_joints_[i] = root_decay(skeleton_, side, leg(side), before_, shown_, now, after, seconds,
                                  lever_of(skeleton_, leg(side).root));
    }
    if (arms_by_joints[i]) {
      seam_shoulder_[i] =
          ball_turns(ball_joint(arm(side)), side, shown_.rotation[index(arm(side).root)]);
      shoulders_[i] = root_decay(skeleton_, side, arm(side), before_, shown_, now, after, seconds,
                                 lever_of(skeleton_, arm(side).root));
      continue;
    }
    hands_[i] = {shown.position[hand] + hand_moved - world_now.position[hand],
                 (hand_moved - clip_hand_moved) / kTickSeconds, seconds};
  }
}

void Playback::stitch(const WayUp& way) {
  if (!started_) return;
  stitch(way.clip[0], way.clip[1]);
  for (const Side side : kSides) {
    go_round(way, side, arm(side));
    go_round(way, side, leg(side));
  }
}

// How deep, m, a limb is in anything until the blend is over, in the sum of so many moments; not
// counted on where that is more than `most`.
float Playback::depth_on(const WayUp& way, const Limb& limb, float most) const {
  constexpr int kMoments = 12;
  Playback ahead = *this;
  float depth = 0;
  for (int i = 1; i < kMoments && depth <= most; ++i) {
    ahead.step_blend(blend_seconds_ / kMoments);
    const float seconds = blend_seconds_ * static_cast<float>(i) / kMoments;
    const auto tick = static_cast<std::size_t>(seconds / kTickSeconds);
    depth += way.depth(limb, ahead.blended(way.clip[std::min(tick, way.clip.size() - 1)]));
  }
  return depth;
}

// The largest acceleration, m/s2, of the limb's middle and end, over two frames of 60 Hz.
float Playback::haste_on(const WayUp& way, const Limb& limb) const {
  constexpr std::size_t kFrame = 2;  // ticks
  constexpr float kSeconds = kFrame * kTickSeconds;
  Playback ahead = *this;
  std::vector<std::array<Vec3, 2>> path;
  float most = 0;
  for (const Pose& clip : way.clip) {
    const WorldPose world = world_pose(skeleton_, ahead.blended(clip));
    ahead.step_blend(kTickSeconds);
    path.push_back({world.position[index(limb.middle)], world.position[index(limb.end)]});
    if (path.size() <= 2 * kFrame) continue;
    const auto now = path.end() - 1;
    for (const std::size_t k : {0, 1}) {
      const Vec3 turns = now[0][k] - 2.0f * (now - kFrame)[0][k] + (now - 2 * kFrame)[0][k];
      most = std::max(most, glm::length(turns) / (kSeconds * kSeconds));
    }
  }
  return most;
}

// By the shortest turn a limb may go through the floor or its own body: of the ways that leave that
// turn to any side and come back, the one on which it is least deep, if that is worth going so far.
void Playback::go_round(const WayUp& way, Side side, const Limb& limb) {
  constexpr float kStep = radians(15);
  constexpr int kMostSteps = 10;
  constexpr float kWorth = .1f;     // m less deep, in depth_on, for each rad
  constexpr float kMostHaste = 60;  // m/s2
  const auto i = static_cast<std::size_t>(side);
  Vec3& aside = is_leg(limb) ? hip_joints_aside_[i] : shoulders_aside_[i];
  Vec3 best{};
  float least = depth_on(way, limb, std::numeric_limits<float>::max());
  for (int steps = 1; steps <= kMostSteps; ++steps) {
    const float far = kStep * static_cast<float>(steps), costs = kWorth * far;
    for (int k = 0; k < 27 && costs < least; ++k) {  // -1, 0 and 1 of each turn
      const Vec3 turns(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (turns == Vec3{}) continue;
      aside = glm::normalize(turns) * far;
      const float depth = depth_on(way, limb, least - costs) + costs;
      if (depth >= least || haste_on(way, limb) > kMostHaste) continue;
      least = depth;
      best = aside;
    }
  }
  aside = best;
}

// The clip with what is left of the difference to it; but feet and hands.
Pose Playback::blended(const Pose& clip_pose) const {
  Pose pose = clip_pose;
  pose.hips += hips_.value();
  pose.rotation[0] = glm::normalize(turn_.of(clip_pose.rotation[0]));
  for (std::size_t j = 1; j < kJointCount; ++j) {
    pose.rotation[j] =
        glm::normalize(from_rotation_vector(rotation_[j].value()) * clip_pose.rotation[j]);
  }
  bend_hinges(clip_pose, pose);
  turn_roots(clip_pose, pose);
  return pose;
}

void Playback::step_blend(float dt) {
  hips_.step(dt);
  turn_.step(dt);
  for (Decay& decay : rotation_) decay.step(dt);
  for (Decay& decay : hinges_) decay.step(dt);
  for (Decay& decay : shoulders_) decay.step(dt);
  for (Decay& decay : hip_joints_) decay.step(dt);
}

const Pose& Playback::next(const Pose& clip_pose, FootContacts contacts) {
  Pose pose = blended(clip_pose);
  feet_.place(clip_pose, contacts, turn_.left(), pose);
  place_hands(clip_pose, pose);
  step_blend(kTickSeconds);
  return show(pose);
}

const Pose& Playback::next_simulated(const Pose& pose) {
  feet_.let_go();
  hips_ = {};
  turn_ = {};
  hands_ = {};
  shoulders_ = hip_joints_ = {};
  hinges_.fill({});
  rotation_.fill({});
  show(pose);
  simulated_ = true;
  return shown_;
}

const Pose& Playback::show(const Pose& pose) {
  simulated_ = false;
  before_ = started_ ? shown_ : pose;
  started_ = true;
  set_shown(pose);
  feet_.show(world_pose(skeleton_, shown_));
  return shown_;
}

void Playback::amend(const Pose& pose) {
  set_shown(pose);
  feet_.amend(world_pose(skeleton_, shown_));
}

void Playback::set_shown(const Pose& pose) {
  shown_ = pose;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    shown_.rotation[j] = in_hemisphere_of(shown_.rotation[j], before_.rotation[j]);
  }
}

// Led by the hand, the elbow of an arm that comes from a simulation would turn over, and so would
// one that is bent before and after, or whose hand passes nearer to its shoulder than it is then.
bool Playback::arm_by_joints(Side side, const Pose& now) const {
  if (catches_up_) return true;
  constexpr float kPassesNear = .8f;
  constexpr float kBent = .68f;  // of the arm's length: a hand so near to its shoulder
  const auto hand = [&](const Pose& pose) {
    const WorldPose world = world_pose(skeleton_, pose);
    return world.position[index(arm(side).end)] - world.position[index(arm(side).root)];
  };
  const Vec3 from = hand(shown_), to = hand(now), way = to - from;
  const float length = skeleton_.bone(arm(side).middle) + skeleton_.bone(arm(side).end);
  if (std::max(glm::length(from), glm::length(to)) < kBent * length) return true;
  const float share =
      std::clamp(-glm::dot(from, way) / std::max(1e-6f, glm::dot(way, way)), 0.0f, 1.0f);
  return glm::length(from + share * way) <
         kPassesNear * std::min(glm::length(from), glm::length(to));
}

// Where limbs go by their joints, elbows go by their flexion and legs by their reach, and apart
// from it by what turns beside the hinge: as one turn, that of a bent elbow goes anywhere. Where a
// clip's foot stands, its knee goes far as the leg comes near to straight; a leg in the air that
// went by that knee's flexion would be thrown.
void Playback::stitch_hinge(const Limb& limb, const Pose& now, const Pose& after) {
  const std::size_t j = index(limb.middle);
  const auto bent = [&](const Pose& pose) { return flexion(skeleton_, limb, pose.rotation[j]); };
  const auto beside = [&](const Pose& pose) {
    return glm::angleAxis(-bent(pose), hinge_axis(limb)) * pose.rotation[j];
  };
  const auto goes_by = [&](const Pose& pose) {
    return is_leg(limb) ? reach_of(skeleton_, limb, bent(pose)) : bent(pose);
  };
  const float lever = lever_of(skeleton_, limb.middle);
  const float was = goes_by(before_), is = goes_by(shown_), clip = goes_by(now);
  const float velocity = (is - was - (goes_by(after) - clip)) / kTickSeconds;
  seam_flexion_[j] = bent(shown_);
  hinges_[j] = {Vec3{2 * is - was - clip, 0, 0}, Vec3{velocity, 0, 0}, blend_seconds_,
                stopping_seconds(Vec3{velocity * (is_leg(limb) ? 1 : lever), 0, 0})};
  rotation_[j] = rotation_decay(beside(before_), beside(shown_), beside(now), beside(after),
                                blend_seconds_, lever);
}

// The flexion with which a leg reaches so much longer, m, than its clip's. A clip's knee that is
// bent backwards comes back as the blend fades.
float Playback::bent_leg(const Limb& limb, const Free& free, float longer) const {
  const auto reach = [&](float bent) { return reach_of(skeleton_, limb, bent); };
  const float length = reach(0);
  const float reaches =
      slowed(reach(free.own) + longer, {reach(free.own), reach(free.seam), free.gone},
             kSoftLeg * length, length);
  return flexion_for(skeleton_, limb, reaches) + free.gone * std::min(0.0f, 2 * free.own);
}

// A knee or an elbow that carries its speed on may pass straight, or fold: it slows before.
void Playback::bend_hinges(const Pose& clip_pose, Pose& pose) const {
  for (const Side side : kSides) {
    for (const Limb& limb : {arm(side), leg(side)}) {
      const std::size_t j = index(limb.middle);
      const Decay& offset = hinges_[j];
      if (offset.done()) continue;
      const Vec3 axis = hinge_axis(limb);
      const float own = flexion(skeleton_, limb, clip_pose.rotation[j]);
      const float gone = 1 - offset.seconds_left() / blend_seconds_;
      const float seam = seam_flexion_[j];
      // A leg that is nearly straight would bend at once where its foot is lifted.
      const float straight = is_leg(limb) ? radians(-8) : 0.0f;
      const float more = offset.value().x;
      float bent = is_leg(limb) ? bent_leg(limb, {own, seam, gone}, more) : own + more;
      bent = -slowed(-bent, {-own, -seam, gone}, radians(-16), straight);
      bent = slowed(bent, {own, seam, gone}, radians(130), radians(148));
      const Quat beside = from_rotation_vector(rotation_[j].value()) * glm::angleAxis(-own, axis) *
                          clip_pose.rotation[j];
      pose.rotation[j] = glm::normalize(glm::angleAxis(bent, axis) * beside);
    }
  }
}

void Playback::turn_roots(const Pose& clip_pose, Pose& pose) const {
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    for (const bool shoulder : {true, false}) {
      const Decay& offset = shoulder ? shoulders_[i] : hip_joints_[i];
      if (offset.done()) continue;
      const Limb limb = shoulder ? arm(side) : leg(side);
      const Vec3 own = root_turns(skeleton_, side, limb, clip_pose);
      const float gone = 1 - offset.seconds_left() / blend_seconds_;
      const float arc = std::sin(kPi * gone);
      Vec3 turns =
          own + offset.value() + (shoulder ? shoulders_aside_ : hip_joints_aside_)[i] * (arc * arc);
      if (shoulder) {
        turns = shoulder_slowed(ball_joint(limb), turns, own, seam_shoulder_[i], gone);
      }
      set_root_turns(skeleton_, side, limb, turns, pose);
    }
  }
}

void Playback::place_hands(const Pose& clip_pose, Pose& pose) {
  const WorldPose clip_world = world_pose(skeleton_, clip_pose);
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    Decay& offset = hands_[i];
    if (offset.done()) continue;
    // The arm may be as straight as the clip's is or, fading, as it was at the seam; beyond, it
    // eases.
    const float left = offset.seconds_left() / blend_seconds_;
    const float seam =
        kSoftReach + (arm_reach_[i] - kSoftReach) * glm::smoothstep(0.0f, 1.0f, left);
    const float soft = std::max({kSoftReach, seam, reach_share(skeleton_, arm(side), clip_world)});
    const Vec3 target =
        clip_world.position[index(arm(side).end)] - kUp * feet_.sink() + offset.value();
    move_limb_end(skeleton_, arm(side), target, std::min(soft, kLongestArm), pose);
    offset.step(kTickSeconds);
  }
}

}  // namespace ringcraft
