#include <fmt/format.h>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "scene/tree_file.h"
#include "scene/tree_svg.h"

namespace ringcraft {

int run_tree(const std::string& scene_name, const TreeOptions& tree, const CommonOptions& options) {
  const auto scene = scene_with(scene_name, options);
  if (!scene) return fail(scene.error());
  const auto folder = output_folder(options, with_name(kTreeFolder, scene->name),
                                    {"tree.json", "tree.svg"}, files_of(*scene));
  if (!folder) return fail(folder.error());
  const auto library = library_of(*scene);
  if (!library) return fail(library.error());

  FightOptions fight_options;
  fight_options.threads = options.threads;
  fight_options.interrupted = &interrupted;
  const auto found = tree_at(*library, *scene, tree.at_s, tree.nodes, fight_options);
  if (interrupted) return 130;
  if (!found) return fail(found.error());

  const std::string json = tree_json(*found);
  const auto written = write_files(*folder, {{"tree.json", json}, {"tree.svg", tree_svg(*found)}});
  if (!written) return fail(written.error());
  if (options.json) {
    fmt::print("{}", json);
  } else {
    fmt::print("{}{} and tree.json\n", tree_text(*found), (*folder / "tree.svg").string());
  }
  return 0;
}

}  // namespace ringcraft
