#pragma once
// What numbers an option takes.

#include <charconv>
#include <cstdint>
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

// A whole number as people write it: CLI11 takes 010 for 8. To be used as a transform.
inline CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        std::uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [at, fault] = std::from_chars(text.data(), end, value);
        if (fault != std::errc() || at != end || value < least || value > most)
          return fmt::format("Value {} not in range {} to {}", text, least, most);
        text = std::to_string(value);
        return std::string();
      },
      fmt::format("INT in [{} - {}]", least, most));
}

}  // namespace ringcraft
