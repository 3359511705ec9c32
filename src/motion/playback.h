#pragma once
// Playback: one fighter's segments become one continuous motion.
//
// At a seam the difference to the new clip is inertialized (Bollo 2018): it starts from the present
// pose and velocity and decays (decay.h), so that even an interrupted blend does not jump.
// Hands and feet are led by where they are, not by joint angles: those of an arm thrown straight
// cannot decay one by one without throwing the fist aside or bending the elbow backwards. What the
// feet do is in feet.h.

#include <array>
#include <functional>
#include <span>

#include "motion/clip.h"
#include "motion/decay.h"
#include "motion/feet.h"
#include "motion/joint_turns.h"

namespace ringcraft {

class Playback {
 public:
  explicit Playback(const Skeleton& body, const PlaybackSettings& settings = {});

  // The next tick begins a new motion, of which `now` is shown next and `after` one tick later
  // (both placed in the world): the difference in pose and velocity will decay.
  void stitch(const Pose& now, const Pose& after);

  // The same from where a body lies. Each limb goes to the clip by the way on which it is least
  // in anything.
  struct WayUp {
    std::span<const Pose> clip;                            // from `now` on, a pose a tick
    std::function<float(const Limb&, const Pose&)> depth;  // m: of a limb in floor and body
  };
  void stitch(const WayUp& way);

  // Shows one tick. `clip_pose`: the action's frame placed in the world for this body; `contacts`:
  // the clip's. Returns the shown pose in the world.
  const Pose& next(const Pose& clip_pose, FootContacts contacts);

  // Shows a simulated pose as it is; the feet are let go.
  const Pose& next_simulated(const Pose& pose);

  // Replaces the pose just shown, where it may not be so: ranges of joints, a blow that has landed.
  void amend(const Pose& pose);

  // A foot that has been set down and still presses down stands `offset`, m on the ground, off
  // where it was led: something outside stood there. It goes on from where it is shown.
  void stand_aside(Side side, Vec3 offset) { feet_.stand_aside(side, offset); }
  void strain(Side side) { feet_.strain(side); }  // as of Feet
  bool presses_down(Side side) const { return feet_.presses_down(side); }

  const Pose& shown() const { return shown_; }          // last shown
  const Pose& shown_before() const { return before_; }  // one tick earlier
  // Feet that stand still on the ground; not those that still press down or step on their own.
  FootContacts held() const { return {feet_.stands(Side::left), feet_.stands(Side::right)}; }
  bool started() const { return started_; }

 private:
  // How long the difference to a clip takes to fall to nothing.
  float blend_of(const Pose& now, const Pose& after,
                 const std::array<bool, 2>& arms_by_joints) const;
  float trunk_seconds(const WorldPose& now) const;
  float swing_seconds(Side side, const Limb& limb, const Pose& now, float most_acceleration) const;
  Decay hips_decay(Vec3 offset, Vec3 velocity) const;
  bool arm_by_joints(Side side, const Pose& now) const;
  void stitch_hinge(const Limb& limb, const Pose& now, const Pose& after);
  float bent_leg(const Limb& limb, const Free& free, float longer) const;
  void bend_hinges(const Pose& clip_pose, Pose& pose) const;
  void turn_roots(const Pose& clip_pose, Pose& pose) const;
  Pose blended(const Pose& clip_pose) const;
  void step_blend(float dt);
  float depth_on(const WayUp& way, const Limb& limb, float most) const;
  float haste_on(const WayUp& way, const Limb& limb) const;
  void go_round(const WayUp& way, Side side, const Limb& limb);
  void place_hands(const Pose& clip_pose, Pose& pose);
  const Pose& show(const Pose& pose);
  void set_shown(const Pose& pose);

  Skeleton skeleton_;
  PlaybackSettings settings_;
  Pose shown_, before_;
  bool started_ = false;
  bool simulated_ = false;                         // the pose shown last was simulated
  bool catches_up_ = false;                        // since the last seam, with a simulation
  float blend_seconds_ = 0.24f;                    // of the last seam
  BodyTurn turn_;                                  // of the hips
  std::array<Decay, kJointCount> rotation_;        // of the joints above and below them
  std::array<Decay, kJointCount> hinges_;          // x: of elbows' flexion, rad; of legs' reach, m
  std::array<float, kJointCount> seam_flexion_{};  // rad: the same at the seam
  Decay hips_;
  std::array<Decay, 2> hands_;           // of the wrists' world positions
  std::array<Decay, 2> shoulders_;       // of arms that go by their joints instead
  std::array<Vec3, 2> seam_shoulder_{};  // rad: how those were turned at the seam
  std::array<Decay, 2> hip_joints_;      // of the lines of legs that do
  std::array<Vec3, 2> shoulders_aside_{}, hip_joints_aside_{};  // rad: of both, half-way
  std::array<float, 2> arm_reach_{0, 0};  // at the seam, as a share of its length
  Feet feet_;
};

}  // namespace ringcraft
