#pragma once
// What is left of a difference at a seam, and how it falls to nothing.

#include <algorithm>
#include <optional>

#include "motion/pose.h"

namespace ringcraft {

// The shortest times, s, in which a limb is moved a distance, m, from rest to rest, and in which
// the speed, m/s, of one is taken off and it is back where it was, with no more than so much
// acceleration, m/s2: as much one way as the other (bang-bang control of a double integrator).
float seconds_to_move(float distance, float acceleration);
float seconds_to_stop(float speed, float acceleration);

// An offset that decays from a start value and velocity to nothing, each of the two with the least
// acceleration that it takes in its time: constant one way, then the other.
class Decay {
 public:
  Decay() = default;
  // value in m or rad, velocity per second, seconds > 0
  Decay(Vec3 value, Vec3 velocity, float seconds);
  // The same where the velocity is gone sooner: what flies does not fly on while the rest blends.
  Decay(Vec3 value, Vec3 velocity, float seconds, float velocity_seconds);

  Vec3 value() const;
  bool done() const { return age_ >= seconds_; }
  float seconds_left() const { return done() ? 0.0f : seconds_ - age_; }
  void step(float dt) { age_ += dt; }

 private:
  Vec3 start_{}, velocity_{};
  float seconds_ = 0, velocity_seconds_ = 0, age_ = 0;
};

// rad/s about the vertical, as fast as fighters turn: a spin beyond it is braked.
inline constexpr float kFastestTurn = 8;

// s in which a spin goes on as it is at least, before it is taken off.
inline constexpr float kSpinCarries = .15f;

// How far, m, what hangs on a joint reaches from it.
float lever_of(const Skeleton& skeleton, Joint joint);

// Seconds in which a velocity, m/s, is taken off with at most 12 m/s2.
float stopping_seconds(Vec3 velocity);

// The decay of a rotation that was `before` and `shown` in the last two ticks and from now on
// follows `now` and `after`. With a `lever`, m, its speed is taken off as soon as that may be. What
// is carried by something that has `with` to turn, a rotation vector, goes the same way round.
Decay rotation_decay(Quat before, Quat shown, Quat now, Quat after, float seconds, float lever = 0,
                     Vec3 with = {});

// The same of the whole body: its heading, which goes on the way it spins and may be more than half
// a circle off, and how it leans from there.
struct BodyTurn {
  Decay yaw, lean;  // about +Y; a rotation vector in the body's heading
  Decay rolls;      // of one that lies: a rotation vector
  Quat of(Quat clip) const;
  Vec3 left() const { return yaw.value() + lean.value() + rolls.value(); }
  float seconds_left() const { return std::max(yaw.seconds_left(), rolls.seconds_left()); }
  void step(float dt);
};
// After a simulation, which may leave it facing anywhere, it takes up to `longest` s, so that it
// does not whirl round.
BodyTurn body_turn(const Pose& before, const Pose& shown, const Pose& now, const Pose& after,
                   float seconds, std::optional<float> longest);
// Of one that lies, which has no heading where it is on its head: the shortest way there.
BodyTurn lying_turn(const Pose& before, const Pose& shown, const Pose& now, const Pose& after,
                    float seconds);

// The same of a limb's root, as `root_turns` (joint_turns.h).
Decay root_decay(const Skeleton& skeleton, Side side, const Limb& limb, const Pose& before,
                 const Pose& shown, const Pose& now, const Pose& after, float seconds, float lever);

}  // namespace ringcraft
