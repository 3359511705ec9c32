#include <fmt/format.h>

#include "cli/scene_inputs.h"
#include "cli/study_command.h"
#include "scene/study_hits.h"

namespace ringcraft {

int run_hits_study(const StudyOptions& study, const CommonOptions& options) {
  const auto library = library_for_blows(study.library.value_or(kUsualLibrary));
  if (!library) return fail(library.error());
  HitsSettings settings;
  if (study.count) settings.count = *study.count;
  if (options.seed) settings.seed = *options.seed;
  settings.only = study.only;
  StudyRun run;
  run.threads = options.threads;
  run.interrupted = &interrupted;
  if (!options.quiet) run.said = [](const std::string& line) { tell("{}\n", line); };
  const HitsStudy found = hits_study(*library, settings, run);
  if (!options.json) {
    for (const auto& row : found.study.timing.rows) {
      tell("{}\n", study_text({found.study.timing.columns, {row}}));
    }
  }
  return finish_study(found.study, found.missed > 0 ? 1 : 0, options);
}

}  // namespace ringcraft
