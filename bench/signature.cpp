// The planner's signature: nodes and timeline hash of a fixed small fight. The same on every build
// of one version, optimised or not, and for any number of threads.
//
//   ringcraft_signature [threads]
#include <fmt/format.h>

#include <cstdlib>

#include "../tests/fight/synthetic_library.h"
#include "scene/bench.h"

using namespace ringcraft;

int main(int count, char** arguments) {
  const MotionLibrary library = synthetic::library();
  SceneFile scene;
  scene.name = "signature";
  scene.duration = ticks(4);
  for (int i = 0; i < 2; ++i) {
    SceneFighter fighter;
    fighter.team = i;
    fighter.style.horizon_s = 1.0;
    fighter.placement = {0, i == 0 ? -0.6f : 0.6f, i == 0 ? 0 : kPi};
    scene.fighters.push_back(fighter);
  }
  FightOptions options;
  options.threads = count > 1 ? std::max(1, std::atoi(arguments[1])) : 1;
  const FightRecord record = simulate_fight(library, scene, options);
  const FightSignature signature = signature_of(record);
  fmt::print("{}\n", signature_text(signature));
  return signature.nodes > 0 ? 0 : 4;
}
