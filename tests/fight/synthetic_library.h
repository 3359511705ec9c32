#pragma once
// A small library of analytic clips for tests: key stances solved by IK, smoothly interpolated. The
// motion is plain, its times and reaches are those of boxing (jab 0.42 s, cross 0.52 s).

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "motion/ik.h"
#include "motion/library.h"

namespace ringcraft::synthetic {

// One key of a clip. Hands and feet are relative to the root placement, m.
struct Key {
  Tick tick = 0;
  bool speeds_up = false;  // arrives at full speed, as a blow does; else starts and ends at rest
  Placement root{};
  float hips_height = 0.86f;                // m
  float lean = 0.10f, side = 0, twist = 0;  // rad: fore, to the own right, to the own left
  float fall = 0;                           // rad: the whole body tips backward
  Vec3 left_hand{0.12f, 1.34f, 0.36f}, right_hand{-0.10f, 1.34f, 0.26f};
  Vec3 left_foot{0.12f, 0.08f, 0.20f}, right_foot{-0.12f, 0.08f, -0.20f};
};

inline Key blended(const Key& a, const Key& b, float share) {
  Key key;
  key.root = mix(a.root, b.root, share);
  key.hips_height = glm::mix(a.hips_height, b.hips_height, share);
  key.lean = glm::mix(a.lean, b.lean, share);
  key.side = glm::mix(a.side, b.side, share);
  key.twist = glm::mix(a.twist, b.twist, share);
  key.fall = glm::mix(a.fall, b.fall, share);
  key.left_hand = glm::mix(a.left_hand, b.left_hand, share);
  key.right_hand = glm::mix(a.right_hand, b.right_hand, share);
  key.left_foot = glm::mix(a.left_foot, b.left_foot, share);
  key.right_foot = glm::mix(a.right_foot, b.right_foot, share);
  return key;
}

inline Pose posed(const Skeleton& skeleton, const Key& key) {
  Pose pose = rest_pose(skeleton);
  pose.hips.y = key.hips_height;
  const Quat bend = glm::angleAxis(key.lean, kLeft) * glm::angleAxis(key.side, kForward) *
                    yaw_rotation(key.twist);
  for (const Joint joint : {Joint::spine, Joint::chest, Joint::upper_chest}) {
    pose.rotation[index(joint)] = glm::slerp(Quat(1, 0, 0, 0), bend, 1.0f / 3);
  }
  solve_limb(skeleton, arm(Side::left), {key.left_hand, {0.5f, -1, 0}}, pose);
  solve_limb(skeleton, arm(Side::right), {key.right_hand, {-0.5f, -1, 0}}, pose);
  solve_limb(skeleton, leg(Side::left), {key.left_foot, {0.2f, 0, 1}}, pose);
  solve_limb(skeleton, leg(Side::right), {key.right_foot, {-0.2f, 0, 1}}, pose);
  if (key.fall != 0) {  // about a line on the ground through the root
    const Quat tip = glm::angleAxis(-key.fall, kLeft);
    pose.hips = tip * pose.hips + Vec3(0, 0.12f * std::sin(key.fall), 0);
    pose.rotation[0] = tip * pose.rotation[0];
  }
  return placed(pose, key.root);
}

inline Clip clip_of(const Skeleton& skeleton, const std::vector<Key>& keys) {
  Clip clip;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const Tick span = keys[i + 1].tick - keys[i].tick;
    const bool last = i + 2 == keys.size();
    for (Tick t = 0; t < span + (last ? 1 : 0); ++t) {
      const float x = static_cast<float>(t) / static_cast<float>(span);
      const Key key =
          blended(keys[i], keys[i + 1], keys[i + 1].speeds_up ? x * x : x * x * (3 - 2 * x));
      clip.frames.push_back(posed(skeleton, key));
      clip.root.push_back(key.root);
      clip.contacts.push_back({true, true});
    }
  }
  unroll_rotations(clip);
  return clip;
}

class Builder {
 public:
  Action& add(std::string name, Kind kind, const std::vector<Key>& keys) {
    Action action;
    action.name = std::move(name);
    action.kind = kind;
    action.clip = clip_of(skeleton_, keys);
    action.source = "synthetic";
    actions_.push_back(std::move(action));
    return actions_.back();
  }

  // Guard, `strike` at tick `hit`, guard again at `end`.
  void attack(std::string name, const Key& strike, Strike blow, Tick hit, Tick end) {
    Key out = strike, back;
    out.tick = hit;
    out.speeds_up = true;
    back.tick = end;
    back.root = strike.root;
    Action& action = add(std::move(name), Kind::attack, {Key{}, out, back});
    blow.active_begin = hit - 8;
    blow.active_end = hit + 3;
    action.strikes = {blow};
  }

  void step(std::string name, Placement by, Tick ticks) {
    Key to;
    to.tick = ticks;
    to.root = by;
    add(std::move(name), Kind::transition, {Key{}, to});
  }

  void defense(std::string name, const Key& held, Defense defense, Tick ticks) {
    Key in = held, out = held, back;
    in.tick = ticks / 3;
    out.tick = ticks * 2 / 3;
    back.tick = ticks;
    back.root = held.root;
    Action& action = add(std::move(name), Kind::defense, {Key{}, in, out, back});
    defense.begin = ticks / 6;
    defense.end = ticks * 5 / 6;
    action.defense = defense;
  }

  void response(std::string name, Response response, Placement by, Tick ticks) {
    Key bent, back;
    bent.tick = ticks / 2;
    bent.root = mix(Placement{}, by, 0.5f);
    bent.lean = -0.25f;
    back.tick = ticks;
    back.root = by;
    add(std::move(name), Kind::response, {Key{}, bent, back}).response = response;
  }

