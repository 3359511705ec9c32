#include "cli/completion.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

#include "base/file.h"

namespace ringcraft {

namespace {

namespace fs = std::filesystem;

// What a value names, where the parser does not list its values.
struct Named {
  const char* option;  // a long name, or that of a positional
  const char* what;
  const char* folder;  // of the assets; null where no names are known
  const char* ending;  // of its files; empty for folders that hold a library.toml
  Completions::Paths paths;
  const char* joint = "";  // what stands between several names
};
using enum Completions::Paths;
constexpr std::array<Named, 17> kNamed = {{
    {"SCENE", "scene", "scenes", ".toml", files},
    {"--pairings", "style", "styles", ".toml", none, ":"},
    {"--body", "body", "bodies", ".toml", files},
    {"--attacker", "body", "bodies", ".toml", files},
    {"--defender", "body", "bodies", ".toml", files},
    {"LIBRARY", "library", "", "", files},
    {"SOURCE", "library", "", "", files},
    {"--library", "library", "", "", files},
    {"--responses-from", "library", "", "", files},
    {"--export-profile", "profile", "profiles", ".toml", none},
    {"SCHEMA", "schema", "schemas", ".schema.json", none},
    {"WHAT", "", nullptr, "", files},
    {"EVENTS", "", nullptr, "", files},
    {"--captures", "", nullptr, "", files},
    {"DIR", "", nullptr, "", folders},
    {"--out", "", nullptr, "", folders},
    {"FOLDER|PAGE|SCENE", "scene", "scenes", ".toml", files},
}};

const Named* named_by(const CLI::Option& option) {
  for (const Named& named : kNamed) {
    if (option.check_name(named.option)) return &named;
  }
  return nullptr;
}

// The names in a folder of the assets, sorted.
std::vector<Completion> names_of(const Named& named) {
  std::vector<Completion> names;
  if (named.folder == nullptr) return names;
  const std::string ending = named.ending;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(assets_folder() / named.folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (ending.empty()) {
      std::error_code unreadable;
      if (fs::exists(entry.path() / "library.toml", unreadable))
        names.push_back({name, named.what});
    } else if (name.size() > ending.size() && name.ends_with(ending)) {
      names.push_back({name.substr(0, name.size() - ending.size()), named.what});
    }
  }
  std::ranges::sort(names, {}, &Completion::word);
  return names;
}

// The values that the parser itself checks for: "FORMAT:{bvh,vrma}".
std::vector<Completion> listed_values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  std::vector<Completion> values;
  if (begin == std::string::npos || end == std::string::npos) return values;
  for (const std::string& value : CLI::detail::split(type.substr(begin + 1, end - begin - 1), ','))
    values.push_back({value, ""});
  return values;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

bool is_shown(const CLI::Option* option) {
  return !option->get_group().empty();
}

// Where a command line stands after its finished words.
struct Position {
  const CLI::App* command = nullptr;
  const CLI::Option* value_of = nullptr;  // the option whose value comes next
  std::size_t positionals = 0;            // already given to `command`
  bool only_positionals = false;          // after "--"
};

const CLI::Option* option_named(const CLI::App& command, const std::string& word) {
  return command.get_option_no_throw(word.substr(0, word.find('=')));
}

const CLI::App* subcommand_named(const CLI::App& command, const std::string& word) {
  const auto found = command.get_subcommands(
      [&](const CLI::App* one) { return one->get_name() == word && !one->get_group().empty(); });
  return found.empty() ? nullptr : found.front();
}

Position position_after(const CLI::App& app, const std::vector<std::string>& words) {
  Position at;
  at.command = &app;
  int wanted = 0;  // values that `value_of` still needs
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (wanted > 0) {
      if (--wanted == 0) at.value_of = nullptr;
    } else if (word == "--") {
      at.only_positionals = true;
    } else if (word.size() > 1 && word[0] == '-' && !at.only_positionals) {
      const CLI::Option* option = option_named(*at.command, word);
      if (option == nullptr || !takes_value(*option)) continue;
      wanted = std::max(1, option->get_items_expected_min());
      if (word.find('=') != std::string::npos) --wanted;
      at.value_of = wanted > 0 ? option : nullptr;
    } else if (const CLI::App* next = subcommand_named(*at.command, word)) {
      at.command = next;
      at.positionals = 0;
    } else {
      ++at.positionals;
    }
  }
  return at;
}

// The positional that the next bare word fills; null beyond the last.
const CLI::Option* positional_at(const CLI::App& command, std::size_t number) {
  const auto all =
      command.get_options([](const CLI::Option* option) { return option->get_positional(); });
  std::size_t before = 0;
  for (const CLI::Option* option : all) {
    const int most = option->get_items_expected_max();
    before += static_cast<std::size_t>(std::max(1, most));
    if (number < before) return option;
  }
  return nullptr;
}

class Collector {
 public:
  explicit Collector(std::string begun) : begun_(std::move(begun)) {}

  void add(const std::string& word, const std::string& says) {
    if (word.starts_with(begun_)) found_.words.push_back({word, says});
  }

  // Values of `option`, each behind `before`, which is "--export=" or "bvh," or nothing.
  void add_values(const CLI::Option& option, std::string before) {
    const Named* named = named_by(option);
    std::string joints = named != nullptr ? named->joint : "";
    if (option.get_delimiter() != '\0') joints += option.get_delimiter();
    const std::size_t last = begun_.find_last_of(joints);
    if (last != std::string::npos && last >= before.size()) before = begun_.substr(0, last + 1);
    for (const Completion& value : listed_values(option)) add(before + value.word, value.says);
    if (named == nullptr) return;
    for (const Completion& name : names_of(*named)) add(before + name.word, name.says);
    found_.paths = named->paths;
  }

