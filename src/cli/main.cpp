// The command `ringcraft`.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "base/schema.h"
#include "capture/library_builder.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/help.h"
#include "cli/ranges.h"
#include "cli/study_command.h"
#include "scene/single_hit.h"

namespace ringcraft {

namespace {

void add_talk(CLI::App& command, CommonOptions& options) {
  command.add_flag("-q,--quiet", options.quiet, "No progress");
  command.add_flag("-v,--verbose", options.verbose, "Say more");
}

// Of a command that writes no file.
void add_for_stdout(CLI::App& command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "Threads; never changes the result")
      ->transform(whole(1, 256));
  command.add_flag("--json", options.json, "Print the result as JSON on stdout");
  add_talk(command, options);
}

void add_common(CLI::App& command, CommonOptions& options, Overrides overrides,
                const std::string& usual_out) {
  command.add_option("-o,--out", options.out, "Output folder")
      ->type_name("DIR")
      ->default_str(usual_out);
  if (overrides != Overrides::none) {
    command
        .add_option("--seed", options.seed,
                    overrides == Overrides::seed ? "Seed of what is drawn at random"
                                                 : "Seed, instead of the scene's")
        ->type_name("N")
        ->transform(whole(0, kMostSeed));
  }
  if (overrides == Overrides::seed_and_values) {
    command.add_option("--set", options.sets, "Set one value: path.to.key=value (repeatable)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
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

std::shared_ptr<std::string> add_scene(CLI::App& command) {
  auto scene = std::make_shared<std::string>(kUsualScene);
  command.add_option("SCENE", *scene, "Scene file, or the name of one in assets/scenes");
  return scene;
}

std::shared_ptr<std::string> add_library(CLI::App& command) {
  auto library = std::make_shared<std::string>(kUsualLibrary);
  command.add_option("LIBRARY", *library,
                     "Library file, manifest, folder, or the name of one in assets");
  return library;
}

// Each adds one subcommand; `code` receives its exit code. What it is asked is shared with its
// callback, which runs when the function that added it has returned.

void add_fight(CLI::App& app, CommonOptions& options, int& code) {
  CLI::App* fight = app.add_subcommand("fight", "Simulate a scene: GLB, events, report and a page");
  const auto scene = add_scene(*fight);
  const auto asked = std::make_shared<FightCommandOptions>();
  fight->add_option("--export", asked->exports, "Also bvh or vrma, one file a fighter")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"bvh", "vrma"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  fight
      ->add_option("--export-profile", asked->profile,
                   "Names, axes and unit of the BVH: a file of assets/profiles")
      ->type_name("PROFILE")
      ->needs("--export");
  fight->add_flag("--root-motion", asked->root_motion,
                  "fight.glb moves each fighter's own node over the ground");
  add_common(*fight, options, Overrides::seed_and_values, kFightFolder);
  fight->callback([=, &options, &code] { code = run_fight(*scene, *asked, options); });
}

void add_hit(CLI::App& app, CommonOptions& options, int& code) {
  const auto asked = std::make_shared<HitOptions>();
  CLI::App* hit =
      app.add_subcommand("hit", "One hit on one body: the response, its numbers, GLB and page");
  hit->add_option("--pose", asked->pose, "The interrupted action and the seconds into it")
      ->type_name("ACTION@S");
  hit->add_option("--part", asked->part, "Struck body part");
  hit->add_option("--impulse", asked->impulse, "N s along the fighter's left, up and fore")
      ->type_name("X,Y,Z");
  hit->add_option("--strike", asked->strike, "A blow of a placed attacker, not an impulse")
      ->type_name("ACTION")
      ->excludes("--impulse");
  hit->add_option("--attacker", asked->attacker, "Body of the attacker, else as --body")
      ->needs("--strike");
  hit->add_option("--distance", asked->distance, "m between the two, else where it lands best")
      ->needs("--strike");
  hit->add_option("--sweep", asked->sweep, "A map over impulse (N s), direction (deg) or tone")
      ->type_name("AXIS=FROM:TO:STEP")
      ->excludes("--strike")
      ->allow_extra_args(false)
      ->take_all();
  hit->add_option("--tone", asked->tone, "Muscle tone")
      ->check(within(0.0, 1.0))
      ->default_str(fmt::format("{:g}", HitQuery{}.tone));
  hit->add_option("--body", asked->body, "A file of assets/bodies");
  hit->add_option("--library", asked->library, "Motion library");
  add_common(*hit, options, Overrides::none, kHitFolder);
  hit->callback([=, &options, &code] { code = run_hit(*asked, options); });
}

void add_tree(CLI::App& app, CommonOptions& options, int& code) {
  CLI::App* tree = app.add_subcommand("tree", "The game tree of one decision: JSON, SVG, a trace");
  const auto scene = add_scene(*tree);
  const auto asked = std::make_shared<TreeOptions>();
  tree->add_option("--at", asked->at_s, "The first decision from this time on, s")
      ->type_name("T")
      ->required();
  tree->add_option("--nodes", asked->nodes, "Nodes to write out at most")
      ->type_name("N")
      ->transform(whole(1, 20000));
  add_common(*tree, options, Overrides::seed_and_values, kTreeFolder);
  tree->callback([=, &options, &code] { code = run_tree(*scene, *asked, options); });
}

void add_sparring(CLI::App& app, CommonOptions& options, int& code) {
  const auto asked = std::make_shared<SparringOptions>();
  CLI::App* sparring = app.add_subcommand(
      "sparring", "Every attack against every defense: records and the offense/defense table");
  sparring->add_option("LIBRARY", asked->library,
                       "Library file, manifest, folder, or the name of one in assets");
  sparring->add_option("--attacker", asked->attacker, "Body of the attacker");
  sparring->add_option("--defender", asked->defender, "Body of the defender");
  sparring
      ->add_option("--captures", asked->captures,
                   "Two people of one capture space, instead of a library")
      ->type_name("A B")
      ->expected(2)
      ->excludes("LIBRARY")
      ->excludes("--defender");
  add_common(*sparring, options, Overrides::none, kSparringFolder);
  sparring->callback([=, &options, &code] { code = run_sparring(*asked, options); });
}

void add_batch(CLI::App& app, CommonOptions& options, int& code) {
  CLI::App* batch = app.add_subcommand(
      "batch", "Many bouts of a scene, a seed each: means and intervals; goes on where it stopped");
  const auto scene = add_scene(*batch);
  const auto asked = std::make_shared<BatchOptions>();
  batch->add_option("--count", asked->count, "Bouts; the first has the scene's seed")
      ->type_name("N")
      ->transform(whole(1, 10000));
  add_common(*batch, options, Overrides::seed_and_values, kBatchFolder);
  batch->callback([=, &options, &code] { code = run_batch_command(*scene, *asked, options); });
}

void add_merge(CLI::App& app, CommonOptions& options, int& code) {
  const auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* merge =
      app.add_subcommand("merge", "Put the bouts of several batches together, as one batch");
  merge->add_option("DIR", *folders, "Folders that `batch` wrote")->required();
  add_common(*merge, options, Overrides::none, kMergeFolder);
  merge->callback([=, &options, &code] { code = run_merge(*folders, options); });
}

void add_replay(CLI::App& app, CommonOptions& options, int& code) {
  const auto events = std::make_shared<std::string>();
  CLI::App* replay = app.add_subcommand(
      "replay", "Recompute every hit of a fight from its events.jsonl; exit 1 where one differs");
  replay->add_option("EVENTS", *events, "An events.jsonl")->required();
  add_for_stdout(*replay, options);
  replay->callback([=, &options, &code] { code = run_replay(*events, options); });
}

void add_library_build(CLI::App& library, CommonOptions& options, int& code) {
  const auto asked = std::make_shared<LibraryBuildOptions>();
  CLI::App* build =
      library.add_subcommand("build", "One library file from a manifest or a folder of captures");
  build->add_option("SOURCE", asked->source, "Manifest, folder, or the name of one in assets")
      ->required();
  build
      ->add_option("--responses-from", asked->responses_from,
                   "Library that stands in for responses a folder of captures lacks, or none")
      ->type_name("NAME")
      ->default_str(LibraryBuildSettings{}.responses_from);
  build->add_flag("--not-mirrored", asked->not_mirrored, "No action also for the other side");
  auto* interpolated = build->add_flag("--interpolate", asked->interpolate,
                                       "Blends between repetitions also of a manifest's actions");
  build
      ->add_flag("--not-interpolated", asked->not_interpolated,
                 "No blends between a folder's repetitions")
      ->excludes(interpolated);
  build->add_flag("--not-connected", asked->not_connected, "Without the motion graph");
  add_common(*build, options, Overrides::none, kBuiltLibrary);
  build->get_option("--out")->description("Library file to write")->type_name("FILE");
  build->callback([=, &options, &code] { code = run_library_build(*asked, options); });
}

void add_library_interpolate(CLI::App& library, CommonOptions& options, int& code) {
  CLI::App* interpolate = library.add_subcommand(
      "interpolate", "How near blends of repetitions come to wanted targets, steps and turns");
  const auto name = add_library(*interpolate);
  const auto asked = std::make_shared<InterpolateOptions>();
  interpolate->add_option("--wanted", asked->wanted, "Wanted outcomes for each family")
      ->transform(whole(1, 10000));
  add_common(*interpolate, options, Overrides::seed, "");
  interpolate->get_option("--seed")->default_str(fmt::format("{}", asked->seed));
  interpolate->callback(
      [=, &options, &code] { code = run_library_interpolate(*name, *asked, options); });
}

void add_library_inspect(CLI::App& library, CommonOptions& options, int& code) {
  CLI::App* inspect = library.add_subcommand("inspect", "Every action as a filmstrip and a table");
  const auto name = add_library(*inspect);
  add_common(*inspect, options, Overrides::none, kLibraryFolder);
  inspect->get_option("--json")->excludes(inspect->get_option("--out"));  // writes no page
  inspect->callback([=, &options, &code] { code = run_library_inspect(*name, options); });
}

void add_library_check(CLI::App& library, CommonOptions& options, int& code) {
  CLI::App* check = library.add_subcommand("check", "Named faults of every action; exit 1 if any");
  const auto name = add_library(*check);
  const auto heights = std::make_shared<CheckHeights>();
  add_for_stdout(*check, options);
  check->add_option("--height", heights->own, "Height of the fighter, m")->check(within(1.2, 2.3));
  check->add_option("--opponent", heights->opponent, "Height of the opponent, m")
      ->check(within(1.2, 2.3));
  check->callback([=, &options, &code] { code = run_library_check(*name, *heights, options); });
}

void add_library_commands(CLI::App& app, CommonOptions& options, int& code) {
  CLI::App* library = app.add_subcommand("library", "Make a motion library, look into it");
  library->require_subcommand(1);
  add_library_build(*library, options, code);
  add_library_interpolate(*library, options, code);
  add_library_inspect(*library, options, code);
  add_library_check(*library, options, code);
}

void add_schema(CLI::App& app, int& code) {
  const auto name = std::make_shared<std::string>();
  CLI::App* schema = app.add_subcommand("schema", "Print a published JSON Schema");
  schema->add_option("SCHEMA", *name, "scene, style, body, manifest, sheet or profile")->required();
  schema->callback([=, &code] { code = run_schema(*name); });
}

void add_bench(CLI::App& app, CommonOptions& options, int& code) {
  CLI::App* bench = app.add_subcommand(
      "bench", "What a fight costs on this machine; a signature that no machine changes");
  const auto scene = add_scene(*bench);
  const auto asked = std::make_shared<BenchOptions>();
  bench->add_option("--duration", asked->duration_s, "Length of the fight, s")
      ->check(within(0.5, 3600.0))
      ->default_str(fmt::format("{:g}", kBenchSeconds));
  bench->add_option("--rounds", asked->rounds, "How often the fight is fought")
      ->type_name("N")
      ->transform(whole(1, 1000));
  add_common(*bench, options, Overrides::seed_and_values, kBenchFolder);
  bench->callback([=, &options, &code] { code = run_bench_command(*scene, *asked, options); });
}

void add_serve(CLI::App& app, CommonOptions& options, int& code) {
  const auto asked = std::make_shared<ServeOptions>();
  CLI::App* serve =
      app.add_subcommand("serve", "Show a folder of results in a browser, on this machine only");
  serve->add_option("DIR", asked->folder, "Folder of results");
  serve->add_option("--port", asked->port, "Port of 127.0.0.1; 0 takes any that is free")
      ->type_name("N")
      ->transform(whole(0, 65535));
  add_talk(*serve, options);
  serve->callback([=, &options, &code] { code = run_serve(*asked, options); });
}

void add_view(CLI::App& app, CommonOptions& options, int& code) {
  const auto asked = std::make_shared<ViewOptions>();
  CLI::App* view =
      app.add_subcommand("view", "Open a page in the browser; a scene is fought before");
  view->add_option("FOLDER|PAGE|SCENE", asked->what, "Folder of a result, page, or scene");
  view->add_flag("--print", asked->print, "Print the address, open nothing");
  add_common(*view, options, Overrides::seed_and_values, kFightFolder);
  view->remove_option(view->get_option("--json"));  // stdout has the address
  view->callback([=, &options, &code] {
    asked->threads = view->count("--threads") > 0;
    code = run_view(*asked, options);
  });
}

void add_completion(CLI::App& app, int& code) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      app.add_subcommand("completion", "Print the script that completes commands in a shell");
  completion->add_option("SHELL", *shell, "Whose script")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->callback([=, &code] { code = run_completion(*shell); });
  // What the scripts ask: `ringcraft complete-words ringcraft WORD...`, the last being typed.
  CLI::App* words = app.add_subcommand("complete-words")->group("")->prefix_command();
  words->callback([&app, words] {
    std::vector<std::string> typed = words->remaining();
    if (!typed.empty()) typed.erase(typed.begin());
    fmt::print("{}", completion_lines(complete(app, typed)));
  });
}

// An empty path would be the folder in which ringcraft runs, or that of the assets.
void refuse_empty_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty())
        throw CLI::ValidationError(option->get_name(), "an empty value names nothing");
    }
  }
  for (const CLI::App* used : app.get_subcommands()) refuse_empty_values(*used);
}

