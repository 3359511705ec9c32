// How near the sheets' boxing is to a captured boxer, both ways: one way alone is won by blurring.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "capture/bvh.h"
#include "capture/retarget.h"
#include "capture/sheet.h"

namespace ringcraft {
namespace {

constexpr const char* kCapture = "/usr/share/assimp/models/BVH/Boxing_Toes.bvh";

// Twelve joints relative to the pelvis and the hip line, m, with their velocities, m/s.
struct Moment {
  std::array<Vec3, 12> position, velocity;
  float hand = 0;  // m/s, of the faster hand
};

std::array<Vec3, 12> joints_of(const Pose& pose) {
  static const Skeleton skeleton = canonical_skeleton();
  const WorldPose world = world_pose(skeleton, pose);
  const auto at = [&](Joint joint) { return world.position[index(joint)]; };
  const Vec3 line = at(Joint::left_upper_leg) - at(Joint::right_upper_leg);
  const Quat turn = glm::inverse(yaw_rotation(yaw_of(Vec3(-line.z, 0, line.x))));
  const Vec3 top = at(Joint::head) + world.rotation[index(Joint::head)] * Vec3(0, 0.22f, 0.02f);
  std::array<Vec3, 12> joints = {at(Joint::neck),           top,
                                 at(Joint::left_upper_arm), at(Joint::right_upper_arm),
                                 at(Joint::left_lower_arm), at(Joint::right_lower_arm),
                                 at(Joint::left_hand),      at(Joint::right_hand),
                                 at(Joint::left_lower_leg), at(Joint::right_lower_leg),
                                 at(Joint::left_foot),      at(Joint::right_foot)};
  for (Vec3& joint : joints) joint = turn * (joint - at(Joint::hips));
  return joints;
}

void collect(const Clip& clip, Tick first, Tick last, std::vector<Moment>& moments) {
  for (Tick t = std::max<Tick>(1, first); t < std::min<Tick>(last, clip.length()); t += 2) {
    Moment moment;
    moment.position = joints_of(clip.at(t));
    const auto before = joints_of(clip.at(t - 1)), after = joints_of(clip.at(t + 1));
    for (std::size_t i = 0; i < 12; ++i) {
      moment.velocity[i] = (after[i] - before[i]) * (kTicksPerSecond / 2.0f);
    }
    moment.hand = std::max(glm::length(moment.velocity[6]), glm::length(moment.velocity[7]));
    moments.push_back(moment);
  }
}

// The `share` quantile of the distance from each moment of `from` to its nearest one of `to`, m.
float distance(const std::vector<Moment>& from, const std::vector<Moment>& to, float tau,
               double share) {
  std::vector<float> nearest;
  for (const Moment& a : from) {
    float best = 1e9f;
    for (const Moment& b : to) {
      float sum = 0;
      for (std::size_t i = 0; i < 12; ++i) {
        sum += glm::length2(a.position[i] - b.position[i]) +
               tau * tau * glm::length2(a.velocity[i] - b.velocity[i]);
      }
      best = std::min(best, sum);
    }
    nearest.push_back(std::sqrt(best / 12));
  }
  std::sort(nearest.begin(), nearest.end());
  return nearest.at(static_cast<std::size_t>(share * static_cast<double>(nearest.size() - 1)));
}

TEST(SheetYardstick, AuthoredBoxingAndACapturedBoxerAreNearBothWays) {
  if (!std::filesystem::exists(kCapture)) GTEST_SKIP() << "needs the package assimp-testmodels";
  const auto raw = read_bvh(kCapture);
  ASSERT_TRUE(raw.has_value()) << to_string(raw.error());
  const auto profile = read_profile(assets_folder() / "profiles" / "boxing_toes.toml");
  ASSERT_TRUE(profile.has_value()) << to_string(profile.error());
  const auto retargeted = retarget(*raw, *profile, canonical_skeleton());
  ASSERT_TRUE(retargeted.has_value()) << to_string(retargeted.error());
  std::vector<Moment> real, strikes, authored;
  collect(mirrored(*retargeted), ticks(2.3), ticks(16), real);  // a southpaw; later he staggers
  for (const Moment& moment : real) {
    if (moment.hand > 2.5f) strikes.push_back(moment);
  }
  for (const char* name : {"guard", "punches", "combinations", "defenses", "steps"}) {
    const auto actions = compile_sheet_file(assets_folder() / "kickboxing" / "sheets" /
                                            (std::string(name) + ".toml"));
    ASSERT_TRUE(actions.has_value()) << to_string(actions.error());
    for (const Action& action : *actions) {
      const bool kicks = action.name.find("kick") != std::string::npos;
      if (!kicks) collect(action.clip, 0, action.length(), authored);
    }
  }
  // Two captured boxers are 14 and 20 cm apart (median, 90 %); one boxer's strike frames find the
  // other's at 18 and 22 with the longer velocity weight.
  EXPECT_LT(distance(authored, real, 0.05f, 0.5), 0.14f);
  EXPECT_LT(distance(authored, real, 0.05f, 0.9), 0.20f);
  EXPECT_LT(distance(strikes, authored, 0.1f, 0.5), 0.18f);
  EXPECT_LT(distance(strikes, authored, 0.1f, 0.9), 0.22f);
  // Blurred motion loses its fast hands: 99 % of real wrist speeds lie under 4.2-6.8 m/s.
  std::vector<float> hands;
  for (const Moment& moment : authored) hands.push_back(moment.hand);
  std::sort(hands.begin(), hands.end());
  const float fast = hands[hands.size() * 99 / 100];
  EXPECT_GT(fast, 4.2f);
  EXPECT_LT(fast, 7.8f);
}

}  // namespace
}  // namespace ringcraft
