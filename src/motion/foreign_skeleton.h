#pragma once
// How another tool names, measures and turns the canonical skeleton.

#include <array>
#include <string>

#include "base/vec.h"
#include "motion/skeleton.h"

namespace ringcraft {

struct ForeignSkeleton {
  // Names of the bones. Empty: there is no such bone; those it carries hang on the one that carries
  // it, which turns as it does where it carries nothing else.
  std::array<std::string, kJointCount> name;
  float metres_per_unit = 0.01f;
  Quat axes{1, 0, 0, 0};  // turns the tool's axes to ours (+Y up, +Z forward)
};

// VRM's names, centimetres, our axes.
inline ForeignSkeleton vrm_skeleton() {
  ForeignSkeleton form;
  for (std::size_t i = 0; i < kJointCount; ++i) form.name.at(i) = vrm_name(joint_at(i));
  return form;
}

}  // namespace ringcraft