// What was wrong with the command line, and where help is.
Error misuse(const CLI::App& whole, const CLI::Error& error) {
  std::string named = whole.get_name();
  const CLI::App* at = &whole;
  while (!at->get_subcommands().empty()) {
    at = at->get_subcommands().front();
    named += " " + at->get_name();
  }
  const std::string help = fmt::format("`{} --help` says what there is", named);
  const std::vector<std::string> unknown = at->remaining();
  if (at->get_require_subcommand_min() == 0 || unknown.empty())
    return {ErrorKind::usage, "", "", error.what(), help};
  std::vector<std::string> commands;
  for (const CLI::App* command : at->get_subcommands({})) commands.push_back(command->get_name());
  const std::string near = nearest_word(unknown.front(), commands);
  return {ErrorKind::usage, "", "", fmt::format("no command '{}'", unknown.front()),
          near.empty() ? help : fmt::format("did you mean '{}'? {}", near, help)};
}

int run(int argc, char** argv) {
  CLI::App app("Fights in which hits are physical.", "ringcraft");
  app.set_version_flag("--version", RINGCRAFT_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* whole, const CLI::Error& error) {
    return fmt::format("ringcraft: {}\n", to_string(misuse(*whole, error)));
  });
  app.option_defaults()->always_capture_default();  // for say_defaults
  CommonOptions options;
  options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  int code = 0;

  add_fight(app, options, code);
  add_hit(app, options, code);
  add_tree(app, options, code);
  add_sparring(app, options, code);
  add_study_command(app, add_common, options, code);
  add_batch(app, options, code);
  add_merge(app, options, code);
  add_replay(app, options, code);
  add_library_commands(app, options, code);
  add_schema(app, code);
  add_bench(app, options, code);
  add_serve(app, options, code);
  add_view(app, options, code);
  add_completion(app, code);
  say_defaults(app);

  // Logs go to stderr, results to stdout or files.
  app.parse_complete_callback([&] {
    refuse_empty_values(app);
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

// What is opened gets the number of no standard stream that is closed: no text gets into it.
void keep_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace
}  // namespace ringcraft

int main(int argc, char** argv) {
  ringcraft::keep_standard_streams();
  ringcraft::watch_signals();
  const auto nothing_delivered = [] {
    ringcraft::tell("ringcraft: stdout: what was asked for cannot be written; give it room\n");
    return static_cast<int>(ringcraft::ErrorKind::input);
  };
  try {
    const int code = ringcraft::run(argc, argv);
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 ? code : nothing_delivered();
  } catch (const std::filesystem::filesystem_error& error) {
    ringcraft::tell("ringcraft: {}; check the path and its permissions\n", error.what());
    return static_cast<int>(ringcraft::ErrorKind::input);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return nothing_delivered();
    ringcraft::tell("ringcraft: simulation failed: {}; please report this\n", error.what());
    return static_cast<int>(ringcraft::ErrorKind::simulation);
  }
}
