#include <optional>

#include <fmt/format.h>

#include <spdlog/spdlog.h>

#include "base/file.h"
#include "capture/library_file.h"
#include "capture/person.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "motion/strike_fit.h"
#include "planner/sparring.h"
#include "scene/fitted_library.h"
#include "scene/pair_sparring.h"
#include "scene/scene_file.h"
#include "scene/sparring_files.h"

namespace ringcraft {

namespace {

// A line for the first blows of combinations; empty where there are none.
std::string first_blows_text(std::span<const Action> actions,
                             std::span<const SparringRecord> records) {
  std::vector<SparringRecord> firsts;
  for (const SparringRecord& record : records) {
    if (actions[record.attack.at()].strikes.size() < 2) continue;
    firsts.push_back(record);
    firsts.back().end = record.first;
  }
  if (firsts.empty()) return {};
  return "first blow of a " + table_text(actions, OffenseDefenseTable(firsts));
}

// Records, table and page of one source of records.
int write_sparring(const std::string& name, std::span<const Action> actions,
                   std::span<const SparringRecord> records, const std::filesystem::path& folder,
                   const CommonOptions& options) {
  const OffenseDefenseTable table(records);
  const std::string json = table_json(name, actions, table);
  const auto written = write_files(folder, {{"records.csv", records_csv(actions, records)},
                                            {"table.json", json},
                                            {"table.html", table_page(name, actions, table)}});
  if (!written) return fail(written.error());
  if (options.json) {
    fmt::print("{}", json);
  } else {
    fmt::print("{} records\n{}{}open {}\n", records.size(), table_text(actions, table),
               first_blows_text(actions, records), (folder / "table.html").string());
  }
  return 0;
}

int spar_in_captures(const SparringOptions& sparring, const BodyModel& body,
                     const std::filesystem::path& folder, const CommonOptions& options) {
  std::optional<EndAtSignal> nothing_to_keep(std::in_place);
  std::vector<CapturedPerson> people;
  std::vector<Action> actions;
  for (const std::string& file : sparring.captures) {
    auto person = read_person(file);
    if (!person) return fail(person.error());
    for (const std::string& note : person->notes) spdlog::info("{}: {}", file, note);
    for (const CapturedAction& captured : person->actions) actions.push_back(captured.action);
    people.push_back(std::move(*person));
  }
  std::size_t id = 0;
  std::vector<PairTake> takes;
  for (const CapturedPerson& person : people) {
    PairTake take;
    take.clip = &person.clip;
    for (const CapturedAction& captured : person.actions)
      take.moves.push_back({ActionId(id++), &captured.action, captured.begin, captured.root});
    takes.push_back(std::move(take));
  }
  std::vector<SparringRecord> records = pair_records(body, takes[0], takes[1]);
  const std::vector<SparringRecord> back = pair_records(body, takes[1], takes[0]);
  records.insert(records.end(), back.begin(), back.end());
  nothing_to_keep.reset();
  return write_sparring(sparring.captures[0] + " and " + sparring.captures[1], actions, records,
                        folder, options);
}

}  // namespace

int run_sparring(const SparringOptions& sparring, const CommonOptions& options) {
  const auto attacker = body_named(sparring.attacker).map(make_body);
  if (!attacker) return fail(attacker.error());
  const auto defender = body_named(sparring.defender).map(make_body);
  if (!defender) return fail(defender.error());
  const auto folder =
      output_folder(options, kSparringFolder, {"records.csv", "table.json", "table.html"},
                    {sparring.library, sparring.attacker, sparring.defender});
  if (!folder) return fail(folder.error());
  if (!sparring.captures.empty()) return spar_in_captures(sparring, *attacker, *folder, options);
  const auto library = load_library(sparring.library);
  if (!library) return fail(library.error());
  warn_without_attacks(*library, sparring.library);

  SparringSettings settings;
  settings.threads = options.threads;
  settings.interrupted = &interrupted;
  const float ratio = defender->skeleton.height / attacker->skeleton.height;
  const MotionLibrary blows = as_tall(ratio) ? *library : fitted_library(*library, ratio);
  const MotionTables attacks(blows, *attacker), defenses(*library, *defender);
  const Sparring found = spar(attacks, defenses, settings);
  if (interrupted) return 130;
  for (const ActionId attack : found.unlanded)
    spdlog::warn("{} lands on no standing guard", library->action(attack).name);
  return write_sparring(library->name(), library->actions(), found.records, *folder, options);
}

}  // namespace ringcraft
