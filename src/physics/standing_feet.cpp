#include "physics/standing_feet.h"

#include <algorithm>
#include <cmath>

#include "motion/ik.h"

namespace ringcraft {
namespace {

constexpr float kStill = .8f;     // m/s: a foot that moves faster does not stand
constexpr float kHeld = .06f;     // m: so far a foot is held back all the way
constexpr float kMost = .12f;     // m: and no farther than that
constexpr float kLifted = .02f;   // m: a sole that is higher does not stand
constexpr float kLanded = .005f;  // m: one that comes down so far stands from there on
constexpr float kLetGo = .08f;    // s in which what held a foot falls to a third
constexpr float kSoft = .95f;  // of the leg's length: beyond it the leg stretches ever more slowly
constexpr float kLongest = .9995f;

// As far as a foot that was moved by `off` is held back: easing from kHeld on.
Vec3 held_back(Vec3 off) {
  constexpr float kRoom = kMost - kHeld;
  const float far = glm::length(off);
  if (far <= kHeld) return off;
  return off * ((kHeld + kRoom * (1 - std::exp((kHeld - far) / kRoom))) / far);
}

}  // namespace

StandingFeet::StandingFeet(const BodyModel& body, const ImpactFrame& frame) : body_(body) {
  const WorldPose now = world_pose(body.skeleton, frame.pose()),
                  before = world_pose(body.skeleton, frame.before());
  for (const Side side : {Side::left, Side::right}) {
    Foot& foot = feet_[static_cast<std::size_t>(side)];
    foot.ball = now.position[index(toes(side))];
    foot.reach = reach_share(body.skeleton, leg(side), now);
    const float speed = glm::distance(foot.ball, before.position[index(toes(side))]) / kTickSeconds;
    foot.stands = frame.contacts().of(side) && speed < kStill;
  }
}

void StandingFeet::hold(Pose& pose) {
  const WorldPose world = world_pose(body_.skeleton, pose);
  for (const Side side : {Side::left, Side::right}) {
    Foot& foot = feet_[static_cast<std::size_t>(side)];
    const Vec3 ball = world.position[index(toes(side))];
    const float low = sole_height(body_, world, side);
    const float speed = glm::distance(foot.ball, ball) / kTickSeconds;
    foot.stands = foot.stands || (low < kLanded && speed < kStill);
    if (low > kLifted) {
      foot.off *= std::exp(-kTickSeconds / kLetGo);
    } else if (foot.stands) {
      foot.off += foot.ball - ball;
      foot.off.y = 0;
    }
    foot.ball = ball;
    const Limb limb = leg(side);
    move_limb_end(body_.skeleton, limb, world.position[index(limb.end)] + held_back(foot.off),
                  std::clamp(foot.reach, kSoft, kLongest), pose);
  }
}

}  // namespace ringcraft
