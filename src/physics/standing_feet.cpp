#include "physics/standing_feet.h"

#include <algorithm>
#include <cmath>

#include "motion/ik.h"
#include "motion/spring.h"
#include "physics/limits.h"

namespace ringcraft {
namespace {

constexpr float kStill = .8f;          // m/s: a foot that moves faster does not stand
constexpr float kHeld = .12f;          // m: so far a foot is held back all the way
constexpr float kMost = .20f;          // m: and no farther than that
constexpr float kLifted = .10f;        // m: a sole that is higher has been swept off the floor
constexpr float kLanded = .005f;       // m: one that comes down so far stands from there on
constexpr float kLetGo = .08f;         // s in which what held a foot falls to a third
constexpr float kRise = .045f;         // m: of a sole that is dragged, clear of the floor
constexpr float kDragged = .015f;      // m: by which it is dragged when it is as high as that
constexpr float kRiseRate = 50;        // 1/s: of the spring (motion/spring.h) that lifts it
constexpr float kBeyond = radians(5);  // of its range: a leg that would go farther lets go
constexpr float kSoft = .95f;  // of the leg's length: beyond it the leg stretches ever more slowly
constexpr float kLongest = .9995f;

// As far as a foot that was moved by `off` is held back: easing from kHeld on.
Vec3 held_back(Vec3 off) {
  constexpr float kRoom = kMost - kHeld;
  const float far = glm::length(off);
  if (far <= kHeld) return off;
  return off * ((kHeld + kRoom * (1 - std::exp((kHeld - far) / kRoom))) / far);
}

// How much of the `way` of its end a leg can go.
float share_in_range(const BodyModel& body, Side side, Vec3 way, const Pose& pose) {
  constexpr float kLeast = 1 / 64.f;
  const Limb limb = leg(side);
  const Vec3 ankle = world_pose(body.skeleton, pose).position[index(limb.end)];
  const auto beyond = [&](float share) {
    Pose moved = pose;
    move_limb_end(body.skeleton, limb, ankle + share * way, 1.0f, moved);
    const LimitExcesses excesses = limit_excesses(moved);
    float most = 0;
    for (std::size_t i = 0; i < kLimitCount; ++i) {
      if (leg_of_limit(i) == side) most = std::max(most, excesses[i]);
    }
    return most;
  };
  const float most = std::max(kBeyond, beyond(0));
  if (beyond(1) <= most) return 1;
  float share = 0;
  for (float step = 0.5f; step > kLeast; step /= 2) {
    if (beyond(share + step) <= most) share += step;
  }
  return share;
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

void StandingFeet::Foot::rise_to(float height) {
  float over = rise - height;
  settle(over, rising, kRiseRate);
  rise = height + over;
}

void StandingFeet::hold(Pose& pose) {
  const WorldPose world = world_pose(body_.skeleton, pose);
  for (const Side side : {Side::left, Side::right}) {
    Foot& foot = feet_[static_cast<std::size_t>(side)];
    const Vec3 ball = world.position[index(toes(side))];
    const float low = sole_height(body_, world, side);
    const float speed = glm::distance(foot.ball, ball) / kTickSeconds;
    foot.stands = foot.stands || (low < kLanded && speed < kStill);
    if (low < kLanded) foot.down = 1;
    if (low > kLifted || foot.down < 1) {
      const float left = std::exp(-kTickSeconds / kLetGo);
      foot.off *= left;
      foot.down *= left;
    } else if (foot.stands) {
      foot.off += foot.ball - ball;
      foot.off.y = 0;
    }
    foot.ball = ball;
    const float down = foot.stands ? foot.down * std::max(0.0f, low) : 0.0f;
    const Limb limb = leg(side);
    const Vec3 way = held_back(foot.off) - kUp * down;
    const float share = share_in_range(body_, side, way, pose);
    foot.off *= share;
    foot.down *= share;
    const Vec3 ankle = world.position[index(limb.end)] + share * way;
    const auto put = [&](float rise) {
      move_limb_end(body_.skeleton, limb, ankle + kUp * rise,
                    std::clamp(foot.reach, kSoft, kLongest), pose);
    };
    put(foot.rise);
    const Vec3 dragged =
        world_pose(body_.skeleton, pose).position[index(toes(side))] - ball - foot.off;
    foot.rise_to(kRise *
                 glm::smoothstep(0.0f, kDragged, glm::length(Vec3{dragged.x, 0, dragged.z})));
    put(foot.rise);
  }
}

}  // namespace ringcraft
