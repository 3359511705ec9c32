#include "cli/scene_inputs.h"

#include <utility>

#include <fmt/format.h>

#include "capture/library_file.h"
#include "scene/fight.h"

namespace ringcraft {

Result<SceneFile> scene_with(const std::string& name_or_path, const CommonOptions& options,
                             const std::vector<std::string>& more) {
  std::vector<std::string> sets = options.sets;
  if (options.seed) sets.push_back(fmt::format("seed={}", *options.seed));
  sets.insert(sets.end(), more.begin(), more.end());
  return read_scene(name_or_path, sets);
}

Result<MotionLibrary> library_of(const SceneFile& scene) {
  auto loaded = load_library(scene.library);
  if (!loaded) return tl::unexpected(loaded.error());
  return library_for(scene, std::move(*loaded));
}

}  // namespace ringcraft
