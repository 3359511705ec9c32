#include "scene/batch.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "base/json_object.h"
#include "base/tasks.h"
#include "planner/impact_store.h"
#include "scene/fight_files.h"

namespace ringcraft {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestBout = 1u << 20;  // bytes
constexpr std::size_t kMostFighters = 16;       // as a scene may have
constexpr std::size_t kLongestName = 512;       // bytes, as in a scene: it stands by each measure
constexpr double kLargestFigure = 1e15;         // of a report: squares stay finite
constexpr const char* kMeasuredParts[] = {"physics", "quality"};

tl::unexpected<Error> bout_fault(const std::string& file, std::size_t line, std::string what) {
  return input_error(file, fmt::format("line {}", line), std::move(what),
                     "give a bouts.jsonl as `ringcraft batch` wrote it");
}

// Such as no scene has in a name: it goes to tables and terminals.
bool has_control_characters(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20; });
}

// What is wrong with the numbers of a part of a report; empty where nothing is.
std::string wrong_in(const std::string& of, const json& part) {
  if (has_control_characters(of)) return fmt::format("'{}' has control characters", of);
  for (const auto& [name, value] : part.items()) {
    if (has_control_characters(name)) return fmt::format("'{}' has control characters", name);
    if (value.is_number() && std::abs(value.get<double>()) > kLargestFigure)
      return fmt::format("'{}' of {} is larger than any bout's", name, of);
  }
  return {};
}

// What is wrong with a report of `scene`; empty where nothing is.
std::string wrong_with(const json& report, const std::string& scene) {
  const auto seed = report.find("seed");
  if (seed == report.end() || !seed->is_number_unsigned()) return "no 'seed'";
  const auto name = report.find("scene");
  if (name == report.end() || *name != scene) return "not a bout of scene " + scene;
  const auto fighters = report.find("fighters");
  if (fighters == report.end() || !fighters->is_array()) return "no 'fighters'";
  if (fighters->size() > kMostFighters)
    return fmt::format("{} fighters, at most {} are in a fight", fighters->size(), kMostFighters);
  for (const json& fighter : *fighters) {
    if (!fighter.is_object()) return "a fighter is not an object";
    const auto called = fighter.find("name");
    if (called == fighter.end() || !called->is_string()) return "a fighter has no 'name'";
    if (called->get_ref<const std::string&>().size() > kLongestName)
      return fmt::format("a fighter's name is longer than {} bytes", kLongestName);
    if (std::string what = wrong_in(called->get<std::string>(), fighter); !what.empty())
      return what;
  }
  for (const char* part : kMeasuredParts) {
    const auto found = report.find(part);
    if (found == report.end() || !found->is_object()) continue;
    if (std::string what = wrong_in(part, *found); !what.empty()) return what;
  }
  return {};
}

// The values of one number of the report, over the bouts that have it.
struct Measure {
  std::string of, name;
  std::vector<double> values = {};
};

class Measures {
 public:
  // Every number directly in `object`, moments (`..._at_s`) aside: they have no mean.
  void add(const std::string& of, const json& object) {
    for (const auto& [name, value] : object.items()) {
      if (value.is_number() && !name.ends_with("_at_s"))
        at(of, name).values.push_back(value.get<double>());
    }
  }
  const std::vector<Measure>& all() const { return all_; }

 private:
  Measure& at(const std::string& of, const std::string& name) {
    const auto [place, added] = places_.try_emplace({of, name}, all_.size());
    if (added) all_.push_back({of, name});
    return all_[place->second];
  }
  std::map<std::pair<std::string, std::string>, std::size_t> places_;  // in all_
  std::vector<Measure> all_;
};

// Two fighters of a scene may share a name.
std::string fighter_name(const json& fighters, std::size_t i) {
  const auto name = fighters[i].at("name").get<std::string>();
  const auto same = std::count_if(fighters.begin(), fighters.end(),
                                  [&](const json& one) { return one.at("name") == name; });
  return same > 1 ? fmt::format("{} {}", name, i) : name;
}

Measures measures_of(const Batch& batch) {
  Measures measures;
  for (const auto& [seed, line] : batch.bouts) {
    const json report = json::parse(line);
    const json& fighters = report.at("fighters");
    for (std::size_t i = 0; i < fighters.size(); ++i)
      measures.add(fighter_name(fighters, i), fighters[i]);
    for (const char* part : kMeasuredParts) {
      if (const auto found = report.find(part); found != report.end() && found->is_object())
        measures.add(part, *found);
    }
  }
  return measures;
}

StudyChart chart_of(const Measures& measures, const std::string& name) {
  StudyChart chart{name + " a bout, 95 % intervals", "fighter", name, {{"", {}}}, {}, false};
  for (const Measure& one : measures.all()) {
    if (one.name != name) continue;
    const MeanInterval mean = mean_interval(one.values);
    const auto x = static_cast<double>(chart.ticks.size());
    chart.ticks.push_back(one.of);
    chart.series.front().points.push_back({x, mean.mean, mean.low, mean.high});
  }
  return chart;
}

}  // namespace

Batch batch_of(const SceneFile& scene, const MotionLibrary& library) {
  Hasher hasher;
  hasher.add(std::string_view(RINGCRAFT_VERSION)).add(scene.settings).add(library.hash());
  return {scene.name, hash_name(hasher.digest())};
}

