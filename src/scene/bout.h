#pragma once
// A bout under way: the fight state, the shown bodies and the record, and what the fight loop does
// to them.

#include <memory>
#include <optional>

#include "physics/impact.h"
#include "planner/plan.h"
#include "scene/fight.h"
#include "scene/stage.h"

namespace ringcraft {

class Bout {
 public:
  Bout(const MotionLibrary& library, const SceneFile& scene, const FightOptions& options);
  ~Bout();

  const FightState& state() const { return state_; }
  bool over() const;
  bool must_get_up(FighterId fighter) const;  // fell, and its time on the ground is over
  bool is_out(FighterId fighter) const;       // knocked out: lies until the end
  bool has_won(FighterId fighter) const;      // nobody is left to fight

  Plan decide(FighterId fighter);
  // The tree of the decision that `plan` is the outcome of.
  DecisionTree tree(FighterId fighter, const Plan& plan, std::size_t most_nodes) const;
  void commit(FighterId fighter, const Plan& plan);
  void commit_get_up(FighterId fighter);
  void commit_idle(FighterId fighter);  // of who has won
  void advance_one_tick();
  FightRecord record();

 private:
  struct Touch {  // a strike of one fighter meets another
    FighterId attacker, target;
    ActionId action;  // of the attacker, who may be struck and answer in the same tick
    std::size_t strike = 0;
    Contact contact;
  };
  struct Standing {                         // what the bout knows of a fighter beyond the state
    std::vector<Event> foreseen;            // what its strikes in flight will do, by the tree
    std::vector<Event> foreseen_at_launch;  // the same as of when somebody last began something
    bool out = false;
    std::uint32_t fell_upon = 0;  // bit i: this fall has hit fighter i
    Condition condition;          // fatigue and injuries
    Vec3 aside{};                 // m: how far its body is still to follow feet that stood aside
  };

  FighterState& fighter(FighterId id) { return state_.fighters[id.at()]; }
  const Action& action_of(FighterId id) const;
  Vec3 ground_position(FighterId id) const;
  bool enemies(FighterId a, FighterId b) const;
  FighterId nearest_opponent(FighterId id) const;
  void begin(FighterId id, const Launch& launch, std::vector<Pose> simulated = {},
             const Sway& sway = {});
  Launch executed(FighterId id, Launch launch) const;
  void show_planner(FighterId id);
  void rest(FighterId id);
  void note_strikes(FighterId id);
  void note_open_strikes(FighterId id);
  void note_strike(EventType type, FighterId id, const Action& action, const Strike& strike);
  bool may_strike(FighterId attacker, FighterId target) const;
  std::vector<Touch> touches() const;
  std::optional<Touch> touch_of(FighterId attacker, std::size_t strike) const;
  void commit_touch(const Touch& touch);
  void commit_falls();
  void deliver(FighterId attacker, FighterId target, const Blow& blow, Event event);
  void put_out(FighterId id);
  void respond(FighterId id, const ImpactInput& input, ImpactOutcome outcome, Event& event);
  void let_off(FighterId fallen);
  void push_apart();
  void hold_in_ring(FighterId id);
  void follow_feet(FighterId id);
  bool gives_way(FighterId id) const;
  void shift(FighterId id, Vec3 offset);
  bool strikes_now() const;
  void foresee();
  void note_foreseen(Event& event);

  const MotionLibrary& library_;
  const SceneFile& scene_;
  FightOptions options_;
  FightState state_;
  std::vector<Standing> standing_;
  std::unique_ptr<Planner> planner_;
  Stage stage_;
  FightRecord record_;
  bool launched_ = true;  // since the tree was asked what will happen
  Tick end_;
};

// Goes on until a fighter must choose: who. Nothing when the bout is over.
std::optional<FighterId> run_to_decision(Bout& bout);

}  // namespace ringcraft
