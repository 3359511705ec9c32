#pragma once
// The curves of one sheet action: root, trunk, hands and feet over time.

#include <vector>

#include "capture/sheet_body.h"
#include "capture/sheet_keys.h"
#include "capture/sheet_track.h"
#include "motion/clip.h"

namespace ringcraft {

// Keys with the start and end poses merged in at the ends: every channel that a pose gives has a
// key at time 0 and one at the action's length.
std::vector<SheetKey> merged_keys(const SheetAction& action);

// Where the root ends, m and rad: as written, or where the pivot foot leaves it.
Placement end_placement(const SheetAction& action);

// What the yaws of the body have grown by at the end of a spin that goes on to the stance, degrees.
constexpr float full_turns(const SheetAction& action) {
  return 360.0f * static_cast<float>(action.turns);
}

// The root's placement at every tick.
std::vector<Placement> root_track(const SheetAction& action, const std::vector<SheetKey>& keys);

// Pelvis, chest and head over time in the root's frame; the chain of links is in the keys' times.
class TrunkMotion {
 public:
  TrunkMotion(const SheetAction& action, const std::vector<SheetKey>& keys);

  // Fills pelvis and the three rotations of the targets at time t.
  void fill(float t, BodyTargets& targets) const;

 private:
  Vec3 head_angles(float t, Vec3 lean, float chest_yaw) const;

  Track pelvis_, pelvis_yaw_, pelvis_lean_, chest_yaw_, lean_, head_;
  float bounce_hz_, bounce_;
};

// One hand over time in the root's frame.
class HandMotion {
 public:
  HandMotion(const Skeleton& skeleton, const SheetAction& action, const std::vector<SheetKey>& keys,
             const TrunkMotion& trunk, Side side);

  // The trunk's rotations and pelvis must be filled.
  ArmTarget at(float t, const BodyTargets& trunk) const;
  bool strikes() const { return path_.has_value(); }

 private:
  struct Wave {
    Vec3 amount{};
    float hz = 0, phase = 0;
  };
  // A wrist that lags behind its forearm in one strike and snaps straight.
  struct Snap {
    float start = 0, contact = 0;  // s
    float lag = 0;                 // rad
    float at(float t) const;
  };
  Vec3 sway(float t) const;

  const Skeleton& skeleton_;
  Side side_;
  std::vector<Snap> snaps_;
  std::optional<StrikePath> path_;  // root's frame, of a hand that strikes
  Track in_chest_;                  // chest's frame, of one that does not
  Track pole_;                      // chest's frame
  Track palm_;
  std::vector<Wave> waves_;
};

// One foot over time in action space: stands where it was put until a step moves it.
class FootMotion {
 public:
  FootMotion(const Skeleton& skeleton, const SheetAction& action, const std::vector<SheetKey>& keys,
             const std::vector<Placement>& root, const TrunkMotion& trunk, Side side);

  // `root`: the placement at t; `trunk`: the targets with pelvis and rotations in action space.
  FootTarget at(float t, const BodyTargets& trunk) const;
  bool planted(float t) const;
  // How far the foot ends from where the end pose wants it, m; 0 where either is off the ground.
  float end_error() const { return end_error_; }

 private:
  struct Span {  // one step, or the time before the first one of a foot that starts in the air
    float lift = 0, land = 0;
    Vec3 from{}, to{};  // of the ball, m
    float height = 0;
    bool free = false, starts_free = false, ends_free = false;
    bool rests = false;  // comes to rest before it lands
    std::optional<StrikePath> path;
    std::vector<float> rise;  // m by tick from `lift` on: how far a moving ankle is above its path
  };
  const Span* span_at(float t) const;
  float freedom(const Span& span, float t) const;
  float heel_roll(float t) const;  // rad
  void make_spans(const SheetAction& action, const Placement& end);
  void make_angles(const SheetAction& action, const std::vector<SheetKey>& keys,
                   const std::vector<Placement>& root, const Placement& end);
  void make_paths(const SheetAction& action, const std::vector<SheetKey>& keys,
                  const std::vector<Placement>& root);
  Vec3 on_path(const Span& span, float t) const;
  void add_clearance(Span& span, const std::vector<SheetKey>& keys) const;
  void add_landing(Span& span, float earliest) const;
  void make_knee(const SheetAction& action, const std::vector<SheetKey>& keys,
                 const std::vector<Placement>& root, const TrunkMotion& trunk);

  const Skeleton& skeleton_;
  Side side_;
  Vec3 start_ball_{};
  std::vector<Span> spans_;
  Track yaw_, heel_, point_, knee_;
  float end_error_ = 0;
};

}  // namespace ringcraft
