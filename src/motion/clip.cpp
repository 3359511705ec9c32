#include "motion/clip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace ringcraft {

namespace {

template <class T>
const T& clamped(const std::vector<T>& values, Tick tick) {
  assert(!values.empty());  // rules 1 and 2
  const auto last = static_cast<Tick>(values.size()) - 1;
  return values[static_cast<std::size_t>(std::clamp<Tick>(tick, 0, last))];
}

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool near_enough(Vec3 v) {
  return std::abs(v.x) <= kFarthestPlaced && std::abs(v.y) <= kFarthestPlaced &&
         std::abs(v.z) <= kFarthestPlaced;
}
bool finite(Quat q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}

}  // namespace

const Pose& Clip::at(Tick tick) const {
  return clamped(frames, tick);
}
const Placement& Clip::root_at(Tick tick) const {
  return clamped(root, tick);
}
FootContacts Clip::contacts_at(Tick tick) const {
  return clamped(contacts, tick);
}

std::vector<std::string> faults(const Clip& clip) {
  std::vector<std::string> found;
  if (clip.frames.size() < 2) found.emplace_back("rule 1: fewer than two frames");
  if (clip.root.size() != clip.frames.size() || clip.contacts.size() != clip.frames.size()) {
    found.emplace_back("rule 2: frames, root and contacts differ in length");
    return found;
  }
  if (!clip.root.empty() && (std::abs(clip.root[0].x) > 1e-4f || std::abs(clip.root[0].z) > 1e-4f ||
                             std::abs(clip.root[0].yaw) > 1e-4f)) {
    found.emplace_back("rule 3: the root track does not start at the identity");
  }
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const Pose& pose = clip.frames[i];
    const Placement& root = clip.root[i];
    if (!finite(Vec3(root.x, root.yaw, root.z))) {
      found.push_back(fmt::format("rule 4: frame {}: root not finite", i));
    } else if (!in_bounds(root)) {
      found.push_back(fmt::format("rule 4: frame {}: root farther than {} m or {} turns", i,
                                  kFarthestPlaced, kMostTurns));
    }
    if (!finite(pose.hips)) {
      found.push_back(fmt::format("rule 4: frame {}: hips not finite", i));
    } else if (!near_enough(pose.hips)) {
      found.push_back(fmt::format("rule 4: frame {}: hips farther than {} m", i, kFarthestPlaced));
    }
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Quat q = pose.rotation[j];
      if (!finite(q)) {
        found.push_back(fmt::format("rule 4: frame {}: {} not finite", i, vrm_name(joint_at(j))));
      } else if (std::abs(glm::length(q) - 1) > 1e-3f) {
        found.push_back(fmt::format("rule 5: frame {}: {} not unit", i, vrm_name(joint_at(j))));
      } else if (i > 0 && glm::dot(q, clip.frames[i - 1].rotation[j]) < 0) {
        found.push_back(
            fmt::format("rule 5: frame {}: {} changes hemisphere", i, vrm_name(joint_at(j))));
      }
    }
    if (found.size() > 8) break;
  }
  return found;
}

Clip mirrored(const Clip& clip) {
  Clip result;
  result.frames.reserve(clip.frames.size());
  for (const Pose& pose : clip.frames) result.frames.push_back(mirrored(pose));
  for (const Placement& placement : clip.root) result.root.push_back(mirrored(placement));
  for (const FootContacts& c : clip.contacts) result.contacts.push_back({c.right, c.left});
  return result;
}

Clip cut(const Clip& clip, Tick first, Tick last) {
  const Tick end = clip.length();
  first = std::clamp<Tick>(first, 0, end);
  last = std::clamp<Tick>(last, first, end);
  const Placement to_start = inverse(clip.root_at(first));
  Clip result;
  for (Tick tick = first; tick <= last; ++tick) {
    result.frames.push_back(placed(clip.at(tick), to_start));
    result.root.push_back(to_start * clip.root_at(tick));
    result.contacts.push_back(clip.contacts_at(tick));
  }
  if (!result.root.empty()) result.root[0] = {};
  unroll_rotations(result);
  return result;
}

Clip retimed(const Clip& clip, const std::vector<float>& times) {
  Clip result;
  for (const float t : times) {
    const auto tick = static_cast<Tick>(t);
    const float share = t - static_cast<float>(tick);
    result.frames.push_back(share == 0 ? clip.at(tick)
                                       : mix(clip.at(tick), clip.at(tick + 1), share));
    result.root.push_back(mix(clip.root_at(tick), clip.root_at(tick + 1), share));
    result.contacts.push_back(clip.contacts_at(share < 0.5f ? tick : tick + 1));
  }
  unroll_rotations(result);
  return result;
}

void unroll_rotations(Clip& clip) {
  for (std::size_t i = 1; i < clip.frames.size(); ++i) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      Quat& q = clip.frames[i].rotation[j];
      q = in_hemisphere_of(q, clip.frames[i - 1].rotation[j]);
    }
  }
}

}  // namespace ringcraft
