#include "base/utf8.h"

#include <cstdint>

namespace ringcraft {
namespace {

// Bytes of the UTF-8 character that begins here; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  std::size_t length = 0;
  if (byte(0) < 0x80)
    length = 1;
  else if (byte(0) >= 0xC2 && byte(0) < 0xE0)
    length = 2;
  else if (byte(0) >= 0xE0 && byte(0) < 0xF0)
    length = 3;
  else if (byte(0) >= 0xF0 && byte(0) < 0xF5)
    length = 4;
  if (length == 0 || length > text.size()) return 0;
  std::uint32_t code = length == 1 ? byte(0) : byte(0) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool too_long = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return too_long || surrogate || code > 0x10FFFF ? 0 : length;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string clean_name(std::string_view name, std::size_t most) {
  const bool utf8 = is_utf8(name);
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t length = utf8 ? utf8_length(name.substr(i)) : 1;
    const auto byte = static_cast<unsigned char>(name[i]);
    // U+0080 to U+009F are control characters as well.
    const unsigned code =
        length == 2 ? (byte & 0x1Fu) << 6 | (static_cast<unsigned char>(name[i + 1]) & 0x3Fu)
                    : byte;
    std::string character;
    if (code < 0x20 || (code >= 0x7F && code < 0xA0))
      character = "?";
    else if (byte < 0x80 || utf8)
      character = name.substr(i, length);
    else
      character = {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
    if (out.size() + character.size() > most) break;
    out += character;
    i += length;
  }
  return out;
}

}  // namespace ringcraft
