#pragma once
// Where every candidate of a node starts, aims and leads: a few candidates side by side, so that
// they take as long as one (SIMD). What is done with one is what Frame and aim_at do.

#include <array>
#include <span>
#include <vector>

#include "planner/motion_tables.h"

namespace ringcraft {

using Lanes = NextLanes::Lanes;

// Of kLanes candidates; lanes beyond the last candidate hold nothing of use.
struct BearingLanes {
  Lanes start_x, start_z, start_sine, start_cosine;  // action space before the aim, world
  Lanes aim_sine, aim_cosine;
  Lanes target;  // m: how far what is aimed at is from what is turned
  Lanes x, z;    // of the root at the end, world
  Lanes apart;   // m: of the roots then
  Lanes facing;  // cosine of the opponent's bearing off the facing then
};

struct AimLimit {  // of a turn
  float sine = 0, cosine = 1;
};

// `root`: of the fighter where the node is; `opponent`: of the other there, world; `then_x`,
// `then_z`: the same where each candidate is over.
void find_bearings(std::span<const NextLanes> next, const Frame& root, Vec3 opponent,
                   AimLimit attack, AimLimit other, std::span<const Lanes> then_x,
                   std::span<const Lanes> then_z, std::vector<BearingLanes>& out);

}  // namespace ringcraft
