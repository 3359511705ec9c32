#pragma once
// `ringcraft study NAME`: one question, tried over many values; a table, a CSV and a picture.

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "scene/study.h"

namespace CLI {
class App;
}

namespace ringcraft {

// What the studies understand besides the common options, each some of it.
struct StudyOptions {
  std::vector<std::string> what = {};  // SCENE, or the two motions of `clips`
  std::optional<std::string> library;  // otherwise the scene's, or kUsualLibrary
  std::string body = "middleweight";
  std::optional<int> bouts;
  std::optional<int> count;  // decisions, or random hits
  std::optional<double> duration_s;
  float distance_m = 0.95f;  // between the two motions
  double later_s = 0;        // by which the second motion begins later
  float limit_m = 0.02f;     // deeper is a fault
  bool all_contacts = false;
  std::vector<std::string> only = {};      // questions of `hits`
  std::vector<std::string> pairings = {};  // "3v1" or "outboxer:infighter"
  float slow = 1;                          // of the library in the paper's manner
  std::string leaf = "weighted";
  std::optional<float> ring_m;  // none: as the study has it
};

int run_penetration_study(const StudyOptions& study, const CommonOptions& options);
int run_search_study(const StudyOptions& study, const CommonOptions& options);
int run_cost_study(const StudyOptions& study, const CommonOptions& options);
int run_clips_study(const StudyOptions& study, const CommonOptions& options);
int run_hits_study(const StudyOptions& study, const CommonOptions& options);
int run_horizon_study(const StudyOptions& study, const CommonOptions& options);
int run_styles_study(const StudyOptions& study, const CommonOptions& options);

// Writes the study's files and prints its table (or its JSON); the exit code is `code`, or 130
// where it was interrupted.
int finish_study(const Study& study, int code, const CommonOptions& options);

// Adds `study` to the command; `code` receives the exit code.
using AddCommon = void (*)(CLI::App&, CommonOptions&, Overrides, const std::string& usual_out);
void add_study_command(CLI::App& app, AddCommon add_common, CommonOptions& options, int& code);

}  // namespace ringcraft
