#pragma once
// The feet of a body that is shown (playback.h). A planted foot stays where it was set down until
// the clip lifts it, one left too far from the clip's takes a small step of its own, and where the
// legs are too short for that the hips sink.

#include <array>

#include "motion/clip.h"
#include "motion/decay.h"
#include "motion/easing.h"
#include "motion/playback_settings.h"

namespace ringcraft {

class Feet {
 public:
  Feet(const Skeleton& body, const PlaybackSettings& settings);

  // From the next tick on they follow `now`, and `after` one tick later.
  struct Seam {
    const WorldPose &shown, &now, &after;
    float seconds;       // in which the difference falls to nothing
    float turn_seconds;  // the same of where the body faces
    bool simulated;      // the pose shown last was
    bool catches_up;     // with a simulation, now or still
    Vec3 hips_turn;      // left of the hips' turn to the clip's, a rotation vector
  };
  void stitch(const Seam& seam);

  // Moves hips, legs and feet of `pose` for one tick of the clip; the feet where the clip has them,
  // where they stand, or on their way.
  void place(const Pose& clip_pose, FootContacts contacts, Vec3 hips_turn, Pose& pose);

  // Whatever they did is over: a simulation moves them.
  void let_go();

  // What is shown in the next tick, and what replaces it (Playback::amend).
  void show(const WorldPose& world);
  void amend(const WorldPose& world);

  // A foot that stands may not stay there, as where its leg will be at the end of a joint's range
  // soon: it takes a step of its own in the next tick.
  void strain(Side side) { of(side).strained = true; }

  // A foot that stands `offset`, m on the ground, off where it was led.
  void stand_aside(Side side, Vec3 offset);

  bool presses_down(Side side) const { return of(side).mode == Mode::held && !stands(side); }
  bool stands(Side side) const { return stands(of(side)); }
  bool by_joints(Side side) const { return of(side).by_joints; }
  bool lies() const;                          // the hips are too low to stand
  float sink() const { return sink_.value; }  // m: how far the hips are below the clip's

 private:
  enum class Mode : std::uint8_t { swing, step, held };
  // What keeps something over the floor.
  struct Lift {
    float at_first = -1;  // m: what that took at the seam; below 0: not known yet
    float of(float height, float clip_height, float begun);
  };
  // How high, m, a foot on its way back stays over the floor.
  struct Clearance {
    float value = 0, velocity = 0;  // m, m/s
    void follow(float wanted);
  };
  // How far, m, a knee stands off the line from hip to ankle: one of a leg that is nearly straight
  // goes far where its foot goes little, and starts and stops gently all the same.
  struct Knee {
    float shown = 0, shown_before = 0;
    Easing<float> path;
  };
  struct Foot {
    Mode mode = Mode::swing;
    Vec3 place{};            // of the ball of the foot while held, on the ground plane
    Decay offset;            // of the ball to where it is going
    Decay turn;              // of the foot's world rotation to the clip's
    bool by_joints = false;  // swings as the leg's joints take it
    bool rests = false;      // held, and has come down
    bool strained = false;   // it may not stay where it stands
    bool lifted = true;      // off the floor since it stood last
    float rise = 0;          // m: height of an arc on top, so that no foot is moved along the floor
    float rise_age = 0, rise_seconds = 1;
    float load = 0;              // 0 lifted .. 1 carries; says how far the hips sink for it
    float over = 0;              // m: by which the hip is too high for it, one tick ago
    float sink = 0;              // m: by which they have to sink, if it carries, to reach it
    Vec3 ball{}, ball_before{};  // shown
    Quat shown, shown_before;    // world rotation
    Vec3 led{}, led_before{};    // where the ball was to be, as far as the leg reached
    Lift lift;                   // of one that goes by joints
    Clearance clearance;         // of one on its way
    Vec3 clip_ball{};            // the clip's, one tick ago
    Quat clip_turn;              // the same of the foot's world rotation
    Knee knee;
    Easing<Vec3> path;      // of the ball
    float straightest = 0;  // share of its length to which the leg may be straight
    float reach = 0;        // at the seam, as a share of the leg's length
    float reach_left = 0;   // 1 at the seam .. 0: what of that still counts

    // Where the ball would be shown next if nothing changed, and how far that is from here; what
    // went by joints was kept inside their ranges.
    Vec3 moved() const { return by_joints ? ball - ball_before : led - led_before; }
    Vec3 carried() const { return (by_joints ? ball : led) + moved(); }
  };
  struct Sink {
    float value = 0, velocity = 0;  // m, m/s: how far the hips are below the clip's
    void follow(float needed);
  };

  Foot& of(Side side) { return feet_[static_cast<std::size_t>(side)]; }
  const Foot& of(Side side) const { return feet_[static_cast<std::size_t>(side)]; }
  static bool stands(const Foot& foot) { return foot.mode == Mode::held && foot.rests; }
  bool stands_still(const Foot& foot) const;
  static float clearing_rise(Decay path, float seconds);
  void stitch_foot(Side side, const Seam& seam);
  void begin_move(Foot& foot, Mode mode, Vec3 offset, Vec3 velocity, float least_seconds) const;
  void stand(Foot& foot, float floor) const;
  bool stand_as_shown(Foot& foot) const;
  static bool off_the_floor(const Foot& foot);
  static bool lift_waits(const Foot& foot, const Foot& other_foot, Vec3 clip_ball);
  void change_mode(Side side, bool planted, Vec3 clip_ball, float floor);
  Vec3 ball_of(Side side, bool planted, Vec3 clip_ball, Vec3 blended_ball, float floor);
  void lead(Foot& foot, Quat clip_turn, Vec3 hips_turn) const;
  float floor_of_shown(const Foot& foot) const;
  static float fastest_descent(const Foot& foot, float floor);
  float too_high(Vec3 hip, Vec3 ankle, float straightest) const;
  float rise_for(Side side, const WorldPose& world) const;
  float knees_ask(const WorldPose& world, const WorldPose& clip);

  Skeleton skeleton_;
  PlaybackSettings settings_;
  bool started_ = false;
  bool after_simulation_ = false;  // since the last seam they catch up with one
  float blend_seconds_ = 0.24f;    // of the last seam
  float hips_height_ = 0;          // m: shown
  float since_step_ = 1;           // s: since a foot took a step of its own
  Sink sink_;
  std::array<Foot, 2> feet_;
};

}  // namespace ringcraft
