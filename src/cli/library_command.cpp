#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "capture/canonical.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "cli/library_page.h"
#include "motion/strike_fit.h"
#include "planner/sparring.h"
#include "scene/fitted_library.h"
#include "scene/library_check.h"

namespace ringcraft {

namespace {

// Who attacks whom with what works best, by sparring of two bodies of the library's size.
OffenseDefenseTable table_of(const MotionLibrary& library, const CommonOptions& options) {
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  const MotionTables tables(library, body);
  SparringSettings settings;
  settings.threads = options.threads;
  settings.interrupted = &interrupted;
  return OffenseDefenseTable(spar(tables, tables, settings).records);
}

}  // namespace

int run_library_inspect(const std::string& name, const CommonOptions& options) {
  const auto library = load_library(name);
  if (!library) return fail(library.error());
  if (options.json) {
    nlohmann::json rows = nlohmann::json::array();
    for (const ActionMeasures& m : measure(*library)) {
      rows.push_back({{"name", m.name},
                      {"kind", name_of(m.kind)},
                      {"seconds", m.seconds},
                      {"strike_begin_s", m.strike_begin_s},
                      {"peak_speed_mps", m.peak_speed_mps},
                      {"travel_m", m.travel_m},
                      {"turn_rad", m.turn_rad},
                      {"foot_skate", m.foot_skate},
                      {"leads_to", m.leads_to},
                      {"source", m.source}});
    }
    fmt::print("{}\n", json_text(rows, 1));
    return 0;
  }
  const auto folder = output_folder(options, kLibraryFolder, {"library.html"}, {name});
  if (!folder) return fail(folder.error());
  const std::string page = library_page(*library, table_of(*library, options));
  if (interrupted) return 130;
  if (const auto written = write_files(*folder, {{"library.html", page}}); !written)
    return fail(written.error());
  fmt::print("{} actions; open {}\n", library->actions().size(),
             (*folder / "library.html").string());
  return 0;
}

namespace {

// The captured boxer that authored boxing is measured against, where it is installed: a southpaw,
// who staggers from 16 s on.
constexpr const char* kRealBoxer = "/usr/share/assimp/models/BVH/Boxing_Toes.bvh";
constexpr double kRealFrom = 2.3, kRealTo = 16;  // s

std::optional<Yardstick> measured_against_a_boxer(const MotionLibrary& library) {
  if (!std::filesystem::exists(kRealBoxer)) return std::nullopt;
  const auto real = read_canonical(kRealBoxer, library.skeleton());
  if (!real) return std::nullopt;
  Yardstick measured = yardstick(library, mirrored(real->clip), ticks(kRealFrom), ticks(kRealTo));
  if (measured.farthest.empty()) return std::nullopt;  // nothing authored that boxes
  return measured;
}

nlohmann::json json_of(const LibraryCheck& check) {
  using nlohmann::json;
  json actions = json::array(), strikes = json::array(), gates = json::array();
  for (const ActionMeasures& m : check.actions) {
    actions.push_back({{"name", m.name},
                       {"kind", name_of(m.kind)},
                       {"authored", m.authored},
                       {"seconds", m.seconds},
                       {"travel_m", m.travel_m},
                       {"turn_rad", m.turn_rad},
                       {"foot_skate", m.foot_skate},
                       {"limit_violations", m.limit_violations},
                       {"own_jump_mps", m.own_jump_mps},
                       {"worst_limit_deg", m.worst_limit_deg},
                       {"self_penetration_m", m.self_penetration_m},
                       {"still_hands", m.still_hands},
                       {"head_moves_m", m.head_moves_m},
                       {"leads_to", m.leads_to},
                       {"may_lead_to", m.may_lead_to},
                       {"source", m.source}});
  }
  for (const StrikeMeasures& m : check.strikes) {
    strikes.push_back({{"action", m.action},
                       {"number", m.number},
                       {"kind", name_of(m.strike.kind)},
                       {"aim", m.strike.aim},
                       {"impact_mps", m.impact},
                       {"impact_aimed_mps", m.impact_aimed},
                       {"peak_mps", m.peak_world},
                       {"peak_to_pelvis_mps", m.peak_to_pelvis},
                       {"start_to_contact_s", m.start_to_contact_s},
                       {"peak_fraction", m.peak_fraction},
                       {"push_mps2", m.push},
                       {"brake_mps2", m.brake},
                       {"pelvis_to_chest_s", m.pelvis_to_chest_s},
                       {"chest_to_limb_s", m.chest_to_limb_s},
                       {"aim_best_m", m.aim_best_m},
                       {"aim_from_m", m.aim_from},
                       {"aim_to_m", m.aim_to},
                       {"aim_worst_m", m.aim_worst_m}});
  }
  for (const Gate& gate : check.gates) {
    gates.push_back({{"name", gate.name},
                     {"value", gate.value},
                     {"least", gate.least},
                     {"most", gate.most},
                     {"unit", gate.unit},
                     {"passed", gate.passed()}});
  }
  return {{"actions", actions}, {"strikes", strikes}, {"gates", gates}, {"faults", check.faults}};
}

void print_table(const LibraryCheck& check) {
  fmt::print("{:<34}{:>7}{:>7}{:>7}{:>7}{:>7}{:>12}{:>7}{:>6}{:>7}{:>6}{:>6}  {}\n", "strike",
             "impact", "aimed", "at m", "peak", "-hips", "lands m", "in s", "frac", "br/pu", "p>c",
             "c>h", "aim cm, m");
  for (const StrikeMeasures& m : check.strikes) {
    const std::string lands = fmt::format("{:.2f}-{:.2f}", m.lands_from, m.lands_to);
    const std::string aim =
        m.aim_best_m < 0 ? "-"
                         : fmt::format("{:.1f}/{:.1f} {:.2f}-{:.2f}", m.aim_best_m * 100,
                                       std::max(0.0, m.aim_worst_m) * 100, m.aim_from, m.aim_to);
    fmt::print(
        "{:<34}{:>7.1f}{:>7.1f}{:>7.2f}{:>7.1f}{:>7.1f}{:>12}{:>7.2f}{:>6.2f}{:>7.1f}{:>6.0f}{:>6."
        "0f}{:>8}"
        "\n",
        fmt::format("{}{} {}", m.action, m.number > 0 ? fmt::format("/{}", m.number + 1) : "",
                    name_of(m.strike.kind)),
        m.impact, m.impact_aimed, m.impact_at, m.peak_world, m.peak_to_pelvis, lands,
        m.start_to_contact_s, m.peak_fraction, m.brake / std::max(1.0, m.push),
        m.pelvis_to_chest_s * 1000, m.chest_to_limb_s * 1000, aim);
  }
  fmt::print("\n{:<44}{:>9}  {:<10}{}\n", "gate", "is", "", "asked");
  for (const Gate& gate : check.gates) {
    fmt::print("{:<44}{:>9.3g}  {:<10}{:g} to {:g}{}\n", gate.name, gate.value, gate.unit,
               gate.least, gate.most, gate.passed() ? "" : "  FAILS");
  }
  if (check.yardstick) {
    std::string far;
    for (std::size_t i = 0; i < std::min<std::size_t>(5, check.yardstick->farthest.size()); ++i) {
      const auto& f = check.yardstick->farthest[i];
      far += fmt::format("{}{} {:.1f} cm", i > 0 ? ", " : "", f.action, f.median * 100);
    }
    fmt::print("farthest from the captured boxer: {}\n99 % of the faster hand below {:.1f} m/s\n",
               far, check.yardstick->fast_hand);
  } else {
    fmt::print("no captured boxer is installed (package assimp-testmodels): not compared\n");
  }
}

}  // namespace

int run_library_check(const std::string& name, const CheckHeights& heights,
                      const CommonOptions& options) {
  const EndAtSignal no_file_is_written;
  auto library = load_library(name);
  if (!library) return fail(library.error());
  const auto ratio = static_cast<float>(heights.opponent / heights.own);
  if (!as_tall(ratio)) library = fitted_library(*library, ratio);
  const LibraryCheck check = check_library(*library, measured_against_a_boxer(*library), ratio);
  if (options.json) {
    fmt::print("{}\n", json_text(json_of(check), 1));
  } else {
    if (!options.quiet) print_table(check);
    for (const ActionMeasures& m : check.actions) {
      if (m.left_out) fmt::print("left out, not to be thrown at this opponent: {}\n", m.name);
    }
    for (const std::string& fault : check.faults) fmt::print("{}\n", fault);
    const auto left_out = std::count_if(check.actions.begin(), check.actions.end(),
                                        [](const auto& m) { return m.left_out; });
    fmt::print("{} actions, {} faults\n",
               library->actions().size() - static_cast<std::size_t>(left_out), check.faults.size());
  }
  return check.faults.empty() ? 0 : 1;
}

}  // namespace ringcraft
