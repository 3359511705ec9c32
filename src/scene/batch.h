#pragma once
// Many bouts of one scene, each with a seed of its own, and what they say together. What one
// machine has run joins what another has: the bouts stand in a file, a report a line.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "scene/fight.h"
#include "scene/study.h"
#include "scene/study_run.h"

namespace ringcraft {

// bouts.jsonl: a header line, then the report (io/report.h) of each bout, in order of seeds.
struct Batch {
  std::string scene;
  std::string setup;  // hash of program, scene and library: only equal ones are put together
  std::map<std::uint64_t, std::string> bouts = {};  // seed -> report, one line of JSON
};

// A batch of `scene` on `library` without bouts yet.
Batch batch_of(const SceneFile& scene, const MotionLibrary& library);

// Runs the bouts of seeds scene.seed .. scene.seed + count - 1 that `batch` lacks, as many at once
// as there are threads. `kept` is called after each; where it fails no further bout begins, and
// where the run is interrupted the bout on its way is dropped.
Result<void> run_batch(Batch& batch, const MotionLibrary& library, const SceneFile& scene,
                       int count, const StudyRun& run,
                       const std::function<Result<void>(const Batch&)>& kept);

std::string bouts_jsonl(const Batch& batch);

// Reads a bouts.jsonl; `file` is only for messages.
Result<Batch> read_bouts(const std::string& file, std::string_view text);

// Adds the bouts of `more`, which came from `file`: of the same setup, and where both have a seed,
// with the same fight.
Result<void> add_bouts(Batch& batch, const Batch& more, const std::string& file);

// Means over the bouts with 95 % intervals, least and most: of every number
// that a report has for each fighter, of the fight's quality and of its physics.
Study summary_of(const Batch& batch);

}  // namespace ringcraft
