// The command `ringcraft`.

#include <algorithm>
#include <exception>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/ranges.h"
#include "cli/study_command.h"

namespace ringcraft {

namespace {

void add_talk(CLI::App& command, CommonOptions& options) {
  command.add_flag("-q,--quiet", options.quiet, "No progress");
  command.add_flag("-v,--verbose", options.verbose, "Say more");
}

// Of a command that writes no file.
void add_for_stdout(CLI::App& command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "Threads; never changes the result")
      ->check(CLI::Range(1, 256));
  command.add_flag("--json", options.json, "Print the result as JSON on stdout");
  add_talk(command, options);
}

void add_common(CLI::App& command, CommonOptions& options, Overrides overrides) {
  command.add_option("-o,--out", options.out, "Output folder")->type_name("DIR");
  if (overrides != Overrides::none) {
    command
        .add_option("--seed", options.seed,
                    overrides == Overrides::seed ? "Seed of what is drawn at random"
                                                 : "Seed, instead of the scene's")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{0}, kMostSeed));
  }
  if (overrides == Overrides::seed_and_values) {
    command.add_option("--set", options.sets, "Set one value: path.to.key=value (repeatable)")
        ->type_name("KEY=VALUE")
        ->take_all();
  }
  add_for_stdout(command, options);
}

