#include "base/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

// Debian's toml++ 3.3 meets some faulty inputs with a failed assertion ("[[[a]]]": issue 301 of
// marzer/tomlplusplus) or, with NDEBUG, with undefined behaviour. Here it throws instead.
#undef NDEBUG
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#define TOML_ASSERT(expression) ringcraft::expect(static_cast<bool>(expression))
namespace ringcraft {
static constexpr void expect(bool holds) {
  if (!holds) throw std::logic_error("toml++ met what it did not expect");
}
}  // namespace ringcraft
#include <toml++/toml.h>

#include "base/file.h"
#include "base/schema.h"
#include "base/utf8.h"

namespace ringcraft {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestDocument = 4u << 20;  // bytes
constexpr int kDeepest = 32;                        // tables and arrays inside one another
constexpr int kMostIndex = 10'000;                  // largest array index of --set

std::string line_place(const toml::source_region& region) {
  return fmt::format("line {}, column {}", region.begin.line, region.begin.column);
}

// Index of the last character of the TOML string or comment that begins at `i`, or `i`.
std::size_t end_of_text(std::string_view text, std::size_t i) {
  const char c = text[i];
  if (c == '#') return std::min(text.find('\n', i), text.size()) - 1;
  if (c != '"' && c != '\'') return i;
  const std::string mark(text.substr(i, 3) == std::string(3, c) ? 3 : 1, c);
  for (i += mark.size(); i < text.size() && text.substr(i, mark.size()) != mark; ++i) {
    if (mark.size() == 1 && text[i] == '\n') return i - 1;  // not closed
    if (c == '"' && text[i] == '\\') ++i;
  }
  i += mark.size() - 1;
  // Up to two more quotation marks belong to a block that they end.
  while (mark.size() == 3 && i + 1 < text.size() && text[i + 1] == c) ++i;
  return std::min(i, text.size());
}

// What toml++ must not see. It bounds nested values but not dotted keys, and a table a million deep
// exhausts the stack when it is destroyed; and some characters beyond ASCII, which may only stand
// in strings and comments, lead it into undefined behaviour.
Result<void> first_look(std::string_view text, const std::string& file) {
  int line = 1, parts = 1;
  for (std::size_t i = text.starts_with("\xef\xbb\xbf") ? 3 : 0; i < text.size(); ++i) {
    const std::size_t end = end_of_text(text, i);
    const bool is_text = end != i;
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                        text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    i = end;
    if (is_text || i >= text.size()) continue;
    const char c = text[i];
    if ((c & 0x80) != 0) {
      return usage_error(file, fmt::format("line {}", line),
                         "not valid TOML: a character beyond ASCII outside of quotes",
                         "put it in quotes");
    }
    if (c == '.' && ++parts > kDeepest) {
      return usage_error(file, fmt::format("line {}", line), "a dotted key is nested too deeply",
                         fmt::format("keep it within {} levels", kDeepest));
    }
    if (std::string_view(",=[]{}\n").find(c) != std::string_view::npos) parts = 1;
    if (c == '\n') ++line;
  }
  return {};
}

// TOML as JSON, with the line of every value.
class Converter {
 public:
  Converter(std::string file, std::map<std::string, int>& lines)
      : file_(std::move(file)), lines_(lines) {}

  Result<json> convert(const toml::node& node, const std::string& pointer, int depth) {
    if (depth > kDeepest) {
      return usage_error(file_, line_place(node.source()), "nested too deeply",
                         fmt::format("keep it within {} levels", kDeepest));
    }
    if (!lines_.contains(pointer)) lines_[pointer] = static_cast<int>(node.source().begin.line);
    if (const auto* table = node.as_table()) return convert_table(*table, pointer, depth);
    if (const auto* array = node.as_array()) return convert_array(*array, pointer, depth);
    if (const auto* text = node.as_string()) return json(text->get());
    if (const auto* number = node.as_integer()) return json(number->get());
    if (const auto* flag = node.as_boolean()) return json(flag->get());
    if (const auto* number = node.as_floating_point()) {
      if (std::isfinite(number->get())) return json(number->get());
      return usage_error(file_, line_place(node.source()), "the number is not finite",
                         "write a finite number");
    }
    return usage_error(file_, line_place(node.source()), "dates and times have no use here",
                       "put the value in quotes if a text is meant");
  }

