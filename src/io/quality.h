#pragma once
// What people see and dislike in a fight, measured on the committed frames.

#include <cstdint>
#include <vector>

#include "fight/timeline.h"
#include "physics/body.h"

namespace ringcraft {

struct FightQuality {
  double penetration_p99_m =
      0;  // 99th percentile over ticks of the deepest penetration of any pair
  double penetration_max_m = 0;
  double penetration_max_at_s = 0;           // when; 0 where there is none
  double penetration_longest_s = 0;          // longest time without a break deeper than kDeep
  double foot_skate_ratio = 0;               // motion/quality.h, mean over fighters
  std::uint64_t joint_limit_violations = 0;  // joints times ticks beyond their range
  // m/s: 99th percentile over all wrists and ticks of chosen actions (neither answers to hits nor
  // get-ups) of the speed in the world, over 33 ms. Captured boxers: 4.2-6.8.
  double wrist_speed_p99_mps = 0;
};

inline constexpr float kJointTolerance =
    3.0f * kPi / 180.0f;               // rad: beyond a range by less is none
inline constexpr float kDeep = 0.03f;  // m: bodies that overlap by more are seen to
inline constexpr Tick kIntendedContact =
    12;  // ticks after a strike's active time that its limb may touch

FightQuality quality_of(const Timeline& timeline, const std::vector<BodyModel>& bodies,
                        const MotionLibrary& library);

// Deepest penetration between any two fighters at each tick, m. While a strike is active and 0.1 s
// after, the striking hand and forearm, or foot and shin, may touch.
std::vector<float> penetration_by_tick(const Timeline& timeline,
                                       const std::vector<BodyModel>& bodies,
                                       const MotionLibrary& library);

}  // namespace ringcraft
