#include <fmt/format.h>

#include "base/file.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "scene/scene_file.h"
#include "scene/sparring_files.h"

namespace ringcraft {

namespace {

Result<BodyModel> body_named(const std::string& name) {
  const std::filesystem::path path = name.ends_with(".toml")
                                         ? std::filesystem::path(name)
                                         : assets_folder() / "bodies" / (name + ".toml");
  const auto spec = read_body(path);
  if (!spec) return tl::unexpected(spec.error());
  return make_body(*spec);
}

}  // namespace

int run_sparring(const SparringOptions& sparring, const CommonOptions& options) {
  const auto attacker = body_named(sparring.attacker);
  if (!attacker) return fail(attacker.error());
  const auto defender = body_named(sparring.defender);
  if (!defender) return fail(defender.error());
  const auto library = load_library(sparring.library);
  if (!library) return fail(library.error());
  const std::filesystem::path folder = options.out.empty() ? "out/sparring" : options.out;
  if (const auto made = make_output_folder(folder); !made) return fail(made.error());

  SparringSettings settings;
  settings.threads = options.threads;
  settings.interrupted = &interrupted;
  const MotionTables attacks(*library, *attacker), defenses(*library, *defender);
  const Sparring found = spar(attacks, defenses, settings);
  if (interrupted) return 130;
  const OffenseDefenseTable table(found.records);
  const std::string json = table_json(*library, table);
  const std::pair<const char*, std::string> files[] = {
      {"records.csv", records_csv(*library, found.records)},
      {"table.json", json},
      {"table.html", table_page(*library, table)}};
  for (const auto& [name, bytes] : files)
    if (const auto written = write_file(folder / name, bytes); !written)
      return fail(written.error());
  if (options.json) {
    fmt::print("{}", json);
  } else {
    fmt::print("{}open {}\n", table_text(*library, found, table), (folder / "table.html").string());
  }
  return 0;
}

}  // namespace ringcraft
