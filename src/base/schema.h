#pragma once
// Checking a document against a JSON Schema, with the fault's place in words a person can act on.

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace ringcraft {

// The first fault of `document` against `schema` (the subset of draft 7 in document.h), or nothing.
// Unknown keys come before everything else, then the order is that of the lines.
Result<void> check_schema(const Document& document, const nlohmann::json& schema);

// The one of `known` nearest to `word` by edit distance (insert, delete, replace, swap of
// neighbours), or "" where none is near enough to be meant.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

// `pointer` with one more step, escaped as RFC 6901 says.
std::string json_pointer(const std::string& pointer, std::string_view step);

}  // namespace ringcraft
