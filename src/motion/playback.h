#pragma once
// Playback: one fighter's segments become one continuous motion.
//
// At a seam the difference to the new clip is inertialized (Bollo 2018: a quintic decays it from the
// present pose and velocity), so even an interrupted blend does not jump. Planted feet are held by IK
// where they were set down until the clip lifts them; a foot that ends up too far from its place takes
// a small step of its own.

#include <array>
#include <optional>
#include <span>

#include "motion/clip.h"

namespace ringcraft {

struct PlaybackSettings {
  float blend_seconds = 0.30f;   // time over which a seam's difference decays
  float unlock_seconds = 0.18f;  // time over which a lifted foot returns to the clip
  float restep_distance = 0.07f; // m: a planted foot farther from the clip's takes a step of its own
  float restep_seconds = 0.22f;
  float restep_lift = 0.045f;    // m: height of that step
};

class Playback {
 public:
  // `scale`: the body's height over kCanonicalHeight; clips are stored for the canonical body.
  Playback(const Skeleton& body_skeleton, float scale, const PlaybackSettings& settings = {});

  // Stitches to a new motion: from the next frame on, clip frames are shown. Keeps the shown pose and
  // velocity continuous.
  void stitch();

  // Shows the next tick. `clip_pose`: the action's frame placed in the world for this body;
  // `contacts`: the clip's. Returns the shown pose in the world.
  Pose next(const Pose& clip_pose, FootContacts contacts);

  // Shows a pose as it is (a simulated one); feet are let go.
  Pose next_simulated(const Pose& pose);

  // The last shown pose and the one before it; the first shown pose twice at the start.
  const Pose& shown() const { return shown_; }
  const Pose& shown_before() const { return before_; }
  bool started() const { return started_; }

 private:
  struct Decay {  // quintic from (x0, v0) to rest, one per component
    Vec3 x0{}, v0{};
    Tick age = 0;
  };
  struct Foot {
    bool locked = false;
    Vec3 ball{};                 // where the ball of the foot stands, on the ground plane
    std::optional<Tick> restep;  // age of a step of its own
    Vec3 restep_from{};
    Vec3 offset{};               // lifted: offset to the clip that decays
    Tick offset_age = 0;
  };

  void hold_foot(Side side, bool planted, Pose& pose);

  Skeleton skeleton_;
  float scale_;
  PlaybackSettings settings_;
  Pose shown_, before_;
  bool started_ = false;
  bool stitching_ = false;
  std::array<Decay, kJointCount> rotation_;
  Decay hips_;
  std::array<Foot, 2> feet_;
};

}  // namespace ringcraft
