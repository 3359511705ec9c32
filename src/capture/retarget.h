#pragma once
// Retargeting: a capture's motion on the canonical skeleton, at one frame a tick, feet planted.
//
// Every bone points the way the capture's bone points (its rest pose is laid on ours bone by bone),
// wrists follow the captured wrists, the hips' path is scaled by leg length, and the feet are
// cleaned up by inverse kinematics: a foot that stands in the capture stands still on the floor.

#include "capture/profile.h"
#include "motion/clip.h"

namespace ringcraft {

struct RetargetSettings {
  float contact_height = 0.035f;   // m over its standing height: a foot above it does not carry
  float contact_speed = 0.25f;     // m/s at which a foot counts as set down
  float release_speed = 0.45f;     // m/s at which it counts as lifted
  bool keep_first_plants = false;  // feet planted at the first frame stay there, not at their mean
  bool guessed_balls = false;      // the capture has no toes: the floor says where the balls stand
  float floor_play = 0.02f;        // m by which the floor under one contact may lie off that of all
  float blend_seconds = 0.20f;     // over which a lifted foot leaves its corrected place
};

// In the capture's own space (our axes, metres of the target's body); the root track is the
// identity throughout. Tick 0 is the file's first frame.
Result<Clip> retarget(const RawClip& raw, const SkeletonProfile& profile, const Skeleton& target,
                      const RetargetSettings& settings = {});

// What the capture's feet do, one entry a tick, in our axes and metres of the target's body.
struct CapturedFeet {
  std::array<std::vector<Vec3>, 2> ball;   // per side; the ankle, where there are no toes
  std::array<std::vector<Vec3>, 2> ankle;  // per side
  std::vector<Vec3> hips;                  // the middle of the hip joints
  bool has_toes = true;                    // else `ball` is the ankle
};

// Foot contacts of the capture itself, one a tick: the ball of the foot near its lowest height and
// slow.
std::vector<FootContacts> contacts_of(const CapturedFeet& feet, const RetargetSettings& settings);

// A stretch of a contact in which the ball of the foot stays within millimetres.
struct Rest {
  std::size_t begin, end;  // ticks, the end excluded
  Vec3 place;              // mean, m
};

// The rests of one path between two ticks, in order. A foot that creeps steadily has none.
std::vector<Rest> rests_of(const std::vector<Vec3>& path, std::size_t begin, std::size_t end);

// The least rotation that lays the plane under the capture's own plants flat: a captured floor
// tilts by a degree or two where cameras were calibrated so. The identity where plants are too few
// or too near one another to tell; never more than 3 degrees.
Quat floor_level(const CapturedFeet& feet, const RetargetSettings& settings);

// Moves hips and captured feet to the height at which our feet stand on y = 0. Contacts must be
// labelled. Feet of another build than ours stand at another height of the ankle: each side's path
// moves by a height of its own, the hips by their mean.
void stand_on_floor(const Skeleton& skeleton, CapturedFeet& feet, Clip& clip);

// Moves the ankles onto the captured ones.
void carry_feet(const Skeleton& skeleton, const CapturedFeet& feet, Clip& clip);

// The clean-up alone: planted feet are held at one place on the floor, the others return to their
// path; hips sink a little where a leg would not reach. Contacts must be labelled.
void plant_feet(const Skeleton& skeleton, Clip& clip, const RetargetSettings& settings = {});

// Where a body that sits or lies comes to rest over the floor.
inline constexpr float kPalm = 0.035f;        // m of wrist and knuckles when the hand carries
inline constexpr float kSeatHeight = 0.105f;  // m of the hip joints when the seat carries
inline constexpr float kLyingEase = 0.04f;    // m over which a height eases into its least

// Moves the wrists onto the way of the captured ones, scaled about the hips and shifted up or down
// as little as our body's proportions ask for: nothing in that turns when the body turns. Where the
// floor keeps lying hands higher than that, those of a standing body go up too, as far as their way
// takes to stay the captured one. The hips must stand at their height over the floor.
// `captured`: per side and tick, wrist from the middle of the hip joints in our axes, metres of the
// target's body.
void carry_hands(const Skeleton& skeleton, const std::array<std::vector<Vec3>, 2>& captured,
                 Clip& clip);

// Turns upper arms and thighs about themselves until elbows and knees flex about their hinges (y of
// the lower arm, x of the lower leg); the lower bones keep their directions.
void turn_to_hinges(const Skeleton& skeleton, Clip& clip);

// Shares pronation between forearm and hand, and keeps the hand within a wrist's range.
void fit_wrists(Clip& clip);

// Lifts hips, elbows, wrists and knuckles that would lie in the floor, as happens when longer arms
// or shorter legs sit where the captured person sat.
void clear_floor(const Skeleton& skeleton, Clip& clip);

}  // namespace ringcraft
