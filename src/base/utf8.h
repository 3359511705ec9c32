#pragma once
// Text from outside as UTF-8: names of files and what stands in captures may be anything.

#include <string>
#include <string_view>

namespace ringcraft {

bool is_utf8(std::string_view text);

// At most `most` bytes of UTF-8: what is no UTF-8 is taken for Latin-1, control characters become
// '?'.
std::string clean_name(std::string_view name, std::size_t most = 200);

// JSON that may hold such text, as text: what is no UTF-8 is replaced, where dump() throws.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ringcraft
