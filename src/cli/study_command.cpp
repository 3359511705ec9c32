#include "cli/study_command.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "capture/canonical.h"
#include "capture/library_file.h"
#include "cli/ranges.h"
#include "cli/scene_inputs.h"
#include "scene/scene_file.h"
#include "scene/study_bouts.h"
#include "scene/study_clips.h"
#include "scene/study_cost.h"
#include "scene/study_hits.h"
#include "scene/study_penetration.h"
#include "scene/study_search.h"
#include "scene/study_slowed.h"

namespace ringcraft {

namespace {

constexpr float kLeastRing = 3;  // m: bouts of pairings begin up to 3 m apart

// What a study understands besides the common options, one bit each.
enum StudyTakes : std::uint32_t {
  kTakesBouts = 1u << 0,
  kTakesDuration = 1u << 1,
  kTakesCount = 1u << 2,
  kTakesSlow = 1u << 4,
  kTakesOnly = 1u << 5,
  kTakesPlacement = 1u << 6,  // of two motions, and what is a fault
  kTakesHorizons = 1u << 7,   // pairings, and the leaf value and the ring
  kTakesStyles = 1u << 8,     // the same
};

struct StudyEntry {
  const char* name;
  const char* says;
  const char* takes;        // SCENE, A B or nothing
  std::size_t least, most;  // arguments
  std::uint32_t understands;
  Overrides overrides;
  int (*run)(const StudyOptions&, const CommonOptions&);
};

// One line a study.
constexpr StudyEntry kStudies[] = {
    {"penetration", "Pruning by penetration: threshold and check rate", "[SCENE]", 0, 1,
     kTakesDuration | kTakesSlow, Overrides::seed_and_values, run_penetration_study},
    {"search", "A decision's time and its parts; leaves visited, device by device", "[SCENE]", 0, 1,
     kTakesDuration | kTakesSlow | kTakesCount | kTakesBouts, Overrides::seed_and_values,
     run_search_study},
    {"cost", "A decision's nodes and time by horizon and by size of the library", "[SCENE]", 0, 1,
     kTakesDuration | kTakesSlow | kTakesCount, Overrides::seed_and_values, run_cost_study},
    {"clips", "The checker alone on two motions; exit 1 above --limit", "A B", 2, 2,
     kTakesPlacement, Overrides::none, run_clips_study},
    {"hits", "Hits against published figures; exit 1 where a bar fails", "", 0, 0,
     kTakesCount | kTakesOnly, Overrides::seed, run_hits_study},
    {"horizon", "Horizons against each other: wins, hits, defenses, steps", "", 0, 0,
     kTakesBouts | kTakesDuration | kTakesSlow | kTakesHorizons, Overrides::seed_and_values,
     run_horizon_study},
    {"styles", "Styles against each other: distance, hits, wins", "", 0, 0,
     kTakesBouts | kTakesDuration | kTakesSlow | kTakesStyles, Overrides::seed_and_values,
     run_styles_study},
};

// What an option says, --set does not say as well.
Result<void> check_sources(const StudyOptions& study, const std::vector<std::string>& sets) {
  const std::tuple<bool, const char*, const char*> both[] = {
      {study.library.has_value(), "--library", "library"},
      {study.duration_s.has_value(), "--duration", "duration_s"},
      {study.ring_m.has_value(), "--ring", "ring_m"}};
  for (const auto& [given, option, key] : both) {
    if (!given) continue;
    if (auto one = one_source(option, key, sets); !one) return one;
  }
  return {};
}

std::string study_folder(const std::string& name) {
  return "out/study_" + name;
}

Result<SceneFile> scene_of(const StudyOptions& study, const CommonOptions& options) {
  if (auto done = check_sources(study, options.sets); !done) return tl::unexpected(done.error());
  std::vector<std::string> more;
  if (study.duration_s) more.push_back(fmt::format("duration_s={}", *study.duration_s));
  return scene_with(study.what.empty() ? kUsualScene : study.what.front(), options, more);
}

bool is_file(const std::string& name) {
  return std::filesystem::path(name).has_extension() || name.find('/') != std::string::npos;
}

// A motion to be placed: an action of the library, or a capture.
Result<Action> motion_of(const std::string& name, const MotionLibrary& library) {
  if (!is_file(name)) {
    const ActionId id = library.find(name);
    if (id.valid()) return library.action(id);
    return usage_error(name, "", "the library has no such action",
                       meant_action(library, name) +
                           "`ringcraft library inspect` lists them; a capture needs its extension");
  }
  const auto read = read_canonical(name, library.skeleton());
  if (!read) return tl::unexpected(read.error());
  Action action;
  action.name = clean_name(std::filesystem::path(name).stem().string());
  action.clip = from_origin(library.skeleton(), read->clip);
  action.source = name;
  return action;
}

}  // namespace

int finish_study(const Study& study, int code, const CommonOptions& options) {
  const std::filesystem::path folder = options.out.empty()
                                           ? std::filesystem::path(study_folder(study.name))
                                           : std::filesystem::path(options.out);
  if (const auto written = write_study(folder, study); !written) return fail(written.error());
  if (options.json) {
    fmt::print("{}", study_json(study));
  } else {
    for (const std::string& one : study.said) fmt::print("{}\n", one);
    fmt::print("{}open {}\n", study_text(study.table), (folder / "study.html").string());
  }
  return study.interrupted ? 130 : code;
}

namespace {

StudyRun study_run(const CommonOptions& options) {
  StudyRun run;
  run.threads = options.threads;
  run.interrupted = &interrupted;
  if (!options.quiet) run.said = [](const std::string& line) { tell("{}\n", line); };
  return run;
}

// The leaf values that were asked for.
std::vector<LeafValue> leaves_of(const StudyOptions& study) {
  if (study.leaf == "both") return {LeafValue::weighted, LeafValue::paper};
  return {study.leaf == "paper" ? LeafValue::paper : LeafValue::weighted};
}

std::string with_leaf(const std::string& name, LeafValue leaf) {
  return leaf == LeafValue::paper ? name + " (paper's leaf)" : name;
}

// "outboxer:infighter"; without a colon the style fights itself.
Result<Pairing> style_pairing(const std::string& name, LeafValue leaf) {
  const std::size_t colon = name.find(':');
  Pairing pairing{with_leaf(name, leaf), {}};
  const std::string names[] = {name.substr(0, colon),
                               colon == std::string::npos ? name : name.substr(colon + 1)};
  for (std::size_t i = 0; i < 2; ++i) {
    if (names[i].empty())
      return usage_error("--pairings", "", fmt::format("'{}' lacks a style", name),
                         "give two styles, as outboxer:infighter");
    const auto style = style_named(names[i]);
    if (!style) return tl::unexpected(style.error());
    pairing.side[i] = *style;
    pairing.side[i].leaf = leaf;
  }
  return pairing;
}

// The library that the study is of: the one asked for, or the scene's; in the paper's manner where
// that is asked.
Result<MotionLibrary> studied_library(const SceneFile& scene, const StudyOptions& options) {
  auto library = library_of(scene, options.library.value_or(scene.library));
  if (!library || options.slow <= 1) return library;
  return slowed_library(*library, options.slow);
}

// Whoever sets what every bout sets anew would believe that it counts.
Result<void> check_sets(const std::vector<std::string>& sets) {
  for (const std::string& set : sets) {
    const std::string key = set.substr(0, set.find('='));
    if (key != "fighter" && !key.starts_with("fighter.")) continue;
    const bool of_the_two = key.starts_with("fighter.0.") || key.starts_with("fighter.1.");
    const std::string what = of_the_two ? key.substr(10, key.find('.', 10) - 10) : "";
    const auto own = {"style", "horizon_s", "team", "position", "yaw_deg"};
    if (of_the_two && std::find(own.begin(), own.end(), what) == own.end()) continue;
    return usage_error("--set " + key, "",
                       "of no effect: every bout says itself who meets and where",
                       "give styles or horizons as --pairings; fighter.0 and fighter.1 take body, "
                       "health and stance");
  }
  return {};
}

// The default scene gives bodies, health and planner; length and ring are the study's own where
// neither an option nor --set says otherwise.
Result<SceneFile> scene_of_pairings(float usual_ring_m, const StudyOptions& study,
                                    CommonOptions common) {
  if (auto done = check_sources(study, common.sets); !done) return tl::unexpected(done.error());
  if (auto done = check_sets(common.sets); !done) return tl::unexpected(done.error());
  const std::string usual[] = {fmt::format("duration_s={:g}", BoutSeries{}.duration_s),
                               fmt::format("ring_m={:g}", usual_ring_m)};
  common.sets.insert(common.sets.begin(), std::begin(usual), std::end(usual));
  auto scene = scene_with(kUsualScene, common);
  if (!scene) return scene;
  if (study.duration_s) scene->duration = ticks(*study.duration_s);
  if (study.ring_m) scene->ring = *study.ring_m;
  if (scene->ring >= kLeastRing) return scene;
  return usage_error("--set ring_m", "", fmt::format("{:g} m is too small a ring", scene->ring),
                     fmt::format("bouts begin up to 3 m apart: give {:g} m or more", kLeastRing));
}

// Runs the pairings and writes the study.
int finish_pairings(Study study, const std::vector<Pairing>& pairings, float usual_ring_m,
                    const StudyOptions& options, const CommonOptions& common) {
  const auto scene = scene_of_pairings(usual_ring_m, options, common);
  if (!scene) return fail(scene.error());
  const BoutSeries series{options.bouts.value_or(BoutSeries{}.bouts), seconds(scene->duration),
                          scene->ring};
  const auto used = studied_library(*scene, options);
  if (!used) return fail(used.error());
  const StudyRun run = study_run(common);
  const std::vector<PairingResult> results = run_pairings(*used, *scene, pairings, series, run);
  fill_bouts(study, results);
  study.interrupted = run.stopped();
  study.said.push_back(fmt::format(
      "{} bouts of {:g} s a pairing at most, every second one with the sides swapped; ring "
      "{:g} m, seed {}, library {} ({} actions, mean length {:.2f} s, {:.0f} % longer than 1 s), "
      "node limit {}.",
      series.bouts, series.duration_s, series.ring_m, scene->seed, used->name(),
      used->actions().size(), mean_choice_seconds(*used), 100 * share_longer(*used, 1),
      scene->planner.node_limit));
  study.said.emplace_back(
      "A knockout wins, else more damage; a lead of 1 point or less is a draw and no win. "
      "Intervals: Wilson, 95 %. First side a, second side b.");
  return finish_study(study, 0, common);
}

struct PairingsStudy {
  const char* name;
  const char* title;
  float ring_m;                        // side of the ring where none is asked for
  std::span<const char* const> usual;  // pairings where none are asked for
};
constexpr const char* kHorizonPairings[] = {"3v1", "2v1", "3v2", "3v2.5", "1v1", "3v3"};
constexpr const char* kStylePairings[] = {"outboxer:infighter", "balanced:balanced"};
constexpr PairingsStudy kHorizonStudy{"horizon", "Horizon against horizon", 6, kHorizonPairings};
constexpr PairingsStudy kStylesStudy{"styles", "Style against style", 9, kStylePairings};

// Every name with every leaf value that was asked for. `pairing_of`: name, leaf -> Result<Pairing>.
template <class PairingOf>
int run_pairings_study(const PairingsStudy& what, PairingOf pairing_of, const StudyOptions& study,
                       const CommonOptions& options) {
  const std::vector<std::string> usual(what.usual.begin(), what.usual.end());
  std::vector<Pairing> pairings;
  for (const LeafValue leaf : leaves_of(study)) {
    for (const std::string& name : study.pairings.empty() ? usual : study.pairings) {
      auto pairing = pairing_of(name, leaf);
      if (!pairing) return fail(pairing.error());
      pairings.push_back(std::move(*pairing));
    }
  }
  Study result;
  result.name = what.name;
  result.title = what.title;
  return finish_pairings(std::move(result), pairings, what.ring_m, study, options);
}

}  // namespace

int run_penetration_study(const StudyOptions& study, const CommonOptions& options) {
  const auto scene = scene_of(study, options);
  if (!scene) return fail(scene.error());
  const auto library = studied_library(*scene, study);
  if (!library) return fail(library.error());
  const StudyRun run = study_run(options);
  return finish_study(penetration_study(*library, *scene, {}, run), 0, options);
}

int run_search_study(const StudyOptions& study, const CommonOptions& options) {
  const auto scene = scene_of(study, options);
  if (!scene) return fail(scene.error());
  const auto library = studied_library(*scene, study);
  if (!library) return fail(library.error());
  const StudyRun run = study_run(options);
  SearchStudy search;
  if (study.count) search.decisions = static_cast<std::size_t>(*study.count);
  if (study.bouts) search.warm_up_bouts = *study.bouts;
  const Study found = search_study(*library, *scene, search, run);
  const int code = finish_study(found, 0, options);
  if (!options.json) fmt::print("{}", study_text(found.timing));
  return code;
}

int run_cost_study(const StudyOptions& study, const CommonOptions& options) {
  const auto scene = scene_of(study, options);
  if (!scene) return fail(scene.error());
  const auto library = studied_library(*scene, study);
  if (!library) return fail(library.error());
  CostStudy cost;
  if (study.count) cost.decisions = static_cast<std::size_t>(*study.count);
  const Study found = cost_study(*library, *scene, cost, study_run(options));
  const int code = finish_study(found, 0, options);
  if (!options.json) fmt::print("{}", study_text(found.timing));
  return code;
}

int run_clips_study(const StudyOptions& study, const CommonOptions& options) {
  std::optional<EndAtSignal> nothing_to_keep(std::in_place);
  const auto library = load_library(study.library.value_or(kUsualLibrary));
  if (!library) return fail(library.error());
  const auto spec = body_named(study.body);
  if (!spec) return fail(spec.error());
  const auto a = motion_of(study.what[0], *library), b = motion_of(study.what[1], *library);
  if (!a) return fail(a.error());
  if (!b) return fail(b.error());
  const BodyModel body = make_body(*spec);
  const PlacedClip first{a->name, &*a, &body}, second{b->name, &*b, &body};
  const ClipPlacement placement{study.distance_m, ticks(study.later_s), !study.all_contacts};
  const Study found = clips_study(first, second, placement, study.limit_m);
  bool beyond = false;
  for (const auto& row : found.table.rows) beyond |= std::get<std::int64_t>(row.back()) != 0;
  nothing_to_keep.reset();
  return finish_study(found, beyond ? 1 : 0, options);
}

int run_horizon_study(const StudyOptions& study, const CommonOptions& options) {
  const auto style = style_named("balanced");
  if (!style) return fail(style.error());
  const auto pairing_of = [&](const std::string& name, LeafValue leaf) -> Result<Pairing> {
    Style with = *style;
    with.leaf = leaf;
    auto pairing = horizon_pairing(name, with);
    if (!pairing) {
      return usage_error("--pairings", "", fmt::format("'{}' names no horizons", name),
                         "give two horizons in seconds, as 3v1");
    }
    pairing->name = with_leaf(name, leaf);
    return *std::move(pairing);
  };
  return run_pairings_study(kHorizonStudy, pairing_of, study, options);
}

int run_styles_study(const StudyOptions& study, const CommonOptions& options) {
  return run_pairings_study(kStylesStudy, style_pairing, study, options);
}

namespace {

// For the help: what a study takes where an option says nothing.
void add_defaults(CLI::App& one, const StudyEntry& entry) {
  const auto usual = [&](const char* option, const auto& value) {
    one.get_option(option)->default_str(fmt::format("{}", value));
  };
  if (entry.most == 1) usual("SCENE", kUsualScene);
  if (entry.run == run_clips_study || entry.run == run_hits_study)
    usual("--library", kUsualLibrary);
  if (entry.run == run_search_study) {
    usual("--count", SearchStudy{}.decisions);
    usual("--bouts", SearchStudy{}.warm_up_bouts);
  } else if (entry.run == run_cost_study) {
    usual("--count", CostStudy{}.decisions);
  } else if (entry.run == run_hits_study) {
    usual("--count", HitsSettings{}.count);
    usual("--seed", HitsSettings{}.seed);
  } else if (entry.run == run_horizon_study || entry.run == run_styles_study) {
    const PairingsStudy& study = entry.run == run_horizon_study ? kHorizonStudy : kStylesStudy;
    usual("--bouts", BoutSeries{}.bouts);
    usual("--duration", BoutSeries{}.duration_s);
    usual("--ring", study.ring_m);
    usual("--pairings", fmt::format("{}", fmt::join(study.usual, ",")));
  }
}

void add_options(CLI::App& one, std::uint32_t understands, StudyOptions& study) {
  const auto understood = [&](StudyTakes what) { return (understands & what) != 0; };
  const bool pairings = understood(kTakesHorizons) || understood(kTakesStyles);
  if (understood(kTakesBouts)) {
    one.add_option(
           "--bouts", study.bouts,
           pairings ? "Bouts of each pairing" : "Bouts before, whose impulse steps are known")
        ->transform(whole(1, 10000));
  }
  if (understood(kTakesDuration)) {
    one.add_option("--duration", study.duration_s, "Length of a bout, s")
        ->check(within(0.5, 3600.0));
  }
  if (understood(kTakesCount)) {
    one.add_option("--count", study.count,
                   understood(kTakesOnly) ? "Random hits of each question" : "Decisions")
        ->transform(whole(1, 1'000'000));
  }
  if (understood(kTakesSlow)) {
    one.add_option("--slow", study.slow, "Library in the paper's manner, slower by this factor")
        ->check(within(1.0, 5.0));
  }
  if (understood(kTakesOnly)) {
    one.add_option("--only", study.only, "Questions: decision,robustness")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(hit_questions()));
  }
  if (understood(kTakesPlacement)) {
    one.add_option("--body", study.body, "A file of assets/bodies");
    one.add_option("--distance", study.distance_m, "m between the roots")->check(within(0.0, 20.0));
    one.add_option("--later", study.later_s, "s by which the second motion begins later")
        ->check(within(0.0, 600.0));
    one.add_option("--limit", study.limit_m, "Depth that is still right, m")
        ->check(within(0.0, 1.0));
    one.add_flag("--all-contacts", study.all_contacts, "Count what a strike is meant to touch");
  }
  if (pairings) {
    one.add_option(
           "--pairings", study.pairings,
           understood(kTakesStyles) ? "Styles, as outboxer:infighter" : "Horizons, s, as 3v1,2v1")
        ->type_name("A,B")
        ->delimiter(',')
        ->allow_extra_args(false);
    one.add_option("--leaf", study.leaf, "Leaf value")
        ->check(CLI::IsMember({"weighted", "paper", "both"}));
    one.add_option("--ring", study.ring_m, "Side of the ring, m")->check(within(kLeastRing, 50.0));
  }
}

}  // namespace

