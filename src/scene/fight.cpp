#include "scene/fight.h"

#include "motion/both_stances.h"
#include "scene/bout.h"

namespace ringcraft {

// Between decisions the shown bodies move, and a contact may cut an action short: then the response
// that physics chose is the fighter's next action.
std::optional<FighterId> run_to_decision(Bout& bout) {
  while (!bout.over()) {
    const FighterId fighter = next_to_act(bout.state());
    const Tick decision_tick = bout.state().fighters[fighter.at()].launch.end;
    if (bout.state().now < decision_tick) {
      bout.advance_one_tick();  // shows the bodies, tests contacts, commits hits and their
                                // responses
    } else if (bout.must_get_up(fighter)) {
      bout.commit_get_up(fighter);
    } else if (bout.is_out(fighter)) {
      bout.commit_rest(fighter);
    } else if (bout.has_won(fighter)) {
      bout.commit_idle(fighter);
    } else {
      return fighter;
    }
  }
  return std::nullopt;
}

MotionLibrary library_for(const SceneFile& scene, MotionLibrary library) {
  if (!scene.needs_both_stances()) return library;
  return both_stances(library, scene.stance_switches);
}

// The main path. Decisions fall when an action ends.
FightRecord simulate_fight(const MotionLibrary& library, const SceneFile& scene,
                           const FightOptions& options) {
  Bout bout(library, scene, options);
  while (const auto fighter = run_to_decision(bout)) {
    bout.commit(*fighter, bout.decide(*fighter));  // temporal expansion and search
  }
  return bout.record();
}

}  // namespace ringcraft
