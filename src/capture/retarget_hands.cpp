// Hands that go the captured way although their shoulders sit elsewhere: see carry_hands in
// retarget.h.
#include <algorithm>
#include <cmath>

#include "capture/ease.h"
#include "capture/retarget.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.985f;  // of an arm's length: beyond it its reach is eased
constexpr float kStill = 0.01f;       // m (one sigma): a hand that moves less has no way to keep
constexpr float kMostStray = 0.03f;   // of the square of its way, that a hand may leave it by
constexpr float kEvenStep = 0.05f;
constexpr float kLeastScale = 0.7f, kMostScale = 1.4f;

Vec3 wrist_off_hips(const WorldPose& world, Side side) {
  return world.position[index(arm(side).end)] -
         0.5f * (world.position[index(Joint::left_upper_leg)] +
                 world.position[index(Joint::right_upper_leg)]);
}

// How captured wrists become ours: theirs scaled, and shifted up by lift_at.
struct HandFit {
  float scale = 1;
  float lift = 0;   // m along an upright trunk
  float level = 0;  // m by which the floor lifts hands that lie on it
  float even = 0;   // 0: only the lift; 1: hands are shifted by `level` all the time

  float lift_at(float upright) const { return lift * upright * (1 - even) + level * even; }
};

// Least squares of ours = scale x theirs + lift x up, over both hands: they keep their distance to
// each other.
HandFit fit_hands(const std::array<std::vector<Vec3>, 2>& ours,
                  const std::array<std::vector<Vec3>, 2>& captured,
                  const std::vector<float>& upright) {
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
  HandFit fit;
  fit.scale =
      determinant > 1e-3f * square * up_square
          ? glm::clamp((both * up_square - up * their_up) / determinant, kLeastScale, kMostScale)
          : 1.0f;
  fit.lift = up_square > 0 ? (up - fit.scale * their_up) / up_square : 0.0f;
  return fit;
}

// Heights of one wrist over the floor, lying hands on it.
float height_at(const HandFit& fit, Vec3 captured, float upright, float hips) {
  return eased_up(hips + fit.scale * captured.y + fit.lift_at(upright), kPalm, kLyingEase);
}

// The median of what the floor lifts hands by that would lie in it, m; 0 where none would.
float floor_lift(const HandFit& fit, const std::array<std::vector<Vec3>, 2>& captured,
                 const std::vector<float>& hips) {
  std::vector<float> lifts;
  for (const auto& path : captured)
    for (std::size_t i = 0; i < hips.size(); ++i)
      if (const float under = kPalm - hips[i] - fit.scale * path[i].y; under > 0)
        lifts.push_back(under);
  if (lifts.empty()) return 0;
  const auto middle = lifts.begin() + static_cast<std::ptrdiff_t>(lifts.size() / 2);
  std::nth_element(lifts.begin(), middle, lifts.end());
  return *middle;
}

// What of the height of a wrist over the hips is not the captured way: 1 - r^2 of the two.
float strayed(const HandFit& fit, const std::vector<Vec3>& captured,
              const std::vector<float>& upright, const std::vector<float>& hips) {
  const std::size_t count = hips.size();
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto theirs = static_cast<double>(captured[i].y);
    const auto ours =
        static_cast<double>(height_at(fit, captured[i], upright[i], hips[i]) - hips[i]);
    a += theirs, b += ours, aa += theirs * theirs, bb += ours * ours, ab += theirs * ours;
  }
  const auto n = static_cast<double>(count);
  const double spread = aa / n - a / n * (a / n), own = bb / n - b / n * (b / n);
  const double common = ab / n - a / n * (b / n);
  if (spread < kStill * kStill || own <= 0) return 0;
  return static_cast<float>(1 - std::max(0.0, common) * common / (spread * own));
}

}  // namespace

void carry_hands(const Skeleton& skeleton, const std::array<std::vector<Vec3>, 2>& captured,
                 Clip& clip) {
  std::array<std::vector<Vec3>, 2> ours;
  std::vector<float> upright, hips;
  for (const Pose& pose : clip.frames) {
    const WorldPose world = world_pose(skeleton, pose);
    for (std::size_t s = 0; s < 2; ++s)
      ours[s].push_back(wrist_off_hips(world, s == 0 ? Side::left : Side::right));
    const Vec3 trunk = world.position[index(Joint::neck)] - world.position[0];
    upright.push_back(normalized_or(trunk, kUp).y);
    const float height = 0.5f * (world.position[index(Joint::left_upper_leg)].y +
                                 world.position[index(Joint::right_upper_leg)].y);
    hips.push_back(eased_up(height, kSeatHeight, kLyingEase));
  }
  HandFit fit = fit_hands(ours, captured, upright);
  fit.level = floor_lift(fit, captured, hips);
  const auto stray = [&] {
    return std::max(strayed(fit, captured[0], upright, hips),
                    strayed(fit, captured[1], upright, hips));
  };
  while (fit.level > 0 && fit.even < 1 && stray() > kMostStray)
    fit.even = std::min(1.0f, fit.even + kEvenStep);
  for (std::size_t i = 0; i < upright.size(); ++i)
    for (const Side side : {Side::left, Side::right}) {
      const auto s = static_cast<std::size_t>(side);
      Pose& pose = clip.frames[i];
      const Vec3 moved = fit.scale * captured[s][i] + fit.lift_at(upright[i]) * kUp - ours[s][i];
      const Vec3 wrist = world_pose(skeleton, pose).position[index(arm(side).end)];
      move_limb_end(skeleton, arm(side), wrist + moved, kSoftShare, pose);
    }
}

}  // namespace ringcraft
