#pragma once
// Queries that the tests of single hits share.

#include "default_library.h"
#include "scene/scene_file.h"
#include "scene/single_hit.h"

namespace ringcraft::hits {

inline HitQuery query(const std::string& action = "idle_guard_bounce", double at_s = 0.1) {
  HitQuery query;
  query.action = action;
  query.at_s = at_s;
  return query;
}

}  // namespace ringcraft::hits
