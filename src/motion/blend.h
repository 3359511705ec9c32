#pragma once
// One action from several registered repetitions of it, weighed.
//
// The pace is the weighed mean of the paces (Kovar and Gleicher 2004); rotations are averaged
// against the root, the root's way in the action space that all share. Balls of feet and the feet's
// rotations are averaged in that space too, where a planted foot stands still in every repetition
// and so in the mean; the legs follow by inverse kinematics. Where the repetitions do not agree
// that a foot is planted, it is if those that say so weigh more than half, and then moves only as
// theirs do.

#include <span>
#include <vector>

#include "motion/action.h"

namespace ringcraft {

// A repetition, and its tick for every tick of the reference (registration.h).
struct Variant {
  const Action* action = nullptr;
  std::vector<float> tick;
};

// `weights` sum to one and none is negative; all `tick`s have one length. A single weight of one
// gives that action's clip and phases as they are. Name and source are the reference's, the first
// variant's: the caller says what they are. What it was aimed at stays where all weighed
// repetitions say the same.
Action blended(const Skeleton& skeleton, std::span<const Variant> variants,
               std::span<const float> weights);

}  // namespace ringcraft
