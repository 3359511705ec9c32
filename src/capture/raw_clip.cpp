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

// The largest way of a joint between two frames, file units.
float farthest(const RawPose& a, const RawPose& b) {
  float most = 0;
  for (std::size_t j = 0; j < a.position.size(); ++j)
    most = std::max(most, glm::distance2(a.position[j], b.position[j]));
  return std::sqrt(most);
}

RawPose pose_of_row(const RawClip& clip, std::size_t frame) {
  const auto row = [&](const auto& cells) {
    const auto begin = cells.begin() + static_cast<long>(clip.at(frame, 0));
    return std::vector(begin, begin + static_cast<long>(clip.joints.size()));
  };
  RawPose out;
  place_joints(clip.joints, row(clip.translation), row(clip.rotation), out);
  return out;
}

// From the first joint to the one that is farthest from it at rest.
float size_of(const RawClip& clip) {
  const RawPose rest = raw_rest_pose(clip);
  float size = 0;
  for (const Vec3& p : rest.position) size = std::max(size, glm::distance(p, rest.position[0]));
  return size;
}

// Overwrites the frames between two.
void bridge(RawClip& clip, std::size_t before, std::size_t after) {
  for (std::size_t f = before + 1; f < after; ++f) {
    const float share = static_cast<float>(f - before) / static_cast<float>(after - before);
    for (std::size_t j = 0; j < clip.joints.size(); ++j) {
      const std::size_t a = clip.at(before, j);
      const std::size_t b = clip.at(after, j);
      clip.translation[clip.at(f, j)] = glm::mix(clip.translation[a], clip.translation[b], share);
      clip.rotation[clip.at(f, j)] =
          glm::normalize(glm::slerp(clip.rotation[a], clip.rotation[b], share));
    }
  }
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
  const float size = size_of(clip);
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

std::size_t mend_jumps(RawClip& clip) {
  constexpr float kSpeed = 12;         // skeleton's sizes in a second: no hand or foot goes so fast
  constexpr float kBack = 0.25f;       // of the jump, off the place before it
  constexpr double kLongest = 0.15;    // s
  constexpr std::size_t kFrames = 12;  // at any rate
  const float jump = kSpeed * size_of(clip) * static_cast<float>(clip.frame_seconds);
  const std::size_t longest =
      std::clamp(static_cast<std::size_t>(kLongest / clip.frame_seconds), std::size_t{1}, kFrames);
  if (jump == 0 || clip.frames == 0) return 0;
  std::vector<float> step;
  RawPose pose = pose_of_row(clip, 0);
  for (std::size_t f = 0; f + 1 < clip.frames; ++f) {
    RawPose next = pose_of_row(clip, f + 1);
    step.push_back(farthest(pose, next));
    pose = std::move(next);
  }
  std::size_t mended = 0;
  std::size_t first = 0;
  for (std::size_t f = 0; f < step.size(); ++f) {
    if (step[f] < jump) continue;
    for (std::size_t back = f + 1; back < step.size() && back - f <= longest; ++back) {
      if (step[back] < jump || farthest(pose_of_row(clip, f), pose_of_row(clip, back + 1)) >
                                   kBack * std::min(step[f], step[back]))
        continue;
      bridge(clip, f, back + 1);
      if (mended == 0) first = f + 1;
      mended += back - f;
      f = back;
      break;
    }
  }
  if (mended > 0)
    clip.notes.push_back(
        fmt::format("{} frames, {} first, are elsewhere at once (a lost or swapped marker?): what "
                    "lies between their neighbours stands there",
                    mended, first));
  return mended;
}

}  // namespace ringcraft
