// What a project beside ringcraft builds (README, "Use it as a library"); a test configures it.
#include <fmt/format.h>

#include "base/file.h"
#include "capture/library_builder.h"

int main() {
  const auto library =
      ringcraft::build_library(ringcraft::assets_folder() / "kickboxing" / "library.toml");
  fmt::print("{} actions\n", library ? library->actions().size() : 0);
  return library ? 0 : 3;
}
