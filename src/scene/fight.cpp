#include "scene/fight.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "motion/both_stances.h"
#include "motion/feints.h"
#include "motion/strike_fit.h"
#include "scene/bout.h"
#include "scene/fitted_library.h"

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
    } else if (bout.has_won(fighter)) {
      bout.commit_idle(fighter);
    } else {
      return fighter;
    }
  }
  return std::nullopt;
}

namespace {

// How tall the opponents of a fighter are, as a share of the own height; the mean of several.
float opponents_height(const SceneFile& scene, const SceneFighter& fighter) {
  float sum = 0;
  int count = 0;
  for (const SceneFighter& other : scene.fighters) {
    if (other.team == fighter.team) continue;
    sum += other.body.height;
    ++count;
  }
  return count == 0 ? 1 : sum / static_cast<float>(count) / fighter.body.height;
}

}  // namespace

MotionLibrary library_for(const SceneFile& scene, MotionLibrary library) {
  const bool both = scene.needs_both_stances();
  library = with_feints(std::move(library), scene.feints);
  const auto in_stances = [&](const MotionLibrary& one) {
    return both ? both_stances(one, scene.stance_switches) : one;
  };
  std::map<float, std::shared_ptr<const MotionLibrary>> fits;  // by ratio of heights
  std::vector<std::shared_ptr<const MotionLibrary>> of_fighter;
  for (const SceneFighter& fighter : scene.fighters) {
    const float ratio = opponents_height(scene, fighter);
    auto& fit = fits[ratio];
    if (fit == nullptr && !as_tall(ratio)) {
      fit = std::make_shared<const MotionLibrary>(in_stances(fitted_library(library, ratio)));
    }
    of_fighter.push_back(fit);
  }
  MotionLibrary base = both ? in_stances(library) : std::move(library);
  if (std::none_of(of_fighter.begin(), of_fighter.end(), [](const auto& fit) { return fit; })) {
    return base;
  }
  return base.with_fits(std::move(of_fighter));
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
