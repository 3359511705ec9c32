// Hands that go the captured way although their shoulders sit elsewhere: see carry_hands in
// retarget.h.
#include "capture/retarget.h"
#include "motion/smooth.h"
#include "motion/ik.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.985f;  // of an arm's length: beyond it its reach is eased
constexpr float kFacingSigma = 2.0f;  // s over which the body's facing is taken
constexpr float kLeastScale = 0.7f, kMostScale = 1.4f;

Vec3 wrist_off_hips(const WorldPose& world, Side side) {
  return world.position[index(arm(side).end)] -
         0.5f * (world.position[index(Joint::left_upper_leg)] +
                 world.position[index(Joint::right_upper_leg)]);
}

// Where the body faces for long; a spin or a cross turns it little.
std::vector<Quat> lasting_facing(const Clip& clip) {
  std::vector<float> yaw;
  for (const Pose& pose : clip.frames)
    yaw.push_back(yaw_of(glm::cross(pose.rotation[0] * kLeft, kUp)));
  std::vector<Quat> facing;
  for (const float angle : smoothed(unwrapped(yaw), kFacingSigma))
    facing.push_back(yaw_rotation(angle));
  return facing;
}

Vec3 mean(const std::vector<Vec3>& path) {
  Vec3 sum{};
  for (const Vec3& p : path) sum += p;
  return sum / static_cast<float>(path.size());
}

}  // namespace

void carry_hands(const Skeleton& skeleton, const std::array<std::vector<Vec3>, 2>& captured,
                 Clip& clip) {
  const std::vector<Quat> facing = lasting_facing(clip);
  for (const Side side : {Side::left, Side::right}) {
    std::vector<Vec3> theirs, ours;
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
      const Quat back = glm::inverse(facing[i]);
      theirs.push_back(back * captured[static_cast<std::size_t>(side)][i]);
      ours.push_back(back * wrist_off_hips(world_pose(skeleton, clip.frames[i]), side));
    }
    // Least squares of ours = scale x theirs + shift: the captured way in our body's proportions.
    const Vec3 our_mean = mean(ours), their_mean = mean(theirs);
    float both = 0, square = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      both += glm::dot(ours[i] - our_mean, theirs[i] - their_mean);
      square += glm::length2(theirs[i] - their_mean);
    }
    const float scale = square > 1e-6f ? glm::clamp(both / square, kLeastScale, kMostScale) : 1.0f;
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
      Pose& pose = clip.frames[i];
      const Vec3 moved = our_mean + scale * (theirs[i] - their_mean) - ours[i];
      const Vec3 wrist = world_pose(skeleton, pose).position[index(arm(side).end)];
      move_limb_end(skeleton, arm(side), wrist + facing[i] * moved, kSoftShare, pose);
    }
  }
}

}  // namespace ringcraft
