#include "motion/point_cloud.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

namespace {

constexpr float kLookAheadSeconds = 0.1f;
constexpr float kForeseenShare = 0.5f;  // of the weight of what is there

float weight_of(Joint joint) {
  switch (joint) {
    case Joint::left_foot:
    case Joint::right_foot:
    case Joint::left_toes:
    case Joint::right_toes:
      return 3.0f;
    case Joint::hips:
      return 2.0f;
    default:
      return 1.0f;
  }
}

}  // namespace

const std::array<float, kCloudPoints>& cloud_weights() {
  static const std::array<float, kCloudPoints> kWeights = [] {
    std::array<float, kCloudPoints> weights{};
    for (std::size_t i = 0; i < kJointCount; ++i) {
      weights[2 * i] = weight_of(joint_at(i));
      weights[2 * i + 1] = weights[2 * i] * kForeseenShare;
    }
    return weights;
  }();
  return kWeights;
}

Cloud cloud_at(const Skeleton& skeleton, const Clip& clip, Tick tick) {
  constexpr Tick kSpan = 4;
  const Tick early =
      std::clamp<Tick>(tick - kSpan / 2, 0, std::max<Tick>(0, clip.length() - kSpan));
  const Tick late = std::min<Tick>(early + kSpan, clip.length());
  const WorldPose now = world_pose(skeleton, clip.at(tick));
  const WorldPose before = world_pose(skeleton, clip.at(early));
  const WorldPose after = world_pose(skeleton, clip.at(late));
  const float per_look =
      kLookAheadSeconds / (static_cast<float>(std::max<Tick>(1, late - early)) * kTickSeconds);
  const Placement back = inverse(clip.root_at(tick));
  Cloud cloud;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 ahead = (after.position[i] - before.position[i]) * per_look;
    cloud.position[2 * i] = back * now.position[i];
    cloud.position[2 * i + 1] = back * (now.position[i] + ahead);
  }
  return cloud;
}

Alignment align(std::span<const Vec3> first, std::span<const Vec3> second,
                std::span<const float> weight) {
  double weights = 0, x1 = 0, z1 = 0, x2 = 0, z2 = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double w = weight[i];
    weights += w;
    x1 += w * first[i].x;
    z1 += w * first[i].z;
    x2 += w * second[i].x;
    z2 += w * second[i].z;
  }
  x1 /= weights, z1 /= weights, x2 /= weights, z2 /= weights;
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double w = weight[i];
    const double ax = first[i].x - x1, az = first[i].z - z1;
    const double bx = second[i].x - x2, bz = second[i].z - z2;
    sine += w * (ax * bz - az * bx);
    cosine += w * (ax * bx + az * bz);
  }
  Alignment result;
  result.placement.yaw = static_cast<float>(std::atan2(sine, cosine));
  const Quat turn = yaw_rotation(result.placement.yaw);
  const Vec3 turned = turn * Vec3(static_cast<float>(x2), 0, static_cast<float>(z2));
  result.placement.x = static_cast<float>(x1) - turned.x;
  result.placement.z = static_cast<float>(z1) - turned.z;
  const Vec3 moved = result.placement.position();
  double squares = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    squares += weight[i] * glm::distance2(first[i], turn * second[i] + moved);
  }
  result.distance = static_cast<float>(std::sqrt(squares / weights));
  return result;
}

Alignment align(const Cloud& first, const Cloud& second) {
  return align(first.position, second.position, cloud_weights());
}

}  // namespace ringcraft
