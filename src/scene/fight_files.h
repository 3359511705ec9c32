#pragma once
// The files of a fight: fight.glb, events.jsonl, report.json, timing.json, fight.html.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motion/character.h"
#include "motion/foreign_skeleton.h"
#include "scene/fight.h"

namespace ringcraft {

// What is written only on request.
struct FightExtras {
  std::optional<ForeignSkeleton> bvh;  // fighter0.bvh ...: one a fighter, for that skeleton
  bool vrma = false;                   // fighter0.vrma ...: VRM animations, one a fighter
  bool root_motion = false;            // fight.glb moves each fighter's own node over the ground
  // Of each fighter, in place of the mannequin; shorter than the fighters or null where it has
  // none.
  std::vector<std::shared_ptr<const Character>> characters = {};
};

struct FightSummary {
  std::string report;  // report.json's text
  std::string text;    // one line: what to open
};

// report.json's object on one line.
std::string fight_report(const SceneFile& scene, const MotionLibrary& library,
                         const FightRecord& record);

// Their names, in the order in which they are written.
std::vector<std::string> fight_file_names(std::size_t fighters, const FightExtras& extras);

// Writes all files into `folder`; each appears whole or not at all.
Result<FightSummary> write_fight(const std::filesystem::path& folder, const SceneFile& scene,
                                 const MotionLibrary& library, const FightRecord& record,
                                 double wall_seconds, int threads, const FightExtras& extras = {});

// Removes from `folder` what an earlier fight exported there (fighterN.bvh, fighterN.vrma) and this
// one does not write; one of the `inputs` stays.
void remove_old_exports(const std::filesystem::path& folder, std::size_t fighters,
                        const FightExtras& extras,
                        const std::vector<std::filesystem::path>& inputs);

}  // namespace ringcraft
