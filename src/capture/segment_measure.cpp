#include "capture/segment_measure.h"

#include <algorithm>
#include <cmath>

#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSmoothLimbs = 0.012f;  // s
constexpr float kSmoothTrunk = 0.02f;   // s
constexpr float kSmoothGaze = 0.08f;    // s

// Yaw of the normal of a line from right to left, rad.
float normal_of(Vec3 right_to_left) {
  return std::atan2(-right_to_left.z, right_to_left.x);
}

Measures::LimbTracks limb_tracks(const Measures& m, const Skeleton& skeleton, const Limb& limb) {
  Measures::LimbTracks tracks;
  const float length = skeleton.bone(limb.middle) + skeleton.bone(limb.end);
  for (Tick t = 0; t <= m.last; ++t) {
    tracks.from_hips.push_back(m.at(limb.end, t) - m.at(Joint::hips, t));
    tracks.extension.push_back(glm::distance(m.at(limb.end, t), m.at(limb.root, t)) / length);
  }
  tracks.from_hips = smoothed(tracks.from_hips, kSmoothLimbs);
  tracks.speed.assign(tracks.from_hips.size(), 0.0f);
  for (std::size_t i = 1; i + 1 < tracks.from_hips.size(); ++i)
    tracks.speed[i] =
        glm::distance(tracks.from_hips[i + 1], tracks.from_hips[i - 1]) / (2 * kTickSeconds);
  return tracks;
}

void measure_hips(Measures& m) {
  std::vector<Vec3> hips;
  hips.reserve(m.world.size());
  for (Tick t = 0; t <= m.last; ++t) hips.push_back(m.at(Joint::hips, t));
  hips = smoothed(hips, kSmoothTrunk);
  constexpr Tick kSpan = 6;
  for (Tick t = 0; t <= m.last; ++t) {
    const Tick a = m.clamped(t - kSpan);
    const Tick b = m.clamped(t + kSpan);
    const Vec3 way = hips[static_cast<std::size_t>(b)] - hips[static_cast<std::size_t>(a)];
    const float time = static_cast<float>(std::max(1, b - a)) * kTickSeconds;
    m.hips_speed.push_back(std::hypot(way.x, way.z) / time);
    m.hips_climb.push_back(way.y / time);
  }
}

// Median height of the hips while the trunk is up and the hips above 0.4 H; of all frames where
// that never is.
float usual_height_of_hips(const Measures& m) {
  std::vector<float> heights;
  for (Tick t = 0; t <= m.last; ++t) {
    const float h = m.at(Joint::hips, t).y;
    if (h > 0.4f * m.height && m.trunk[static_cast<std::size_t>(t)] > radians(45))
      heights.push_back(h);
  }
  if (heights.empty()) return 0.53f * m.height;
  std::nth_element(heights.begin(), heights.begin() + static_cast<long>(heights.size() / 2),
                   heights.end());
  return heights[heights.size() / 2];
}

}  // namespace

Vec3 seen_along(Vec3 v, float yaw, Side side) {
  const Vec3 own = yaw_rotation(-yaw) * v;
  return {side == Side::left ? own.x : -own.x, own.y, own.z};
}

float hands_height(const Measures& m, Tick t) {
  return std::max(m.at(Joint::left_hand, t).y, m.at(Joint::right_hand, t).y);
}

std::vector<Tick> peaks_of(const std::vector<float>& values, float least, Tick around) {
  std::vector<Tick> out;
  const auto count = static_cast<Tick>(values.size());
  for (Tick t = 2; t + 2 < count; ++t) {
    const float value = values[static_cast<std::size_t>(t)];
    if (value < least) continue;
    bool highest = true;
    for (Tick k = std::max(0, t - around); k <= std::min(count - 1, t + around) && highest; ++k) {
      const float other = values[static_cast<std::size_t>(k)];
      highest = k < t ? other < value : other <= value;
    }
    if (highest) out.push_back(t);
  }
  return out;
}

std::vector<Tick> swings_of(const std::vector<float>& speed, float least, Tick around,
                            const SegmentSettings& settings) {
  constexpr Tick kAround = 12;
  const auto count = static_cast<Tick>(speed.size());
  std::vector<Tick> peaks = peaks_of(speed, least, around);
  std::erase_if(peaks, [&](Tick peak) {
    Tick fast = 0;  // ticks; what lies outside of the capture may have been
    for (Tick t = peak - kAround; t <= peak + kAround; ++t)
      if (t < 1 || t + 1 >= count || speed[at(t)] >= 0.25f * speed[at(peak)]) ++fast;
    return static_cast<float>(fast) * kTickSeconds < settings.shortest;
  });
  return peaks;
}

Measures measured(const Skeleton& skeleton, const Clip& capture) {
  Measures m;
  m.last = capture.length();
  m.height = skeleton.height;
  std::vector<float> gaze, pelvis;
  for (const Pose& pose : capture.frames) {
    m.world.push_back(world_pose(skeleton, pose));
    const WorldPose& w = m.world.back();
    const auto at = [&](Joint joint) { return w.position[index(joint)]; };
    gaze.push_back(yaw_of(w.rotation[index(Joint::head)] * kForward));
    pelvis.push_back(normal_of(at(Joint::left_upper_leg) - at(Joint::right_upper_leg)));
    const Vec3 trunk = at(Joint::neck) - at(Joint::hips);
    m.trunk.push_back(std::atan2(trunk.y, std::hypot(trunk.x, trunk.z)));
  }
  m.gaze = smoothed(unwrapped(std::move(gaze)), kSmoothGaze);
  m.pelvis_yaw = smoothed(unwrapped(std::move(pelvis)), kSmoothTrunk);
  for (const Side side : kSides) {
    m.hand[index(side)] = limb_tracks(m, skeleton, arm(side));
    m.foot[index(side)] = limb_tracks(m, skeleton, leg(side));
  }
  measure_hips(m);
  m.usual_hips = usual_height_of_hips(m);
  return m;
}

}  // namespace ringcraft
