#pragma once
// What may follow a command line that is being typed. It is read from the parser itself and from
// the assets, so it knows every command, option and name there is; the scripts for the shells only
// ask.

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace CLI {
class App;
}

namespace ringcraft {

struct Completion {
  std::string word, says;
};

struct Completions {
  enum class Paths : std::uint8_t { none, files, folders };
  std::vector<Completion> words;
  Paths paths = Paths::none;  // what the shell adds from the disk
};

// What may stand in place of the last word; the words begin after the program's name.
Completions complete(const CLI::App& app, const std::vector<std::string>& words);

// "none", "files" or "folders", then a line for each word: the word, a tab, what it is.
std::string completion_lines(const Completions& completions);

// The script for bash, zsh or fish.
Result<std::string> completion_script(const std::string& shell);

}  // namespace ringcraft
