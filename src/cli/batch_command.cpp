#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "cli/study_command.h"
#include "scene/batch.h"

namespace ringcraft {

namespace {

constexpr const char* kBouts = "bouts.jsonl";

Result<Batch> bouts_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kBouts;
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return read_bouts(file.string(), *text);
}

// Of an output folder: what stands there is kept.
Result<void> add_bouts_in(const std::filesystem::path& folder, Batch& batch) {
  if (!std::filesystem::exists(folder / kBouts)) return {};
  const auto before = bouts_in(folder);
  if (!before) return tl::unexpected(before.error());
  return add_bouts(batch, *before, (folder / kBouts).string());
}

}  // namespace

int run_batch_command(const std::string& scene_name, const BatchOptions& asked,
                      const CommonOptions& options) {
  const auto scene = scene_with(scene_name, options);
  if (!scene) return fail(scene.error());
  const std::uint64_t last_start = kMostSeed - (static_cast<std::uint64_t>(asked.count) - 1);
  if (scene->seed > last_start) {
    return fail({ErrorKind::usage, "--count", "",
                 fmt::format("{} bouts from seed {} on go beyond the largest seed, {}", asked.count,
                             scene->seed, kMostSeed),
                 fmt::format("begin at --seed {} or below, or run fewer", last_start)});
  }
  CommonOptions found = options;
  if (found.out.empty()) found.out = with_name(kBatchFolder, scene->name);
  const std::filesystem::path folder = found.out;
  if (const auto made = output_folder(found, {}, study_file_names(), files_of(*scene)); !made)
    return fail(made.error());
  const auto lock = lock_folder(folder);  // from reading the bouts to the last one written
  if (!lock) return fail(lock.error());
  const auto library = library_of(*scene);
  if (!library) return fail(library.error());

  Batch batch = batch_of(*scene, *library);
  if (const auto added = add_bouts_in(folder, batch); !added) return fail(added.error());
  StudyRun run{options.threads, &interrupted, {}};
  if (!options.quiet) run.said = [](const std::string& line) { tell("{}\n", line); };
  const auto kept = [&](const Batch& so_far) {
    return write_file(folder / kBouts, bouts_jsonl(so_far));
  };
  const auto ran = run_batch(batch, *library, *scene, asked.count, run, kept);
  if (!ran) return fail(ran.error());
  Study study = summary_of(batch);
  study.interrupted = interrupted;
  return finish_study(study, 0, found);
}

int run_merge(const std::vector<std::string>& folders, const CommonOptions& options) {
  CommonOptions found = options;
  if (found.out.empty()) found.out = kMergeFolder;
  std::optional<Batch> batch;
  for (const std::string& folder : folders) {
    const auto more = bouts_in(folder);
    if (!more) return fail(more.error());
    if (!batch) {
      batch = *more;
      continue;
    }
    const auto added = add_bouts(*batch, *more, (std::filesystem::path(folder) / kBouts).string());
    if (!added) return fail(added.error());
  }
  const std::filesystem::path folder = found.out;
  if (const auto made = make_output_folder(folder); !made) return fail(made.error());
  const auto lock = lock_folder(folder);
  if (!lock) return fail(lock.error());
  if (const auto added = add_bouts_in(folder, *batch); !added) return fail(added.error());
  const auto written = write_file(folder / kBouts, bouts_jsonl(*batch));
  if (!written) return fail(written.error());
  return finish_study(summary_of(*batch), 0, found);
}

}  // namespace ringcraft