void add_study_command(CLI::App& app, AddCommon add_common, CommonOptions& options, int& code) {
  CLI::App* command =
      app.add_subcommand("study", "One question over many values: table, CSV, JSON and a picture");
  command->require_subcommand(1);
  const auto study = std::make_shared<StudyOptions>();  // outlives this call, as the parser does
  for (const StudyEntry& entry : kStudies) {
    CLI::App* one = command->add_subcommand(entry.name, entry.says);
    if (entry.most > 0) {
      one->add_option(entry.most == 1 ? "SCENE" : "WHAT", study->what,
                      entry.most == 1 ? "Scene file, or the name of one in assets/scenes"
                                      : "Two motions: actions or captures")
          ->type_name(entry.most == 1 ? "TEXT" : entry.takes)
          ->expected(static_cast<int>(entry.least), static_cast<int>(entry.most))
          ->required(entry.least > 0);
    }
    one->add_option("--library", study->library, "Motion library");
    add_options(*one, entry.understands, *study);
    add_common(*one, options, entry.overrides, study_folder(entry.name));
    add_defaults(*one, entry);
    one->callback([&code, &options, study, &entry] {
      std::vector<std::filesystem::path> inputs(study->what.begin(), study->what.end());
      inputs.insert(inputs.end(), {study->library.value_or(""), study->body});
      const auto folder =
          output_folder(options, study_folder(entry.name), study_file_names(), inputs);
      code = folder ? entry.run(*study, options) : fail(folder.error());
    });
  }
}

}  // namespace ringcraft
