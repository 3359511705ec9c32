#include "motion/feet.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/ik.h"
#include "motion/spring.h"

namespace ringcraft {

namespace {

constexpr float kStraightest = 0.95f;     // of the leg's length: beyond it the hips sink
constexpr float kBends = 0.3f;            // 1/s: nor has it to bend faster than that
constexpr float kSinkSoft = 0.012f;       // m: over which that sets in, and more where they rise
constexpr float kSinkSoftest = 0.05f;     // m
constexpr float kSinkBrake = 25;          // m/s2: so fast that they are braked by this
constexpr float kMostSink = 0.1f;         // m: a foot for which they would sink deeper is let go
constexpr float kLoadSeconds = 0.12f;     // in which a foot that was set down takes the weight
constexpr float kRiseRate = 12;           // 1/s: at which hips that sank come up again
constexpr float kStepSpeed = 1.6f;        // m/s: mean speed of a long step of its own
constexpr float kFootAcceleration = 17;   // m/s2
constexpr float kFastFoot = 0.07f;        // s per m/s that a step has to take off
constexpr float kLongestStep = 0.45f;     // s: for that
constexpr float kLongestWait = 0.12f;     // m: how far a clip's foot may go ahead of one that waits
constexpr float kLedFrom = 0.2f;          // m: nearer to its goal a foot after a simulation is led
constexpr float kLedSpeed = 1.5f;         // m/s: nor does it pass by faster than that
constexpr float kBetweenSteps = 0.05f;    // s: between two steps of its own
constexpr float kLandingHeight = 0.05f;   // m: a foot above it is not down yet, whatever the label
constexpr float kNearlyDown = 0.035f;     // m: a step that is broken off below it is over
constexpr float kResting = 0.015f;        // m: the ball of a foot that rests is no higher
constexpr float kFarAstray = 0.12f;       // m: so far off it stands only beside one that carries
constexpr float kStill = 0.5f;            // m/s: nor does it move faster
constexpr float kTouching = 0.008f;       // m: a foot lower than that and
constexpr float kTouchingSpeed = 0.05f;   // m/s: coming down faster than that touches the floor
constexpr float kTouchingAstray = 0.02f;  // m: nearer to its goal it may glide in
constexpr float kMeetsFloor = 0.5f;       // m/s: nor does it come down faster than that, and
constexpr float kSlowsAt = 18;            // 1/s: times its height over it, after a simulation or
                                          // where the clip lifts it
constexpr float kClears = 0.25f;          // of its way back: so high it goes over the floor,
constexpr float kClearest = 0.06f;        // m: or so high
constexpr float kClearRate = 20;          // 1/s: at which it is taken there
constexpr float kLandingSpeed = 0.8f;     // m/s: nor is one that moves faster over the ground
constexpr float kLongestLeg = 0.9995f;    // of its length: where nothing is eased any more
constexpr float kKneeAcceleration = 60;   // m/s2: of a knee off its leg's line, beyond the clip's
constexpr float kBallAcceleration = 50;   // m/s2: the same of the ball of a foot
constexpr float kEasingRate = 30;         // 1/s: at which what eases them fades
constexpr float kEased = 1e-4f;           // m: less than that is nothing
constexpr float kMostEasing = 0.015f;     // m: by which the hips move for that
constexpr float kUpright = 0.7f;          // of its length: a leg that stands no higher is not eased
constexpr float kLying = 0.6f;            // of the leg's length: hips lower than that do not stand
constexpr float kCrouched = 0.4f;         // of the leg's length: nor lower than that
constexpr float kFlat = 0.3f;             // rad: of the roll of a foot that stands flat, at most
constexpr float kHalfSole = 0.025f;       // of the height: from the middle of a sole to its edge
constexpr float kHeelLength = 0.04f;      // the same from below the ankle to the end of the heel
constexpr float kToeLength = 0.04f;       // the same from the ball to the tip of the toes

constexpr std::array<Side, 2> kEachFoot = {Side::left, Side::right};

Vec3 on_ground(Vec3 v) {
  return {v.x, 0, v.z};
}

// max(x, 0) with a parabola over +-width in place of the corner.
float soft_positive(float x, float width) {
  if (x >= width) return x;
  if (x <= -width) return 0;
  return (x + width) * (x + width) / (4 * width);
}

// How far, m, a knee stands off the line from hip to ankle.
float bend_of(const WorldPose& world, const Limb& leg) {
  const Vec3 hip = world.position[index(leg.root)], knee = world.position[index(leg.middle)],
             ankle = world.position[index(leg.end)];
  const Vec3 line = normalized_or(ankle - hip, -kUp), thigh = knee - hip;
  return glm::length(thigh - line * glm::dot(thigh, line));
}

// Lowest height of the ball at which neither ball nor heel of a foot turned so is under the floor.
float ball_floor(const Skeleton& skeleton, Quat foot) {
  const Vec3 heel = -skeleton.offset[index(Joint::left_toes)] - kUp * skeleton.ankle_height() -
                    kForward * (kHeelLength * skeleton.height);
  return std::max(skeleton.toe_height(), -(foot * heel).y);
}

// The same of one that lies on an edge of its sole.
float sole_floor(const Skeleton& skeleton, Quat foot) {
  return std::max(ball_floor(skeleton, foot),
                  skeleton.toe_height() * (foot * kUp).y +
                      kHalfSole * skeleton.height * std::abs((foot * kLeft).y));
}

// Rolls a foot back that lies over on an edge of its sole as that comes down to the floor, at most
// until it lies over no farther than the clip's.
Quat edge_on_floor(const Skeleton& skeleton, Quat foot, float ball_height, Quat clip_foot) {
  constexpr float kSoft = .3f;  // rad
  const auto over = [](Quat rotation) {
    return std::asin(std::clamp((rotation * kLeft).y, -1.0f, 1.0f));
  };
  const float roll = over(foot), own = std::abs(roll) - std::abs(over(clip_foot));
  if (own <= 0) return foot;
  const float low = std::max(0.0f, ball_height - ball_floor(skeleton, foot));
  const float most = kFlat + low / (kHalfSole * skeleton.height);
  const float back = std::min(own, soft_positive(std::abs(roll) - most, kSoft));
  return glm::normalize(glm::angleAxis(-std::copysign(back, roll), foot * kForward) * foot);
}

// Lifts the toes of a foot that points down until their tip lies on the floor.
Quat toes_on_floor(const Skeleton& skeleton, Quat toes, float ball_height) {
  const float length = kToeLength * skeleton.height;
  const float dip = std::clamp((ball_height - skeleton.toe_height()) / length, 0.0f, 1.0f);
  const Vec3 forward = toes * kForward;
  if (forward.y >= -dip || on_ground(forward) == Vec3()) return toes;
  const Vec3 level = glm::normalize(on_ground(forward)) * std::sqrt(1 - dip * dip) - kUp * dip;
  return glm::normalize(rotation_between(forward, level) * toes);
}

}  // namespace

Feet::Feet(const Skeleton& body, const PlaybackSettings& settings)
    : skeleton_(body), settings_(settings) {}

bool Feet::lies() const {
  return hips_height_ < kLying * skeleton_.leg_length();
}

void Feet::stitch(const Seam& seam) {
  after_simulation_ = seam.catches_up;
  blend_seconds_ = seam.seconds;
  sink_ = {};  // what the hips had sunk is part of their offset now
  for (const Side side : kEachFoot) stitch_foot(side, seam);
}

void Feet::let_go() {
  for (Foot& foot : feet_) {
    foot.mode = Mode::swing;
    foot.offset = {};
    foot.turn = {};
    foot.by_joints = false;
    foot.load = 0;
    foot.clearance = {};
  }
  sink_ = {};
}

void Feet::show(const WorldPose& world) {
  for (Foot& foot : feet_) {
    foot.ball_before = foot.ball;
    foot.shown_before = foot.shown;
    foot.knee.shown_before = foot.knee.shown;
  }
  amend(world);
  if (started_) return;
  for (Foot& foot : feet_) {
    foot.ball_before = foot.ball;
    foot.shown_before = foot.shown;
    foot.knee.shown_before = foot.knee.shown;
  }
  started_ = true;
}

void Feet::amend(const WorldPose& world) {
  hips_height_ = world.position[index(Joint::hips)].y;
  for (const Side side : kEachFoot) {
    of(side).ball = world.position[index(toes(side))];
    of(side).shown = world.rotation[index(leg(side).end)];
    of(side).knee.shown = bend_of(world, leg(side));
  }
}

// Whether a simulated foot rests on the floor, under a body that is up.
bool Feet::stands_still(const Foot& foot) const {
  return hips_height_ > kCrouched * skeleton_.leg_length() &&
         foot.ball.y < sole_floor(skeleton_, foot.shown) + kResting &&
         glm::distance(foot.ball, foot.ball_before) < kStill * kTickSeconds;
}

// What kept a foot off the place where it stands (the range of its ankle) may be over at a seam: it
// stands where it is, or slides to rest from there.
bool Feet::stand_as_shown(Foot& foot) const {
  constexpr float kOff = .005f;  // m
  const float floor = ball_floor(skeleton_, foot.shown);
  const Vec3 off = foot.ball - foot.place - kUp * floor - foot.offset.value();
  if (glm::length(off) < kOff) return false;
  const Vec3 moved = on_ground(foot.ball - foot.ball_before), slides = moved / kTickSeconds;
  const Vec3 stops = slides * (settings_.land_seconds / 3);
  foot.place = on_ground(foot.ball) + moved + stops;
  foot.offset = {kUp * (foot.ball.y - floor) - stops, slides, settings_.land_seconds};
  return true;
}

void Feet::stitch_foot(Side side, const Seam& seam) {
  const auto& [shown, now, after, seconds, turn_seconds, simulated, catches_up, hips_turn] = seam;
  Foot& foot = of(side);
  const std::size_t end = index(leg(side).end), ball = index(toes(side));
  foot.turn = rotation_decay(foot.shown_before, foot.shown, now.rotation[end], after.rotation[end],
                             turn_seconds, 0, hips_turn);
  const Vec3 clip_moved = after.position[ball] - now.position[ball];
  foot.clip_ball = now.position[ball] - clip_moved;
  // What they were eased by is part of what is shown.
  const Easing<Vec3> path{foot.ball, foot.ball_before, foot.clip_ball, foot.clip_ball - clip_moved};
  const float clip = bend_of(now, leg(side)), clip_moves = bend_of(after, leg(side)) - clip;
  foot.knee.path = {foot.knee.shown, foot.knee.shown_before, clip - clip_moves,
                    clip - 2 * clip_moves};
  foot.reach = reach_share(skeleton_, leg(side), shown);
  foot.reach_left = 1;
  foot.over = too_high(shown.position[index(leg(side).root)], shown.position[end],
                       std::clamp(std::max(foot.reach, reach_share(skeleton_, leg(side), now)),
                                  kStraightest, kLongestLeg));
  foot.sink = soft_positive(foot.over, kSinkSoft);
  foot.clip_turn = now.rotation[end];
  // Led along a line, a foot far from the clip's passes its own hip and the knee turns over. One
  // that stands does not go by the speeds of its leg's joints, which only cancel at the seam.
  foot.by_joints = simulated && !stands_still(foot);
  foot.lift = {};
  if (foot.mode == Mode::held) {
    if (stand_as_shown(foot)) foot.path = path;
    return;
  }
  foot.path = path;
  foot.led_before = foot.ball_before;  // as it was amended
  foot.led = foot.ball;
  const Vec3 moved = foot.led - foot.led_before;
  const Vec3 offset = foot.led + moved - now.position[ball];
  const Vec3 velocity = (moved - clip_moved) / kTickSeconds;
  if (simulated && !foot.by_joints) {  // rests on the floor, wherever the clip's is
    stand(foot, ball_floor(skeleton_, foot.shown));
  } else if (foot.mode == Mode::swing) {
    begin_move(foot, Mode::swing, offset, velocity, seconds);
  } else if (moved.y < 0 && foot.ball.y < skeleton_.toe_height() + kNearlyDown &&
             glm::length(on_ground(moved)) < kLandingSpeed * kTickSeconds) {
    stand(foot, skeleton_.toe_height());
  } else {
    // Its goal has moved: no less time than that takes at kFootAcceleration (blend_of).
    const float needed = seconds_to_move(glm::length(on_ground(offset)), kFootAcceleration);
    const Vec3 goal = on_ground(now.position[ball]) + kUp * ball_floor(skeleton_, foot.shown);
    begin_move(foot, Mode::step, foot.led + moved - goal,
               (moved - on_ground(clip_moved)) / kTickSeconds,
               std::max({foot.offset.seconds_left(), settings_.land_seconds, needed}));
  }
}

// Height of an arc, m, on which a foot that comes down fast does not dip below its goal, nor glides
// to it along the floor.
float Feet::clearing_rise(Decay path, float seconds) {
  constexpr int kSamples = 12;
  constexpr float kMost = .15f;    // m
  constexpr float kClear = .035f;  // m: of the floor, while the foot has twice that to go
  float rise = 0;
  for (int i = 1; i < kSamples; ++i) {
    path.step(seconds / kSamples);
    const float arc = std::sin(kPi * static_cast<float>(i) / kSamples);
    const Vec3 left = path.value();
    const float clear = 4 * i < kSamples ? 0 : std::min(kClear, glm::length(on_ground(left)) / 2);
    rise = std::max(rise, (clear - left.y) / (arc * arc));
  }
  return std::min(rise, kMost);
}

// The foot moves to its goal, the clip's or a place on the floor, from `offset` off it. It rises
// enough to clear the floor half-way, whatever height it starts from.
void Feet::begin_move(Foot& foot, Mode mode, Vec3 offset, Vec3 velocity,
                      float least_seconds) const {
  const float far = glm::length(on_ground(offset)) / settings_.restep_distance;
  foot.lifted = foot.mode != Mode::held;
  foot.mode = mode;
  foot.rise_seconds = std::max(
      {least_seconds, glm::length(offset) / kStepSpeed,
       after_simulation_ ? std::min(kFastFoot * glm::length(velocity), kLongestStep) : 0.0f});
  foot.offset = {offset, velocity, foot.rise_seconds};
  // A step that sets out faster than a foot may land would skim the floor.
  const bool skims = mode == Mode::step && glm::length(on_ground(velocity)) > kLandingSpeed;
  const float clearing =
      after_simulation_ || skims ? clearing_rise(foot.offset, foot.rise_seconds) : 0.0f;
  foot.rise =
      std::max({0.0f, settings_.restep_lift * std::min(far, 1.0f) - offset.y / 2, clearing});
  foot.rise_age = 0;
  if (!after_simulation_) return;
  // The arc's sin^2 takes 2 (pi / T)^2 of its height in acceleration.
  constexpr float kMostAcceleration = 25;  // m/s2
  const float seconds = kPi * std::sqrt(2 * foot.rise / kMostAcceleration);
  if (seconds <= foot.rise_seconds) return;
  foot.rise_seconds = seconds;
  foot.offset = {offset, velocity, seconds};
}

// The foot stands where it is from this tick on, and presses down.
void Feet::stand(Foot& foot, float floor) const {
  const Vec3 carried = foot.carried(), moved = foot.moved();
  foot.mode = Mode::held;
  if (foot.sink == 0) foot.load = 1;  // asks nothing of the hips that would have to set in
  foot.place = on_ground(carried);
  foot.offset = {kUp * (carried.y - floor), kUp * (moved.y / kTickSeconds), settings_.land_seconds};
  foot.rise = 0;
}

void Feet::stand_aside(Side side, Vec3 offset) {
  Foot& foot = of(side);
  foot.place += offset;
  foot.led += offset;
  foot.led_before += offset;
  foot.path.set_aside(offset);
  foot.load = 0;  // the hips sink for it bit by bit
}

// In the air where the clip does not have it: the other foot carries alone.
bool Feet::off_the_floor(const Foot& foot) {
  return foot.by_joints || foot.mode == Mode::step;
}

// A clip that lifts this foot meanwhile: it carries until the other is down, unless the clip goes
// far.
bool Feet::lift_waits(const Foot& foot, const Foot& other_foot, Vec3 clip_ball) {
  return foot.mode == Mode::held && off_the_floor(other_foot) &&
         glm::distance(foot.ball, clip_ball) < kLongestWait;
}

// Down with what is needed at once, up again softly.
void Feet::Sink::follow(float needed) {
  const float before = value;
  float over = value - needed;
  settle(over, velocity, kRiseRate);
  value = needed + std::max(0.0f, over);
  if (over <= 0) velocity = (needed - before) / kTickSeconds;
}

// What the foot does from this tick on. `floor`: height of the ball when the foot stands.
void Feet::change_mode(Side side, bool planted, Vec3 clip_ball, float floor) {
  Foot& foot = of(side);
  const Foot& other_foot = of(other(side));
  const Vec3 carried = foot.carried();
  const Vec3 clip_velocity = (clip_ball - foot.clip_ball) / kTickSeconds;
  const Vec3 velocity = foot.moved() / kTickSeconds;
  const float astray = glm::distance(on_ground(carried), on_ground(clip_ball));
  const float height = carried.y - floor;
  const bool strained = std::exchange(foot.strained, false);

  // 0. A leg goes on by its joints until it is near where the clip puts it down and could stop
  // there; of a body that lies, until it is there.
  const bool fast = glm::length(velocity - clip_velocity) > kLedSpeed;
  if (foot.by_joints && (fast || astray > (lies() ? settings_.restep_distance : kLedFrom))) return;
  // 1. Lifted: the way back to the clip.
  if (!planted && foot.mode != Mode::swing) {
    if (lift_waits(foot, other_foot, clip_ball)) return;
    // The floor stops one that comes down: else it would go along it while the clip's is up.
    const Vec3 stopped{velocity.x, std::max(velocity.y, -kSlowsAt * std::max(0.0f, height)),
                       velocity.z};
    begin_move(foot, Mode::swing, carried - clip_ball, stopped - clip_velocity,
               settings_.unlock_seconds);
    return;
  }
  // 2. Set down: where it is, if that is near enough and it is nearly down; else by a step.
  const bool near = height < kLandingHeight && astray < settings_.restep_distance;
  const bool coming_down = height < kNearlyDown && velocity.y < 0 &&
                           (astray < kFarAstray || other_foot.mode == Mode::held);
  const bool may_stand = (near || coming_down) && glm::length(on_ground(velocity)) < kLandingSpeed;
  if (planted && foot.mode == Mode::swing && may_stand) {
    stand(foot, floor);
    return;
  }
  // 3. Left behind: a step of its own, while the other foot carries or where the leg is too short
  // or it may not stay.
  const bool other_carries = stands(other_foot) && since_step_ > kBetweenSteps;
  const bool left_behind =
      foot.mode == Mode::held && (strained || (astray > settings_.restep_distance &&
                                               (other_carries || foot.sink > kMostSink)));
  if (planted && (foot.mode == Mode::swing || left_behind)) {
    const Vec3 goal = on_ground(clip_ball) + kUp * floor;
    begin_move(foot, Mode::step, carried - goal, velocity - on_ground(clip_velocity),
               settings_.restep_seconds);
    return;
  }
  // 4. A step of its own that has arrived, or that touches the floor on the way.
  foot.lifted = foot.lifted || height > kTouching;
  const bool comes_down = velocity.y < -kTouchingSpeed || foot.rise_age > foot.rise_seconds / 2;
  const bool touches = foot.lifted && height < kTouching && comes_down &&
                       astray > kTouchingAstray && glm::length(on_ground(velocity)) < kLandingSpeed;
  if (foot.mode == Mode::step && (foot.offset.done() || touches)) {
    stand(foot, floor);
  }
}

// A foot that went by its leg's joints has a place to go to from this tick on.
void Feet::lead(Foot& foot, Quat clip_turn, Vec3 hips_turn) const {
  const Quat clip_spin = clip_turn * glm::inverse(foot.clip_turn);
  foot.by_joints = false;
  foot.turn = rotation_decay(foot.shown_before, foot.shown, clip_turn, clip_spin * clip_turn,
                             blend_seconds_, 0, hips_turn);
}

// What goes by joints is kept over the floor without a corner in its way: what that lifts it at
// either end of the blend is taken off there, so that it starts and ends where it should.
// Heights over where it would lie, m; `begun` 1 at the seam .. 0.
float Feet::Lift::of(float height, float clip_height, float begun) {
  constexpr float kSoft = .05f;  // m
  const auto lift = [](float over) { return soft_positive(-over, kSoft); };
  if (at_first < 0) at_first = lift(height);
  return lift(height) - at_first * begun - lift(clip_height) * (1 - begun);
}

void Feet::Clearance::follow(float wanted) {
  float off = value - wanted;
  settle(off, velocity, kClearRate);
  value = wanted + off;
}

// Height of the ball of a foot that stands, turned as it is going to be shown.
float Feet::floor_of_shown(const Foot& foot) const {
  const Quat spin = foot.shown * glm::inverse(foot.shown_before);
  return ball_floor(skeleton_, glm::normalize(spin * foot.shown));
}

// m/s: how fast a foot that a simulation threw may come down.
float Feet::fastest_descent(const Foot& foot, float floor) {
  return kMeetsFloor + kSlowsAt * std::max(0.0f, foot.ball.y - floor);
}

// Where the ball of the foot goes in this tick.
Vec3 Feet::ball_of(Side side, bool planted, Vec3 clip_ball, Vec3 blended_ball, float floor) {
  Foot& foot = of(side);
  const float stands_at = foot.by_joints ? floor_of_shown(foot) : floor;
  if (started_) {
    change_mode(side, planted, clip_ball, stands_at);
  } else {
    foot.mode = planted ? Mode::held : Mode::swing;
    foot.place = on_ground(clip_ball);
    foot.load = planted ? 1.0f : 0.0f;
  }
  // Thrown aside by a blow, it would be drawn back along the floor.
  const bool clears = after_simulation_ && foot.mode != Mode::held && !lies();
  const Vec3 way = foot.by_joints ? blended_ball - clip_ball : foot.offset.value();
  foot.clearance.follow(clears ? std::min(kClearest, kClears * glm::length(on_ground(way))) : 0.0f);
  const float arc = std::sin(kPi * std::min(1.0f, foot.rise_age / foot.rise_seconds));
  Vec3 ball = foot.offset.value() + kUp * (foot.rise * arc * arc);
  switch (foot.mode) {
    case Mode::swing:
      if (foot.by_joints) {
        ball = blended_ball + kUp * foot.lift.of(blended_ball.y - floor - foot.clearance.value,
                                                 clip_ball.y - floor,
                                                 glm::smoothstep(0.0f, 1.0f, foot.reach_left));
      } else {
        ball += clip_ball;
      }
      break;
    case Mode::held:
      ball += foot.place + kUp * stands_at;
      break;
    case Mode::step:
      ball += on_ground(clip_ball) + kUp * stands_at;
      since_step_ = 0;
      break;
  }
  foot.rise_age += kTickSeconds;
  // A foot that a simulation threw slows before it meets the floor.
  if (after_simulation_ && foot.mode != Mode::held) {
    if (!foot.by_joints) {
      ball.y = std::max(ball.y, std::min(stands_at + foot.clearance.value,
                                         foot.led.y + kMeetsFloor * kTickSeconds));
    }
    ball.y = std::max(ball.y, foot.ball.y - fastest_descent(foot, floor) * kTickSeconds);
  }
  // Never under the floor; one that a simulation left there comes up as its offset decays.
  ball.y = std::max(ball.y, started_ ? std::min(floor, foot.ball.y) : floor);
  foot.led_before = started_ ? foot.led : ball;
  foot.led = ball;
  foot.rests = foot.mode == Mode::held && foot.offset.done();
  foot.offset.step(kTickSeconds);
  foot.load =
      foot.mode == Mode::held ? std::min(1.0f, foot.load + kTickSeconds / kLoadSeconds) : 0.0f;
  foot.clip_ball = clip_ball;
  return ball;
}

// By how much the hip is too high for an ankle, m; below 0: by how much it could be higher.
float Feet::too_high(Vec3 hip, Vec3 ankle, float straightest) const {
  const float reach = straightest * skeleton_.leg_length();
  const Vec3 line = hip - ankle;
  const float across = std::min(glm::length(on_ground(line)), 0.9f * reach);
  return line.y - std::sqrt(reach * reach - across * across);
}

// How far, m, the hips rise so that the knee stands where it is eased to.
float Feet::rise_for(Side side, const WorldPose& world) const {
  const Easing<float>& knee = of(side).knee.path;
  const Limb limb = leg(side);
  const float thigh = skeleton_.bone(limb.middle), shin = skeleton_.bone(limb.end);
  const Vec3 line = world.position[index(limb.root)] - world.position[index(limb.end)];
  const float length = glm::length(line);
  if (std::abs(knee.eased()) < kEased || line.y < kUpright * (thigh + shin)) return 0;
  const float stands = std::clamp(knee.wanted() + knee.eased(), 0.0f, std::min(thigh, shin));
  const auto along = [&](float bone) { return std::sqrt(bone * bone - stands * stands); };
  return std::clamp((along(thigh) + along(shin) - length) * length / line.y, -kMostEasing,
                    kMostEasing);
}

// The same of whichever knee asks more.
float Feet::knees_ask(const WorldPose& world, const WorldPose& clip) {
  float most = 0;
  for (const Side side : kEachFoot) {
    Knee& knee = of(side).knee;
    const float wants = bend_of(world, leg(side)), clip_wants = bend_of(clip, leg(side));
    if (!started_) knee = {wants, wants, {wants, wants, clip_wants, clip_wants}};
    knee.path.follow(wants, clip_wants, kKneeAcceleration, kEasingRate);
    const float rise = rise_for(side, world);
    if (std::abs(rise) > std::abs(most)) most = rise;
  }
  return most;
}

void Feet::place(const Pose& clip_pose, FootContacts contacts, Vec3 hips_turn, Pose& pose) {
  const WorldPose world = world_pose(skeleton_, pose);
  const WorldPose clip_world = world_pose(skeleton_, clip_pose);
  std::array<Vec3, 2> ankle;
  std::array<Quat, 2> foot_rotation;
  std::array<float, 2> height, straightest;
  float needed = 0;
  since_step_ += kTickSeconds;
  // 1. Where the feet go, and how far the hips must sink so that those that carry are in reach.
  for (const Side side : kEachFoot) {
    const auto i = static_cast<std::size_t>(side);
    Foot& foot = feet_[i];
    const std::size_t ball = index(toes(side)), end = index(leg(side).end);
    const auto led_rotation = [&] {
      return glm::normalize(from_rotation_vector(foot.turn.value()) * clip_world.rotation[end]);
    };
    foot_rotation[i] = foot.by_joints ? world.rotation[end] : led_rotation();
    const float floor = ball_floor(skeleton_, foot_rotation[i]);
    const Vec3 clip_ball = clip_world.position[ball], clip_moved = clip_ball - foot.clip_ball;
    Vec3 wanted = ball_of(side, contacts.of(side), clip_ball, world.position[ball], floor);
    if (foot.by_joints && foot.mode != Mode::swing) {
      lead(foot, clip_world.rotation[end], hips_turn);
      foot_rotation[i] = led_rotation();
      foot.path = {foot.ball, foot.ball_before, clip_ball - clip_moved,
                   clip_ball - 2.0f * clip_moved};
    }
    if (!started_) foot.path = {wanted, wanted, clip_ball, clip_ball};
    foot.path.follow(wanted, clip_ball, kBallAcceleration, kEasingRate);
    wanted += foot.path.eased();
    wanted.y = std::max(wanted.y, std::min(floor, foot.path.wanted().y));
    foot_rotation[i] =
        edge_on_floor(skeleton_, foot_rotation[i], wanted.y, clip_world.rotation[end]);
    foot.clip_turn = clip_world.rotation[end];
    foot.turn.step(kTickSeconds);
    height[i] = wanted.y;
    ankle[i] = wanted - foot_rotation[i] * skeleton_.offset[ball];
    const Vec3 hip = world.position[index(leg(side).root)];
    // As straight as the clip's leg or, fading, as it was at the seam.
    const float seam =
        kStraightest + (foot.reach - kStraightest) * glm::smoothstep(0.0f, 1.0f, foot.reach_left);
    foot.reach_left = std::max(0.0f, foot.reach_left - kTickSeconds / blend_seconds_);
    // A foot that waits does not bend its leg as the clip's does, which is in the air.
    const bool waits = foot.mode == Mode::held && !contacts.of(side);
    const float bends = waits ? 0 : kBends * kTickSeconds;
    foot.straightest = std::clamp(
        std::max({seam, reach_share(skeleton_, leg(side), clip_world), foot.straightest - bends}),
        kStraightest, kLongestLeg);
    straightest[i] = foot.straightest;
    const float over = too_high(hip, ankle[i], straightest[i]);
    const float rises = started_ ? std::max(0.0f, over - foot.over) / kTickSeconds : 0.0f;
    foot.over = over;
    foot.sink =
        soft_positive(over, std::clamp(rises * rises / (2 * kSinkBrake), kSinkSoft, kSinkSoftest));
    needed = std::max(needed, glm::smoothstep(0.0f, 1.0f, foot.load) * foot.sink);
  }
  sink_.follow(needed);
  pose.hips.y -= sink_.value;
  // 2. The legs follow.
  const auto legs_follow = [&] {
    for (const Side side : kEachFoot) {
      const auto i = static_cast<std::size_t>(side);
      move_limb_end(skeleton_, leg(side), ankle[i], straightest[i], pose);
    }
  };
  legs_follow();
  const float rise = knees_ask(world_pose(skeleton_, pose), clip_world);
  if (rise != 0) {
    pose.hips.y += rise;
    legs_follow();
  }
  for (const Side side : kEachFoot) {
    const auto i = static_cast<std::size_t>(side);
    const Limb limb = leg(side);
    set_world_rotation(skeleton_, limb.end, foot_rotation[i], pose);
    const Quat toe_rotation = foot_rotation[i] * pose.rotation[index(toes(side))];
    pose.rotation[index(toes(side))] = glm::normalize(
        glm::inverse(foot_rotation[i]) * toes_on_floor(skeleton_, toe_rotation, height[i]));
  }
}

}  // namespace ringcraft
