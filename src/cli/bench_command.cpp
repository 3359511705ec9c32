// `ringcraft bench`: what a fight costs on this machine, and a signature that no machine changes.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "scene/bench.h"

namespace ringcraft {

int run_bench_command(const std::string& scene_name, const BenchOptions& asked,
                      const CommonOptions& options) {
  CommonOptions with = options;
  with.sets.insert(with.sets.begin(), fmt::format("duration_s={:g}", kBenchSeconds));
  std::vector<std::string> asked_for;
  if (asked.duration_s) {
    if (const auto one = one_source("--duration", "duration_s", options.sets); !one)
      return fail(one.error());
    asked_for.push_back(fmt::format("duration_s={}", *asked.duration_s));
  }
  const auto scene = scene_with(scene_name, with, asked_for);
  if (!scene) return fail(scene.error());
  const auto folder =
      output_folder(options, kBenchFolder, {"bench.json", "timing.json"}, files_of(*scene));
  if (!folder) return fail(folder.error());
  const auto library = library_of(*scene);
  if (!library) return fail(library.error());
  StudyRun run{options.threads, &interrupted, {}};
  if (!options.quiet) run.said = [](const std::string& line) { tell("{}\n", line); };

  const Bench bench = run_bench(*library, *scene, asked.rounds, run);
  if (bench.rounds == 0) return 130;  // interrupted before there was anything to say
  const nlohmann::json same = bench_json(bench, *scene, *library);
  const nlohmann::json clock = bench_timing_json(bench, options.threads);
  const auto written = write_files(
      *folder, {{"bench.json", same.dump(1) + "\n"}, {"timing.json", clock.dump(1) + "\n"}});
  if (!written) return fail(written.error());
  if (options.json) {
    fmt::print("{}\n", nlohmann::json{{"bench", same}, {"timing", clock}}.dump(1));
  } else {
    fmt::print("{}{}\n", bench_text(clock), signature_text(bench.signature));
  }
  if (bench.differs) {
    tell("ringcraft: rounds of one fight differ; please report this\n");
    return 1;
  }
  return bench.interrupted ? 130 : 0;
}

}  // namespace ringcraft
