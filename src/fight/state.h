#pragma once
// The fight state: what a decision starts from. A small value with a hash and equality.

#include <cstdint>
#include <vector>

#include "base/index.h"
#include "base/ticks.h"
#include "fight/pace.h"
#include "motion/library.h"

namespace ringcraft {

// An action in flight. Its clip is shown at `placement_at`; a planner knows no more of motion.
struct Launch {
  ActionId action;
  Tick start = 0;  // tick of the clip's first frame
  Tick end = 0;    // tick at which the fighter acts again; earlier than the clip's end when cut
  Placement placement;  // of action space, world
  float aim = 0;  // rad: turn toward the opponent, eased in over the first half of the startup
  bool forced = false;     // a response, a get-up or how a winner stands: not chosen
  std::uint8_t spent = 0;  // bit i: strike i has hit, was blocked or was evaded
  // 0..1, of the clip that is shown, where a struck body stays up (physics/partial.h).
  float share = 1;
  Pace pace;  // at which it runs through its clip

  // Age of the clip at `tick`, ticks: in between frames, and to the nearest.
  float age(Tick tick) const { return pace.age(tick - start); }
  Tick clip_age(Tick tick) const;
  // The first tick at which the clip is at the age `clip`, or past it.
  Tick when(Tick clip) const { return start + pace.reached(clip); }

  bool has_spent(std::size_t strike) const { return ((spent >> strike) & 1u) != 0; }
  void spend(std::size_t strike) { spent = static_cast<std::uint8_t>(spent | (1u << strike)); }

  bool operator==(const Launch&) const = default;
};

inline constexpr Tick kNever = 1'000'000'000;  // end of the action of who is out

struct FighterState {
  Launch launch;
  std::int32_t health = 100'000;  // thousandths of a point
  std::int32_t balance = 0;       // 0 steady, 1 staggering (recovery steps), 2 down
  FighterId opponent;             // the chief one
  Tick last_contact = 0;          // when it last struck somebody, or was struck
  bool last_at_tie = false;       // was expanded second at the last tie: goes first at the next

  bool operator==(const FighterState&) const = default;
  bool down() const { return balance == 2; }
};

struct FightState {
  Tick now = 0;
  std::vector<FighterState> fighters;

  bool operator==(const FightState&) const = default;
  std::uint64_t hash() const;
};

// Ground position scaled for a body of another height; the yaw stays.
Placement scaled(const Placement& placement, float factor);

// Ticks over which the aim is eased in: half the startup of an attack, half the clip of the rest.
Tick aim_ticks(const Action& action);

// Share of the aim that is eased in where the clip is `age` ticks old: 0 at the start, 1 from
// `aim_ticks` on.
float aim_share(const Action& action, float age);

// Where action space lies in the world at `tick`: the launch's placement turned by the share of the
// aim that has been eased in.
Placement placement_at(const MotionLibrary& library, const Launch& launch, Tick tick);

// The fighter's root placement in the world at `tick` (ground position and facing); where a share
// of the clip is shown, that share of its way. `scale`: the body's height over kCanonicalHeight.
Placement root_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale);

// The clip's pose in the world at `tick`, for a body of that scale.
Pose pose_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale);

// The turn that aims an action at `target`, rad, clamped to `most_aim`: an attack sends its blow
// there, any other action ends facing there.
float aim_at(const Action& action, const Placement& placement, Vec3 target, float scale,
             float most_aim);

// The launch of `next` at the end of `last`, by the state machine's edge, aimed at `target` by
// aim_at. The edge must exist.
Launch following(const MotionLibrary& library, const Launch& last, ActionId next, Tick start,
                 Vec3 target, float scale, float most_aim);

// How long a fallen body lies before it gets up: the ragdoll is at rest by then.
inline constexpr Tick kLyingTicks = 100;

// When a fighter is free whose opponent begins to fall at `now`: a blow that is on its way is let
// out, what else the attack holds is not thrown. The launch's end for anything but an attack.
Tick free_after_fall(const Action& action, const Launch& launch, Tick now);

// Of a turn off the way that an answer would face, rad, what is beyond 90 degrees (authored): so
// much it brings back, and begins turned by the rest.
float not_brought_back(float turn);

// The same of the body that shows a clip at the age `age`, off the way its root faces, as in a
// spin.
float turned_away(const MotionLibrary& library, const Action& action, Tick age);

// Where the answer to a blow at `tick` begins: at the root of the struck body, the way it has
// turned.
Placement answers_from(const MotionLibrary& library, const Launch& cut, Tick tick, float scale);

// The launch of a response at tick `start`, begun there. A knockdown lasts until the get-up begins.
Launch forced_response(const MotionLibrary& library, const Launch& cut, ActionId response,
                       Tick start, float scale);

// The launch of a get-up at tick `start`, from where the fallen body lies: by the state machine's
// edge where there is one, else from its root.
Launch forced_get_up(const MotionLibrary& library, const Launch& fallen, ActionId get_up,
                     Tick start, float scale);

// Who acts next: the fighter whose action ends first; at equal ends the one that was expanded
// second at the last tie, then the lower index.
FighterId next_to_act(const FightState& state);

// Marks who went first at a tie, so that the other goes first at the next one. Call it while the
// fighter's last action is still in the state, before the new launch replaces it.
void note_expanded(FightState& state, FighterId expanded);

}  // namespace ringcraft
