#pragma once
// JSON of files from outside.

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace ringcraft {

// Levels inside one another: nlohmann copies, compares and writes a value by recursion.
inline constexpr int kDeepestJson = 32;

// Nothing where the text is no JSON object or is nested deeper; `why` then says which.
std::optional<nlohmann::json> json_object(std::string_view text, std::string& why);

}  // namespace ringcraft
