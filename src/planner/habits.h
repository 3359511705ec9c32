#pragma once
// Habits: what a fighter was seen to launch in which situation, and what that says of its next
// launch (the paper: "after the enemy repeats the same attack a few times, a human will learn the
// pre-action of that attack").

#include <array>
#include <vector>

#include "base/index.h"
#include "fight/state.h"

namespace ringcraft {

// How far apart the two stand, what the fighter did last, and whether it sees an attack coming.
struct Situation {
  std::uint8_t band = 0;   // of the distance
  std::uint8_t after = 0;  // kind of the fighter's last action
  bool attacked = false;
};

// `distance` of the roots, m.
Situation situation_of(float distance, Kind last, bool attacked);

// Whether the launch, of `action`, looks at `now` like an attack whose blows are not yet over, to
// one who sees it `late_sight_s` late: an attack, or a feint that nobody can tell from one yet.
bool looks_like_attack(const Action& action, const Launch& launch, Tick now, double late_sight_s);

// A feint's launch as who is taken in sees it at `now`: the attack's own, at its usual speed.
Launch taken_for(const Launch& feint, ActionId id, const Action& attack, Tick now);

// Counts of one fighter. Constant inside a search.
class Habits {
 public:
  // Sighted launches of one situation.
  struct Seen {
    ActionId action;
    int count = 0;
  };

  void note(Situation situation, ActionId action);

  // What was launched in the situation, the most frequent first (at equal counts the lower index).
  const std::vector<Seen>& seen(Situation situation) const;
  int total(Situation situation) const;
  int count(Situation situation, ActionId action) const;
  // Of all situations, how often the most frequent launch of one was seen.
  int most() const { return most_; }

  // How much the counts of a situation are believed, 0 (never met) .. 1: n / (n + 3).
  static double belief(int total);

  // What began like `attack` was one, or was a feint of it.
  void note_begun(ActionId attack, bool feint);
  // How far a motion that begins like `attack` is taken for a feint, 0 .. 1: the share that were
  // feints, as far as it is believed.
  double feint_expected(ActionId attack) const;

 private:
  struct Begun {
    ActionId attack;
    int feints = 0, all = 0;
  };
  static constexpr std::size_t kBands = 3, kAfter = 7;
  static std::size_t index_of(Situation situation);
  std::array<std::vector<Seen>, 2 * kBands * kAfter> seen_;
  int most_ = 0;
  std::vector<Begun> begun_;
};

}  // namespace ringcraft
