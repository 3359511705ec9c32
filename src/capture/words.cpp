#include "capture/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/utf8.h"

namespace ringcraft {
namespace {

constexpr float kLargestNumber = 1e7f;

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
