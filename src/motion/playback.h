#pragma once
// Playback: one fighter's segments become one continuous motion.
//
// At a seam the difference to the new clip is inertialized (Bollo 2018): it starts from the present
// pose and velocity and decays along a quintic, so that even an interrupted blend does not jump.
// Hands and feet are led by where they are, not by joint angles: those of an arm thrown straight
// cannot decay one by one without throwing the fist aside or bending the elbow backwards. A planted
// foot stays where it was set down until the clip lifts it, one left too far from the clip's takes
// a small step of its own, and where the legs are too short for that the hips sink.

#include <array>

#include "motion/clip.h"
#include "motion/decay.h"

namespace ringcraft {

struct PlaybackSettings {
  float blend_seconds = 0.24f;   // in which a seam's difference falls to nothing
  float longest_blend = 0.90f;   // s: the same where a simulated body is far from the clip
  float unlock_seconds = 0.20f;  // the same for a lifted foot's way back to the clip
  float land_seconds = 0.10f;    // in which a foot that was set down presses to the floor
  // m: a planted foot farther from the clip's takes a step of its own
  float restep_distance = 0.06f;
  float restep_seconds = 0.22f;
  float restep_lift = 0.05f;  // m: height of that step
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

  // Replaces the pose just shown, where something outside (another body) stood in its way.
  void amend(const Pose& pose);

  // A foot that has been set down and still presses down stands `offset`, m on the ground, off
  // where it was led: something outside stood there. It goes on from where it is shown.
  void stand_aside(Side side, Vec3 offset);
  bool presses_down(Side side) const {
    const Foot& foot = feet_[static_cast<std::size_t>(side)];
    return foot.mode == Mode::held && !foot.offset.done();
  }

  const Pose& shown() const { return shown_; }          // last shown
  const Pose& shown_before() const { return before_; }  // one tick earlier
  // Feet that stand still on the ground; not those that still press down or step on their own.
  FootContacts held() const { return {stands(feet_[0]), stands(feet_[1])}; }
  bool started() const { return started_; }

 private:
  enum class Mode : std::uint8_t { swing, step, held };
  // What keeps something over the floor.
  struct Lift {
    float at_first = -1;  // m: what that took at the seam; below 0: not known yet
    float of(float height, float clip_height, float begun);
  };
  struct Foot {
    Mode mode = Mode::swing;
    Vec3 place{};            // of the ball of the foot while held, on the ground plane
    Decay offset;            // of the ball to where it is going
    Decay turn;              // of the foot's world rotation to the clip's
    bool by_joints = false;  // swings as the leg's joints take it
    float rise = 0;          // m: height of an arc on top, so that no foot is moved along the floor
    float rise_age = 0, rise_seconds = 1;
    float load = 0;              // 0 lifted .. 1 carries; says how far the hips sink for it
    float over = 0;              // m: by which the hip is too high for it, one tick ago
    float sink = 0;              // m: by which they have to sink, if it carries, to reach it
    Vec3 ball{}, ball_before{};  // shown
    Vec3 led{}, led_before{};    // where the ball was to be, as far as the leg reached
    Lift lift;                   // of one that goes by joints
    Vec3 clip_ball{};            // the clip's, one tick ago
    Quat clip_turn;              // the same of the foot's world rotation
    float reach = 0;             // at the seam, as a share of the leg's length
    float reach_left = 0;        // 1 at the seam .. 0: what of that still counts
  };

  struct Sink {
    float value = 0, velocity = 0;  // m, m/s: how far the hips are below the clip's
    void follow(float needed);
  };

  // How long the difference to a clip takes to fall to nothing.
  float blend_of(const Pose& now, const Pose& after,
                 const std::array<bool, 2>& arms_by_joints) const;
  float trunk_seconds(const WorldPose& now) const;
  float swing_seconds(Side side, const Limb& limb, const Pose& now, float most_acceleration) const;
  Decay hips_decay(Vec3 offset, Vec3 velocity) const;
  bool lies() const;
  Vec3 hips_turn() const { return turn_.left(); }  // left of the seam
  bool stands_still(const Foot& foot) const;
  static bool stands(const Foot& foot) { return foot.mode == Mode::held && foot.offset.done(); }
  static float clearing_rise(Decay path, float seconds);
  void stitch_foot(Side side, const WorldPose& now, const WorldPose& after);
  void begin_move(Foot& foot, Mode mode, Vec3 offset, Vec3 velocity, float least_seconds) const;
  void stand(Foot& foot, float floor) const;
  bool lift_waits(const Foot& foot, const Foot& other_foot, Vec3 clip_ball) const;
  void change_mode(Side side, bool planted, Vec3 clip_ball, float floor);
  Vec3 ball_of(Side side, bool planted, Vec3 clip_ball, Vec3 blended_ball, float floor);
  void lead(Side side, Quat clip_turn);
  float floor_of_shown(Side side) const;
  float too_high(Vec3 hip, Vec3 ankle, float straightest) const;
  void place_feet(const Pose& clip_pose, FootContacts contacts, Pose& pose);
  bool arm_by_joints(Side side, const Pose& now) const;
  void stitch_hinge(const Limb& limb, const Pose& now, const Pose& after);
  void bend_hinges(const Pose& clip_pose, Pose& pose);
  void turn_roots(const Pose& clip_pose, Pose& pose);
  void place_hands(const Pose& clip_pose, Pose& pose);
  const Pose& show(const Pose& pose);

  Skeleton skeleton_;
  PlaybackSettings settings_;
  Pose shown_, before_;
  bool started_ = false;
  bool simulated_ = false;                         // the pose shown last was simulated
  bool after_simulation_ = false;                  // the last seam was one from a simulated pose
  float blend_seconds_ = 0.24f;                    // of the last seam
  BodyTurn turn_;                                  // of the hips
  std::array<Decay, kJointCount> rotation_;        // of the joints above and below them
  std::array<Decay, kJointCount> flexion_;         // of knees and elbows about their hinge (x, rad)
  std::array<float, kJointCount> seam_flexion_{};  // rad: the same at the seam
  Decay hips_;
  Sink sink_;
  std::array<Decay, 2> hands_;            // of the wrists' world positions
  std::array<Decay, 2> shoulders_;        // of arms that go by their joints instead
  std::array<Vec3, 2> seam_shoulder_{};   // rad: how those were turned at the seam
  std::array<Decay, 2> hip_joints_;       // of legs that do
  std::array<float, 2> arm_reach_{0, 0};  // at the seam, as a share of its length
  std::array<Foot, 2> feet_;
  float since_step_ = 1;  // s: since a foot took a step of its own
};

}  // namespace ringcraft