 private:
  Result<json> convert_table(const toml::table& table, const std::string& pointer, int depth) {
    json object = json::object();
    for (const auto& [key, child] : table) {
      const std::string at = json_pointer(pointer, key.str());
      if (key.source().begin.line > 0) lines_[at] = static_cast<int>(key.source().begin.line);
      auto value = convert(child, at, depth + 1);
      if (!value) return value;
      object[std::string(key.str())] = std::move(*value);
    }
    return object;
  }

  Result<json> convert_array(const toml::array& array, const std::string& pointer, int depth) {
    json list = json::array();
    for (const toml::node& child : array) {
      auto value = convert(child, json_pointer(pointer, std::to_string(list.size())), depth + 1);
      if (!value) return value;
      list.push_back(std::move(*value));
    }
    return list;
  }

  std::string file_;
  std::map<std::string, int>& lines_;
};

// The line in which toml++ meets what it did not expect: the last one of the shortest text that
// fails so. Lines are read in order, so bisection finds it.
int unexpected_line(std::string_view text) {
  std::vector<std::size_t> ends;  // of the lines
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ends.push_back(i + 1);
  }
  ends.push_back(text.size());
  const auto is_before = [&](std::size_t end) {
    try {
      static_cast<void>(toml::parse(text.substr(0, end)));
    } catch (const toml::parse_error&) {
    } catch (const std::logic_error&) {
      return false;
    }
    return true;
  };
  const auto line = std::partition_point(ends.begin(), ends.end(), is_before);
  return static_cast<int>(line - ends.begin()) + 1;
}

Result<Document> parse(const std::string& text, const std::filesystem::path& path) {
  Document document{path, {}, {}};
  if (text.size() > kLargestDocument) {
    return usage_error(path.string(), "", "larger than 4 MiB", "split it");
  }
  if (auto fine = first_look(text, path.string()); !fine) return tl::unexpected(fine.error());
  try {
    const toml::table parsed = toml::parse(std::string_view(text), path.string());
    auto value = Converter(path.string(), document.lines).convert(parsed, "", 0);
    if (!value) return tl::unexpected(value.error());
    document.value = std::move(*value);
  } catch (const toml::parse_error& fault) {
    const std::string place = line_place(fault.source());
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin != std::string::npos && text[begin] == '{')
      return usage_error(path.string(), place, "JSON, and no TOML", "name a TOML file");
    return usage_error(path.string(), place, "not valid TOML: " + std::string(fault.description()),
                       "correct the syntax there");
  } catch (const std::logic_error&) {
    return usage_error(path.string(), fmt::format("line {}", unexpected_line(text)),
                       "not valid TOML: unexpected character", "correct the syntax there");
  }
  return document;
}

Result<json> read_schema(const std::string& schema) {
  auto text = schema_text(schema);
  if (!text) return tl::unexpected(text.error());
  json value = json::parse(*text, nullptr, false);
  if (!value.is_object()) {
    return input_error(schema + ".schema.json", "", "not a JSON schema", "restore assets/schemas");
  }
  return value;
}

// Whether a text is a number, be it one that TOML has no form for: 010, .5, 1e999.
bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() && text.find_first_of("0123456789") != std::string::npos;
}

// The value of --set: TOML, or the text itself where it is a bare word.
Result<json> set_text(const std::string& text, const std::string& assignment) {
  if (text.find_first_of("\n\r") == std::string::npos) {
    const auto document = parse("value = " + text + "\n", "--set");
    if (document && document->value.size() == 1) return document->value["value"];
    if (!document && is_number(text)) {
      return usage_error("--set " + assignment, "", document.error().what,
                         "write a number as 7 or 0.5, or text in quotes");
    }
    const bool bare = !text.empty() && std::string("\"'[{").find(text[0]) == std::string::npos;
    const bool has_sign = text.starts_with('+') || text.starts_with('-');
    const std::string word = text.substr(has_sign ? 1 : 0);
    if (bare && word != "inf" && word != "nan") return json(text);
  }
  return usage_error(
      "--set " + assignment, "", "the value is not valid",
      "write path.to.key=value with a finite number, true, false, \"text\" or [list]");
}

