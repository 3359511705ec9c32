#include "capture/library_file.h"

#include "base/file.h"
#include "capture/library_builder.h"

namespace ringcraft {

Result<MotionLibrary> load_library(const std::filesystem::path& library) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path manifest = library;
  if (!fs::exists(manifest, ignored) && !library.has_parent_path())
    manifest = assets_folder() / library;
  if (fs::is_directory(manifest, ignored)) manifest /= "library.toml";
  if (!fs::is_regular_file(manifest, ignored)) {
    return input_error(library.string(), "", "no motion library there",
                       "name a manifest (library.toml), its folder, or a folder of assets");
  }
  return build_library(manifest);
}

}  // namespace ringcraft