Result<void> run_batch(Batch& batch, const MotionLibrary& library, const SceneFile& scene,
                       int count, const StudyRun& run,
                       const std::function<Result<void>(const Batch&)>& kept) {
  std::vector<std::uint64_t> seeds;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = scene.seed + static_cast<std::uint64_t>(i);
    if (!batch.bouts.contains(seed)) seeds.push_back(seed);
  }
  const auto store = std::make_shared<ImpactStore>();
  std::mutex keeping;
  std::optional<Error> failed;
  std::atomic<bool> stop = false;
  run_tasks(seeds.size(), run.threads, [&](std::size_t i) {
    if (run.stopped() || stop) return;
    SceneFile bout = scene;
    bout.seed = seeds[i];
    bout.planner.threads = 1;
    FightOptions options;
    options.interrupted = run.interrupted;
    options.impacts = store;
    const FightRecord record = simulate_fight(library, bout, options);
    if (record.interrupted) return;
    const std::string report = fight_report(bout, library, record);
    const std::lock_guard lock(keeping);
    batch.bouts[bout.seed] = report;
    run.say(fmt::format("seed {}: {} of {} bouts", bout.seed, batch.bouts.size(), count));
    if (const auto written = kept(batch); !written && !failed) {
      failed = written.error();
      stop = true;
    }
  });
  if (failed) return tl::unexpected(*failed);
  return {};
}

std::string bouts_jsonl(const Batch& batch) {
  std::string out = json{{"type", "header"},
                         {"scene", batch.scene},
                         {"setup", batch.setup},
                         {"bouts", batch.bouts.size()}}  // where fewer follow, the file is cut off
                        .dump();
  out += '\n';
  for (const auto& [seed, report] : batch.bouts) out += report + '\n';
  return out;
}

Result<Batch> read_bouts(const std::string& file, std::string_view text) {
  Batch batch;
  std::optional<std::size_t> counted;  // bouts, where the header says so
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos)
      return bout_fault(file, number, "the file ends inside a line: it is cut off");
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line.size() > kLongestBout) return bout_fault(file, number, "longer than 1 MiB");
    std::string why;
    const auto read = json_object(line, why);
    if (!read) return bout_fault(file, number, why);
    if (number == 1) {
      const auto word = [&](const char* key) {
        const auto found = read->find(key);
        return found != read->end() && found->is_string() ? found->get<std::string>()
                                                          : std::string();
      };
      batch = {word("scene"), word("setup")};
      if (word("type") != "header" || batch.scene.empty() || batch.setup.empty() ||
          has_control_characters(batch.scene + batch.setup))
        return bout_fault(file, number, "not the header line");
      if (const auto count = read->find("bouts"); count != read->end()) {
        if (!count->is_number_unsigned()) return bout_fault(file, number, "'bouts' is no count");
        counted = *count;
      }
      continue;
    }
    if (const std::string what = wrong_with(*read, batch.scene); !what.empty())
      return bout_fault(file, number, what);
    const auto seed = read->at("seed").get<std::uint64_t>();
    if (!batch.bouts.emplace(seed, std::string(line)).second)
      return bout_fault(file, number, fmt::format("seed {} stands there twice", seed));
  }
  if (number == 0) return bout_fault(file, 1, "the file is empty");
  if (counted && *counted != batch.bouts.size()) {
    return input_error(
        file, fmt::format("line {}", number),
        fmt::format("the header counts {} bouts, and {} are there: {}", *counted,
                    batch.bouts.size(),
                    *counted < batch.bouts.size() ? "lines were added" : "the file is cut off"),
        "fetch it again, or take 'bouts' out of its header to go on with what is there");
  }
  return batch;
}

Result<void> add_bouts(Batch& batch, const Batch& more, const std::string& file) {
  if (more.scene != batch.scene || more.setup != batch.setup) {
    return usage_error(file, "line 1",
                       fmt::format("scene {} of setup {}, the others are of scene {} and setup {}",
                                   more.scene, more.setup, batch.scene, batch.setup),
                       "merge bouts of one scene, one library and one version of the program, or "
                       "choose another folder with --out");
  }
  for (const auto& [seed, report] : more.bouts) {
    const auto [at, added] = batch.bouts.emplace(seed, report);
    if (!added && at->second != report) {
      return input_error(
          file, fmt::format("seed {}", seed), "gave another fight elsewhere",
          "build both programs alike, and run the seed again with `ringcraft fight`");
    }
  }
  return {};
}

Study summary_of(const Batch& batch) {
  Study study;
  study.name = "batch";
  study.title = fmt::format("{}: {} bouts", batch.scene, batch.bouts.size());
  study.said = {fmt::format("{} bouts of {}", batch.bouts.size(), batch.scene)};
  if (!batch.bouts.empty()) {
    study.said.front() +=
        fmt::format(", seeds {} to {}", batch.bouts.begin()->first, batch.bouts.rbegin()->first);
  }
  study.table.columns = {"of", "measure", "bouts", "mean", "low", "high", "least", "most"};
  const Measures measures = measures_of(batch);
  for (const Measure& one : measures.all()) {
    const MeanInterval mean = mean_interval(one.values);
    const auto [least, most] = std::minmax_element(one.values.begin(), one.values.end());
    study.table.rows.push_back({one.of, one.name, static_cast<std::int64_t>(one.values.size()),
                                mean.mean, cell_of(mean.low), cell_of(mean.high), *least, *most});
  }
  if (batch.bouts.empty()) return study;
  for (const char* name : {"strikes", "landed", "hits_taken", "knockdowns"})
    study.charts.push_back(chart_of(measures, name));
  return study;
}

}  // namespace ringcraft
