#include "io/root_motion.h"

#include <cmath>

#include "motion/smooth.h"

namespace ringcraft {

namespace {

constexpr float kSigma = 0.16f;   // s: half the power at 1 Hz
constexpr float kUpright = 0.5f;  // cosine: hips that lean farther have no heading

}  // namespace

std::vector<Placement> root_motion(const FighterTrack& track) {
  std::vector<Vec3> ground;
  std::vector<float> yaw;
  ground.reserve(track.frames.size());
  yaw.reserve(track.frames.size());
  for (const Pose& pose : track.frames) {
    ground.emplace_back(pose.hips.x, 0.0f, pose.hips.z);
    const Quat& hips = pose.rotation[index(Joint::hips)];
    const bool upright = (hips * kUp).y > kUpright;
    yaw.push_back(upright || yaw.empty() ? heading_of(hips) : yaw.back());
  }
  ground = smoothed(ground, kSigma);
  yaw = smoothed(unwrapped(std::move(yaw)), kSigma);
  std::vector<Placement> roots;
  roots.reserve(ground.size());
  for (std::size_t i = 0; i < ground.size(); ++i)
    roots.push_back({ground[i].x, ground[i].z, wrapped_angle(yaw[i])});
  return roots;
}

}  // namespace ringcraft
