#include "cli/scene_inputs.h"

#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "base/schema.h"
#include "capture/library_builder.h"
#include "capture/library_file.h"
#include "motion/feints.h"
#include "scene/fight.h"

namespace ringcraft {

namespace {

// Every attack that the scene's fighters may feign must be there, and leave the time for it.
Result<void> check_feints(const SceneFile& scene, const MotionLibrary& library) {
  for (const std::string& name : scene.feints) {
    const ActionId id = library.find(name);
    if (id.valid() && can_be_feigned(library.action(id))) continue;
    std::vector<std::string> known;
    for (const Action& action : library.actions()) {
      if (can_be_feigned(action)) known.push_back(action.name);
    }
    const std::string near = nearest_word(name, known);
    return usage_error(scene.path.string(), scene.feints_at,
                       fmt::format("feints: {} \"{}\" {}", id.valid() ? "action" : "no action",
                                   name, id.valid() ? "cannot be feigned" : "in the library"),
                       near.empty() ? "name an attack; `ringcraft library inspect` shows them all"
                                    : "did you mean \"" + near + "\"?");
  }
  return {};
}

}  // namespace

Result<void> one_source(const std::string& option, const std::string& key,
                        const std::vector<std::string>& sets) {
  for (const std::string& set : sets) {
    if (set.substr(0, set.find('=')) != key) continue;
    return usage_error("", option, fmt::format("--set {} says it, too", key),
                       "give one of the two");
  }
  return {};
}

Result<SceneFile> scene_with(const std::string& name_or_path, const CommonOptions& options,
                             const std::vector<std::string>& more) {
  if (options.seed) {
    if (auto one = one_source("--seed", "seed", options.sets); !one)
      return tl::unexpected(one.error());
  }
  std::vector<std::string> sets = options.sets;
  if (options.seed) sets.push_back(fmt::format("seed={}", *options.seed));
  sets.insert(sets.end(), more.begin(), more.end());
  return read_scene(name_or_path, sets);
}

std::vector<std::filesystem::path> files_of(const SceneFile& scene) {
  std::vector<std::filesystem::path> files = files_of_library(scene.library);
  files.insert(files.end(), scene.files.begin(), scene.files.end());
  for (const SceneFighter& fighter : scene.fighters) files.push_back(fighter.character);
  return files;
}

Result<MotionLibrary> library_for_blows(const std::filesystem::path& library) {
  auto loaded = load_library(library);
  if (!loaded || !loaded->responses().empty()) return loaded;
  return input_error(library.string(), "", "no action in it answers a blow",
                     "give it actions of kind 'response'; `ringcraft library check` says which");
}

void warn_without_attacks(const MotionLibrary& library, const std::filesystem::path& file) {
  if (library.count(Kind::attack) + library.count(Kind::combination) > 0) return;
  spdlog::warn(
      "{}: no attack in it: nobody who fights with it can strike; add captures of blows that "
      "begin and end near one guard, or name attacks in a manifest (docs/captures.md)",
      file.string());
}

std::string meant_action(const MotionLibrary& library, const std::string& name) {
  std::vector<std::string> known;
  known.reserve(library.actions().size());
  for (const Action& action : library.actions()) known.push_back(action.name);
  const std::string near = nearest_word(name, known);
  return near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
}

Result<MotionLibrary> library_of(const SceneFile& scene) {
  return library_of(scene, scene.library);
}

Result<MotionLibrary> library_of(const SceneFile& scene, const std::filesystem::path& library) {
  auto loaded = library_for_blows(library);
  if (!loaded) return tl::unexpected(loaded.error());
  warn_without_attacks(*loaded, library);
  if (auto done = check_feints(scene, *loaded); !done) return tl::unexpected(done.error());
  return library_for(scene, std::move(*loaded));
}

}  // namespace ringcraft
