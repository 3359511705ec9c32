#include "capture/raw_clip.h"

#include <algorithm>
#include <cmath>

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

bool replace_junk_first_frame(RawClip& clip) {
  constexpr std::size_t kCompared = 10;  // steps after the first
  constexpr float kRatio = 8;  // a human start is never that much faster than what follows
  if (clip.frames < kCompared + 2) return false;
  float size = 0;  // of the skeleton, to tell a jump from stillness
  const RawPose rest = raw_rest_pose(clip);
  for (const Vec3& p : rest.position) size = std::max(size, glm::distance(p, rest.position[0]));
  std::vector<float> steps;
  for (std::size_t f = 1; f <= kCompared; ++f) steps.push_back(largest_step(clip, f));
  std::sort(steps.begin(), steps.end());
  const float first = largest_step(clip, 0);
  // One tenth of the body's half height within a frame: 10 m/s at 100 Hz.
  if (first < 0.1f * size || first < kRatio * steps[kCompared / 2]) return false;
  for (std::size_t j = 0; j < clip.joints.size(); ++j) {
    clip.rotation[clip.at(0, j)] = clip.rotation[clip.at(1, j)];
    clip.translation[clip.at(0, j)] = clip.translation[clip.at(1, j)];
  }
  clip.notes.emplace_back("frame 0 jumps (a T-pose?): replaced by frame 1");
  return true;
}

}  // namespace ringcraft
