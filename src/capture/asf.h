#pragma once
// Acclaim skeletons (.asf, as CMU and HDM05 ship them).

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "capture/raw_clip.h"

namespace ringcraft {

// What a number of the motion file moves: translation along or rotation about x, y, z, or the
// bone's length.
enum class AsfChannel : std::uint8_t { tx, ty, tz, rx, ry, rz, length };

struct AsfBone {
  std::string name;
  int parent = -1;                   // index; parents stand before their children
  Vec3 start{};                      // from the parent's start to its own in the rest pose, m
  Vec3 along{};                      // from its start to its end, m
  Quat axis{1, 0, 0, 0};             // its own frame: a turn M in it is axis M axis^-1
  std::vector<AsfChannel> channels;  // in the order of the motion file; turns apply in this order
};

struct AsfSkeleton {
  std::string file;
  float metres_per_unit = 0.0254f;
  bool degrees = true;         // unless the motion file says otherwise
  std::vector<AsfBone> bones;  // the root is the first
  std::vector<std::string> notes;
};

// `file` is only for messages. The file's `length` is inches per unit's inverse (CMU: 0.45), so a
// unit is 0.0254 / length metres. Limits of joints are not read.
Result<AsfSkeleton> parse_asf(std::string_view text, const std::string& file,
                              const CaptureLimits& limits = {});

}  // namespace ringcraft
