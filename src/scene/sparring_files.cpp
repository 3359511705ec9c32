#include "scene/sparring_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/markup.h"
#include "base/utf8.h"

namespace ringcraft {

namespace {

constexpr const char* kPage =
    "<!doctype html><meta charset=\"utf-8\"><title>Offense/defense table {0}</title>\n"
    "<style>body{{font:13px system-ui;margin:2em}}table{{border-collapse:collapse}}"
    "td,th{{padding:.15em .5em;border:1px solid #ddd;text-align:right}}"
    "th{{font-weight:500;text-align:left}}thead th{{writing-mode:vertical-rl}}</style>\n"
    "<h1>Offense/defense table of {0}</h1>\n{1}";

constexpr const char* kTable =
    "<p>Share of launches that kept the blow from landing clean, in percent, at the defense's best "
    "launch offset; below it that offset in ms after the attack's launch.</p>\n"
    "<table class='exchanges'><thead><tr><th>attack{0}</tr></thead><tbody>\n{1}</tbody></table>\n";

std::vector<ActionId> attacks_of(std::span<const Action> actions,
                                 const OffenseDefenseTable& table) {
  std::vector<ActionId> attacks;
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (!table.against(ActionId(i)).empty()) attacks.emplace_back(i);
  return attacks;
}

// Those that stand in the table, by id.
std::vector<ActionId> defenses_of(std::span<const Action> actions,
                                  const OffenseDefenseTable& table) {
  std::vector<ActionId> defenses;
  for (const ActionId attack : attacks_of(actions, table))
    for (const DefenseEntry& entry : table.against(attack)) defenses.emplace_back(entry.defense);
  std::sort(defenses.begin(), defenses.end());
  defenses.erase(std::unique(defenses.begin(), defenses.end()), defenses.end());
  return defenses;
}

int milliseconds(Tick offset) {
  return static_cast<int>(std::lround(1000 * seconds(offset)));
}

// Attacks of one blow by kind and zone, combinations apart.
std::string blow_of(const Action& action) {
  if (action.strikes.size() > 1) return "combination";
  return fmt::format("{} to the {}", name_of(action.strikes.front().kind),
                     name_of(action.strikes.front().zone));
}

}  // namespace

std::string records_csv(std::span<const Action> actions, std::span<const SparringRecord> records) {
  std::string csv = "attack,defense,offset_s,distance_m,bearing_deg,facing_deg,end\n";
  for (const SparringRecord& record : records) {
    const Placement& at = record.relative;
    fmt::format_to(std::back_inserter(csv), "{},{},{:.3f},{:.2f},{:.1f},{:.1f},{}\n",
                   actions[record.attack.at()].name, actions[record.defense.at()].name,
                   seconds(record.offset), std::hypot(at.x, at.z), degrees(yaw_of(at.position())),
                   degrees(wrapped_angle(at.yaw)), name_of(record.end));
  }
  return csv;
}

std::string table_json(const std::string& name, std::span<const Action> actions,
                       const OffenseDefenseTable& table) {
  nlohmann::json attacks = nlohmann::json::array();
  for (const ActionId attack : attacks_of(actions, table)) {
    nlohmann::json defenses = nlohmann::json::array();
    for (const DefenseEntry& entry : table.against(attack)) {
      nlohmann::json offsets = nlohmann::json::array();
      for (const ExchangeTiming& timing : timings(entry))
        offsets.push_back({{"offset_ms", milliseconds(timing.offset)},
                           {"launched", timing.launched},
                           {"worked", timing.worked}});
      defenses.push_back({{"defense", actions[entry.defense.at()].name},
                          {"launched", entry.launched},
                          {"worked", entry.worked},
                          {"best_offset_ms", milliseconds(best_timing(entry).offset)},
                          {"lift", std::round(1000 * table.lift(attack, entry.defense)) / 1000},
                          {"offsets", std::move(offsets)}});
    }
    attacks.push_back({{"attack", actions[attack.at()].name}, {"defenses", std::move(defenses)}});
  }
  return json_text(nlohmann::json{{"library", name}, {"attacks", std::move(attacks)}}, 1) + "\n";
}

std::string table_html(std::span<const Action> actions, const OffenseDefenseTable& table) {
  const std::vector<ActionId> defenses = defenses_of(actions, table);
  std::string head, rows;
  for (const ActionId id : defenses) head += "<th>" + escaped(actions[id.at()].name);
  for (const ActionId attack : attacks_of(actions, table)) {
    rows += "<tr><th>" + escaped(actions[attack.at()].name);
    for (const ActionId defense : defenses) {
      const DefenseEntry* entry = table.entry(attack, defense);
      if (entry == nullptr) {
        rows += "<td>";
        continue;
      }
      const ExchangeTiming best = best_timing(*entry);
      rows +=
          fmt::format("<td style=\"background:hsl(140 45% {:.0f}%)\">{:.0f}<br><small>{}</small>",
                      100 - 45 * best.share(), 100 * best.share(), milliseconds(best.offset));
    }
    rows += "</tr>\n";
  }
  return fmt::format(kTable, head, rows);
}

std::string table_page(const std::string& name, std::span<const Action> actions,
                       const OffenseDefenseTable& table) {
  return fmt::format(kPage, escaped(name), table_html(actions, table));
}

std::string table_text(std::span<const Action> actions, const OffenseDefenseTable& table) {
  // Per kind of blow the mean over its attacks of each defense's share at its best timing.
  struct Mean {
    double sum = 0;
    int count = 0;
    double value() const { return sum / count; }
  };
  std::map<std::string, std::map<ActionId, Mean>> blows;
  for (const ActionId attack : attacks_of(actions, table)) {
    for (const DefenseEntry& entry : table.against(attack)) {
      Mean& mean = blows[blow_of(actions[attack.at()])][entry.defense];
      mean.sum += static_cast<double>(best_timing(entry).share());
      ++mean.count;
    }
  }
  std::string text;
  for (const auto& [blow, means] : blows) {
    // The surest of each kind of defense.
    std::map<DefenseKind, std::pair<ActionId, double>> of_kind;
    for (const auto& [defense, mean] : means) {
      const DefenseKind kind = actions[defense.at()].defense.value_or(Defense{}).kind;
      const auto known = of_kind.try_emplace(kind, defense, mean.value()).first;
      if (mean.value() > known->second.second) known->second = {defense, mean.value()};
    }
    std::vector<std::pair<DefenseKind, std::pair<ActionId, double>>> sorted(of_kind.begin(),
                                                                            of_kind.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) {
      return x.second.second > y.second.second;
    });
    text += blow;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const auto& [kind, best] = sorted[i];
      text += fmt::format("{} {} {:.0f} % ({})", i == 0 ? ":" : ",", name_of(kind),
                          100 * best.second, actions[best.first.at()].name);
    }
    text += "\n";
  }
  return text;
}

}  // namespace ringcraft
