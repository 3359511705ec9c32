// The planner's signature: nodes and timeline hash of a fixed small fight. The same on every build
// of one version, optimised or not, and for any number of threads.
//
//   ringcraft_signature [threads]
#include <fmt/format.h>

#include <cstdlib>

#include "../tests/fight/synthetic_library.h"
#include "base/hash.h"
#include "scene/fight.h"

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
  std::uint64_t nodes = 0, leaves = 0;
  for (const Event& event : record.timeline.events) {
    nodes += event.decision.nodes;
    leaves += event.decision.leaves;
  }
  fmt::print("signature nodes {} leaves {} impacts {} memo {} timeline {}\n", nodes, leaves,
             record.counts.impacts, record.counts.memo_misses, hash_name(record.timeline.hash()));
  return nodes > 0 ? 0 : 4;
}
