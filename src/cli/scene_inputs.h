#pragma once
// What every command that runs a scene reads first.

#include <string>
#include <vector>

#include "cli/commands.h"
#include "motion/library.h"
#include "scene/scene_file.h"

namespace ringcraft {

// A usage error where --set gives `key`, which `option` gives already.
Result<void> one_source(const std::string& option, const std::string& key,
                        const std::vector<std::string>& sets);

// The scene of that name or path with the command's --set, --seed and `more`, in this order.
Result<SceneFile> scene_with(const std::string& name_or_path, const CommonOptions& options,
                             const std::vector<std::string>& more = {});

// Every file that the scene and its library name, themselves included.
std::vector<std::filesystem::path> files_of(const SceneFile& scene);

// A library in which who is struck finds an answer.
Result<MotionLibrary> library_for_blows(const std::filesystem::path& library);

// Says so where nobody could strike with a library, which was read from or written to `file`.
void warn_without_attacks(const MotionLibrary& library, const std::filesystem::path& file);

// "did you mean 'cross'? " where the library has an action of nearly that name, else "".
std::string meant_action(const MotionLibrary& library, const std::string& name);

// The scene's library, as its fighters need it (library_for).
Result<MotionLibrary> library_of(const SceneFile& scene);
// Another library for the same fighters.
Result<MotionLibrary> library_of(const SceneFile& scene, const std::filesystem::path& library);

}  // namespace ringcraft
