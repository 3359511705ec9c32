#pragma once
// Errors from the outside world are values: which file, where in it, what is wrong, what to do.

#include <string>

#include <tl/expected.hpp>

namespace ringcraft {

// The command's exit codes (README).
enum class ErrorKind { usage = 2, input = 3, simulation = 4 };

struct Error {
  ErrorKind kind = ErrorKind::input;
  std::string file;    // path as the user gave it; empty where there is none
  std::string place;   // "line 12", "bytes 0-4", "joint Hips"; empty where it is the whole file
  std::string what;    // what is wrong
  std::string remedy;  // what to do about it
};

template <class T>
using Result = tl::expected<T, Error>;

// One line: "file: place: what; remedy".
std::string to_string(const Error& error);

inline tl::unexpected<Error> input_error(std::string file, std::string place, std::string what,
                                         std::string remedy) {
  return tl::unexpected<Error>(Error{ErrorKind::input, std::move(file), std::move(place),
                                     std::move(what), std::move(remedy)});
}
inline tl::unexpected<Error> usage_error(std::string file, std::string place, std::string what,
                                         std::string remedy) {
  return tl::unexpected<Error>(Error{ErrorKind::usage, std::move(file), std::move(place),
                                     std::move(what), std::move(remedy)});
}

}  // namespace ringcraft
