#pragma once
// What numbers an option takes.

#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace ringcraft {

// CLI::Range lets what is no number through: `nan` compares with nothing.
inline CLI::Validator within(double least, double most) {
  const std::string range = fmt::format("FLOAT in [{:g} - {:g}]", least, most);
  return CLI::Validator(
      [least, most, range](const std::string& text) {
        double value = 0;
        const bool inside =
            CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? std::string() : fmt::format("{} is no {}", text, range);
      },
      range);
}

}  // namespace ringcraft
