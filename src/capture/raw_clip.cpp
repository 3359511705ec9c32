#include "capture/raw_clip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ringcraft {
namespace {

void place_joints(const std::vector<RawJoint>& joints, const std::vector<Vec3>& translation,
                  const std::vector<Quat>& rotation, RawPose& out) {
  out.position.resize(joints.size());
  out.rotation.resize(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent < 0) {
      out.position[j] = translation[j];
      out.rotation[j] = rotation[j];
      continue;
    }
    const auto parent = static_cast<std::size_t>(joints[j].parent);
    out.position[j] = out.position[parent] + out.rotation[parent] * translation[j];
    out.rotation[j] = out.rotation[parent] * rotation[j];
  }
}

// Largest way a joint goes from one frame to the next, file units.
float largest_step(const RawClip& clip, std::size_t frame) {
  const RawPose a = raw_pose(clip, static_cast<double>(frame) * clip.frame_seconds);
  const RawPose b = raw_pose(clip, static_cast<double>(frame + 1) * clip.frame_seconds);
  float largest = 0;
  for (std::size_t j = 0; j < a.position.size(); ++j)
    largest = std::max(largest, glm::distance(a.position[j], b.position[j]));
  return largest;
}

// The largest angle by which a joint below the root is off the rest pose, rad.
float off_rest(const RawClip& clip, std::size_t frame) {
  float largest = 0;
  for (std::size_t j = 1; j < clip.joints.size(); ++j)
    largest = std::max(largest, glm::length(rotation_vector(clip.rotation[clip.at(frame, j)])));
  return largest;
}

// Frames of exactly the rest pose before one that is far from it.
std::size_t resting_start(const RawClip& clip) {
  constexpr float kAtRest = radians(2), kFar = radians(20);
  std::size_t count = 0;
  while (count < clip.frames && off_rest(clip, count) < kAtRest) ++count;
  return count < clip.frames && off_rest(clip, count) > kFar ? count : 0;
}

}  // namespace

int RawClip::find(std::string_view name) const {
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].name == name) return static_cast<int>(j);
  return -1;
}

RawPose raw_pose(const RawClip& clip, double time) {
  const double row =
      std::clamp(time / clip.frame_seconds, 0.0, static_cast<double>(clip.frames - 1));
  const auto first = static_cast<std::size_t>(row);
  const std::size_t second = std::min(first + 1, clip.frames - 1);
  const auto share = static_cast<float>(row - static_cast<double>(first));
  std::vector<Vec3> translation(clip.joints.size());
  std::vector<Quat> rotation(clip.joints.size());
  for (std::size_t j = 0; j < clip.joints.size(); ++j) {
    const std::size_t a = clip.at(first, j);
    const std::size_t b = clip.at(second, j);
    translation[j] = glm::mix(clip.translation[a], clip.translation[b], share);
    rotation[j] = glm::normalize(glm::slerp(clip.rotation[a], clip.rotation[b], share));
  }
  RawPose out;
  place_joints(clip.joints, translation, rotation, out);
  return out;
}

RawPose raw_rest_pose(const RawClip& clip) {
  std::vector<Vec3> translation;
  for (const RawJoint& joint : clip.joints) translation.push_back(joint.offset);
  RawPose out;
  place_joints(clip.joints, translation, std::vector<Quat>(clip.joints.size(), Quat(1, 0, 0, 0)),
               out);
  return out;
}

bool replace_junk_start(RawClip& clip) {
  constexpr std::size_t kCompared = 10;  // steps after the jump
  constexpr float kRatio = 8;       // a human start is never that much faster than what follows
  constexpr float kJump = 0.1f;     // of the skeleton's size within a frame: 10 m/s at 100 Hz
  constexpr float kStill = 0.002f;  // of the skeleton's size: a pose that is held
  constexpr double kLongest = 3;    // s
  float size = 0;                   // of the skeleton, to tell a jump from stillness
  const RawPose rest = raw_rest_pose(clip);
  for (const Vec3& p : rest.position) size = std::max(size, glm::distance(p, rest.position[0]));
  std::size_t junk = resting_start(clip);
  for (std::size_t f = 0; f + kCompared + 1 < clip.frames; ++f) {
    const float step = largest_step(clip, f);
    if (static_cast<double>(f) * clip.frame_seconds > kLongest) break;
    if (step < kStill * size) continue;
    if (step < kJump * size) break;
    std::vector<float> steps;
    for (std::size_t k = 1; k <= kCompared; ++k) steps.push_back(largest_step(clip, f + k));
    std::nth_element(steps.begin(), steps.begin() + kCompared / 2, steps.end());
    if (step >= kRatio * steps[kCompared / 2]) junk = std::max(junk, f + 1);
  }
  if (junk == 0) return false;
  for (std::size_t cell = 0; cell < clip.at(junk, 0); ++cell) {
    const std::size_t kept = clip.at(junk, cell % clip.joints.size());
    clip.rotation[cell] = clip.rotation[kept];
    clip.translation[cell] = clip.translation[kept];
  }
  clip.notes.push_back(
      fmt::format("a jump after frame {} (a T-pose?): what stands before is replaced by frame {}",
                  junk - 1, junk));
  return true;
}

}  // namespace ringcraft
