#pragma once
// The fight state: what is searched. A small value with a hash and equality.

#include <cstdint>
#include <vector>

#include "base/index.h"
#include "base/ticks.h"
#include "motion/library.h"

namespace ringcraft {

// An action in flight. Its clip is shown at `placement_at`; a planner knows no more of motion.
struct Launch {
  ActionId action;
  Tick start = 0;       // tick of the clip's first frame
  Tick end = 0;         // tick at which the fighter acts again; earlier than the clip's end when cut
  Placement placement;  // of action space, world
  float aim = 0;        // rad: turn toward the opponent, eased in over the first half of the startup
  bool forced = false;  // a response or a get-up: not chosen
  std::uint8_t spent = 0;  // bit i: strike i has hit, was blocked or was evaded

  bool operator==(const Launch&) const = default;
};

struct FighterState {
  Launch launch;
  std::int32_t health = 100'000;  // thousandths of a point
  std::int32_t balance = 0;       // 0 steady, 1 staggering (recovery steps), 2 down
  FighterId opponent;             // the chief one
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

// Where action space lies in the world at `tick`: the launch's placement turned by the share of the aim
// that has been eased in.
Placement placement_at(const MotionLibrary& library, const Launch& launch, Tick tick);

// The fighter's root placement in the world at `tick` (ground position and facing). `scale`: the body's
// height over kCanonicalHeight.
Placement root_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale);

// The clip's frame in the world at `tick`, for a body of that scale.
Pose pose_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale);

// The launch of `next` at the end of `last`, by the state machine's edge, aimed at `target`: the aim is
// the bearing of the target, clamped to `most_aim`. The edge must exist.
Launch following(const MotionLibrary& library, const Launch& last, ActionId next, Tick start, Vec3 target,
                 float scale, float most_aim);

// The launch of a response at tick `start`, from where the cut action stands.
Launch forced_response(const MotionLibrary& library, const Launch& cut, ActionId response, Tick start,
                       float scale);

// Who acts next: the fighter whose action ends first; at equal ends the one that was expanded second at
// the last tie, then the lower index.
FighterId next_to_act(const FightState& state);

// Marks who went first at a tie, so that the other goes first at the next one.
void note_expanded(FightState& state, FighterId expanded);

}  // namespace ringcraft
