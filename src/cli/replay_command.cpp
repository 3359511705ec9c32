#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/commands.h"
#include "scene/hit_replay.h"

namespace ringcraft {

int run_replay(const std::string& file, const CommonOptions& options) {
  const auto events = read_file(file);
  if (!events) return fail(events.error());
  const auto report = replay_hits(file, *events, options.threads, &interrupted);
  if (!report) return fail(report.error());
  if (options.json) {
    const nlohmann::json json = {
        {"hits", report->hits}, {"differ", report->differ}, {"differences", report->lines}};
    fmt::print("{}\n", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    for (const std::string& line : report->lines) fmt::print("{}\n", line);
    fmt::print("{} hits replayed, {} differ\n", report->hits, report->differ);
  }
  if (report->interrupted) return 130;
  return report->differ > 0 ? 1 : 0;
}

}  // namespace ringcraft
