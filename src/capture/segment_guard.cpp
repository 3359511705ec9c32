// The guard, and where the opponent stands.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture/segment_measure.h"
#include "motion/state_machine.h"

namespace ringcraft {
namespace {

constexpr float kQuietHand = 1.6f;       // m/s (docs/sources.md, C1)
constexpr float kQuietHips = 0.9f;       // m/s over the ground
constexpr float kUpright = radians(50);  // of the trunk
constexpr float kHigh = 0.85f;           // share of the hips' usual height
constexpr float kBentArm = 0.80f;        // of the arm's length
constexpr float kHandsUp = 0.08f;        // H of both wrists over the hips
constexpr float kAheadOfHips = 0.02f;    // H of both wrists ahead of the hips
constexpr std::size_t kFewest = 60;      // ticks that make a guard
constexpr float kBladed = 0.22f;         // H one ankle stands ahead of the other
constexpr float kSideOn = radians(25);   // the pelvis is off the opponent
constexpr Tick kAsideOfBlows = 12;       // ticks

constexpr std::array<Joint, 9> kLooks = {Joint::head,
                                         Joint::left_hand,
                                         Joint::right_hand,
                                         Joint::left_lower_arm,
                                         Joint::right_lower_arm,
                                         Joint::left_lower_leg,
                                         Joint::right_lower_leg,
                                         Joint::left_foot,
                                         Joint::right_foot};

std::vector<bool> quiet_ticks(const Measures& m, const std::vector<FoundBlow>& blows,
                              const std::vector<Descent>& falls) {
  std::vector<bool> quiet(m.world.size(), true);
  const auto busy = [&](Tick first, Tick last) {
    for (Tick t = m.clamped(first); t <= m.clamped(last); ++t) quiet[at(t)] = false;
  };
  for (const FoundBlow& blow : blows)
    busy(ticks(blow.begin) - kAsideOfBlows, ticks(blow.end) + kAsideOfBlows);
  for (const Descent& d : falls) busy(d.begin, d.up < 0 ? m.last : d.up);
  for (Tick t = 0; t <= m.last; ++t) {
    const bool still = m.hand[0].speed[at(t)] < kQuietHand && m.hand[1].speed[at(t)] < kQuietHand &&
                       m.hips_speed[at(t)] < kQuietHips;
    const bool tall = m.trunk[at(t)] > kUpright && m.at(Joint::hips, t).y > kHigh * m.usual_hips;
    quiet[at(t)] = quiet[at(t)] && still && tall;
  }
  return quiet;
}

bool hands_up(const Measures& m, Tick t) {
  return std::all_of(kSides.begin(), kSides.end(), [&](Side side) {
    const Vec3 wrist = m.at(arm(side).end, t) - m.at(Joint::hips, t);
    return wrist.y > kHandsUp * m.height &&
           seen_along(wrist, m.gaze[at(t)], side).z > kAheadOfHips * m.height &&
           m.hand[index(side)].extension[at(t)] < kBentArm;
  });
}

std::vector<Vec3> looks_at(const Measures& m, Tick t) {
  std::vector<Vec3> out;
  out.reserve(kLooks.size());
  for (const Joint joint : kLooks)
    out.push_back(
        seen_along(m.at(joint, t) - m.at(Joint::hips, t), m.pelvis_yaw[at(t)], Side::left));
  return out;
}

// The tick whose joints are nearest to the medians over `among`.
Tick nearest_to_medians(const Measures& m, const std::vector<Tick>& among) {
  std::vector<std::vector<Vec3>> looks;
  looks.reserve(among.size());
  for (const Tick t : among) looks.push_back(looks_at(m, t));
  std::vector<Vec3> median(kLooks.size());
  std::vector<float> values(among.size());
  for (std::size_t j = 0; j < kLooks.size(); ++j) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < among.size(); ++i) values[i] = looks[i][j][axis];
      const auto middle = values.begin() + static_cast<long>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      median[j][axis] = *middle;
    }
  }
  Tick best = among.front();
  float least = 1e9f;
  for (std::size_t i = 0; i < among.size(); ++i) {
    float sum = 0;
    for (std::size_t j = 0; j < kLooks.size(); ++j) sum += glm::distance2(looks[i][j], median[j]);
    if (sum < least) {
      least = sum;
      best = among[i];
    }
  }
  return best;
}

