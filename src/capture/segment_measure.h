#pragma once
// What segmentation measures on a capture, once for all finders, and the thresholds they use.

#include <array>
#include <vector>

#include "capture/segment.h"

namespace ringcraft {

// A tick of the capture as an index.
inline std::size_t at(Tick tick) {
  return static_cast<std::size_t>(tick);
}

// Speeds in m/s of a body of 1.75 m (captures are retargeted to it), lengths as shares of the limb
// or of the standing height H. Each stands between what was measured on strikes and what was
// measured on everything else; docs/captures.md has both sides and what +-15 % does.
struct SegmentSettings {
  // Hands.
  float straight_speed = 2.0f;   // peak speed of the wrist relative to the hips
  float arm_opens = 0.20f;       // growth of shoulder-wrist over arm length
  float arm_opens_late = 0.07f;  // the part of it after the peak speed
  float arm_open = 0.70f;        // at full reach
  float goes_ahead = 0.15f;      // share of the peak velocity along the gaze
  float bent_speed = 4.05f;      // the same as straight_speed, for hooks and uppercuts
  float bent_ahead = 0.20f;      // as goes_ahead
  float bent_least = 0.45f;      // extension a bent-arm blow has at least
  float bent_gain = 0.08f;       // H the fist gains along the gaze
  float gaze_turn = 0.90f;       // rad the gaze may turn in a bent-arm blow
  float block_speed = 3.5f;      // for blocks
  float across = 0.04f;          // H: how far past the midline a sweeping block begins
  float rises = 0.87f;           // share of the peak velocity upward in a rising block
  // Kicks.
  float kick_speed = 3.4f;    // peak speed of the ankle relative to the hips
  float leg_folds = 0.72f;    // hip-ankle over leg length, in the chamber
  float leg_opens = 0.25f;    // growth from there
  float kick_height = 0.20f;  // H: the ankle at full reach
  float kick_ahead = 0.15f;   // H: the ankle past the hips along the gaze at full reach
  float round_turn = 1.25f;   // rad the hips turn in 0.6 s in a roundhouse
  float spin_turn = 4.2f;     // rad the hips turn in 1.3 s in a spin
  // The body.
  float shortest = 0.1f;    // s at a quarter of its peak speed or more: shorter is a cut
  float standing = 0.72f;   // share of the usual height of the hips under which nobody strikes
  float travelling = 1.5f;  // m/s of the hips over the ground: faster is running, not boxing
};

// The same with other thresholds, for studies.
Segmentation segment(const Skeleton& skeleton, const Clip& capture, const std::string& name,
                     const SegmentSettings& settings);
inline constexpr Tick kShortestCapture = 24;  // 0.2 s

// Frames of one capture and what follows from them, one entry a tick.
struct Measures {
  Tick last = 0;
  float height = 0;      // H, m
  float usual_hips = 0;  // m: the hips' height while the fighter stands
  std::vector<WorldPose> world;
  std::vector<float> gaze;        // rad, yaw of the head, unwrapped
  std::vector<float> pelvis_yaw;  // rad, of the hip line's normal, unwrapped
  std::vector<float> trunk;       // rad: elevation of the line from hips to neck
  std::vector<float> hips_speed;  // m/s over the ground
  std::vector<float> hips_climb;  // m/s upward
  struct LimbTracks {
    std::vector<Vec3> from_hips;   // m, hand or ankle
    std::vector<float> speed;      // m/s relative to the hips
    std::vector<float> extension;  // distance to the shoulder or hip over the limb's length
  };
  std::array<LimbTracks, 2> hand, foot;  // by side

  const Vec3& at(Joint joint, Tick tick) const {
    return world[static_cast<std::size_t>(tick)].position[index(joint)];
  }
  Tick clamped(Tick tick) const { return tick < 0 ? 0 : tick > last ? last : tick; }
};

Measures measured(const Skeleton& skeleton, const Clip& capture);

// A direction or offset seen by somebody who looks along `yaw`: x outward on `side`, y up, z ahead.
Vec3 seen_along(Vec3 v, float yaw, Side side);

inline const std::array<Side, 2> kSides = {Side::left, Side::right};
inline std::size_t index(Side side) {
  return static_cast<std::size_t>(side);
}
inline const char* word(Side side) {
  return side == Side::left ? "left" : "right";
}

// The higher wrist over the ground, m.
float hands_height(const Measures& measures, Tick tick);

// Ticks of local peaks of at least `least`, highest within `around` ticks to both sides.
std::vector<Tick> peaks_of(const std::vector<float>& values, float least, Tick around);

// Those of a limb's peaks of speed that somebody swung: where two takes were put together a hand is
// elsewhere at once.
std::vector<Tick> swings_of(const std::vector<float>& speed, float least, Tick around,
                            const SegmentSettings& settings);

// Blows of hands and feet in order of time, none of which overlap on one limb.
std::vector<FoundBlow> hand_blows(const Measures& measures, const SegmentSettings& settings);
std::vector<FoundBlow> kicks(const Measures& measures, const SegmentSettings& settings);

// When the body goes down and comes up again.
struct Descent {
  Tick begin = 0, down = 0;   // leaves its standing height; has landed
  Lying lying = Lying::none;  // how it lies then
  Lying rests = Lying::none;  // how it lies before it rises, or at the end
  bool controlled = false;    // a hand finds the floor well before the seat
  Tick rise = -1, up = -1;    // leaves the floor; stands; -1 where it stays down
  Tick left_lying = 0;        // the last moment at which it lay as it did first
  bool starts_down = false;   // the capture begins on the floor: begin and down are its start
  bool rolls = false;         // goes over its head and on: no fall
  std::string evidence_down, evidence_up;
};
std::vector<Descent> descents(const Measures& measures);

// Hands and feet together. Arms that swing while a leg kicks strike nobody; nor do those of a
// fighter who falls.
std::vector<FoundBlow> all_blows(const Measures& measures, const std::vector<Descent>& falls,
                                 const SegmentSettings& settings);

// How the fighter stands when he does nothing: the moment nearest to the medians of the joints over
// all moments at which he stands quietly with his hands up (with his hands anywhere, where he never
// puts them up).
struct Guard {
  Tick at = 0;
  bool hands_up = false;
  bool fights = false;          // stands with its hands up and one foot ahead, as who fights does
  bool southpaw = false;        // then: the right foot ahead
  float yaw = 0;                // rad: pelvis yaw off the opponent at `at`
  float hands = 0;              // m over the ground: the higher wrist, median of the quiet moments
  std::vector<float> distance;  // m rms of the pose from the guard's, laid on it (state_machine.h)
  std::vector<float> facing;    // rad: where the body would face if it stood in guard
  std::string evidence;
};
Guard guard_of(const Skeleton& skeleton, const Clip& capture, const Measures& measures,
               const std::vector<FoundBlow>& blows, const std::vector<Descent>& descents);

}  // namespace ringcraft
