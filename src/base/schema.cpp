#include "base/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace ringcraft {
namespace {

using nlohmann::json;

// Longest string that is matched against a pattern: std::regex recurses once per character.
constexpr std::size_t kLongestMatched = 512;
// References that are followed one after the other before the schema is called circular.
constexpr int kMostReferences = 16;

enum class FaultKind { unknown_key, other };

struct Fault {
  FaultKind kind = FaultKind::other;
  int line = 0;  // 0 where the place has no line
  std::string place;
  std::string what;
  std::string remedy;
};

// "/fighter/0/style" as a person writes it after --set: "fighter.0.style".
std::string key_path(const std::string& pointer) {
  std::string path;
  for (std::size_t i = 1; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      path += '.';
    } else if (pointer[i] == '~' && i + 1 < pointer.size()) {
      path += pointer[++i] == '1' ? '/' : '~';
    } else {
      path += pointer[i];
    }
  }
  return path;
}

std::string type_word(const json& value) {
  if (value.is_object()) return "a table";
  if (value.is_array()) return "an array";
  if (value.is_string()) return "a string";
  if (value.is_boolean()) return "a boolean";
  if (value.is_number_integer()) return "an integer";
  if (value.is_number()) return "a number";
  return "nothing";
}

std::string type_word(const std::string& schema_type) {
  if (schema_type == "object") return "a table";
  if (schema_type == "array") return "an array";
  if (schema_type == "string") return "a string";
  if (schema_type == "boolean") return "a boolean (true or false)";
  if (schema_type == "integer") return "an integer";
  return "a number";
}

bool has_type(const json& value, const std::string& schema_type) {
  if (schema_type == "object") return value.is_object();
  if (schema_type == "array") return value.is_array();
  if (schema_type == "string") return value.is_string();
  if (schema_type == "boolean") return value.is_boolean();
  if (schema_type == "integer") return value.is_number_integer();
  if (schema_type == "number") return value.is_number();
  return false;
}

std::vector<std::string> types_of(const json& schema) {
  const auto type = schema.find("type");
  if (type == schema.end()) return {};
  if (type->is_string()) return {type->get<std::string>()};
  return type->get<std::vector<std::string>>();
}

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

// "a number above 0 and at most 5"
std::string range_words(const json& schema) {
  std::string words;
  const auto limit = [&](const char* key, const char* before) {
    const auto at = schema.find(key);
    if (at == schema.end()) return;
    words += (words.empty() ? " " : " and ") + std::string(before) + " " + at->dump();
  };
  limit("exclusiveMinimum", "above");
  limit("minimum", "at least");
  limit("maximum", "at most");
  limit("exclusiveMaximum", "below");
  return words;
}

std::string allowed_words(const json& schema) {
  if (const auto choices = schema.find("enum"); choices != schema.end()) {
    std::string words = "one of ";
    for (std::size_t i = 0; i < choices->size(); ++i) {
      words += (i == 0 ? "" : ", ") + shown((*choices)[i]);
    }
    return words;
  }
  std::string words;
  for (const std::string& type : types_of(schema)) {
    words += (words.empty() ? "" : " or ") + type_word(type);
  }
  if (words.empty()) words = "a value";
  return words + range_words(schema);
}

std::string remedy_for(const json& schema) {
  std::string words = "write " + allowed_words(schema);
  if (const auto text = schema.find("description"); text != schema.end()) {
    words += " (" + text->get<std::string>() + ")";
  }
  return words;
}

// Walks document and schema together and collects every fault.
class Checker {
 public:
  Checker(const Document& document, const json& schema) : document_(document), root_(schema) {}

  std::vector<Fault> faults() {
    check(document_.value, root_, "");
    return std::move(faults_);
  }

 private:
  const json& resolved(const json& schema) const {
    const json* at = &schema;
    for (int i = 0; i < kMostReferences; ++i) {
      const auto reference = at->find("$ref");
      if (reference == at->end()) return *at;
      at = &root_.at(json::json_pointer(reference->get<std::string>().substr(1)));
    }
    throw std::runtime_error("circular $ref");
  }

  void add(FaultKind kind, const std::string& pointer, std::string what, std::string remedy) {
    // A value without a line of its own stands where its nearest parent stands.
    std::string at = pointer;
    while (!at.empty() && !document_.lines.contains(at)) at.resize(at.rfind('/'));
    const auto line = document_.lines.find(at);
    faults_.push_back({kind, line == document_.lines.end() ? 0 : line->second, document_.place(at),
                       std::move(what), std::move(remedy)});
  }

