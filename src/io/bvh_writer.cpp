#include "io/bvh_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

namespace ringcraft {

namespace {

constexpr Tick kTicksPerRow = 2;     // 60 Hz
constexpr float kSamePlace = 1e-4f;  // m
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
  BvhText(const Skeleton& skeleton, const ForeignSkeleton& form)
      : skeleton_(skeleton), form_(form), to_file_(glm::inverse(form.axes)) {
    for (std::size_t joint = 1; joint < kJointCount; ++joint) {
      if (has(joint)) carried_[carrier_of(joint)].push_back(joint);
    }
    for (std::size_t joint = 0; joint < kJointCount; ++joint) turns_as_[joint] = turning_of(joint);
    text_ = "HIERARCHY\n";
    add_joint(0, {}, 0);
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

  // A skeleton hangs on its hips, whatever they are called.
  bool has(std::size_t joint) const { return joint == 0 || !form_.name.at(joint).empty(); }
  std::size_t carrier_of(std::size_t joint) const {
    do joint = static_cast<std::size_t>(kParent.at(joint));
    while (!has(joint));
    return joint;
  }

  // The joint whose turning a bone shows: the last one that is missing below it, where everything
  // it carries hangs on that one.
  static std::size_t only_child(std::size_t joint) {
    std::size_t only = 0;
    for (std::size_t child = joint + 1; child < kJointCount; ++child) {
      if (kParent.at(child) != static_cast<int>(joint)) continue;
      if (only != 0) return 0;
      only = child;
    }
    return only;
  }
  std::size_t turning_of(std::size_t joint) const {
    const std::size_t child = only_child(joint);
    if (child == 0 || has(child) || carried_[joint].empty()) return joint;
    return turning_of(child);
  }

  void add_offset(const std::string& indent, Vec3 offset) {
    const Vec3 shown = to_file_ * offset / form_.metres_per_unit;
    put("{}OFFSET {:.5f} {:.5f} {:.5f}\n", indent, shown.x, shown.y, shown.z);
  }

  // From the joint that carries it to a joint, in the rest pose.
  Vec3 offset_of(std::size_t joint) const {
    const std::size_t carrier = carrier_of(joint);
    Vec3 offset{};
    for (; joint != carrier; joint = static_cast<std::size_t>(kParent.at(joint)))
      offset += skeleton_.offset.at(joint);
    return offset;
  }
  // The end of a bone that carries none: where a joint would follow, or its tip.
  Vec3 end_of(std::size_t joint) const {
    const std::size_t child = only_child(joint);
    return child != 0 ? skeleton_.offset.at(child) : tip_of(skeleton_, joint_at(joint));
  }

  void add_joint(std::size_t joint, Vec3 offset, std::size_t depth) {
    const std::string indent(2 * depth, ' '), inner(2 * depth + 2, ' ');
    order_.push_back(joint);
    put("{}{} {}\n{}{{\n", indent, joint == 0 ? "ROOT" : "JOINT", form_.name.at(joint), indent);
    add_offset(inner, offset);
    put("{}CHANNELS {}Zrotation Xrotation Yrotation\n", inner,
        joint == 0 ? "6 Xposition Yposition Zposition " : "3 ");
    for (const std::size_t child : carried_[joint]) add_joint(child, offset_of(child), depth + 1);
    if (carried_[joint].empty()) {
      put("{}End Site\n{}{{\n", inner, inner);
      add_offset(inner + "  ", end_of(joint));
      put("{}}}\n", inner);
    }
    put("{}}}\n", indent);
  }

  // Both bones of an arm whose root hangs a little elsewhere, so that the hand is where it was: the
  // elbow in the plane in which it stands.
  static void reach(const WorldPose& world, const Limb& limb, Vec3 root, WorldPose& written) {
    const Vec3 shoulder = world.position[index(limb.root)];
    const Vec3 elbow = world.position[index(limb.middle)], hand = world.position[index(limb.end)];
    const float upper = glm::distance(shoulder, elbow), lower = glm::distance(elbow, hand);
    const Vec3 way = normalized_or(hand - root, kForward);
    const float far = std::clamp(glm::distance(hand, root), std::abs(upper - lower) + 1e-4f,
                                 upper + lower - 1e-4f);
    const float along = (upper * upper + far * far - lower * lower) / (2 * far);
    const Vec3 aside = elbow - root;
    const Vec3 bend = normalized_or(aside - way * glm::dot(aside, way), kUp);
    const Vec3 at =
        root + way * along + bend * std::sqrt(std::max(0.0f, upper * upper - along * along));
    Quat& turn = written.rotation[index(limb.root)];
    turn = rotation_between(elbow - shoulder, at - root) * turn;
    Quat& fore = written.rotation[index(limb.middle)];
    fore = rotation_between(hand - elbow, root + way * far - at) * fore;
  }

  void add_row(const Pose& pose) {
    const WorldPose world = world_pose(skeleton_, pose);
    WorldPose written = world;  // of the bones that the file has
    for (const std::size_t joint : order_)
      written.rotation[joint] = world.rotation[turns_as_[joint]];
    for (const std::size_t joint : order_) {
      if (joint == 0) continue;
      const std::size_t carrier = carrier_of(joint);
      written.position[joint] =
          written.position[carrier] + written.rotation[carrier] * offset_of(joint);
      for (const Side side : {Side::left, Side::right}) {
        const Limb limb = arm(side);
        if (index(limb.root) != joint || !has(index(limb.middle)) || !has(index(limb.end)))
          continue;
        if (glm::distance(written.position[joint], world.position[joint]) < kSamePlace) continue;
        reach(world, limb, written.position[joint], written);
      }
    }
    const Vec3 hips = to_file_ * pose.hips / form_.metres_per_unit;
    put("{:.4f} {:.4f} {:.4f}", hips.x, hips.y, hips.z);
    for (const std::size_t joint : order_) {
      Quat turn = written.rotation[joint];
      if (joint != 0) turn = glm::inverse(written.rotation[carrier_of(joint)]) * turn;
      const glm::dvec3 angles = angles_of(to_file_ * turn * form_.axes);
      put(" {:.5f} {:.5f} {:.5f}", angles.x, angles.y, angles.z);
    }
    text_ += '\n';
  }

  const Skeleton& skeleton_;
  const ForeignSkeleton& form_;
  Quat to_file_;
  std::array<std::vector<std::size_t>, kJointCount> carried_;
  std::array<std::size_t, kJointCount> turns_as_{};
  std::vector<std::size_t> order_;  // as the hierarchy is written
  std::string text_;
};

}  // namespace

std::string fighter_bvh(const Skeleton& skeleton, const FighterTrack& track,
                        const ForeignSkeleton& form) {
  return BvhText(skeleton, form).with_motion(track);
}

}  // namespace ringcraft
