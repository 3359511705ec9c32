#pragma once
// The evaluation: S = w_l F_loc + w_f F_fight + w_c F_control (the paper's objective function), in
// points, summed along a route in integer thousandths. docs/planning.md sets code beside equation.

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/action.h"
#include "physics/body.h"
#include "planner/style.h"

namespace ringcraft {

inline constexpr std::size_t kStrikeKinds = static_cast<std::size_t>(StrikeKind::knee) + 1;

// Thousandths of a point, rounded to nearest.
inline std::int32_t thousandths(double points) {
  const double scaled = std::clamp(points, -1e5, 1e5) * 1000;
  return static_cast<std::int32_t>(scaled + std::copysign(0.5, scaled));
}

// A style at one moment of the fight: boredom has been worked in. Constant inside a search.
struct Weights {
  double location = 1, sigma = 0.5, distance = 0.95;  // w_l points/s, sigma m, d* m
  double least = -3;                                  // g(d) never falls below
  double facing = 1, ropes = 1;                       // points/s
  double fight = 1, defense = 0.3, knockdown = 6;     // w_f, w_d, points
  double caution = 1.5;                               // kappa_f
  double control = 1, rarity = 4, duration = 0.5, attack_bonus = 0;
  LeafValue leaf = LeafValue::weighted;
  std::array<double, kStrikeKinds> strikes{1, 1, 1, 1, 1, 1, 1, 1, 1};  // on hits, by kind
};

// `quiet`: seconds since the last contact. Beyond boredom_after_s a fighter comes closer, dares
// more and likes attacks better. `apart`: from root to root, m. However far that is, every step
// nearer counts, also where the opponent steps back. `scale`: of the fighter's body; a style's
// distances are those of the canonical one.
Weights weights_at(const Style& style, double quiet, double apart = 0, double scale = 1);

inline constexpr double kOverlapDistance = 0.5;  // m: roots nearer than this overlap
inline constexpr double kOverlapCost = 10.0;     // points/s per metre
inline constexpr double kFallenCost = 40.0;      // the same in who lies, beside the opponent
inline constexpr double kRopesNear = 0.8;        // m
inline constexpr double kLyingReach = 1.0;       // m: from the root of who lies to its head or feet
inline constexpr float kInsideRopes = 0.2f;      // m: from the ropes to a root, which they hold

// F_loc as a rate, points/s: `distance` of the roots (m), `cosine` of the opponent's bearing off
// the own facing, `to_ropes` from the own root to the nearest ropes (m), `down` where the opponent
// has fallen, may not be struck and needs room to rise in; `in_fallen` of kOverlapDistance, how
// much the own root lacks of it to others who lie, m.
inline double location_rate(const Weights& weights, double distance, double cosine, double to_ropes,
                            bool down = false, double in_fallen = 0) {
  const double wanted = weights.distance + (down ? kLyingReach : 0.0);
  double in_reach = std::max(weights.least, -std::abs(distance - wanted) / weights.sigma);
  in_reach -= kOverlapCost * std::max(0.0, kOverlapDistance - distance) + kFallenCost * in_fallen;
  const double at_ropes = std::clamp(1 - to_ropes / kRopesNear, 0.0, 1.0);
  return weights.location * in_reach - weights.facing * (1 - cosine) - weights.ropes * at_ropes;
}

// The least that it can be where so many others lie; it is never above 0.
double least_location_rate(const Weights& weights, std::size_t fallen = 0);

// F_control of a launch, points (mostly a cost): `use` is phi, the action's share of recent
// launches. Without reach_bonus.
double launch_points(const Weights& weights, const Style& style, const Action& action, double use);

// w_i where it is a bonus: earned by an attack that reaches the opponent where it goes by itself,
// so that who likes to attack comes near and does not fight the air. Where it is a price, every
// attack pays it.
inline double reach_bonus(const Weights& weights) {
  return std::max(0.0, weights.attack_bonus);
}

// F_fight of a landed blow, points; `damage` in thousandths.
double hit_points(const Weights& weights, StrikeKind kind, std::int32_t damage, bool knockdown);

// F_fight of a strike that was evaded or blocked: by the damage that was prevented, thousandths.
double defense_points(const Weights& weights, std::int32_t prevented);

// What a point of each side is worth to the planner: f = S_p - kappa_f (Hit_q + Def_q), or the
// paper's S_A - S_B. Index 0 is the planner's side.
struct LeafFactors {
  double events[2] = {1, -1};  // hits and defenses
  double rest[2] = {1, -1};    // location and control
};
LeafFactors leaf_factors(const Weights& planner);

}  // namespace ringcraft
