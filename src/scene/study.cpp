#include "scene/study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/markup.h"
#include "base/utf8.h"

namespace ringcraft {
namespace {

constexpr double kZ975 = 1.959964;  // 97.5 % of the normal distribution

std::string cell_text(const StudyCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string();
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

nlohmann::ordered_json cell_json(const StudyCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  const double value = std::get<double>(cell);
  if (!std::isfinite(value)) return nullptr;
  return value;
}

nlohmann::ordered_json rows_json(const StudyTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json one = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      one[table.columns[i]] = cell_json(row[i]);
    rows.push_back(std::move(one));
  }
  return rows;
}

std::string html_table(const StudyTable& table) {
  std::string out = "<table><tr>";
  for (const std::string& column : table.columns) out += "<th>" + escaped(column);
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const StudyCell& cell : row) out += "<td>" + escaped(cell_text(cell));
  }
  return out + "</table>\n";
}

}  // namespace

StudyCell cell_of(const std::optional<double>& number) {
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string study_csv(const StudyTable& table) {
  std::string out;
  const auto line = [&](const auto& cells, const auto& text_of) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) out += ',';
      out += quoted(text_of(cells[i]));
    }
    out += '\n';
  };
  line(table.columns, [](const std::string& name) { return name; });
  for (const auto& row : table.rows) line(row, cell_text);
  return out;
}

std::string study_json(const Study& study) {
  const nlohmann::ordered_json json{{"version", RINGCRAFT_VERSION},
                                    {"study", study.name},
                                    {"title", study.title},
                                    {"said", study.said},
                                    {"interrupted", study.interrupted},
                                    {"rows", rows_json(study.table)}};
  return json_text(json, 1) + "\n";
}

std::string study_text(const StudyTable& table) {
  std::vector<std::size_t> width;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t most = table.columns[i].size();
    for (const auto& row : table.rows) most = std::max(most, cell_text(row[i]).size());
    width.push_back(most);
  }
  std::string out;
  const auto line = [&](const auto& text_of) {
    for (std::size_t i = 0; i < width.size(); ++i) {
      out += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", text_of(i), width[i]);
    }
    out += '\n';
  };
  line([&](std::size_t i) { return table.columns[i]; });
  for (const auto& row : table.rows) line([&](std::size_t i) { return cell_text(row[i]); });
  return out;
}

std::string study_html(const Study& study) {
  std::string said;
  for (const std::string& one : study.said) said += "<p>" + escaped(one) + "\n";
  return fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body{{font:14px system-ui;margin:2em;max-width:1200px}}"
      "table{{border-collapse:collapse;margin:1em 0}}"
      "td,th{{padding:.25em .7em;border-bottom:1px solid #ccc;text-align:right;"
      "font-variant-numeric:tabular-nums}}"
      "td:first-child,th:first-child{{text-align:left}}</style>\n<h1>{0}</h1>\n{1}{2}{3}",
      escaped(study.title), said, study_svg(study), html_table(study.table));
}

std::vector<std::string> study_file_names() {
  return {"study.csv", "study.json", "study.svg", "study.html", "timing.json", "timing.svg"};
}

Result<void> write_study(const std::filesystem::path& folder, const Study& study) {
  const nlohmann::ordered_json timing{
      {"version", RINGCRAFT_VERSION}, {"study", study.name}, {"rows", rows_json(study.timing)}};
  NamedBytes files = {{"study.csv", study_csv(study.table)},
                      {"study.json", study_json(study)},
                      {"study.svg", study_svg(study)},
                      {"study.html", study_html(study)},
                      {"timing.json", json_text(timing, 1) + "\n"}};
  if (!study.timing_charts.empty()) {
    Study clock;
    clock.title = study.title;
    clock.charts = study.timing_charts;
    files.emplace_back("timing.svg", study_svg(clock));
  }
  return write_files(folder, files);
}

Interval wilson(std::size_t wins, std::size_t of) {
  if (of == 0) return {};
  constexpr double kZ = kZ975;
  const auto n = static_cast<double>(of);
  const double p = static_cast<double>(wins) / n;
  const double spread = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  const double middle = p + kZ * kZ / (2 * n), whole = 1 + kZ * kZ / n;
  return {std::max(0.0, (middle - spread) / whole), std::min(1.0, (middle + spread) / whole)};
}

MeanInterval mean_interval(const std::vector<double>& values) {
  if (values.empty()) return {0, {}, {}};
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  if (values.size() < 2) return {mean, {}, {}};
  for (const double value : values) squares += (value - mean) * (value - mean);
  // Student's t at 97.5 % for n - 1 degrees of freedom (Abramowitz & Stegun 26.7.5).
  constexpr double z = kZ975, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  const double v = n - 1;
  const double t = z + (z3 + z) / (4 * v) + (5 * z5 + 16 * z3 + 3 * z) / (96 * v * v) +
                   (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * v * v * v);
  const double spread = t * std::sqrt(squares / v / n);
  return {mean, mean - spread, mean + spread};
}

}  // namespace ringcraft
