#pragma once
// A capture as its file has it: its own skeleton, units and axes, one frame a row.

#include <string>
#include <vector>

#include "base/vec.h"

namespace ringcraft {

struct RawJoint {
  std::string name;
  int parent = -1;  // index; parents stand before their children
  Vec3 offset{};    // from the parent in the rest pose, file units
};

// What a joint's end site is called after the joint's name: it is a joint that never turns.
inline constexpr const char* kEndSite = " End Site";

// Limits on what a file may ask for.
struct CaptureLimits {
  std::size_t joints = 1024;
  std::size_t depth = 128;
  std::size_t cells = std::size_t{8} << 20;  // frames x joints
};

// Joint positions (file units) and rotations of one moment, in the file's axes.
struct RawPose {
  std::vector<Vec3> position;
  std::vector<Quat> rotation;
};

struct RawClip {
  std::string file;
  std::vector<RawJoint> joints;
  std::size_t frames = 0;
  double frame_seconds = 0;
  std::vector<Quat> rotation;      // frames x joints, local
  std::vector<Vec3> translation;   // frames x joints, local, file units
  std::vector<std::string> notes;  // what was odd and how it was read

  std::size_t at(std::size_t frame, std::size_t joint) const {
    return frame * joints.size() + joint;
  }
  double seconds() const {
    return frames < 2 ? 0 : static_cast<double>(frames - 1) * frame_seconds;
  }
  int find(std::string_view name) const;  // -1 when there is none
};

// The pose `time` seconds after the first frame, clamped to the ends; between frames the local
// rotations go the shortest way.
RawPose raw_pose(const RawClip& clip, double time);

// Rest pose: all rotations identity, the root where its offset says.
RawPose raw_rest_pose(const RawClip& clip);

// Many files begin with a T-pose, of one frame or held, or with frames between it and the motion,
// where they were resampled; it is seen as a jump far above the speed of the rest, or as the rest
// pose itself. Those frames are overwritten with the first one after them, so that times stay those
// of the file. Says whether there were any.
bool replace_junk_start(RawClip& clip);

// Frames in which a joint is elsewhere at once and back at once, as where markers were swapped or
// lost (some systems write zeros then), are overwritten with what lies between their neighbours:
// such frames would be falls and blows. Returns how many.
std::size_t mend_jumps(RawClip& clip);

}  // namespace ringcraft
