#pragma once
// Words and numbers of text captures, shared by their readers.

#include <optional>
#include <string>
#include <string_view>

#include "base/utf8.h"

namespace ringcraft {

bool is_space(char c);

// Lower-case copy (ASCII), for keywords.
std::string lowered(std::string_view word);

// A word of the file for a message: short and printable.
std::string in_quotes(std::string_view word);

// A finite number of at most 1e7 in size (beyond it no length or angle makes sense) that fills the
// whole word.
std::optional<float> number(std::string_view word);

// Words of a text with their lines.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next();  // "" at the end
  std::string_view peek();
  // What is left of the line, without the blanks around it; then stands at the next line.
  std::string_view rest_of_line();
  bool done() const { return at_ >= text_.size(); }
  int line() const { return line_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace ringcraft
