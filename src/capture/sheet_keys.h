#pragma once
// A technique sheet as it was written: key poses by channel, steps and strikes.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "motion/action.h"

namespace ringcraft {

// What a key can give. Points are fractions of height in the root's frame, angles degrees.
enum class Channel : std::uint8_t {
  root,         // x, z, yaw of the root in action space
  pelvis,       // point: middle of the hips
  pelvis_yaw,   // 0 faces the opponent, positive to the own left
  pelvis_lean,  // forward, left; of the pelvis' own up axis
  chest_yaw,    // of the shoulders
  lean,         // forward, left; of the trunk
  head,         // yaw, pitch (chin up is positive)
  lead_wrist,
  rear_wrist,  // points
  lead_elbow,
  rear_elbow,  // points: only their direction off the arm's line counts
  lead_ankle,
  rear_ankle,  // points: of a foot in the air
  lead_knee,
  rear_knee,  // points: only their direction off the leg's line counts
  lead_foot_yaw,
  rear_foot_yaw,  // of a planted foot, which turns on its ball
  lead_heel,
  rear_heel,  // heel lift of a planted foot, degrees of foot pitch
  lead_point,
  rear_point,  // toes away from the shin, of a foot in the air
  lead_palm,
  rear_palm,  // turn of the fist about the forearm, palm down is positive
};
inline constexpr std::size_t kChannelCount = 23;
constexpr std::size_t index(Channel channel) {
  return static_cast<std::size_t>(channel);
}

struct ChannelInfo {
  const char* name;
  int size;  // numbers a key gives
};
const ChannelInfo& info(Channel channel);

// The channel of one side: of_side(Channel::lead_wrist, Side::right) is rear_wrist. Sheets are
// orthodox: lead is left.
constexpr Channel of_side(Channel lead, Side side) {
  return side == Side::left ? lead : static_cast<Channel>(static_cast<std::uint8_t>(lead) + 1);
}

using KeyValues = std::array<std::optional<Vec3>, kChannelCount>;

struct SheetKey {
  float t = 0;  // s
  KeyValues values;
};

// A whole pose by name, with where the balls of the feet stand (fractions of height, root's frame).
// A foot without a place hangs free, at its ankle's point.
struct SheetPose {
  KeyValues values;
  std::array<std::optional<Vec2>, 2> ball;  // left, right
};

struct SheetStep {
  Side foot = Side::left;
  float lift = 0;             // s: leaves the ground
  std::optional<float> land;  // s: stands again; never where there is none
  std::optional<Vec3> at;     // x, z, yaw: the root placement in whose guard the foot stands
  float height = 0.024f;      // of the ball in mid step, fraction of height
  bool free = false;          // the ankle follows its keys (kicks, falls)
};

struct SheetStrike {
  Strike strike;                 // its ticks are filled by the compiler
  float start = 0, contact = 0;  // s: the limb leaves, full extension
  float active_begin = 0, active_end = 0;
  std::string profile;
  float snap = 0;  // degrees by which a wrist lags behind its forearm until the contact
};

constexpr bool is_foot(Joint joint) {
  return tip_of(joint) == Joint::left_foot || tip_of(joint) == Joint::right_foot;
}
constexpr Side side_of(Joint striker) {
  const Joint led = tip_of(striker);
  return led == Joint::left_hand || led == Joint::left_foot ? Side::left : Side::right;
}

struct SheetAction {
  Action action;        // header; the clip is compiled
  std::string pointer;  // where it stands in the document
  float length = 0;     // s
  SheetPose start, end;
  Placement end_at;  // m, rad
  std::optional<Side>
      pivot;        // this foot stays: the end placement follows from its place and the yaw
  int turns = 0;    // whole ones of the body by its end, positive to the own left; the root stays
  float chain = 0;  // s between the links pelvis, chest and arm
  float bounce_hz = 0, bounce = 0;  // Hz, amplitude as a fraction of height
  float sway = 0;                   // of the hands, standard deviation as a fraction of height
  // The same attack at other distances: end of its name, and fraction of height farther away.
  std::map<std::string, float> variants;
  std::optional<Vec2> root_time;
  std::vector<SheetKey> keys;
  std::vector<SheetStep> steps;
  std::vector<SheetStrike> strikes;
};

// Reads a checked document; `poses` files are looked up in its folder.
Result<std::vector<SheetAction>> sheet_actions(const Document& document);

}  // namespace ringcraft
