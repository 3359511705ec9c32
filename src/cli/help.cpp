#include "cli/help.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace ringcraft {

void say_defaults(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string usual = option->get_default_str();
    option->default_str("");  // CLI11 would say it before, between type and limits
    if (usual.empty() || usual == "[]" || option->get_required()) continue;
    option->description(fmt::format("{} [{}]", option->get_description(), usual));
  }
  for (CLI::App* below : command.get_subcommands({})) say_defaults(*below);
}

}  // namespace ringcraft
