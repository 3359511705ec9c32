#pragma once
// The ways of both feet while they are cleaned up, and the places where they stand; used by
// plant_feet only (retarget.h).

#include "capture/retarget.h"

namespace ringcraft {

inline constexpr float kTouchTicks = 12;    // over which a ball of the foot leaves its plant
inline constexpr float kFloorEase = 0.03f;  // m over which a foot in the air keeps out of the floor

// One foot, one entry a tick.
struct FootTrack {
  std::vector<Quat> foot, toe;  // world rotations, laid flat near the floor
  std::vector<Vec3> ball;       // where the ball of the foot goes
  std::vector<Vec3> ankle;      // where the ankle would go
  std::vector<Vec3> captured;   // where it went before plants were held
  std::vector<float> held;      // 1 while the ball is planted, 0 in the air
};

// The feet as the clip has them; balls that the capture does not tell are laid on the floor.
std::array<FootTrack, 2> foot_tracks(const Skeleton& skeleton, const Clip& clip,
                                     const RetargetSettings& settings);

Vec3 ankle_at(const Skeleton& skeleton, Side side, const FootTrack& track, std::size_t i);

// A planted foot turns about its ball; one in the air about its ankle, which so keeps its way.
void turn_foot(const Skeleton& skeleton, Side side, Quat to, std::size_t i, FootTrack& track);

// A stretch of ticks, the end excluded, in which a foot stands.
struct Plant {
  std::size_t begin, end;
  std::vector<Rest> rests;  // at least one
  float lift;               // m by which the capture's floor lies lower than ours here
};

std::vector<Plant> plants_of(const Skeleton& skeleton, const Clip& clip, Side side,
                             const RetargetSettings& settings, const FootTrack& track);

// Where a planted ball of the foot stands: at its rests, moving slowly from one to the next.
Vec3 place_at(const Plant& plant, std::size_t i);

// The body goes with the feet it stands on: where plants take motion out of the captured feet, hips
// and feet together leave the captured way by as much, smoothly.
void sway_with_plants(const Skeleton& skeleton, const RetargetSettings& settings,
                      std::array<std::vector<Plant>, 2>& plants, std::array<FootTrack, 2>& feet,
                      Clip& clip);

}  // namespace ringcraft