  void check(const json& value, const json& unresolved, const std::string& pointer) {
    const json& schema = resolved(unresolved);
    const std::string name = pointer.empty() ? "the file" : "'" + key_path(pointer) + "'";
    const auto types = types_of(schema);
    if (!types.empty() &&
        std::none_of(types.begin(), types.end(), [&](auto& t) { return has_type(value, t); })) {
      add(FaultKind::other, pointer, name + " is " + type_word(value), remedy_for(schema));
      return;
    }
    if (const auto choices = schema.find("enum"); choices != schema.end()) {
      if (std::find(choices->begin(), choices->end(), value) == choices->end()) {
        std::string what = name + " is " + shown(value);
        if (value.is_string()) {
          std::vector<std::string> known;
          for (const json& c : *choices) {
            if (c.is_string()) known.push_back(c.get<std::string>());
          }
          const std::string near = nearest_word(value.get<std::string>(), known);
          if (!near.empty()) what += "; did you mean \"" + near + "\"?";
        }
        add(FaultKind::other, pointer, what, remedy_for(schema));
        return;
      }
    }
    if (value.is_object()) check_table(value, schema, pointer, name);
    if (value.is_array()) check_array(value, schema, pointer, name);
    if (value.is_number()) check_number(value.get<double>(), schema, pointer, name);
    if (value.is_string()) check_string(value.get<std::string>(), schema, pointer, name);
  }

  void check_table(const json& value, const json& schema, const std::string& pointer,
                   const std::string& name) {
    static const json none = json::object();
    const json& properties = schema.contains("properties") ? schema["properties"] : none;
    const auto more = schema.find("additionalProperties");
    const auto names = schema.find("propertyNames");
    for (const auto& [key, child] : value.items()) {
      const std::string at = json_pointer(pointer, key);
      if (names != schema.end()) check_string(key, *names, at, "a key of " + name);
      if (const auto known = properties.find(key); known != properties.end()) {
        check(child, *known, at);
      } else if (more != schema.end() && more->is_object()) {
        check(child, *more, at);
      } else if (more != schema.end() && more->is_boolean() && !more->get<bool>()) {
        add_unknown(key, properties, at);
      }
    }
    for (const json& needed : schema.value("required", json::array())) {
      const auto key = needed.get<std::string>();
      if (value.contains(key)) continue;
      const auto property = properties.find(key);
      std::string remedy = "add it";
      if (property != properties.end()) remedy += ": " + remedy_for(resolved(*property));
      add(FaultKind::other, pointer, fmt::format("key '{}' is missing in {}", key, name), remedy);
    }
    if (schema.contains("minProperties") && value.size() < schema["minProperties"]) {
      add(FaultKind::other, pointer, name + " is empty", remedy_for(schema));
    }
  }

  void add_unknown(const std::string& key, const json& properties, const std::string& pointer) {
    std::vector<std::string> known;
    for (const auto& [name, unused] : properties.items()) known.push_back(name);
    const std::string near = nearest_word(key, known);
    std::string remedy = "did you mean '" + near + "'?";
    if (near.empty()) {
      remedy =
          known.empty() ? "remove it" : "known here: " + fmt::format("{}", fmt::join(known, ", "));
    }
    add(FaultKind::unknown_key, pointer, "unknown key '" + key + "'", remedy);
  }

