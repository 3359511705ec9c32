#pragma once
// A fighting style: the weights of the evaluation and the search's limits. Read from assets/styles.

#include <map>
#include <string>
#include <vector>

#include "base/document.h"
#include "base/ticks.h"

namespace ringcraft {

enum class LeafValue : std::uint8_t { paper, weighted };

// Points: 1 point = one unit of damage, a clean jab is about 3. See docs/planning.md.
struct Style {
  std::string name = "balanced";
  double horizon_s = 2.0;        // t_f
  double location_weight = 1.0;  // w_l, points/s at one sigma
  double fight_weight = 1.0;     // w_f
  double control_weight = 1.0;   // w_c
  double distance_m = 0.95;      // d*: preferred distance of the roots
  double distance_sigma_m = 0.5;
  double facing_weight = 1.0;    // points/s
  double ropes_weight = 1.0;     // points/s
  double defense_share = 0.3;    // w_d: points per point of damage prevented
  double caution = 1.5;          // k_f: weight of what the opponent wins
  double attack_bonus = 0.0;     // w_i, points per attack (reach_bonus)
  double knockdown_bonus = 6.0;  // points
  double rarity_weight = 4.0;    // points per share of recent use
  double duration_weight = 0.5;  // points per second of action
  double temperature = 0.3;      // points: soft choice at the root; 0 takes the best
  double boredom_rate = 0.1;     // per second without contact beyond boredom_after_s
  double boredom_after_s = 4.0;
  double late_sight_s = 0.25;  // how young an attack cannot yet be answered
  double learning = 0;         // 0..1: how far the opponent is taken to do what it was seen to do
  double fatigue = 0;          // factor on what work and blows cost the fighter's reserve; 0: never
  double injury = 0;           // factor on what blows on arms and legs cost them; 0: never
  double aim_error_deg = 0;    // standard deviation of an attack's aim in execution
  double speed_error = 0;      // standard deviation of an action's speed in execution, share
  LeafValue leaf = LeafValue::weighted;
  int candidates = 6;  // k, the same at every depth
  std::map<std::string, double>
      strikes;  // strike kind -> factor on what its hits are worth; else 1
  std::map<std::string, double>
      liked;  // action name -> bonus in points per launch (may be negative)

  bool operator==(const Style&) const = default;
};

// A TOML file held to the schema `style`: an unknown key or a value out of range is an error that
// names its line. What the file leaves out has the values above.
Result<Style> read_style(const std::filesystem::path& path);

}  // namespace ringcraft
