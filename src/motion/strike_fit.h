#pragma once
// Strikes moved to where they meet: a body of another height, or one nearer or farther away.
//
// A clip's blows meet a body of the own height at one distance. Here the striking limb is led
// elsewhere, more and more along its own path until it meets and back again after it, so that the
// profile of its speed stays; the pelvis sinks and the trunk leans with it, feet stay where they
// stand. Root track, first and last frame are the clip's: what leads to it and from it stays too.

#include <vector>

#include "motion/library.h"

namespace ringcraft {

// What one strike of an action meets and when.
struct Meeting {
  Tick tick = 0;  // of the action
  Vec3 at{};      // of the striking point, m in action space
};

// The tick at which each strike passes nearest to its aim, of a body in `guard` in the middle of
// its reach; without an aim, at which it reaches farthest while it can hit.
std::vector<Meeting> meetings(const Skeleton& skeleton, const Action& action, const Pose& guard);

// The action against somebody `ratio` times as tall: strikes with an aim meet it on that body,
// others land as much higher as it is taller. Their reach is what is left of it, of m, within
// which they pass the aim by less than 3 cm; 0 to 0 where the limbs are too short for the aim.
Action fitted(const Skeleton& skeleton, const Action& action, const Pose& guard, float ratio);

// The action with its strikes `by` m farther (nearer where negative), against somebody as tall.
Action moved_reach(const Skeleton& skeleton, const Action& action, const Pose& guard, float by);

// The action with every strike that names an aim, and no reach yet, led up, down and sideways until
// it meets it on a body as tall; the reach is where it does. A strike that does not keeps no aim.
Action aimed(const Skeleton& skeleton, const Action& action, const Pose& guard);

// The library against somebody `ratio` times as tall: the same actions in the same order, with the
// same edges and paths. There is no motion graph.
MotionLibrary fitted(const MotionLibrary& library, float ratio);

// Sets the reaches of an attack's strikes to where they pass their aims on somebody `ratio` times
// as tall, looked for near the old ones.
void find_reaches(const Skeleton& skeleton, const Pose& guard, float ratio, Action& action);

// Whether somebody `ratio` times as tall needs no clips of his own: up to 1 % taller or shorter.
bool as_tall(float ratio);

// The pose in which a library's fighters stand before one who strikes: the first frame of its first
// authored idle, or of any. Null where there is none.
const Pose* standing_guard(const std::vector<Action>& actions, Stance stance = Stance::orthodox);
const Pose* standing_guard(const MotionLibrary& library, Stance stance = Stance::orthodox);

}  // namespace ringcraft
