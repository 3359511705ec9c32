#include "base/json_object.h"

#include <fmt/format.h>

namespace ringcraft {

std::optional<nlohmann::json> json_object(std::string_view text, std::string& why) {
  using Json = nlohmann::json;
  bool too_deep = false;
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > kDeepestJson;
    return !too_deep;
  };
  Json json = Json::parse(text, shallow, false);
  if (too_deep) {
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
