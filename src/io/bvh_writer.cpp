#include "io/bvh_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace ringcraft {

namespace {

constexpr Tick kTicksPerRow = 2;  // 60 Hz
constexpr float kCentimetres = 100;
// Tips of bones that end in no joint, as shares of the height (hand, foot: de Leva 1996).
constexpr float kHandLength = 0.046f, kToeLength = 0.04f;

// Degrees about Z, X and Y, applied in this order of channels: R = Rz Rx Ry. In double precision
// and without arc sines, which lose half the digits near a quarter turn.
glm::dvec3 angles_of(Quat rotation) {
  const glm::dmat3 m = glm::mat3_cast(glm::normalize(glm::dquat(rotation)));  // m[column][row]
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  const double cosine = std::hypot(m[0][2], m[2][2]);
  const double x = std::atan2(m[1][2], cosine) * kDegrees;
  // Where X is a quarter turn, Z and Y turn about one axis: Z takes all of it.
  if (cosine < 1e-7) return {std::atan2(m[0][1], m[0][0]) * kDegrees, x, 0};
  return {std::atan2(-m[1][0], m[1][1]) * kDegrees, x, std::atan2(-m[0][2], m[2][2]) * kDegrees};
}

// The end of a bone that carries no joint, from that joint, m; zero where one follows.
Vec3 tip_of(const Skeleton& skeleton, Joint joint) {
  switch (joint) {
    case Joint::head: {
      float crown = skeleton.height;
      for (int i = static_cast<int>(joint); i >= 0; i = kParent.at(static_cast<std::size_t>(i)))
        crown -= skeleton.offset.at(static_cast<std::size_t>(i)).y;
      return {0, crown, 0};
    }
    case Joint::left_hand:
      return {kHandLength * skeleton.height, 0, 0};
    case Joint::right_hand:
      return {-kHandLength * skeleton.height, 0, 0};
    case Joint::left_toes:
    case Joint::right_toes:
      return {0, 0, kToeLength * skeleton.height};
    default:
      return {};
  }
}

class BvhText {
 public:
  explicit BvhText(const Skeleton& skeleton) : skeleton_(skeleton) {
    text_ = "HIERARCHY\n";
    add_joint(0, 0);
  }

  std::string with_motion(const FighterTrack& track) && {
    const std::size_t rows = (track.frames.size() + kTicksPerRow - 1) / kTicksPerRow;
    put("MOTION\nFrames: {}\nFrame Time: {:.8f}\n", rows,
        static_cast<double>(kTicksPerRow) / kTicksPerSecond);
    for (std::size_t row = 0; row < rows; ++row) add_row(track.frames[row * kTicksPerRow]);
    return std::move(text_);
  }

 private:
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  void add_offset(const std::string& indent, Vec3 offset) {
    const Vec3 shown = offset * kCentimetres;
    put("{}OFFSET {:.5f} {:.5f} {:.5f}\n", indent, shown.x, shown.y, shown.z);
  }

  void add_joint(std::size_t joint, std::size_t depth) {
    const std::string indent(2 * depth, ' '), inner(2 * depth + 2, ' ');
    put("{}{} {}\n{}{{\n", indent, joint == 0 ? "ROOT" : "JOINT", vrm_name(joint_at(joint)),
        indent);
    add_offset(inner, joint == 0 ? Vec3{} : skeleton_.offset.at(joint));
    put("{}CHANNELS {}Zrotation Xrotation Yrotation\n", inner,
        joint == 0 ? "6 Xposition Yposition Zposition " : "3 ");
    bool carries = false;
    for (std::size_t child = joint + 1; child < kJointCount; ++child) {
      if (kParent.at(child) != static_cast<int>(joint)) continue;
      add_joint(child, depth + 1);
      carries = true;
    }
    if (!carries) {
      put("{}End Site\n{}{{\n", inner, inner);
      add_offset(inner + "  ", tip_of(skeleton_, joint_at(joint)));
      put("{}}}\n", inner);
    }
    put("{}}}\n", indent);
  }

  void add_row(const Pose& pose) {
    const Vec3 hips = pose.hips * kCentimetres;
    put("{:.4f} {:.4f} {:.4f}", hips.x, hips.y, hips.z);
    // The canonical order is depth first, as the hierarchy above is written.
    for (const Quat& rotation : pose.rotation) {
      const glm::dvec3 angles = angles_of(rotation);
      put(" {:.5f} {:.5f} {:.5f}", angles.x, angles.y, angles.z);
    }
    text_ += '\n';
  }

  const Skeleton& skeleton_;
  std::string text_;
};

}  // namespace

std::string fighter_bvh(const Skeleton& skeleton, const FighterTrack& track) {
  return BvhText(skeleton).with_motion(track);
}

}  // namespace ringcraft