float middle_angle(std::vector<float> angles) {
  float x = 0;
  float z = 0;
  for (const float a : angles) x += std::sin(a), z += std::cos(a);
  const float mean = std::atan2(x, z);
  for (float& a : angles) a = wrapped_angle(a - mean);
  std::nth_element(angles.begin(), angles.begin() + static_cast<long>(angles.size() / 2),
                   angles.end());
  return wrapped_angle(mean + angles[angles.size() / 2]);
}

// Pelvis yaw off the opponent in guard: the way the straights and straight kicks go, each seen from
// the guard the body would stand in as it begins. Without any, the way the fighter looks.
float yaw_off_opponent(const Measures& m, const Guard& guard, const std::vector<FoundBlow>& blows,
                       const std::vector<Tick>& among) {
  std::vector<float> offs;
  for (const FoundBlow& blow : blows) {
    const bool straight = blow.strike.kind == StrikeKind::straight ||
                          blow.strike.kind == StrikeKind::front_kick ||
                          blow.strike.kind == StrikeKind::side_kick;
    if (!straight || blow.blocks) continue;
    const Tick reach = ticks(blow.reach);
    const Vec3 way = m.at(blow.strike.joint, reach) - m.at(Joint::hips, reach);
    offs.push_back(wrapped_angle(guard.facing[at(ticks(blow.begin))] - yaw_of(way)));
  }
  if (offs.empty()) {
    for (const Tick t : among) offs.push_back(wrapped_angle(guard.facing[at(t)] - m.gaze[at(t)]));
  }
  return middle_angle(std::move(offs));
}

float middle_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void find_stance(const Measures& m, const std::vector<Tick>& among, Guard& guard) {
  std::vector<float> ahead_of, hands;
  for (const Tick t : among) {
    hands.push_back(hands_height(m, t));
    const Vec3 apart = m.at(Joint::left_foot, t) - m.at(Joint::right_foot, t);
    ahead_of.push_back(seen_along(apart, guard.facing[at(t)], Side::left).z / m.height);
  }
  const float ahead = middle_of(std::move(ahead_of));
  guard.hands = middle_of(std::move(hands));
  guard.fights = guard.hands_up && std::abs(ahead) >= kBladed && std::abs(guard.yaw) >= kSideOn;
  guard.southpaw = guard.fights && ahead < 0;
  guard.evidence = fmt::format(
      "{} of {} ticks stand quietly{}, nearest to their medians {:.2f} s; left ankle {:+.2f} H "
      "ahead of the right, pelvis {:+.0f} degrees off the opponent",
      among.size(), m.world.size(), guard.hands_up ? " with both hands up" : "", seconds(guard.at),
      ahead, degrees(guard.yaw));
}

}  // namespace

Guard guard_of(const Skeleton& skeleton, const Clip& capture, const Measures& m,
               const std::vector<FoundBlow>& blows, const std::vector<Descent>& falls) {
  const std::vector<bool> quiet = quiet_ticks(m, blows, falls);
  std::vector<Tick> up, any, all;
  for (Tick t = 0; t <= m.last; ++t) {
    all.push_back(t);
    if (!quiet[at(t)]) continue;
    any.push_back(t);
    if (hands_up(m, t)) up.push_back(t);
  }
  Guard guard;
  guard.hands_up = up.size() >= kFewest;
  const std::vector<Tick>& among = guard.hands_up ? up : any.size() >= kFewest ? any : all;
  guard.at = nearest_to_medians(m, among);
  const Clip pose = window_about(capture, guard.at);
  const float heading = m.pelvis_yaw[at(guard.at)];
  for (Tick t = 0; t <= m.last; ++t) {
    const Alignment alignment = aligned(skeleton, pose, window_about(capture, t));
    guard.distance.push_back(alignment.distance);
    guard.facing.push_back(wrapped_angle(heading - alignment.placement.yaw));
  }
  guard.yaw = yaw_off_opponent(m, guard, blows, among);
  for (float& facing : guard.facing) facing = wrapped_angle(facing - guard.yaw);
  find_stance(m, among, guard);
  return guard;
}

}  // namespace ringcraft
