#include "io/skin_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ringcraft {

namespace {

using Shares = std::array<float, kJointCount>;

// 0 below `low`, 1 above `high`, smooth between; `low` may stand above `high`.
float ramp(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Shares in 1/65535 of the four largest; what rounding leaves goes to the largest.
SkinWeights packed(const Shares& shares) {
  std::array<std::size_t, kJointCount> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += shares[order[i]];
  SkinWeights weights;
  int left = 65535;
  for (std::size_t i = 0; i < 4; ++i) {
    const int share = static_cast<int>(std::lround(65535.0f * shares[order[i]] / sum));
    if (share < 64) break;  // a thousandth moves nothing
    weights.joint[i] = static_cast<std::uint8_t>(order[i]);
    weights.share[i] = static_cast<std::uint16_t>(share);
    left -= share;
  }
  weights.share[0] = static_cast<std::uint16_t>(weights.share[0] + left);
  return weights;
}

// Hands the share of `parent` on to `child` by `part`.
void pass_on(Shares& shares, Joint parent, Joint child, float part) {
  const float moved = shares[index(parent)] * part;
  shares[index(parent)] -= moved;
  shares[index(child)] += moved;
}

// Up the trunk by height; the chin belongs to the head, the nape to the neck.
void share_trunk(Shares& shares, const Build& build, Vec3 p, float unit) {
  const auto height = [&](Joint joint) { return build.rest.position[index(joint)].y; };
  const auto step = [&](Joint parent, Joint child, float value, float half) {
    pass_on(shares, parent, child,
            ramp(height(child) - half * unit, height(child) + half * unit, value));
  };
  step(Joint::hips, Joint::spine, p.y, 0.060f);
  step(Joint::spine, Joint::chest, p.y, 0.060f);
  step(Joint::chest, Joint::upper_chest, p.y, 0.060f);
  // The neck's base runs down from the nape to the pit of the throat.
  step(Joint::upper_chest, Joint::neck, p.y + 0.4f * p.z - 0.35f * p.x, 0.050f);
  const Vec3 head = p - build.rest.position[index(Joint::head)];
  pass_on(shares, Joint::neck, Joint::head,
          ramp(-0.030f * unit, 0.030f * unit, head.y + 0.75f * head.z));
}

// Collarbone, upper arm, lower arm, hand, by the distance out from the midline (p.x >= 0).
void share_arm(Shares& shares, const Build& build, Vec3 p, float unit, float girth) {
  const Vec3 shoulder = build.rest.position[index(Joint::left_upper_arm)];
  const Vec3 root = build.rest.position[index(Joint::left_shoulder)];
  const float above = p.y - shoulder.y;
  const float out = p.x - shoulder.x;
  const float collar =
      ramp(root.x + 0.010f * unit, shoulder.x, p.x) * ramp(-0.140f * unit, -0.010f * unit, above);
  pass_on(shares, Joint::upper_chest, Joint::left_shoulder, 0.85f * collar);
  pass_on(shares, Joint::neck, Joint::left_shoulder, 0.85f * collar);
  // The top of the shoulder rides with the arm; below, the armpit's skin stays with the trunk
  // longer.
  const float tilt = 0.35f * above;
  const float arm = ramp(-0.060f * unit * girth, 0.055f * unit * girth, out + tilt);
  for (const Joint joint : {Joint::chest, Joint::upper_chest, Joint::neck, Joint::left_shoulder}) {
    pass_on(shares, joint, Joint::left_upper_arm, arm);
  }
  const auto along = [&](Joint parent, Joint child, float half, float value) {
    const float at = build.rest.position[index(child)].x;
    pass_on(shares, parent, child, ramp(at - half * unit, at + half * unit, value));
  };
  // The elbow's point belongs to the forearm, its crook to the upper arm.
  along(Joint::left_upper_arm, Joint::left_lower_arm, 0.050f, p.x - 0.5f * (p.z - shoulder.z));
  along(Joint::left_lower_arm, Joint::left_hand, 0.030f, p.x);
}

// Thigh, shin, foot, toes, by the distance below the hip joint (p.x >= 0).
void share_leg(Shares& shares, const Build& build, Vec3 p, float unit) {
  const Vec3 hip = build.rest.position[index(Joint::left_upper_leg)];
  const Vec3 knee = build.rest.position[index(Joint::left_lower_leg)];
  const Vec3 ankle = build.rest.position[index(Joint::left_foot)];
  const Vec3 ball = build.rest.position[index(Joint::left_toes)];
  // The fold runs from the crotch up and out to the hip bone; behind, the buttock stretches over
  // more.
  const float lateral = std::clamp(p.x / hip.x, 0.0f, 1.8f);
  const float fold = hip.y + unit * (-0.065f + 0.050f * lateral);
  const float behind = ramp(0.02f * unit, -0.08f * unit, p.z);
  const float leg =
      ramp(fold + unit * (0.055f + 0.025f * behind), fold - unit * (0.055f + 0.075f * behind), p.y);
  // On the midline both legs have the same share.
  const float own = ramp(-0.025f * unit, 0.025f * unit, p.x);
  for (const Joint joint : {Joint::hips, Joint::spine}) {
    const float moved = shares[index(joint)] * leg;
    shares[index(joint)] -= moved;
    shares[index(Joint::left_upper_leg)] += moved * own;
    shares[index(Joint::right_upper_leg)] += moved * (1.0f - own);
  }
  const float shin = ramp(knee.y + 0.065f * unit, knee.y - 0.065f * unit, p.y);
  pass_on(shares, Joint::left_upper_leg, Joint::left_lower_leg, shin);
  const float foot = ramp(ankle.y + 0.045f * unit, ankle.y - 0.020f * unit, p.y - 0.3f * p.z);
  pass_on(shares, Joint::left_lower_leg, Joint::left_foot, foot);
  pass_on(shares, Joint::left_foot, Joint::left_toes,
          ramp(ball.z - 0.020f * unit, ball.z + 0.025f * unit, p.z));
}

}  // namespace

SkinWeights skin_weights(const Build& build, Vec3 point) {
  const float unit = build.scale;
  const Vec3 p{std::abs(point.x), point.y, point.z};
  Shares shares{};
  shares[index(Joint::hips)] = 1;
  share_trunk(shares, build, p, unit);
  share_arm(shares, build, p, unit, build.girth);
  share_leg(shares, build, p, unit);
  if (point.x < 0) {
    Shares other{};
    for (std::size_t i = 0; i < kJointCount; ++i) other[index(mirrored(joint_at(i)))] = shares[i];
    shares = other;
  }
  return packed(shares);
}

SkinWeights rigid_weights(Joint joint) {
  SkinWeights weights;
  weights.joint[0] = static_cast<std::uint8_t>(index(joint));
  weights.share[0] = 65535;
  return weights;
}

}  // namespace ringcraft
