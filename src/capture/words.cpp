#include "capture/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace ringcraft {
namespace {

constexpr float kLargestNumber = 1e7f;
constexpr std::size_t kLongestName = 200;  // bytes

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

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string lowered(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string clean_name(std::string_view name) {
  const bool utf8 = is_utf8(name);
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t length = utf8 ? utf8_length(name.substr(i)) : 1;
    const auto byte = static_cast<unsigned char>(name[i]);
    std::string character;
    if (byte < 0x20 || byte == 0x7f)
      character = "?";
    else if (byte < 0x80 || utf8)
      character = name.substr(i, length);
    else
      character = {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
    if (out.size() + character.size() > kLongestName) break;
    out += character;
    i += length;
  }
  return out;
}

std::string in_quotes(std::string_view word) {
  return "'" + clean_name(word.substr(0, 24)) + "'";
}

std::optional<float> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  float value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault == std::errc::result_out_of_range && end == word.data() + word.size()) {
    // Too small for a float is zero; too large is refused below.
    return word.find("e-") != word.npos || word.find("E-") != word.npos ? std::optional(0.0f)
                                                                        : std::nullopt;
  }
  if (fault != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  if (!std::isfinite(value) || std::abs(value) > kLargestNumber) return std::nullopt;
  return value;
}

std::string_view Words::next() {
  while (at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '\n')) {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '\n') ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view Words::peek() {
  const Words before = *this;
  const std::string_view word = next();
  *this = before;
  return word;
}

std::string_view Words::rest_of_line() {
  std::size_t end = text_.find('\n', at_);
  if (end == text_.npos) end = text_.size();
  std::string_view rest = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (end < text_.size()) ++line_;
  while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
  return rest;
}

}  // namespace ringcraft
