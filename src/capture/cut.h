#pragma once
// Cutting labelled actions out of a retargeted capture.
//
// A cut is moved to action space: +Z points at the opponent, who is nowhere in a capture of one
// person. The fighter's guard says where he stands: the body is laid on one moment at which it is
// known to stand in guard. Blows of shadow work stray (this boxer's crosses go 35 degrees across
// his jabs), so a cut with straights is turned about its own axis, smoothly, until each of them
// goes the way the guard at the start faces and the body comes back to it; then its feet are
// planted again.
//
// The root track is smooth: it follows the body over the ground but neither the swing of the hips
// nor the bounce.

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/action.h"

namespace ringcraft {

struct StrikeCut {
  StrikeKind kind = StrikeKind::straight;
  Joint joint = Joint::left_hand;
  TargetZone zone = TargetZone::head;
  double at = 0;         // s: the joint's peak speed
  std::string aim = {};  // what it is led to (motion/aim.h); empty: the captured way stays
};

// One action of a manifest. Times in seconds from the capture's first frame.
struct ActionCut {
  std::string name;
  Kind kind = Kind::idle;
  double begin = 0, end = 0;
  float turn = 0;  // rad, added to the facing that is found
  // rad: where the fighter faces at begin and end, for poses that are far from any guard; found on
  // the guard without them.
  std::optional<float> facing_begin, facing_end;
  std::vector<StrikeCut> strikes;
  std::optional<Defense> defense;  // ticks from the capture's first frame
  std::optional<Response> response;
  bool measure_direction = false;  // of the response, from the root track
  Lying starts_lying = Lying::none, ends_lying = Lying::none;
};

// What the cuts of one capture share.
struct CaptureTracks {
  std::vector<Vec3> ground;  // under the pelvis, low-passed at 1 Hz
  Clip guard;                // the moment in guard, a few frames of the capture
  float guard_facing = 0;    // rad: where the fighter faces in it
};
// `guard_at`: s at which the fighter stands in guard; `guard_yaw`: pelvis yaw off the opponent in
// it, rad (boxers -58 degrees).
CaptureTracks tracks_of(const Clip& capture, double guard_at, float guard_yaw);

// Where the body would face if it stood in guard, rad: its joints laid on those of the guard.
float facing_at(const Skeleton& skeleton, const Clip& capture, const CaptureTracks& tracks,
                Tick tick);

// `file` and `place` are for messages.
Result<Action> cut_action(const Skeleton& skeleton, const Clip& capture,
                          const CaptureTracks& tracks, const ActionCut& cut,
                          const std::string& file, const std::string& place);

// The tick in [first, last] at which the joint moves fastest relative to the hips.
Tick fastest_tick(const Skeleton& skeleton, const Clip& clip, Joint joint, Tick first, Tick last);

// A moment as a clip of its own, five ticks, for alignment.
Clip window_about(const Clip& capture, Tick tick);

}  // namespace ringcraft
