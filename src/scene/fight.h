#pragma once
// The fight loop: library and scene in, timeline out. Start reading here.

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "fight/timeline.h"
#include "motion/library.h"
#include "scene/scene_file.h"

namespace ringcraft {

struct FightOptions {
  int threads = 1;                                 // never changes the result
  std::function<void(Tick, Tick)> progress;        // now, end
  const std::atomic<bool>* interrupted = nullptr;  // what is finished is kept
  std::shared_ptr<ImpactStore> impacts = nullptr;  // shared by bouts; never changes the result
};

// How often the committed fight went through Bullet, and how well the tree had foreseen it.
struct FightCounts {
  std::uint64_t impacts = 0;           // committed contacts that went through the impulse step
  std::uint64_t impulse_steps = 0;     // impulse steps in all: committed and first-time in the tree
  std::uint64_t foreseen = 0;          // contacts that the tree had told of the strikes in flight
  std::uint64_t agreed_at_launch = 0;  // of them, as it told when somebody last began something
  std::uint64_t memo_hits = 0, memo_misses = 0;
};

struct FightRecord {
  Timeline timeline;
  std::vector<BodyModel> bodies;
  FightCounts counts;
  std::vector<Condition> condition;                  // of every fighter at the end
  std::vector<double> decision_ms, impulse_step_us;  // what the clock said
  bool interrupted = false;
};

// The library as the scene's fighters need it: with the feints that the scene names; with both
// stances where one of them is a southpaw or may switch; with clips of their own for those whose
// opponents are taller or shorter; else as it is. What a bout, its timeline and its files are
// given.
MotionLibrary library_for(const SceneFile& scene, MotionLibrary library);

// `library` is what library_for() made of the scene's: without it feints and fitted clips are
// missing, and a southpaw fails an assertion. The same inputs give the same record.
FightRecord simulate_fight(const MotionLibrary& library, const SceneFile& scene,
                           const FightOptions& options = {});

}  // namespace ringcraft
