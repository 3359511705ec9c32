#include "scene/library_check_yardstick.h"

#include <algorithm>
#include <array>

#include "base/quantile.h"
#include "scene/library_check_strikes.h"

namespace ringcraft {

namespace {

constexpr std::size_t kJoints = 12;
constexpr Tick kEvery = 3;                        // ticks between two frames that are compared
constexpr float kStrikeHand = 2.5f;               // m/s: a hand faster than that strikes
constexpr float kTau = 0.05f, kStrikeTau = 0.1f;  // s, weights of velocities

struct Posture {
  std::array<Vec3, kJoints> position, velocity;
  float hand = 0;  // m/s, of the faster hand against the pelvis
};

std::array<Vec3, kJoints> joints_of(const Skeleton& skeleton, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const auto at = [&](Joint joint) { return world.position[index(joint)]; };
  const Vec3 line = at(Joint::left_upper_leg) - at(Joint::right_upper_leg);
  const Quat turn = glm::inverse(yaw_rotation(yaw_of(Vec3(-line.z, 0, line.x))));
  const Vec3 top = at(Joint::head) + world.rotation[index(Joint::head)] * Vec3(0, 0.22f, 0.02f);
  std::array<Vec3, kJoints> joints = {at(Joint::neck),           top,
                                      at(Joint::left_upper_arm), at(Joint::right_upper_arm),
                                      at(Joint::left_lower_arm), at(Joint::right_lower_arm),
                                      at(Joint::left_hand),      at(Joint::right_hand),
                                      at(Joint::left_lower_leg), at(Joint::right_lower_leg),
                                      at(Joint::left_foot),      at(Joint::right_foot)};
  for (Vec3& joint : joints) joint = turn * (joint - at(Joint::hips));
  return joints;
}

void collect(const Skeleton& skeleton, const Clip& clip, Tick from, Tick to,
             std::vector<Posture>& moments) {
  for (Tick t = std::max<Tick>(1, from); t < std::min<Tick>(to, clip.length()); t += kEvery) {
    Posture moment;
    moment.position = joints_of(skeleton, clip.at(t));
    const auto before = joints_of(skeleton, clip.at(t - 1));
    const auto after = joints_of(skeleton, clip.at(t + 1));
    for (std::size_t i = 0; i < kJoints; ++i) {
      moment.velocity[i] = (after[i] - before[i]) * (kTicksPerSecond / 2.0f);
    }
    moment.hand = std::max(glm::length(moment.velocity[6]), glm::length(moment.velocity[7]));
    moments.push_back(moment);
  }
}

double nearest(const Posture& a, const std::vector<Posture>& to, float tau) {
  float best = 1e9f;
  for (const Posture& b : to) {
    float sum = 0;
    for (std::size_t i = 0; i < kJoints && sum < best; ++i) {
      sum += glm::length2(a.position[i] - b.position[i]) +
             tau * tau * glm::length2(a.velocity[i] - b.velocity[i]);
    }
    best = std::min(best, sum);
  }
  return std::sqrt(best / static_cast<float>(kJoints));
}

bool boxes(const Action& action) {
  if (!is_authored(action)) return false;
  if (action.forced()) return false;
  return std::all_of(action.strikes.begin(), action.strikes.end(), [](const Strike& strike) {
    const bool hand = strike.joint == Joint::left_hand || strike.joint == Joint::right_hand;
    return hand && strike.kind != StrikeKind::backfist;
  });
}

}  // namespace

Yardstick yardstick(const MotionLibrary& library, const Clip& real, Tick from, Tick to) {
  std::vector<Posture> captured, strikes, authored;
  collect(library.skeleton(), real, from, to, captured);
  std::copy_if(captured.begin(), captured.end(), std::back_inserter(strikes),
               [](const Posture& moment) { return moment.hand > kStrikeHand; });
  Yardstick result;
  std::vector<double> out, hands;
  for (const Action& action : library.actions()) {
    if (!boxes(action)) continue;
    std::vector<Posture> moments;
    collect(library.skeleton(), action.clip, 0, action.length(), moments);
    std::vector<double> own;
    own.reserve(moments.size());
    for (const Posture& moment : moments) {
      own.push_back(nearest(moment, captured, kTau));
      hands.push_back(moment.hand);
    }
    out.insert(out.end(), own.begin(), own.end());
    result.farthest.push_back({action.name, quantile(own, 0.5)});
    authored.insert(authored.end(), moments.begin(), moments.end());
  }
  std::stable_sort(result.farthest.begin(), result.farthest.end(),
                   [](const auto& a, const auto& b) { return a.median > b.median; });
  result.authored_median = quantile(out, 0.5);
  result.authored_90 = quantile(out, 0.9);
  std::vector<double> back;
  back.reserve(strikes.size());
  for (const Posture& moment : strikes) back.push_back(nearest(moment, authored, kStrikeTau));
  result.strikes_median = quantile(back, 0.5);
  result.strikes_90 = quantile(back, 0.9);
  result.fast_hand = quantile(hands, 0.99);
  return result;
}

}  // namespace ringcraft