  void check_array(const json& value, const json& schema, const std::string& pointer,
                   const std::string& name) {
    const auto count = [](std::size_t n) {
      return fmt::format("{} {}", n, n == 1 ? "entry" : "entries");
    };
    const std::size_t size = value.size();
    if (schema.contains("minItems") && size < schema["minItems"].get<std::size_t>()) {
      add(FaultKind::other, pointer,
          fmt::format("{} has {}, at least {} are needed", name, count(size),
                      schema["minItems"].dump()),
          remedy_for_items(schema, "add"));
    }
    if (schema.contains("maxItems") && size > schema["maxItems"].get<std::size_t>()) {
      add(FaultKind::other, pointer,
          fmt::format("{} has {}, at most {} are allowed", name, count(size),
                      schema["maxItems"].dump()),
          remedy_for_items(schema, "remove"));
      return;  // a fault more for each of very many says no more
    }
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < size; ++i) {
      check(value[i], schema["items"], json_pointer(pointer, std::to_string(i)));
    }
  }

  static std::string remedy_for_items(const json& schema, const char* verb) {
    std::string words = std::string(verb) + " entries";
    if (schema.contains("description"))
      words += " (" + schema["description"].get<std::string>() + ")";
    return words;
  }

  void check_number(double value, const json& schema, const std::string& pointer,
                    const std::string& name) {
    const auto limit = [&](const char* key) {
      return schema.contains(key) ? schema[key].get<double>() : std::nan("");
    };
    // Comparisons with NaN are false: a limit that is not there is kept by every value.
    const bool low = value < limit("minimum") || value <= limit("exclusiveMinimum");
    const bool high = value > limit("maximum") || value >= limit("exclusiveMaximum");
    if (low || high) {
      add(FaultKind::other, pointer, fmt::format("{} is {}, out of range", name, value),
          remedy_for(schema));
    }
  }

  void check_string(const std::string& value, const json& schema, const std::string& pointer,
                    const std::string& name) {
    const bool empty = schema.contains("minLength") && value.size() < schema["minLength"];
    const auto pattern = schema.find("pattern");
    const auto most = schema.find("maxLength");
    const auto length = static_cast<std::size_t>(
        std::count_if(value.begin(), value.end(), [](char c) { return (c & 0xc0) != 0x80; }));
    if (most != schema.end() && length > most->get<std::size_t>()) {
      add(FaultKind::other, pointer,
          fmt::format("{} has {} characters, at most {} are allowed", name, length, most->dump()),
          "shorten it");
      return;
    }
    if (pattern != schema.end() && value.size() > kLongestMatched) {
      add(FaultKind::other, pointer,
          fmt::format("{} is {} bytes long, more than {}", name, value.size(), kLongestMatched),
          "shorten it");
      return;
    }
    const bool wrong = pattern != schema.end() &&
                       !std::regex_search(value, std::regex(pattern->get<std::string>()));
    if (empty || wrong) {
      std::string remedy = remedy_for(schema);
      if (empty) remedy += " that is not empty";
      if (wrong) remedy += " that matches " + pattern->get<std::string>();
      add(FaultKind::other, pointer, name + " is " + shown(value), remedy);
    }
  }

  const Document& document_;
  const json& root_;
  std::vector<Fault> faults_;
};

// What valijson, which knows all of draft 7, says of a document in which the walk above found
// nothing.
Result<void> agreed(const Document& document, const json& schema) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  valijson::Schema compiled;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(schema), compiled);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  if (validator.validate(compiled, Adapter(document.value), &results)) return {};
  valijson::ValidationResults::Error fault;
  results.popError(fault);
  std::string where;
  for (const std::string& step : fault.context) where += step;
  return usage_error(document.path.string(), "", where + ": " + fault.description,
                     "compare it with the schema");
}

}  // namespace

std::string json_pointer(const std::string& pointer, std::string_view step) {
  std::string longer = pointer + "/";
  for (const char c : step) {
    if (c == '~') {
      longer += "~0";
    } else if (c == '/') {
      longer += "~1";
    } else {
      longer += c;
    }
  }
  return longer;
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > 64) return {};
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const std::size_t columns = candidate.size() + 1;
    // Optimal string alignment distance: rows are prefixes of `word`.
    std::vector<std::size_t> before(columns), last(columns), row(columns);
    for (std::size_t j = 0; j < columns; ++j) last[j] = j;
    for (std::size_t i = 1; i <= word.size(); ++i) {
      row[0] = i;
      for (std::size_t j = 1; j < columns; ++j) {
        const std::size_t replaced = last[j - 1] + (word[i - 1] == candidate[j - 1] ? 0 : 1);
        row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
        if (i > 1 && j > 1 && word[i - 1] == candidate[j - 2] && word[i - 2] == candidate[j - 1]) {
          row[j] = std::min(row[j], before[j - 2] + 1);
        }
      }
      before = last;
      last = row;
    }
    // A word that shares nothing is not meant: the distance must be less than its length.
    if (last.back() < best && last.back() < std::max(word.size(), candidate.size())) {
      best = last.back();
      nearest = candidate;
    }
  }
  return nearest;
}

Result<void> check_schema(const Document& document, const json& schema) {
  try {
    std::vector<Fault> faults = Checker(document, schema).faults();
    if (faults.empty()) return agreed(document, schema);
    const auto& first = *std::min_element(faults.begin(), faults.end(), [](auto& a, auto& b) {
      return std::pair(a.kind, a.line) < std::pair(b.kind, b.line);
    });
    return usage_error(document.path.string(), first.place, first.what, first.remedy);
  } catch (const std::exception& fault) {
    return usage_error(document.path.string(), "", std::string("schema is faulty: ") + fault.what(),
                       "restore assets/schemas");
  }
}

}  // namespace ringcraft
