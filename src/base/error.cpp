#include "base/error.h"

namespace ringcraft {

std::string to_string(const Error& error) {
  std::string line;
  for (const std::string& part : {error.file, error.place, error.what}) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += part;
  }
  if (!error.remedy.empty()) line += "; " + error.remedy;
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return line;
}

}  // namespace ringcraft
