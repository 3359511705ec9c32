#pragma once
// A study: one question, tried over many values, answered by a table and a picture.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"

namespace ringcraft {

using StudyCell = std::variant<std::string, double, std::int64_t>;

// A number as a cell; an empty one where there is none (null in JSON).
StudyCell cell_of(const std::optional<double>& number);

struct StudyTable {
  std::vector<std::string> columns;          // with the unit: "penetration_p99_m"
  std::vector<std::vector<StudyCell>> rows;  // each as long as `columns`
};

struct StudyPoint {
  double x = 0, y = 0;
  std::optional<double> low, high;  // ends of the confidence interval
};

struct StudySeries {
  std::string name;
  std::vector<StudyPoint> points;
};

// One panel of the picture. Where `ticks` are given they name x = 0, 1, 2 ...
struct StudyChart {
  std::string title, x, y;  // axes with their units
  std::vector<StudySeries> series;
  std::vector<std::string> ticks;
  bool joined = true;              // a line through the points of a series
  std::optional<double> bar = {};  // the value to be held
  bool dots = true;                // a mark at each point
};

struct Study {
  std::string name;  // of the files' folder: "penetration"
  std::string title;
  std::vector<std::string> said;  // how it was done, with every number that limits it
  StudyTable table;
  std::vector<StudyChart> charts;
  StudyTable timing;  // what the clock said; the only part that differs from run to run
  std::vector<StudyChart> timing_charts = {};  // of it
  bool interrupted = false;
};

std::string study_csv(const StudyTable& table);
std::string study_json(const Study& study);  // without the timing
std::string study_svg(const Study& study);
std::string study_html(const Study& study);       // table and picture; opens by itself
std::string study_text(const StudyTable& table);  // columns of equal width

// The files of write_study().
std::vector<std::string> study_file_names();

// study.csv, study.json, study.svg, study.html and timing.json, and timing.svg where the timing has
// charts; each appears whole or not at all.
Result<void> write_study(const std::filesystem::path& folder, const Study& study);

// 95 % interval of a share, by Wilson's score (Wilson 1927); 0..1 where nothing was tried.
struct Interval {
  double low = 0, high = 1;
};
Interval wilson(std::size_t wins, std::size_t of);

// Mean of values and its 95 % interval by Student's t (series, 1 % off from 4 values on); one value
// has none.
struct MeanInterval {
  double mean = 0;
  std::optional<double> low, high;
};
MeanInterval mean_interval(const std::vector<double>& values);

}  // namespace ringcraft
