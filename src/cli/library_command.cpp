#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "capture/filmstrip.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "scene/library_check.h"

namespace ringcraft {

namespace {

constexpr const char* kPage =
    "<!doctype html><meta charset=\"utf-8\"><title>Motion library {0}</title>\n"
    "<style>body{{font:14px system-ui;margin:2em}}table{{border-collapse:collapse}}"
    "td,th{{padding:.2em .7em;border-bottom:1px solid #ccc;text-align:right}}"
    "td:first-child,td:last-child,th:first-child{{text-align:left}}</style>\n"
    "<h1>Motion library {0}</h1><p>{1} actions: {2} attacks, {3} combinations, {4} defenses, "
    "{5} transitions, {6} idles, {7} responses, {8} get-ups</p>\n"
    "<table><tr><th>action<th>kind<th>s<th>hits from s<th>peak m/s<th>travel m<th>turn deg"
    "<th>foot skate<th>leads to<th>source</tr>\n{9}</table>\n{10}\n";

std::string table_rows(const MotionLibrary& library) {
  std::string rows;
  for (const ActionMeasures& m : measure(library)) {
    rows += fmt::format(
        "<tr><td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{:.1f}<td>{:.2f}<td>{:.0f}<td>{:.3f}<td>{}<td>{}</"
        "tr>\n",
        m.name, name_of(m.kind), m.seconds, m.strike_begin_s, m.peak_speed_mps, m.travel_m,
        degrees(static_cast<float>(m.turn_rad)), m.foot_skate, m.leads_to, m.source);
  }
  return rows;
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
    fmt::print("{}\n", rows.dump(1));
    return 0;
  }
  const std::filesystem::path folder = options.out.empty() ? "out/library" : options.out;
  if (const auto made = make_output_folder(folder); !made) return fail(made.error());
  const std::string page = fmt::format(
      kPage, library->name(), library->actions().size(), library->count(Kind::attack),
      library->count(Kind::combination), library->count(Kind::defense),
      library->count(Kind::transition), library->count(Kind::idle), library->count(Kind::response),
      library->count(Kind::get_up), table_rows(*library), filmstrip_svg(*library));
  const std::filesystem::path file = folder / "library.html";
  if (const auto written = write_file(file, page); !written) return fail(written.error());
  fmt::print("{} actions; open {}\n", library->actions().size(), file.string());
  return 0;
}

int run_library_check(const std::string& name, const CommonOptions& options) {
  const auto library = load_library(name);
  if (!library) return fail(library.error());
  const std::vector<std::string> found = library_faults(*library);
  if (options.json) {
    fmt::print("{}\n", nlohmann::json(found).dump(1));
  } else {
    for (const std::string& fault : found) fmt::print("{}\n", fault);
    fmt::print("{} actions, {} faults\n", library->actions().size(), found.size());
  }
  return found.empty() ? 0 : 1;
}

}  // namespace ringcraft
