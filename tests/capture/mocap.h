#pragma once
// Captures that the project does not hold: the folder RINGCRAFT_MOCAP names, else ../shared/mocap
// beside the sources. Tests that need them skip where they are not there.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "base/file.h"
#include "capture/retarget.h"
#include "motion/quality.h"

namespace ringcraft::testing {

inline std::filesystem::path mocap_folder() {
  if (const char* set = std::getenv("RINGCRAFT_MOCAP"); set != nullptr && *set != '\0') return set;
  return std::filesystem::path(RINGCRAFT_SOURCE_DIR) / ".." / "shared" / "mocap";
}

inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double mean_a = 0, mean_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) mean_a += a[i], mean_b += b[i];
  mean_a /= static_cast<double>(a.size());
  mean_b /= static_cast<double>(b.size());
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

inline double spread(const std::vector<double>& a) {
  double mean = 0, sum = 0;
  for (const double v : a) mean += v;
  mean /= static_cast<double>(a.size());
  for (const double v : a) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// What retargeting did to one capture. Paths are relative to the middle of the hip joints.
struct RetargetMeasures {
  struct Axis {
    Joint joint;
    int axis;
    double correlation, spread;  // spread of the source, m
  };
  std::vector<Axis> axes;
  double source_skate = 0, our_skate = 0;          // shares of time
  double source_knee_jerk = 0, our_knee_jerk = 0;  // largest second difference, deg/tick2
  double worst(double least_spread) const {
    double worst = 1;
    for (const Axis& a : axes)
      if (a.spread >= least_spread) worst = std::min(worst, a.correlation);
    return worst;
  }
};

inline float knee_bend(Vec3 hip, Vec3 knee, Vec3 ankle) {
  const float cosine = glm::dot(glm::normalize(hip - knee), glm::normalize(ankle - knee));
  return degrees(std::acos(glm::clamp(cosine, -1.0f, 1.0f)));
}

inline double largest_second_difference(const std::vector<float>& values) {
  float largest = 0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i + 1] - 2 * values[i] + values[i - 1]));
  return static_cast<double>(largest);
}

// The source in our axes, at our body's size.
inline RetargetMeasures measure(const RawClip& raw, const JointMap& map, const Clip& clip,
                                const Skeleton& skeleton) {
  const auto source_at = [&](const RawPose& pose, Joint joint) {
    return map.axes * pose.position[static_cast<std::size_t>(map.source[index(joint)])];
  };
  const RawPose rest = raw_rest_pose(raw);
  float leg_units = 0;
  for (const Side side : {Side::left, Side::right})
    leg_units +=
        0.5f * (glm::distance(source_at(rest, leg(side).root), source_at(rest, leg(side).middle)) +
                glm::distance(source_at(rest, leg(side).middle), source_at(rest, leg(side).end)));
  const float scale = skeleton.leg_length() / leg_units;
  const std::array<Joint, 4> ends = {Joint::left_hand, Joint::right_hand, Joint::left_foot,
                                     Joint::right_foot};
  std::array<std::vector<double>, 12> ours, theirs;
  std::array<FootPath, 2> feet;
  std::array<std::vector<float>, 2> our_knees, their_knees;
  std::vector<float> hips;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const WorldPose world = world_pose(skeleton, clip.frames[i]);
    const RawPose source = raw_pose(raw, static_cast<double>(i) / kTicksPerSecond);
    const Vec3 our_hips = 0.5f * (world.position[index(Joint::left_upper_leg)] +
                                  world.position[index(Joint::right_upper_leg)]);
    const Vec3 their_hips = 0.5f * (source_at(source, Joint::left_upper_leg) +
                                    source_at(source, Joint::right_upper_leg));
    hips.push_back(their_hips.y * scale);
    for (std::size_t e = 0; e < 4; ++e)
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t at = 3 * e + static_cast<std::size_t>(axis);
        ours[at].push_back(
            static_cast<double>(world.position[index(ends[e])][axis] - our_hips[axis]));
        theirs[at].push_back(
            static_cast<double>((source_at(source, ends[e])[axis] - their_hips[axis]) * scale));
      }
    for (const Side side : {Side::left, Side::right}) {
      const Limb limb = leg(side);
      our_knees[static_cast<std::size_t>(side)].push_back(
          knee_bend(world.position[index(limb.root)], world.position[index(limb.middle)],
                    world.position[index(limb.end)]));
      their_knees[static_cast<std::size_t>(side)].push_back(
          knee_bend(source_at(source, limb.root), source_at(source, limb.middle),
                    source_at(source, limb.end)));
      FootPath& path = feet[static_cast<std::size_t>(side)];
      path.ankle.push_back(source_at(source, leg(side).end) * scale);
      path.toes.push_back(map.source[index(toes(side))] >= 0 ? source_at(source, toes(side)) * scale
                                                             : path.ankle.back());
    }
  }
  RetargetMeasures out;
  for (std::size_t at = 0; at < 12; ++at)
    out.axes.push_back({ends[at / 3], static_cast<int>(at % 3), correlation(ours[at], theirs[at]),
                        spread(theirs[at])});
  for (std::size_t s = 0; s < 2; ++s) {
    out.our_knee_jerk = std::max(out.our_knee_jerk, largest_second_difference(our_knees[s]));
    out.source_knee_jerk =
        std::max(out.source_knee_jerk, largest_second_difference(their_knees[s]));
  }
  out.source_skate = foot_skate_ratio(feet, hips, kTicksPerSecond);
  out.our_skate = foot_skate_ratio(skeleton, clip.frames, kTicksPerSecond);
  return out;
}

}  // namespace ringcraft::testing
