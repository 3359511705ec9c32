#pragma once
// Playback: one fighter's segments become one continuous motion.
//
// At a seam the difference to the new clip is inertialized (Bollo 2018): it decays from the present
// pose and velocity, here by a critically damped spring on the offset's rotation vector, so that
// even an interrupted blend does not jump. Planted feet are held by IK where they were set down
// until the clip lifts them; a foot left too far from the clip's takes a small step of its own.

#include <array>
#include <optional>

#include "motion/clip.h"

namespace ringcraft {

struct PlaybackSettings {
  float blend_seconds = 0.32f;   // in which a seam's difference falls to about 1 %
  float unlock_seconds = 0.20f;  // the same for a lifted foot's way back to the clip
  float restep_distance =
      0.06f;  // m: a planted foot farther from the clip's takes a step of its own
  float restep_seconds = 0.20f;
  float restep_lift = 0.05f;  // m: height of that step
};

// An offset that decays from a start value and velocity to nothing (critically damped spring).
struct Decay {
  Vec3 value{};                     // m or rad
  Vec3 velocity{};                  // per second
  void step(float dt, float rate);  // rate: 1/s
};

class Playback {
 public:
  explicit Playback(const Skeleton& body, const PlaybackSettings& settings = {});

  // The next tick begins a new motion, of which `now` is shown next and `after` one tick later
  // (both placed in the world): the difference in pose and velocity will decay.
  void stitch(const Pose& now, const Pose& after);

  // Shows one tick. `clip_pose`: the action's frame placed in the world for this body; `contacts`:
  // the clip's. Returns the shown pose in the world.
  const Pose& next(const Pose& clip_pose, FootContacts contacts);

  // Shows a simulated pose as it is; the feet are let go.
  const Pose& next_simulated(const Pose& pose);

  const Pose& shown() const { return shown_; }                          // last shown
  const Pose& shown_before() const { return before_; }                  // one tick earlier
  FootContacts held() const { return {feet_[0].held, feet_[1].held}; }  // feet held on the ground
  bool started() const { return started_; }

 private:
  struct Foot {
    bool held = false;
    Vec3 place{};                // of the ball of the foot while held, ground plane
    std::optional<Tick> restep;  // age of a step of its own
    Vec3 restep_from{};
    Decay offset;  // lifted: ball's offset to the clip
  };

  Vec3 hold_foot(Side side, bool planted, Vec3 ball, Vec3 clip_ball);
  void place_feet(const Pose& clip_pose, FootContacts contacts, Pose& pose);
  const Pose& show(const Pose& pose);

  Skeleton skeleton_;
  PlaybackSettings settings_;
  Pose shown_, before_;
  bool started_ = false;
  std::array<Decay, kJointCount> rotation_;
  Decay hips_;
  std::array<Foot, 2> feet_;
  Tick since_restep_ = 1000;
};

}  // namespace ringcraft
