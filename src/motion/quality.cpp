#include "motion/quality.h"

#include <algorithm>
#include <cmath>

#include "base/quantile.h"

namespace ringcraft {
namespace {

constexpr double kMeasuredRate = 60;  // Hz

float standing_height(const std::vector<Vec3>& path, const std::vector<std::size_t>& upright) {
  std::vector<float> heights;
  heights.reserve(upright.size());
  for (const std::size_t i : upright) heights.push_back(path[i].y);
  return quantile(std::move(heights), 0.05);
}

float ground_speed(const std::vector<Vec3>& path, std::size_t a, std::size_t b, double seconds) {
  const Vec3 way = path[b] - path[a];
  return std::hypot(way.x, way.z) / static_cast<float>(seconds);
}

}  // namespace

double foot_skate_ratio(const std::array<FootPath, 2>& feet, std::span<const float> hips_height,
                        double frames_per_second, const FootSkateSettings& settings) {
  const auto stride =
      static_cast<std::size_t>(std::max(1.0, std::round(frames_per_second / kMeasuredRate)));
  const double step = static_cast<double>(stride) / frames_per_second;
  if (hips_height.size() < 2 * stride) return 0;
  const float usual = quantile(std::vector<float>(hips_height.begin(), hips_height.end()), 0.75);
  std::vector<std::size_t> upright;
  for (std::size_t i = 0; i < hips_height.size(); i += stride)
    if (hips_height[i] >= settings.hips_up * usual) upright.push_back(i);
  if (upright.empty()) return 0;

  const auto shortest = static_cast<std::size_t>(std::ceil(settings.shortest / step - 1e-6));
  std::size_t sliding = 0;
  std::size_t all = 0;
  for (const FootPath& foot : feet) {
    const float ankle_low = standing_height(foot.ankle, upright) + settings.height;
    const float toes_low = standing_height(foot.toes, upright) + settings.height;
    std::size_t run = 0;
    for (std::size_t i = 0; i + stride < hips_height.size(); i += stride, ++all) {
      const float speed = std::min(ground_speed(foot.ankle, i, i + stride, step),
                                   ground_speed(foot.toes, i, i + stride, step));
      const bool slides = foot.ankle[i].y < ankle_low && foot.toes[i].y < toes_low &&
                          speed >= settings.slowest && speed <= settings.fastest;
      run = slides ? run + 1 : 0;
      if (run == shortest) sliding += shortest;
      if (run > shortest) ++sliding;
    }
  }
  return static_cast<double>(sliding) / static_cast<double>(all);
}

double foot_skate_ratio(const Skeleton& skeleton, std::span<const Pose> frames,
                        double frames_per_second, const FootSkateSettings& settings) {
  std::array<FootPath, 2> feet;
  std::vector<float> hips;
  for (const Pose& pose : frames) {
    const WorldPose world = world_pose(skeleton, pose);
    for (const Side side : {Side::left, Side::right}) {
      FootPath& foot = feet[static_cast<std::size_t>(side)];
      foot.ankle.push_back(world.position[index(leg(side).end)]);
      foot.toes.push_back(world.position[index(toes(side))]);
    }
    hips.push_back(pose.hips.y);
  }
  return foot_skate_ratio(feet, hips, frames_per_second, settings);
}

}  // namespace ringcraft
