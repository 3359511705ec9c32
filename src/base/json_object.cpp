#include "base/json_object.h"

#include <algorithm>

#include <fmt/format.h>

namespace ringcraft {
namespace {

bool is_deeper(const nlohmann::json& value, int levels) {
  if (!value.is_structured() || value.empty()) return false;
  return levels == 0 || std::any_of(value.begin(), value.end(), [&](const nlohmann::json& element) {
           return is_deeper(element, levels - 1);
         });
}

}  // namespace

std::optional<nlohmann::json> json_object(std::string_view text, std::string& why) {
  // Not with a filter: nlohmann's looks through an array again at each of its objects.
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (is_deeper(json, kDeepestJson)) {
    why = fmt::format("JSON nested deeper than {}", kDeepestJson);
    return std::nullopt;
  }
  if (!json.is_object()) {
    why = "not a JSON object";
    return std::nullopt;
  }
  return json;
}

}  // namespace ringcraft