int run_completion(const std::string& shell) {
  const auto script = completion_script(shell);
  if (!script) return fail(script.error());
  fmt::print("{}", *script);
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app("Fights in which hits are physical.", "ringcraft");
  app.set_version_flag("--version", RINGCRAFT_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* whole, const CLI::Error& error) {
    std::string named = whole->get_name();
    for (const CLI::App* at = whole; !at->get_subcommands().empty();) {
      at = at->get_subcommands().front();
      named += " " + at->get_name();
    }
    return fmt::format("ringcraft: {}; `{} --help` says what there is\n", error.what(), named);
  });
  CommonOptions options;
  options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  int code = 0;

  std::string scene = "duel";
  CLI::App* fight = app.add_subcommand("fight", "Simulate a scene: GLB, events, report and a page");
  fight->add_option("SCENE", scene, "Scene file, or the name of one in assets/scenes");
  FightCommandOptions fight_options;
  fight->add_option("--export", fight_options.exports, "Also bvh or vrma, one file a fighter")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"bvh", "vrma"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  fight
      ->add_option("--export-profile", fight_options.profile,
                   "Names, axes and unit of the BVH: a file of assets/profiles")
      ->type_name("PROFILE")
      ->needs("--export");
  fight->add_flag("--root-motion", fight_options.root_motion,
                  "fight.glb moves each fighter's own node over the ground");
  add_common(*fight, options, Overrides::seed_and_values);
  fight->callback([&] { code = run_fight(scene, fight_options, options); });

  HitOptions hit_options;
  CLI::App* hit =
      app.add_subcommand("hit", "One hit on one body: the response, its numbers, GLB and page");
  hit->add_option("--pose", hit_options.pose, "The interrupted action and the seconds into it")
      ->type_name("ACTION@S");
  hit->add_option("--part", hit_options.part, "Struck body part");
  hit->add_option("--impulse", hit_options.impulse, "N s along the fighter's left, up and fore")
      ->type_name("X,Y,Z");
  hit->add_option("--strike", hit_options.strike, "A blow of a placed attacker, not an impulse")
      ->type_name("ACTION")
      ->excludes("--impulse");
  hit->add_option("--attacker", hit_options.attacker, "Body of the attacker")->needs("--strike");
  hit->add_option("--distance", hit_options.distance, "m between the two, else where it lands best")
      ->needs("--strike");
  hit->add_option("--sweep", hit_options.sweep, "A map over impulse (N s), direction (deg) or tone")
      ->type_name("AXIS=FROM:TO:STEP")
      ->excludes("--strike")
      ->take_all();
  hit->add_option("--tone", hit_options.tone, "Muscle tone")->check(within(0.0, 1.0));
  hit->add_option("--body", hit_options.body, "A file of assets/bodies");
  hit->add_option("--library", hit_options.library, "Motion library");
  add_common(*hit, options, Overrides::none);
  hit->callback([&] { code = run_hit(hit_options, options); });

  TreeOptions tree_options;
  CLI::App* tree = app.add_subcommand("tree", "The game tree of one decision: JSON, SVG, a trace");
  tree->add_option("SCENE", scene, "Scene file, or the name of one in assets/scenes");
  tree->add_option("--at", tree_options.at_s, "The first decision from this time on, s")
      ->type_name("T")
      ->required();
  tree->add_option("--nodes", tree_options.nodes, "Nodes to write out at most")
      ->type_name("N")
      ->check(CLI::Range(1, 20000));
  add_common(*tree, options, Overrides::seed_and_values);
  tree->callback([&] { code = run_tree(scene, tree_options, options); });

  SparringOptions sparring_options;
  CLI::App* sparring = app.add_subcommand(
      "sparring", "Every attack against every defense: records and the offense/defense table");
  sparring->add_option("LIBRARY", sparring_options.library,
                       "Manifest, folder, or the name of one in assets");
  sparring->add_option("--attacker", sparring_options.attacker, "Body of the attacker");
  sparring->add_option("--defender", sparring_options.defender, "Body of the defender");
  sparring
      ->add_option("--captures", sparring_options.captures,
                   "Two people of one capture space, instead of a library")
      ->type_name("A B")
      ->expected(2)
      ->excludes("LIBRARY");
  add_common(*sparring, options, Overrides::none);
  sparring->callback([&] { code = run_sparring(sparring_options, options); });

  add_study_command(app, add_common, options, code);

  BatchOptions batch_options;
  CLI::App* batch = app.add_subcommand(
      "batch", "Many bouts of a scene, a seed each: means and intervals; goes on where it stopped");
  batch->add_option("SCENE", scene, "Scene file, or the name of one in assets/scenes");
  batch->add_option("--count", batch_options.count, "Bouts; the first has the scene's seed")
      ->type_name("N")
      ->check(CLI::Range(1, 10000));
  add_common(*batch, options, Overrides::seed_and_values);
  batch->callback([&] { code = run_batch_command(scene, batch_options, options); });

  std::vector<std::string> folders;
  CLI::App* merge =
      app.add_subcommand("merge", "Put the bouts of several batches together, as one batch");
  merge->add_option("DIR", folders, "Folders that `batch` wrote")->required();
  add_common(*merge, options, Overrides::none);
  merge->callback([&] { code = run_merge(folders, options); });

  std::string events_file;
  CLI::App* replay = app.add_subcommand(
      "replay", "Recompute every hit of a fight from its events.jsonl; exit 1 where one differs");
  replay->add_option("EVENTS", events_file, "An events.jsonl")->required();
  add_for_stdout(*replay, options);
  replay->callback([&] { code = run_replay(events_file, options); });

  std::string library_name = "kickboxing";
  CLI::App* library = app.add_subcommand("library", "Make a motion library, look into it");
  library->require_subcommand(1);
  LibraryBuildOptions build_options;
  CLI::App* build =
      library->add_subcommand("build", "One library file from a manifest or a folder of captures");
  build
      ->add_option("SOURCE", build_options.source, "Manifest, folder, or the name of one in assets")
      ->required();
  build
      ->add_option("--responses-from", build_options.responses_from,
                   "Library that stands in for responses a folder of captures lacks, or none")
      ->type_name("NAME");
  build->add_flag("--not-mirrored", build_options.not_mirrored,
                  "No action also for the other side");
  auto* interpolated = build->add_flag("--interpolate", build_options.interpolate,
                                       "Blends between repetitions also of a manifest's actions");
  build
      ->add_flag("--not-interpolated", build_options.not_interpolated,
                 "No blends between a folder's repetitions")
      ->excludes(interpolated);
  build->add_flag("--not-connected", build_options.not_connected, "Without the motion graph");
  add_common(*build, options, Overrides::none);
  build->callback([&] { code = run_library_build(build_options, options); });
  InterpolateOptions interpolate_options;
  CLI::App* interpolate = library->add_subcommand(
      "interpolate", "How near blends of repetitions come to wanted targets, steps and turns");
  interpolate->add_option("LIBRARY", library_name,
                          "Library file, manifest, folder, or the name of one in assets");
  interpolate->add_option("--wanted", interpolate_options.wanted, "Wanted outcomes for each family")
      ->check(CLI::Range(1, 10000));
  add_common(*interpolate, options, Overrides::seed);
  interpolate->callback(
      [&] { code = run_library_interpolate(library_name, interpolate_options, options); });
  CLI::App* inspect = library->add_subcommand("inspect", "Every action as a filmstrip and a table");
  inspect->add_option("LIBRARY", library_name,
                      "Library file, manifest, folder, or the name of one in assets");
  add_common(*inspect, options, Overrides::none);
  inspect->get_option("--json")->excludes(inspect->get_option("--out"));  // writes no page
  inspect->callback([&] { code = run_library_inspect(library_name, options); });
  CheckHeights check_heights;
  CLI::App* check = library->add_subcommand("check", "Named faults of every action; exit 1 if any");
  check->add_option("LIBRARY", library_name,
                    "Library file, manifest, folder, or the name of one in assets");
  add_for_stdout(*check, options);
  check->add_option("--height", check_heights.own, "Height of the fighter, m")
      ->check(within(1.2, 2.3));
  check->add_option("--opponent", check_heights.opponent, "Height of the opponent, m")
      ->check(within(1.2, 2.3));
  check->callback([&] { code = run_library_check(library_name, check_heights, options); });

  std::string schema_name;
  CLI::App* schema = app.add_subcommand("schema", "Print a published JSON Schema");
  schema->add_option("SCHEMA", schema_name, "scene, style, body, manifest, sheet or profile")
      ->required();
  schema->callback([&] { code = run_schema(schema_name); });

  BenchOptions bench_options;
  CLI::App* bench = app.add_subcommand(
      "bench", "What a fight costs on this machine; a signature that no machine changes");
  bench->add_option("SCENE", scene, "Scene file, or the name of one in assets/scenes");
  bench->add_option("--duration", bench_options.duration_s, "Length of the fight, s")
      ->check(within(0.5, 3600.0));
  bench->add_option("--rounds", bench_options.rounds, "How often the fight is fought")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add_common(*bench, options, Overrides::seed_and_values);
  bench->callback([&] { code = run_bench_command(scene, bench_options, options); });

  ServeOptions serve_options;
  CLI::App* serve =
      app.add_subcommand("serve", "Show a folder of results in a browser, on this machine only");
  serve->add_option("DIR", serve_options.folder, "Folder of results");
  serve->add_option("--port", serve_options.port, "Port of 127.0.0.1; 0 takes any that is free")
      ->type_name("N")
      ->check(CLI::Range(0, 65535));
  add_talk(*serve, options);
  serve->callback([&] { code = run_serve(serve_options, options); });

  ViewOptions view_options;
  CLI::App* view =
      app.add_subcommand("view", "Open a page in the browser; a scene is fought before");
  view->add_option("FOLDER|PAGE|SCENE", view_options.what, "Folder of a result, page, or scene");
  view->add_flag("--print", view_options.print, "Print the address, open nothing");
  add_common(*view, options, Overrides::seed_and_values);
  view->callback([&] { code = run_view(view_options, options); });

  std::string shell;
  CLI::App* completion =
      app.add_subcommand("completion", "Print the script that completes commands in a shell");
  completion->add_option("SHELL", shell, "Whose script")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->callback([&] { code = run_completion(shell); });
  // What the scripts ask: `ringcraft complete-words ringcraft WORD...`, the last being typed.
  CLI::App* words = app.add_subcommand("complete-words")->group("")->prefix_command();
  words->callback([&] {
    std::vector<std::string> typed = words->remaining();
    if (!typed.empty()) typed.erase(typed.begin());
    fmt::print("{}", completion_lines(complete(app, typed)));
  });

  // Logs go to stderr, results to stdout or files.
  app.parse_complete_callback([&] {
    spdlog::set_default_logger(spdlog::stderr_logger_st("ringcraft"));
    spdlog::set_pattern("%n: %v");
    spdlog::set_level(options.verbose > 0 ? spdlog::level::info : spdlog::level::warn);
  });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ErrorKind::usage);
  }
  return code;
}

}  // namespace
}  // namespace ringcraft

int main(int argc, char** argv) {
  ringcraft::watch_signals();
  const auto nothing_delivered = [] {
    fmt::print(stderr, "ringcraft: stdout: what was asked for cannot be written; give it room\n");
    return static_cast<int>(ringcraft::ErrorKind::input);
  };
  try {
    const int code = ringcraft::run(argc, argv);
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 ? code : nothing_delivered();
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "ringcraft: {}; check the path and its permissions\n", error.what());
    return static_cast<int>(ringcraft::ErrorKind::input);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return nothing_delivered();
    fmt::print(stderr, "ringcraft: simulation failed: {}; please report this\n", error.what());
    return static_cast<int>(ringcraft::ErrorKind::simulation);
  }
}
