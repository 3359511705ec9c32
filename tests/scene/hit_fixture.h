#pragma once
// The library and queries that the tests of single hits share.

#include <stdexcept>

#include "capture/library_file.h"
#include "scene/scene_file.h"
#include "scene/single_hit.h"

namespace ringcraft::hits {

inline const MotionLibrary& library() {
  static const MotionLibrary built = [] {
    auto result = load_library("kickboxing");
    if (!result) throw std::runtime_error(to_string(result.error()));
    return std::move(*result);
  }();
  return built;
}

inline HitQuery query(const std::string& action = "idle_guard_bounce", double at_s = 0.1) {
  HitQuery query;
  query.action = action;
  query.at_s = at_s;
  return query;
}

}  // namespace ringcraft::hits
