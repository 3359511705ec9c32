#include "scene/moments.h"

#include "scene/bout.h"

namespace ringcraft {

std::vector<Moment> moments_of(const MotionLibrary& library, const SceneFile& scene,
                               const FightOptions& options) {
  std::vector<Moment> all;
  Bout bout(library, scene, options);
  while (const auto fighter = run_to_decision(bout)) {
    Moment moment{bout.state(), *fighter, {}, 0};
    const Plan plan = bout.decide(*fighter);
    moment.state = bout.state();  // deciding names the opponent
    moment.launched = plan.launch.action;
    moment.horizon = plan.record.horizon;
    all.push_back(std::move(moment));
    bout.commit(*fighter, plan);
  }
  return all;
}

}  // namespace ringcraft