std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps;
  std::size_t from = 0;
  for (std::size_t dot = 0; dot != std::string::npos; from = dot + 1) {
    dot = path.find('.', from);
    steps.push_back(path.substr(from, dot == std::string::npos ? dot : dot - from));
  }
  return steps;
}

// The child of `at` that `step` names; made where it is missing. Null where it cannot be.
json* child_of(json& at, const std::string& step) {
  if (at.is_null()) at = json::object();
  if (at.is_object()) return &at[step];
  if (!at.is_array()) return nullptr;
  int index = -1;
  const auto [end, failed] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (failed != std::errc() || end != step.data() + step.size()) return nullptr;
  if (index < 0 || index > kMostIndex || index > static_cast<int>(at.size())) return nullptr;
  if (index == static_cast<int>(at.size())) at.push_back(json());
  return &at[static_cast<std::size_t>(index)];
}

}  // namespace

std::string Document::place(const std::string& pointer) const {
  const auto line = lines.find(pointer);
  if (line == lines.end()) return {};
  return line->second == 0 ? "--set" : fmt::format("line {}", line->second);
}

Result<Document> read_document(const std::filesystem::path& path, const std::string& schema) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_document(*text, path, schema);
}

Result<Document> parse_document(const std::string& text, const std::filesystem::path& path,
                                const std::string& schema) {
  auto document = parse(text, path);
  if (!document) return document;
  if (const auto valid = checked(*document, schema); !valid) return tl::unexpected(valid.error());
  return document;
}

Result<void> set_value(Document& document, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    return usage_error("--set " + assignment, "", "not an assignment", "write path.to.key=value");
  }
  if (!is_utf8(assignment)) {
    return usage_error("--set " + clean_name(assignment), "", "not UTF-8",
                       "write the value in UTF-8, as the terminal does in a UTF-8 locale");
  }
  const auto value = set_text(assignment.substr(equals + 1), assignment);
  if (!value) return tl::unexpected(value.error());
  const auto steps = steps_of(assignment.substr(0, equals));
  if (steps.size() > kDeepest) {
    return usage_error("--set " + assignment, "", "nested too deeply", "shorten the path");
  }
  Document changed = document;
  json* at = &changed.value;
  std::string pointer;
  for (const std::string& step : steps) {
    at = step.empty() ? nullptr : child_of(*at, step);
    if (at == nullptr) {
      return usage_error("--set " + assignment, "", "no such place: '" + step + "'",
                         "name keys and array indices that exist, as in fighter.0.horizon_s=2");
    }
    pointer = json_pointer(pointer, step);
    changed.lines.try_emplace(pointer, 0);
  }
  *at = *value;
  // Lines of what stood below are gone; 0 says that the value came from --set.
  std::erase_if(changed.lines, [&](const auto& l) { return l.first.starts_with(pointer + "/"); });
  changed.lines[pointer] = 0;
  document = std::move(changed);
  return {};
}

Result<void> checked(const Document& document, const std::string& schema) {
  const auto rules = read_schema(schema);
  if (!rules) return tl::unexpected(rules.error());
  return check_schema(document, *rules);
}

Result<std::string> schema_text(const std::string& schema) {
  const std::string ending = ".schema.json";
  const std::filesystem::path folder = assets_folder() / "schemas";
  std::vector<std::string> known;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(ending)) known.push_back(name.substr(0, name.size() - ending.size()));
  }
  std::sort(known.begin(), known.end());
  if (std::find(known.begin(), known.end(), schema) != known.end()) {
    return read_file(folder / (schema + ending));
  }
  if (known.empty()) {
    return input_error(folder.string(), "", "no schemas there",
                       "set RINGCRAFT_ASSETS to ringcraft's folder assets");
  }
  return usage_error("", "", "no schema is called '" + schema + "'",
                     fmt::format("known schemas: {}", fmt::join(known, ", ")));
}

}  // namespace ringcraft