  void add_options(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options(is_shown)) {
      for (const std::string& name : option->get_lnames())
        add("--" + name, option->get_description());
      for (const std::string& name : option->get_snames())
        add("-" + name, option->get_description());
    }
  }

  void add_commands(const CLI::App& command) {
    for (const CLI::App* one :
         command.get_subcommands([](const CLI::App* any) { return !any->get_group().empty(); })) {
      add(one->get_name(), one->get_description());
    }
  }

  bool nothing_to_offer() const {
    return found_.words.empty() && found_.paths == Completions::Paths::none;
  }
  Completions found() && { return std::move(found_); }

 private:
  std::string begun_;
  Completions found_;
};

constexpr const char* kBash =
    R"(# bash completion for ringcraft: source <(ringcraft completion bash)
_ringcraft() {
  local words=() lines=() line word i
  for ((i = 1; i <= COMP_CWORD; ++i)); do
    # bash breaks words at = and :, the command does not.
    if ((${#words[@]} > 0)) && [[ ${COMP_WORDS[i]} == [=:] || ${COMP_WORDS[i - 1]} == [=:] ]]; then
      words[${#words[@]} - 1]+=${COMP_WORDS[i]}
    else
      words+=("${COMP_WORDS[i]}")
    fi
  done
  local now=${COMP_WORDS[COMP_CWORD]}
  [[ $now == [=:] ]] && now=
  local whole=${words[${#words[@]} - 1]}
  local cut=$((${#whole} - ${#now}))
  mapfile -t lines < <("${COMP_WORDS[0]/#\~/$HOME}" complete-words ringcraft "${words[@]}" 2>/dev/null)
  COMPREPLY=()
  for line in "${lines[@]:1}"; do
    word=${line%%$'\t'*}
    COMPREPLY+=("${word:cut}")
  done
  case ${lines[0]-} in
    files | folders)
      local kind=-f
      [[ ${lines[0]} == folders ]] && kind=-d
      compopt -o filenames 2>/dev/null
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen "$kind" -- "$now")
      ;;
  esac
}
complete -F _ringcraft ringcraft
)";

constexpr const char* kZsh = R"(#compdef ringcraft
# zsh completion for ringcraft, after compinit: source <(ringcraft completion zsh)
_ringcraft() {
  local -a lines found
  local line program=${(Q)words[1]}
  lines=("${(@f)$("${program/#\~/$HOME}" complete-words ringcraft "${(@Q)words[2,CURRENT]}" 2>/dev/null)}")
  for line in "${(@)lines[2,-1]}"; do
    found+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
  done
  (( $#found )) && _describe -t words 'ringcraft' found
  case $lines[1] in
    files) _files ;;
    folders) _files -/ ;;
  esac
}
if [[ $funcstack[1] == _ringcraft ]]; then _ringcraft "$@"; else compdef _ringcraft ringcraft; fi
)";

constexpr const char* kFish = R"(# fish completion for ringcraft: ringcraft completion fish | source
function __ringcraft_words
    set -l words (commandline -opc)
    set -l now (commandline -ct)
    set -l program (string replace -r '^~' $HOME -- $words[1])
    set -e words[1]
    set -l lines ($program complete-words ringcraft $words "$now" 2>/dev/null)
    set -l paths $lines[1]
    set -e lines[1]
    test (count $lines) -gt 0; and printf '%s\n' $lines
    switch "$paths"
        case files
            __fish_complete_path "$now"
        case folders
            __fish_complete_directories "$now"
    end
end
complete -c ringcraft -f -a '(__ringcraft_words)'
)";

}  // namespace

Completions complete(const CLI::App& app, const std::vector<std::string>& words) {
  const std::string begun = words.empty() ? "" : words.back();
  const Position at = position_after(app, words);
  Collector collector(begun);
  if (at.value_of != nullptr) {
    collector.add_values(*at.value_of, "");
    return std::move(collector).found();
  }
  if (begun.starts_with('-') && !at.only_positionals) {
    const std::size_t equals = begun.find('=');
    const CLI::Option* option = option_named(*at.command, begun);
    if (equals == std::string::npos) {
      collector.add_options(*at.command);
    } else if (option != nullptr && takes_value(*option)) {
      collector.add_values(*option, begun.substr(0, equals + 1));
    }
    return std::move(collector).found();
  }
  collector.add_commands(*at.command);
  if (const CLI::Option* positional = positional_at(*at.command, at.positionals))
    collector.add_values(*positional, "");
  if (begun.empty() && collector.nothing_to_offer()) collector.add_options(*at.command);
  return std::move(collector).found();
}

std::string completion_lines(const Completions& completions) {
  constexpr std::array<const char*, 3> kPaths = {"none", "files", "folders"};
  std::string lines = kPaths[static_cast<std::size_t>(completions.paths)];
  lines += '\n';
  for (const Completion& one : completions.words) lines += one.word + '\t' + one.says + '\n';
  return lines;
}

Result<std::string> completion_script(const std::string& shell) {
  const std::map<std::string, const char*> scripts = {
      {"bash", kBash}, {"fish", kFish}, {"zsh", kZsh}};
  const auto found = scripts.find(shell);
  if (found == scripts.end())
    return usage_error("", "", "no script for '" + shell + "'", "choose bash, fish or zsh");
  return found->second;
}

}  // namespace ringcraft
