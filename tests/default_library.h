#pragma once
// The default motion library, built once a program.

#include <stdexcept>
#include <utility>

#include "capture/library_file.h"

namespace ringcraft {

inline const MotionLibrary& default_library() {
  static const MotionLibrary kLibrary = [] {
    auto result = load_library("kickboxing");
    if (!result) throw std::runtime_error(to_string(result.error()));
    return std::move(*result);
  }();
  return kLibrary;
}

}  // namespace ringcraft
