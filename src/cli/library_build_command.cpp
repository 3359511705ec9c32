// `ringcraft library build`: captures and sheets to one library file.

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/hash.h"
#include "base/utf8.h"
#include "capture/library_builder.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "io/report.h"
#include "scene/blend_judge.h"

namespace ringcraft {

namespace {

// What a fighter waits between two actions that do not follow each other directly, ticks, over all
// pairs that may be launched.
double mean_path(const MotionLibrary& library) {
  double ticks = 0, pairs = 0;
  for (const ActionId from : library.launchable()) {
    for (const ActionId to : library.launchable()) {
      const Path* path = library.machine().path(from, to);
      if (path == nullptr) continue;
      ticks += path->ticks;
      ++pairs;
    }
  }
  return pairs > 0 ? ticks / pairs : 0;
}

// Of a folder: captures and cuts that could not be read, each with its reason.
std::vector<std::string> passed_over(const MotionLibrary& library) {
  std::vector<std::string> notes;
  for (const std::string& note : library.notes()) {
    if (note.starts_with("passed over: ")) notes.push_back(note);
  }
  return notes;
}

nlohmann::json summary_of(const MotionLibrary& library) {
  nlohmann::json summary = library_counts(library);
  summary.update({{"name", library.name()},
                  {"hash", hash_name(library.hash())},
                  {"blends", std::count_if(library.actions().begin(), library.actions().end(),
                                           [](const Action& one) { return is_blend(one); })},
                  {"dropped", library.dropped()},
                  {"passed_over", passed_over(library)},
                  {"notes", library.notes()},
                  {"mean_path_ticks", mean_path(library)},
                  {"graph",
                   {{"clips", library.graph().clips.size()},
                    {"pairs", library.graph().pairs},
                    {"minima", library.graph().minima},
                    {"transitions", library.graph().transitions.size()}}}});
  return summary;
}

}  // namespace

int run_library_build(const LibraryBuildOptions& build, const CommonOptions& options) {
  const std::filesystem::path source = library_source(build.source);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(source, ignored) &&
      (build.responses_from || build.not_mirrored)) {
    const auto refused =
        usage_error(source.string(), build.responses_from ? "--responses-from" : "--not-mirrored",
                    "of no effect on a manifest, whose actions are those it names",
                    "leave it out, or name a folder of captures without library.toml");
    return fail(refused.value());
  }
  LibraryBuildSettings settings;
  if (build.responses_from)
    settings.responses_from = *build.responses_from == "none" ? "" : *build.responses_from;
  settings.mirrored = !build.not_mirrored;
  settings.connect = !build.not_connected;
  if (build.interpolate || build.not_interpolated) settings.interpolate = build.interpolate;
  settings.judge = joint_limit_judge();
  settings.threads = options.threads;
  if (!options.out.empty()) {  // before the work
    if (const auto folder = std::filesystem::path(options.out).parent_path(); !folder.empty()) {
      if (const auto made = make_output_folder(folder); !made) return fail(made.error());
    }
    if (const auto may = may_write_library(options.out); !may) return fail(may.error());
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto library = [&] {
    const EndAtSignal nothing_to_keep;
    return build_library(source, settings);
  }();
  if (!library) return fail(library.error());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const std::filesystem::path file =
      options.out.empty() ? std::filesystem::path(with_name(kBuiltLibrary, library->name()))
                          : std::filesystem::path(options.out);
  if (const auto written = write_library(*library, file); !written) return fail(written.error());
  const nlohmann::json summary = summary_of(*library);
  const std::vector<std::string> unread = passed_over(*library);
  if (options.verbose > 0 || !options.quiet) {
    for (const std::string& note : options.verbose > 0 ? library->notes() : unread)
      tell("{}\n", note);
  }
  if (!options.quiet) {
    for (const std::string& dropped : library->dropped()) tell("dropped: {}\n", dropped);
    tell("built in {:.1f} s\n", took.count());
  }
  warn_without_attacks(*library, file);
  if (options.json) {
    fmt::print("{}\n", json_text(summary, 1));
    return 0;
  }
  const auto number = [&](const char* key) { return summary[key].get<std::size_t>(); };
  fmt::print(
      "{}: {} actions ({} attacks, {} combinations, {} defenses, {} transitions, {} idles, {} "
      "responses, {} get-ups; {} of them blends), {} dropped, {} passed over\n"
      "motion graph: {} transitions between {} clips; {} short ways of it connect actions; from "
      "one "
      "action to the next {:.1f} ticks in the mean\n",
      file.string(), number("actions"), number("attacks"), number("combinations"),
      number("defenses"), number("transitions"), number("idles"), number("responses"),
      number("get_ups"), number("blends"), library->dropped().size(), unread.size(),
      library->graph().transitions.size(), library->graph().clips.size(), number("connecting"),
      summary["mean_path_ticks"].get<double>());
  return 0;
}

}  // namespace ringcraft
