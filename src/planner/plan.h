#pragma once
// Planning: temporal expansion (Shum & Komura 2006) searched by alpha-beta.

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "fight/timeline.h"
#include "physics/body.h"
#include "planner/condition.h"
#include "planner/style.h"

namespace ringcraft {

class MotionTables;  // per library and body: capsules, roots and strike sweeps by action and tick
struct MotionInFlight;
struct DecisionTree;  // planner/tree.h
class ImpactMemo;     // quantised impulse steps, shared by a fight; a memo never changes a result
struct ImpactStore;   // impulse steps that are known already, shared by planners
struct SearchCost;    // planner/search_cost.h
struct SearchTrial;   // planner/tally.h
struct SearchTally;
struct TreeShape;

// One fighter as the planner sees it.
struct Contender {
  BodyModel body;
  Style style;
  int team = -1;  // fighters of one team do not strike each other; below 0: of none
};

inline bool of_one_team(int team, int other) {
  return team >= 0 && team == other;
}

struct PruneSettings {
  bool unanswered_hit = true;
  bool back_turned = true;
  bool out_of_reach = true;  // attacks from where they end 1.5 m or more short of the opponent
  bool penetration = true;
  double penetration_m = 0.03;  // deeper prunes the branch
  Tick penetration_every = 4;   // ticks between checks
};

struct PlanSettings {
  PruneSettings prune;
  std::uint64_t node_limit = 25'000;  // for each horizon of a decision; 0 is none
  int threads = 1;                    // never changes the result
  double ring_half_m = 3.0;           // half the side of the square ring; 0 is no ring
  bool hits_on_downed = false;
  bool replies = true;     // one of the others may reply to the planner inside the tree
  bool alpha_beta = true;  // false: plain minimax, for tests
};

// For live use. A plan that a limit has cut short depends on the clock: it is marked.
struct PlanLimits {
  double seconds = 0;                       // of the wall clock; 0 is none
  const std::atomic<bool>* stop = nullptr;  // ends the search as soon as it is true
  bool any() const { return seconds > 0 || stop != nullptr; }
};

struct Plan {
  Launch launch;                // of the chosen action
  std::vector<ActionId> then;   // the rest of a path; may be launched in turn, or the fighter
                                // decides anew, as fights do. ringcraft tree names lines by it
  DecisionRecord record;        // lines, nodes, what was pruned
  std::vector<Event> foreseen;  // hits with their responses along the principal variation
  bool reproducible = true;  // false under PlanLimits: another run may look less or farther ahead
};

// What a fight's decisions share: tables of the library, and what it is told and learns from plan
// to plan (use, habits, conditions, what is shown, impulse steps, searches). One plan at a time.
// `library` is kept by reference and must outlive the planner.
class Planner {
 public:
  // `store`, where there is one, is looked into before an impulse step is made, and added to; it
  // never changes a result.
  Planner(const MotionLibrary& library, std::vector<Contender> contenders, PlanSettings settings,
          std::uint64_t seed, std::shared_ptr<ImpactStore> store = nullptr);
  ~Planner();

  // The decision of `fighter`, who acts now, against its opponent; the others are obstacles, and
  // one of those that fight it may reply (PlanSettings::replies). An opponent's feint that cannot
  // be told from its attack yet is taken for the attack. Boredom counts from each fighter's own
  // last contact. Where nobody is to be fought, the launch is of the first action that may follow,
  // or the last one held for 0.5 s more where none may, and the record is empty.
  Plan plan(const FightState& state, FighterId fighter);

  // The same in a game's loop: looks ahead as far as the limits allow, in steps, and keeps the last
  // horizon that was finished; where not even the shortest was, one step of every move is weighed.
  Plan plan(const FightState& state, FighterId fighter, const PlanLimits& limits);

  // What the strikes of `fighter` in flight will do to its opponent, as the tree tells it: until
  // the first action of the two ends or is cut.
  std::vector<Event> foresee(const FightState& state, FighterId fighter) const;

  // The tree of the same decision, written out to `horizon` ticks from now (as
  // Plan::record.horizon says) and to at most `most_nodes` nodes. Empty where nobody is to be
  // fought.
  DecisionTree tree(const FightState& state, FighterId fighter, Tick horizon,
                    std::size_t most_nodes) const;

  // One search of the same decision to `horizon` ticks from now, without a limit and on one thread;
  // and what the tree that it searches looks like, by `dives` random ways down. For studies.
  SearchTally tally(const FightState& state, FighterId fighter, Tick horizon,
                    const SearchTrial& trial) const;
  TreeShape shape(const FightState& state, FighterId fighter, Tick horizon, int dives) const;

  // From now on plans add the time of their parts to `cost` (null: no longer). For one thread.
  void measure(SearchCost* cost);

  // Rarity: tells the planner what was committed.
  void note_launch(FighterId fighter, ActionId action);

  // Learning: the same launch with the situation in which it is made, while the fighter's last
  // action is still in the state.
  void note_habit(const FightState& state, FighterId fighter, ActionId action);

  // What the fighter's launch looks like from now on: blends, pace, a simulated response. A planner
  // that is not told plays what is in flight as its clip is.
  void show(FighterId fighter, const MotionInFlight& motion);

  // Fatigue and injuries as they are from now on. A search tells fatigue in fifths; the first time
  // a body comes to one, its tables at that pace are made (some 20 ms).
  void set_condition(FighterId fighter, const Condition& condition);
  // Kinetic work of an action of that fighter's body, J; 0 where its style never tires.
  double work_of(FighterId fighter, ActionId action) const;

  struct MemoCounts {
    std::uint64_t hits = 0, misses = 0;
  };
  MemoCounts memo_counts() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace ringcraft
