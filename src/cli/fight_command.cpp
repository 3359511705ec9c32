#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "capture/character.h"
#include "capture/profile.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "io/outputs.h"
#include "scene/fight.h"
#include "scene/fight_files.h"

namespace ringcraft {

namespace {

// The characters that the scene names, each file read once; null where a fighter has none.
Result<std::vector<std::shared_ptr<const Character>>> characters_of(const SceneFile& scene) {
  std::vector<std::shared_ptr<const Character>> characters;
  std::map<std::filesystem::path, std::shared_ptr<const Character>> known;
  for (const SceneFighter& fighter : scene.fighters) {
    if (fighter.character.empty()) {
      characters.push_back(nullptr);
      continue;
    }
    std::shared_ptr<const Character>& kept = known[fighter.character];
    if (!kept) {
      auto character = read_character(fighter.character);
      if (!character) return tl::unexpected(character.error());
      for (const std::string& note : character->notes)
        spdlog::info("{}: {}", character->file, note);
      kept = std::make_shared<const Character>(std::move(*character));
    }
    characters.push_back(kept);
  }
  return characters;
}

Result<ForeignSkeleton> export_skeleton(const std::string& profile) {
  if (profile.empty()) return vrm_skeleton();
  return profile_named(profile).map(foreign_skeleton).map_error([](Error error) {
    if (error.file.empty()) error.file = "--export-profile";
    return error;
  });
}

}  // namespace

int run_fight(const std::string& scene_name, const FightCommandOptions& fight,
              const CommonOptions& options) {
  const auto scene = scene_with(scene_name, options);
  if (!scene) return fail(scene.error());
  const auto wants = [&](std::string_view format) {
    return std::find(fight.exports.begin(), fight.exports.end(), format) != fight.exports.end();
  };
  if (!fight.profile.empty() && !wants("bvh")) {
    return fail({ErrorKind::usage, "", "--export-profile",
                 "no BVH is asked for that it would be of", "add bvh to --export"});
  }
  if (const auto page = page_template(); !page) return fail(page.error());
  const auto skeleton = export_skeleton(fight.profile);
  if (!skeleton) return fail(skeleton.error());
  const auto characters = characters_of(*scene);
  if (!characters) return fail(characters.error());
  FightExtras extras{{}, wants("vrma"), fight.root_motion, *characters};
  if (wants("bvh")) extras.bvh = *skeleton;
  const auto folder =
      output_folder(options, with_name(kFightFolder, scene->name),
                    fight_file_names(scene->fighters.size(), extras), files_of(*scene));
  if (!folder) return fail(folder.error());
  const auto library = library_of(*scene);
  if (!library) return fail(library.error());

  spdlog::info("library {}: {} actions, {} dropped, hash {:016x}", library->name(),
               library->actions().size(), library->dropped().size(), library->hash());
  for (const std::string& dropped : library->dropped()) spdlog::info("dropped {}", dropped);

  FightOptions fight_options;
  fight_options.threads = options.threads;
  fight_options.interrupted = &interrupted;
  if (!options.quiet) {
    fight_options.progress = [&](Tick now, Tick end) {
      tell("\r{}: {:.0f} of {:g} s", scene->name, seconds(now), seconds(end));
    };
  }
  const auto begin = std::chrono::steady_clock::now();
  const FightRecord record = simulate_fight(*library, *scene, fight_options);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  if (!options.quiet) tell("\n");

  std::error_code failed;
  const bool fought_before = std::filesystem::is_regular_file(*folder / "report.json", failed);
  const auto summary =
      write_fight(*folder, *scene, *library, record, wall.count(), options.threads, extras);
  if (!summary) return fail(summary.error());
  if (fought_before) {  // else such files are somebody's own
    remove_old_exports(*folder, scene->fighters.size(), extras, files_of(*scene));
  }
  const std::string& said = options.json ? summary->report : summary->text;
  if (options.summary_to_stderr) {
    tell("{}\n", said);
  } else {
    fmt::print("{}\n", said);
  }
  return record.interrupted ? 130 : 0;
}

}  // namespace ringcraft