  std::vector<Action> take() { return std::move(actions_); }

 private:
  Skeleton skeleton_ = canonical_skeleton();
  std::vector<Action> actions_;
};

inline Tick paced(int ticks, float pace) {
  return static_cast<Tick>(std::lround(static_cast<float>(ticks) * pace));
}

inline void add_attacks(Builder& builder, float pace) {
  const auto t = [&](int ticks) { return paced(ticks, pace); };
  Key jab;
  jab.left_hand = {0.02f, 1.48f, 0.74f};
  jab.twist = -0.3f;
  jab.root = {0, 0.08f, 0};
  builder.attack("jab", jab, {StrikeKind::straight, Joint::left_hand, TargetZone::head, 0, 0},
                 t(22), t(50));
  Key cross;
  cross.right_hand = {0.0f, 1.48f, 0.76f};
  cross.twist = 0.55f;
  cross.root = {0, 0.10f, 0};
  builder.attack("cross", cross, {StrikeKind::straight, Joint::right_hand, TargetZone::head, 0, 0},
                 t(28), t(62));
  Key hook;
  hook.left_hand = {-0.12f, 1.45f, 0.55f};
  hook.twist = -0.7f;
  hook.root = {0, 0.12f, 0};
  builder.attack("hook", hook, {StrikeKind::hook, Joint::left_hand, TargetZone::head, 0, 0}, t(34),
                 t(73));
  Key body = cross;
  body.right_hand = {0.0f, 1.10f, 0.72f};
  body.hips_height = 0.80f;
  builder.attack("body_cross", body,
                 {StrikeKind::straight, Joint::right_hand, TargetZone::body, 0, 0}, t(32), t(68));
  Key kick;
  kick.right_foot = {0.0f, 1.05f, 0.80f};
  kick.lean = -0.3f;
  kick.twist = 0.3f;
  builder.attack("front_kick", kick,
                 {StrikeKind::front_kick, Joint::right_foot, TargetZone::body, 0, 0}, t(44),
                 t(110));
}

inline void add_defenses(Builder& builder, float pace) {
  const auto t = [&](int ticks) { return paced(ticks, pace); };
  Key high;
  high.left_hand = {0.08f, 1.48f, 0.24f};
  high.right_hand = {-0.08f, 1.48f, 0.24f};
  builder.defense("guard_high", high, {DefenseKind::guard, 0, 0}, t(48));
  Key slip;
  slip.side = 0.5f;
  slip.lean = 0.3f;
  builder.defense("slip_right", slip, {DefenseKind::slip, 0, 0}, t(50));
  Key duck;
  duck.hips_height = 0.60f;
  duck.lean = 0.6f;
  builder.defense("duck", duck, {DefenseKind::duck, 0, 0}, t(60));
  Key away;
  away.root = {0, -0.35f, 0};
  builder.defense("pull_away", away, {DefenseKind::step_away, 0, 0}, t(48));
}

inline void add_responses(Builder& builder) {
  builder.response("absorb_back", {ResponseKind::absorb, 0, kPi}, {0, -0.03f, 0}, 24);
  builder.response("absorb_fore", {ResponseKind::absorb, 0, 0}, {0, 0.03f, 0}, 24);
  builder.response("steps_back_1", {ResponseKind::recovery_steps, 1, kPi}, {0, -0.35f, 0}, 60);
  builder.response("steps_left_1", {ResponseKind::recovery_steps, 1, kPi / 2}, {0.3f, 0, 0}, 60);
  builder.response("steps_right_1", {ResponseKind::recovery_steps, 1, -kPi / 2}, {-0.3f, 0, 0}, 60);
  builder.response("steps_back_2", {ResponseKind::recovery_steps, 2, kPi}, {0, -0.65f, 0}, 100);
  builder.response("steps_back_3", {ResponseKind::recovery_steps, 3, kPi}, {0, -0.85f, 0}, 130);
  Key down;
  down.tick = 90;
  down.fall = kPi / 2;
  down.root = {0, -0.2f, 0};
  Key still = down;
  still.tick = 150;
  Action& fall = builder.add("knockdown_back", Kind::response, {Key{}, down, still});
  fall.response = Response{ResponseKind::knockdown, 0, kPi};
  fall.ends_lying = Lying::back;
  Key lying = still;
  lying.tick = 0;
  lying.root = {};
  Key up;
  up.tick = 180;
  up.root = {0, 0.1f, 0};
  builder.add("get_up_back", Kind::get_up, {lying, up}).starts_lying = Lying::back;
}

// `pace` 1 is real boxing; 2.2 is the paper's long actions.
inline MotionLibrary library(float pace = 1) {
  const auto t = [&](int ticks) { return paced(ticks, pace); };
  Builder builder;
  Key breathe, back;
  breathe.tick = t(18);
  breathe.hips_height = 0.85f;
  back.tick = t(36);
  builder.add("idle", Kind::idle, {Key{}, breathe, back});
  add_attacks(builder, pace);
  add_defenses(builder, pace);
  builder.step("step_fore", {0, 0.30f, 0}, t(48));
  builder.step("step_back", {0, -0.30f, 0}, t(48));
  builder.step("step_left", {0.28f, 0.05f, 0}, t(48));
  builder.step("step_right", {-0.28f, 0.05f, 0}, t(48));
  builder.step("turn_left", {0, 0, radians(45)}, t(54));
  builder.step("turn_right", {0, 0, radians(-45)}, t(54));
  add_responses(builder);
  return {"synthetic", builder.take()};
}

}  // namespace ringcraft::synthetic
