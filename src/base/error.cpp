#include "base/error.h"

#include <algorithm>

#include "base/utf8.h"

namespace ringcraft {

namespace {

// Files and paths are quoted in errors, whatever they hold.
std::string in_a_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return clean_name(text, std::string::npos);
}

}  // namespace

std::string to_string(const Error& error) {
  std::string line;
  for (const std::string& part : {error.file, error.place, error.what}) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += in_a_line(part);
  }
  if (!error.remedy.empty()) line += "; " + in_a_line(error.remedy);
  return line;
}

}  // namespace ringcraft
