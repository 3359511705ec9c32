#include "planner/evaluation.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {
namespace {

constexpr double kBoredDistance = 0.9;  // m: boredom brings d* down to here
constexpr double kLeastNearness = -3;   // of who are near each other

}  // namespace

Weights weights_at(const Style& style, double quiet, double apart, double scale) {
  Weights w;
  const double bored = style.boredom_rate * std::max(0.0, quiet - style.boredom_after_s);
  w.location = std::max(style.location_weight, std::min(1.0, bored));
  const double nearer = std::max(kBoredDistance, style.distance_m - bored);
  w.distance = scale * std::min(style.distance_m, nearer);
  w.sigma = scale * style.distance_sigma_m;
  w.least = kLeastNearness - 2 * std::max(0.0, (apart - w.distance) / w.sigma - 2);
  w.facing = style.facing_weight;
  w.ropes = style.ropes_weight;
  w.fight = style.fight_weight;
  w.defense = style.defense_share;
  w.knockdown = style.knockdown_bonus;
  w.caution = 1 + (style.caution - 1) * std::exp(-2 * bored);
  w.control = style.control_weight;
  w.rarity = style.rarity_weight;
  w.duration = style.duration_weight;
  w.attack_bonus = style.attack_bonus + 10 * bored;
  w.leaf = style.leaf;
  for (std::size_t i = 0; i < kStrikeKinds; ++i) {
    const auto found = style.strikes.find(std::string(name_of(static_cast<StrikeKind>(i))));
    if (found != style.strikes.end()) w.strikes[i] = found->second;
  }
  return w;
}

double least_location_rate(const Weights& weights, std::size_t fallen) {
  const double cost = kOverlapCost + kFallenCost * static_cast<double>(fallen);
  const double farthest = weights.least - cost * kOverlapDistance;
  return weights.location * farthest - weights.facing * 2 - weights.ropes;
}

double launch_points(const Weights& weights, const Style& style, const Action& action, double use) {
  const double cost = weights.rarity * use + weights.duration * seconds(action.length());
  double points = -weights.control * cost;
  if (action.attacks()) points += std::min(0.0, weights.attack_bonus);
  const auto liked = style.liked.find(action.name);
  if (liked != style.liked.end()) points += liked->second;
  return points;
}

double hit_points(const Weights& weights, StrikeKind kind, std::int32_t damage, bool knockdown) {
  const double liked = weights.strikes[static_cast<std::size_t>(kind)];
  return weights.fight * liked * damage / 1000.0 + (knockdown ? weights.knockdown : 0.0);
}

double defense_points(const Weights& weights, std::int32_t prevented) {
  return weights.defense * std::max(0, prevented) / 1000.0;
}

LeafFactors leaf_factors(const Weights& planner) {
  LeafFactors factors;
  if (planner.leaf == LeafValue::weighted) {
    factors.events[1] = -planner.caution;
    factors.rest[1] = 0;
  }
  return factors;
}

}  // namespace ringcraft
