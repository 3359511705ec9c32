// Hands that go the captured way although their shoulders sit elsewhere: see carry_hands in
// retarget.h.
#include "capture/retarget.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.985f;  // of an arm's length: beyond it its reach is eased
constexpr float kLeastScale = 0.7f, kMostScale = 1.4f;

Vec3 wrist_off_hips(const WorldPose& world, Side side) {
  return world.position[index(arm(side).end)] -
         0.5f * (world.position[index(Joint::left_upper_leg)] +
                 world.position[index(Joint::right_upper_leg)]);
}

}  // namespace

void carry_hands(const Skeleton& skeleton, const std::array<std::vector<Vec3>, 2>& captured,
                 Clip& clip) {
  std::array<std::vector<Vec3>, 2> ours;
  std::vector<float> upright;
  for (const Pose& pose : clip.frames) {
    const WorldPose world = world_pose(skeleton, pose);
    for (std::size_t s = 0; s < 2; ++s)
      ours[s].push_back(wrist_off_hips(world, s == 0 ? Side::left : Side::right));
    const Vec3 trunk = world.position[index(Joint::neck)] - world.position[0];
    upright.push_back(normalized_or(trunk, kUp).y);
  }
  // Least squares of ours = scale x theirs + lift x up, over both hands: they keep their distance
  // to each other.
  float both = 0, square = 0, up = 0, their_up = 0, up_square = 0;
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t i = 0; i < upright.size(); ++i) {
      both += glm::dot(ours[s][i], captured[s][i]);
      square += glm::length2(captured[s][i]);
      up += ours[s][i].y * upright[i];
      their_up += captured[s][i].y * upright[i];
      up_square += upright[i] * upright[i];
    }
  const float determinant = square * up_square - their_up * their_up;
  const float scale =
      determinant > 1e-3f * square * up_square
          ? glm::clamp((both * up_square - up * their_up) / determinant, kLeastScale, kMostScale)
          : 1.0f;
  const float lift = up_square > 0 ? (up - scale * their_up) / up_square : 0.0f;
  for (std::size_t i = 0; i < upright.size(); ++i)
    for (const Side side : {Side::left, Side::right}) {
      const auto s = static_cast<std::size_t>(side);
      Pose& pose = clip.frames[i];
      const Vec3 moved = scale * captured[s][i] + lift * upright[i] * kUp - ours[s][i];
      const Vec3 wrist = world_pose(skeleton, pose).position[index(arm(side).end)];
      move_limb_end(skeleton, arm(side), wrist + moved, kSoftShare, pose);
    }
}

}  // namespace ringcraft
