#pragma once
// Synthetic clips, built by IK from a few numbers, so that tests know every contact and target.

#include <functional>
#include <string>

#include "motion/action.h"
#include "motion/ik.h"
#include "motion/library.h"

namespace ringcraft {

inline const Skeleton kSkeleton = canonical_skeleton();

namespace test {

// What a body does at one instant, in action space; metres and radians.
struct Stance {
  Vec3 hips{0, 0.84f, 0};
  float hips_yaw = -0.5f;  // bladed: the left side leads
  float chest_yaw = 0;     // on top of the hips', spread over the spine
  // Balls of the feet; y is the height above standing.
  Vec3 left_ball{0.10f, 0, 0.26f}, right_ball{-0.13f, 0, -0.20f};
  float left_yaw = -0.15f, right_yaw = -0.9f;  // of the feet
  float left_heel = 0, right_heel = 0.25f;     // pitch of the foot, heel up
  Vec3 left_hand{0.08f, 1.42f, 0.38f}, right_hand{-0.10f, 1.40f, 0.24f};
};

inline Quat pitched(float yaw, float heel) {
  return yaw_rotation(yaw) * glm::angleAxis(heel, kLeft);
}

inline Pose posed(const Skeleton& skeleton, const Stance& stance) {
  Pose pose = rest_pose(skeleton);
  pose.hips = stance.hips * (skeleton.height / kCanonicalHeight);
  pose.rotation[0] = yaw_rotation(stance.hips_yaw);
  for (const Joint joint : {Joint::spine, Joint::chest, Joint::upper_chest}) {
    pose.rotation[index(joint)] = yaw_rotation(stance.chest_yaw / 3);
  }
  pose.rotation[index(Joint::neck)] = yaw_rotation(-stance.hips_yaw - stance.chest_yaw);
  for (const Side side : {Side::left, Side::right}) {
    const bool left = side == Side::left;
    const Quat foot = pitched(left ? stance.left_yaw : stance.right_yaw,
                              left ? stance.left_heel : stance.right_heel);
    Vec3 ball = left ? stance.left_ball : stance.right_ball;
    ball.y += skeleton.toe_height();
    LimbTarget target;
    target.position = ball - foot * skeleton.offset[index(toes(side))];
    // The knee bends about an axis between the hips' and the foot's.
    const float knee_yaw = (stance.hips_yaw + (left ? stance.left_yaw : stance.right_yaw)) / 2;
    const Vec3 hip = world_pose(skeleton, pose).position[index(leg(side).root)];
    target.pole = glm::cross(target.position - hip, yaw_rotation(knee_yaw) * kLeft);
    target.soft_share = 0.995f;
    solve_limb(skeleton, leg(side), target, pose);
    set_world_rotation(skeleton, leg(side).end, foot, pose);
    const float heel = left ? stance.left_heel : stance.right_heel;
    pose.rotation[index(toes(side))] = glm::angleAxis(-std::max(0.0f, heel), kLeft);
    LimbTarget hand;
    hand.position = left ? stance.left_hand : stance.right_hand;
    hand.pole = {left ? 0.4f : -0.4f, -1, -0.3f};
    hand.soft_share = 0.98f;
    solve_limb(skeleton, arm(side), hand, pose);
  }
  return pose;
}

inline float ramp(float t, float from, float to) {
  const float s = std::clamp((t - from) / (to - from), 0.0f, 1.0f);
  return s * s * s * (10 + s * (6 * s - 15));
}
// Up from 0 to 1 and down again, between `from` and `to`.
inline float bump(float t, float from, float to) {
  const float middle = (from + to) / 2;
  return ramp(t, from, middle) * (1 - ramp(t, middle, to));
}

// `at(t)`: the stance at t in 0..1; `feet(t)`: what is planted; `root(t)`: the placement.
inline Clip clip_of(const Skeleton& skeleton, Tick length, const std::function<Stance(float)>& at,
                    const std::function<FootContacts(float)>& feet,
                    const std::function<Placement(float)>& root) {
  Clip clip;
  for (Tick tick = 0; tick <= length; ++tick) {
    const float t = static_cast<float>(tick) / static_cast<float>(length);
    clip.frames.push_back(posed(skeleton, at(t)));
    clip.contacts.push_back(feet(t));
    clip.root.push_back(root(t));
  }
  unroll_rotations(clip);
  return clip;
}

inline FootContacts both(float) {
  return {true, true};
}
inline Placement in_place(float) {
  return {};
}

inline Clip idle_clip(const Skeleton& skeleton, Tick length = 60) {
  return clip_of(
      skeleton, length,
      [](float t) {
        Stance stance;
        stance.hips.y += 0.01f * std::sin(2 * kPi * t);
        stance.left_hand.y += 0.01f * std::sin(2 * kPi * t);
        return stance;
      },
      both, in_place);
}

// A straight of the left hand, out at t = 0.4 and back at t = 0.9.
inline Clip jab_clip(const Skeleton& skeleton, Tick length = 60) {
  return clip_of(
      skeleton, length,
      [](float t) {
        Stance stance;
        const float out = ramp(t, 0, 0.4f) * (1 - ramp(t, 0.45f, 0.9f));
        stance.hips.z += 0.06f * out;
        stance.chest_yaw = -0.4f * out;
        stance.right_heel += 0.2f * out;
        stance.left_hand += (Vec3(0.02f, 1.42f, 0.66f) - stance.left_hand) * out;
        return stance;
      },
      both, in_place);
}

// A step by `way` on the ground: the left foot over t 0.1..0.5, the right one over 0.5..0.9, in an
// arc 6 cm high.
inline Clip step_clip(const Skeleton& skeleton, Vec3 way, Tick length = 84) {
  return clip_of(
      skeleton, length,
      [way](float t) {
        Stance stance;
        const float body = ramp(t, 0, 1);
        stance.hips += way * body;
        stance.left_hand += way * body;
        stance.right_hand += way * body;
        stance.left_ball += way * ramp(t, 0.1f, 0.5f) + kUp * (0.06f * bump(t, 0.1f, 0.5f));
        stance.right_ball += way * ramp(t, 0.5f, 0.9f) + kUp * (0.06f * bump(t, 0.5f, 0.9f));
        return stance;
      },
      [](float t) {
        return FootContacts{t <= 0.1f || t >= 0.5f, t <= 0.5f || t >= 0.9f};
      },
      [way](float t) {
        return Placement{way.x * ramp(t, 0, 1), way.z * ramp(t, 0, 1), 0};
      });
}

// A kick of the rear leg to hip height; the foot is up over t 0.1..0.9.
inline Clip kick_clip(const Skeleton& skeleton, Tick length = 120) {
  return clip_of(
      skeleton, length,
      [](float t) {
        Stance stance;
        const float out = bump(t, 0.1f, 0.9f);
        stance.hips += Vec3(0.06f, 0.02f, 0.12f) * out;
        stance.right_ball += (Vec3(-0.08f, 0.75f, 0.55f) - stance.right_ball) * out;
        stance.right_yaw += 0.8f * out;
        stance.right_heel += 0.5f * out;
        return stance;
      },
      [](float t) {
        return FootContacts{true, t <= 0.1f || t >= 0.9f};
      },
      in_place);
}

inline Action action_of(std::string name, Kind kind, Clip clip) {
  Action action;
  action.name = std::move(name);
  action.kind = kind;
  action.clip = std::move(clip);
  action.source = "synthetic";
  return action;
}

}  // namespace test
}  // namespace ringcraft
