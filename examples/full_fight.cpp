// A fight from a scene to its record, without writing files: who did what, hit by hit.
#include <fmt/format.h>

#include "capture/library_file.h"
#include "scene/fight.h"

using namespace ringcraft;

int main(int argc, char** argv) {
  const auto scene = read_scene(argc > 1 ? argv[1] : "duel", {"duration_s=8"});
  if (!scene) {
    fmt::print(stderr, "{}\n", to_string(scene.error()));
    return static_cast<int>(scene.error().kind);
  }
  auto loaded = load_library(scene->library);
  if (!loaded) {
    fmt::print(stderr, "{}\n", to_string(loaded.error()));
    return static_cast<int>(loaded.error().kind);
  }
  const MotionLibrary library = library_for(*scene, std::move(*loaded));
  const FightRecord record = simulate_fight(library, *scene);

  const auto name = [&](FighterId id) { return scene->fighters[id.at()].name; };
  for (const Event& event : record.timeline.events) {
    if (event.type == EventType::hit || event.type == EventType::block) {
      fmt::print("{:6.2f} s  {} {} {}: {} on the {}, {:.0f} N s at {:.1f} m/s\n",
                 seconds(event.tick), name(event.who),
                 event.type == EventType::hit ? "hits" : "is blocked by", name(event.whom),
                 event.action, event.part, glm::length(event.impulse), event.speed);
    } else if (event.type == EventType::response || event.type == EventType::knockdown) {
      fmt::print("{:6.2f} s  {} answers: {} ({})\n", seconds(event.tick), name(event.who),
                 event.action, name_of(event.response));
    }
  }
  fmt::print("{} decisions, {} impacts, timeline {:016x}\n", record.decision_ms.size(),
             record.counts.impacts, record.timeline.hash());
  return record.decision_ms.empty() ? 1 : 0;
}
