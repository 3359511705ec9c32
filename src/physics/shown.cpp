// The shown response: the second simulation of a hit, active, aimed at the chosen clip or at a
// fall.
#include <algorithm>
#include <cmath>

#include "motion/ik.h"
#include "motion/joint_turns.h"
#include "physics/braking.h"
#include "physics/flung_limbs.h"
#include "physics/impact_frame.h"
#include "physics/response.h"
#include "physics/standing_feet.h"
#include "physics/tone.h"

namespace ringcraft {
namespace {

constexpr float kIntoClip = .20f;    // s over which the aim goes from the cut action to the clip
constexpr float kMeetBy = .45f;      // s: by then the simulated motion has met the clip
constexpr float kMeetFrom = .12f;    // s: from here on hips and legs do; sooner they would slide
constexpr float kArmsMeetBy = .30f;  // s: as light as they are, they swing fastest
constexpr float kProtect = .10f;     // s: from here on a falling body protects itself
constexpr float kLimpTone = .03f;    // of a knocked-out body; 0 looks like a sack
constexpr float kLimpLyingTone = .003f;  // more, and forearms of a guard stay up
constexpr float kLyingTone = .08f;
constexpr float kLetDownTone = .3f;
constexpr float kFade = .6f;  // s after the landing in which the muscles let go
constexpr float kGatherFrom = .25f, kGatherUntil = 1.6f;  // s after the landing
constexpr float kGatherIn = .2f;                          // s in which that sets in and ends
constexpr float kAstray = .08f;  // m rms: a body so far from a lying pose goes on gathering itself
constexpr float kMostGather = 3.0f;        // s after the landing
constexpr float kNearer = .01f;            // m: a body that comes no nearer than by this
constexpr float kStuckFor = .4f;           // in so many s is stuck
constexpr float kRollsFor = .6f;           // s for which it then aims at lying on its back
constexpr float kLed = radians(60);        // most, by which an upper arm is ahead of where it is
constexpr float kResting = .15f;           // m/s
constexpr float kRestFor = .25f;           // s
constexpr float kMostAfterLanding = 5.0f;  // s
constexpr Tick kReposes = 12;              // a body that has come to rest
constexpr Tick kMostLater = 360;           // than asked for, a body comes to rest
constexpr int kPunchSteps = 3;     // of 1/240 s over which a punch's impulse is spread (12 ms)
constexpr int kKickSteps = 12;     // of a kick (50 ms)
constexpr float kKickMass = 4.0f;  // kg: a striker heavier than this is a leg
constexpr Tick kEased = 8;         // ticks on either side that a shown pose is the mean of
constexpr float kLimitTolerance = radians(2);

void set_arm(Pose& pose, bool left, Vec3 direction, float elbow) {
  const float out = left ? 1.0f : -1.0f;
  const Limb a = arm(left ? Side::left : Side::right);
  pose.rotation[index(a.root)] =
      rotation_between(Vec3{out, 0, 0}, Vec3{out * direction.x, direction.y, direction.z});
  pose.rotation[index(a.middle)] = from_rotation_vector({0, -out * radians(elbow), 0});
}

void set_legs(Pose& pose, float hip, float knee) {
  for (const Side side : {Side::left, Side::right}) {
    pose.rotation[index(leg(side).root)] = from_rotation_vector({-radians(hip), 0, 0});
    pose.rotation[index(leg(side).middle)] = from_rotation_vector({radians(knee), 0, 0});
    pose.rotation[index(leg(side).end)] = Quat(1, 0, 0, 0);
  }
}

void bend(Pose& pose, float trunk, float neck, float head) {
  pose.rotation[index(Joint::spine)] = from_rotation_vector({radians(trunk * .6f), 0, 0});
  pose.rotation[index(Joint::chest)] = from_rotation_vector({radians(trunk * .4f), 0, 0});
  pose.rotation[index(Joint::neck)] = from_rotation_vector({radians(neck), 0, 0});
  pose.rotation[index(Joint::head)] = from_rotation_vector({radians(head), 0, 0});
}

// What a falling body does (docs/sources.md, R5), by the direction it falls in off its facing.
Pose protective_pose(const Pose& now, float direction) {
  Pose pose = now;
  const float off = std::abs(direction);
  if (off > radians(120)) {  // back: chin tucked, rolls over the seat
    bend(pose, 30, 22, 18);
    set_legs(pose, 60, 75);
    for (const bool left : {true, false}) set_arm(pose, left, {.6f, -.6f, -.5f}, 20);
  } else if (off < radians(60)) {  // fore: arms and knees to the ground, face away
    bend(pose, 15, -17, -10);
    set_legs(pose, 35, 50);
    for (const bool left : {true, false}) set_arm(pose, left, {.15f, -.26f, .97f}, 35);
  } else {  // side: the near arm out
    const bool left = direction > 0;
    bend(pose, 15, 5, 5);
    set_legs(pose, 40, 60);
    set_arm(pose, left, {.80f, -.50f, .25f}, 20);
    set_arm(pose, !left, {.25f, -.60f, .70f}, 60);
  }
  return pose;
}

// What a body lies down to once its trunk is on the ground: the arms stay, the legs come down, bent
// with the soles on the floor on its back, straight on its face, where bent knees hold the shins in
// the air.
Pose lying_pose(const BodyModel& body, const Pose& aimed, const Pose& now) {
  Pose pose = aimed;
  bend(pose, 5, 2, 2);
  const Vec3 chest_faces = world_pose(body.skeleton, now).rotation[index(Joint::chest)] * kForward;
  const float up = glm::smoothstep(-.7f, .5f, chest_faces.y);  // 0 on the face, 1 on side or back
  set_legs(pose, 30 * up, 55 * up);
  if (up < .5f) {
    for (const Side side : {Side::left, Side::right}) {
      pose.rotation[index(leg(side).end)] = from_rotation_vector({radians(45), 0, 0});
    }
  }
  return pose;
}

// The mean of the poses `from`..`to` around `middle`, those near to it counting for more.
Pose mean_pose(std::span<const Pose> poses, std::size_t from, std::size_t middle, std::size_t to) {
  const float half = static_cast<float>(to - middle + 1);
  Pose mean;
  std::array<glm::vec4, kJointCount> turns{};
  float all = 0;
  for (std::size_t i = from; i <= to; ++i) {
    const float off = std::abs(static_cast<float>(i) - static_cast<float>(middle)) / half;
    const float weight = 1 + std::cos(kPi * off);  // Hann
    all += weight;
    mean.hips += weight * poses[i].hips;
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Quat q = in_hemisphere_of(poses[i].rotation[j], poses[middle].rotation[j]);
      turns[j] += weight * glm::vec4(q.w, q.x, q.y, q.z);
    }
  }
  mean.hips /= all;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    mean.rotation[j] = glm::normalize(Quat(turns[j].x, turns[j].y, turns[j].z, turns[j].w));
  }
  return mean;
}

// The first `count` of simulated poses without the engine's rattling: each the mean of those around
// it, from the blow on.
std::vector<Pose> eased(std::span<const Pose> simulated, std::size_t count) {
  std::vector<Pose> out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t around =
        std::min({i, simulated.size() - 1 - i, static_cast<std::size_t>(kEased)});
    out.push_back(mean_pose(simulated, i - around, i, i + around));
  }
  return out;
}

float depth_below_ground(const BodyModel& body, const WorldPose& world, Side side) {
  return -std::min(0.0f, sole_height(body, world, side));
}

// Lifts the end of a limb by `depth`, with as little change as that takes.
void lift(const BodyModel& body, const Limb& limb, float depth, Pose& pose) {
  const Vec3 end = world_pose(body.skeleton, pose).position[index(limb.end)];
  move_limb_end(body.skeleton, limb, end + Vec3{0, depth, 0}, 1.0f, pose);
}

// Mends simulated poses one after the other: no sole and no glove below the ground, no joint beyond
// its range. A limb is lifted by itself; what that cannot do for a foot, or the ranges forbid, the
// whole body does. A correction comes and goes at a limited speed: near a range's far end it can
// turn over.
class Mender {
 public:
  Mender(const BodyModel& body, const Pose& start)
      : body_(body), simulated_(start), shown_(start) {}

  Pose operator()(const Pose& simulated) {
    const Pose before = shown_;
    Pose pose = within_limits(body_, simulated, kLimitTolerance, before);
    for (const Side side : {Side::left, Side::right}) {
      const WorldPose world = world_pose(body_.skeleton, pose);
      const float sunk = depth_below_ground(body_, world, side);
      if (sunk >= kLeast) lift(body_, leg(side), sunk, pose);
      lift_glove(side, before, pose);
    }
    pose = within_limits(body_, pose, kLimitTolerance, before);
    hold_back(simulated, pose);
    for (const Side side : {Side::left, Side::right}) lift_glove(side, before, pose);
    raise(pose);
    simulated_ = simulated;
    shown_ = pose;
    return pose;
  }

 private:
  static constexpr float kLeast = .001f;   // m
  static constexpr float kGives = .015f;   // m: so deep may what is soft press
  static constexpr float kRaise = .008f;   // m a tick
  static constexpr float kDeep = .02f;     // m: what is deeper is raised at once
  static constexpr float kAside = .1f;     // m beyond its lift that an arm may turn aside for it
  static constexpr float kMostTurn = .5f;  // rad a tick: 60 rad/s, as fast as a limb is thrown
  // Of a correction in a tick: a hand or the toes carry nothing that would be flung.
  static float most_turn(Joint joint) {
    const bool last = joint == Joint::left_hand || joint == Joint::right_hand ||
                      joint == Joint::left_toes || joint == Joint::right_toes;
    return radians(last ? 30.0f : 8.0f);
  }

  static float angle(Quat a, Quat b) { return glm::length(rotation_vector(a * glm::conjugate(b))); }

  // The hand goes with the forearm, which turns it: it takes more than one go. As far as the arm's
  // ranges let it.
  void lift_glove(Side side, const Pose& before, Pose& pose) const {
    constexpr int kGoes = 3;
    const WorldPose was = world_pose(body_.skeleton, pose);
    const float most = glove_depth(side, pose) + kAside;
    for (int i = 0; i < kGoes; ++i) {
      const float depth = glove_depth(side, pose);
      if (depth < kLeast) return;
      Pose lifted = pose;
      const std::size_t hand = index(arm(side).end);
      lift(body_, arm(side), depth, lifted);
      lifted.rotation[hand] = pose.rotation[hand];
      lifted = within_limits(body_, lifted, kLimitTolerance, before);
      if (glove_depth(side, lifted) >= depth) return;
      if (largest_joint_distance(was, world_pose(body_.skeleton, lifted)) > most) return;
      pose = lifted;
    }
  }

  float glove_depth(Side side, const Pose& pose) const {
    const Part hand = side == Side::left ? Part::left_hand : Part::right_hand;
    const Capsule glove = capsules(body_, world_pose(body_.skeleton, pose))[index(hand)];
    return glove.radius - std::min(glove.a.y, glove.b.y);
  }

  // What no limb can mend, the whole body does: soles at once, anything else that is deep bit by
  // bit.
  void raise(Pose& pose) {
    const WorldPose world = world_pose(body_.skeleton, pose);
    const float soles = std::max(depth_below_ground(body_, world, Side::left),
                                 depth_below_ground(body_, world, Side::right));
    float deepest = 0;
    for (const Capsule& c : capsules(body_, world)) {
      deepest = std::max(deepest, c.radius - std::min(c.a.y, c.b.y) - kGives);
    }
    const float missing = deepest - raised_;
    raised_ += std::clamp(missing, -kRaise, std::max(kRaise, missing - kDeep));
    const float up = std::max(soles >= kLeast ? soles : 0.0f, raised_);
    pose.hips.y += up;
  }

  // A joint moves by so much a tick more than it does in the simulation, and no faster than limbs
  // do. From one pose inside its range to another it stays inside, where holding back the
  // correction alone would let it out.
  void hold_back(const Pose& simulated, Pose& pose) const {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Quat last = shown_.rotation[j], wanted = pose.rotation[j];
      const float turn = angle(wanted, last);
      const float most = std::min(
          angle(simulated.rotation[j], simulated_.rotation[j]) + most_turn(joint_at(j)), kMostTurn);
      if (turn > most) pose.rotation[j] = between(joint_at(j), last, wanted, most / turn);
    }
  }

  static Quat between(Joint joint, Quat a, Quat b, float share) {
    for (const Side side : {Side::left, Side::right}) {
      for (const Limb& limb : {arm(side), leg(side)}) {
        if (joint == limb.root) return mix_root(side, limb, a, b, share);
      }
    }
    return glm::normalize(glm::slerp(a, in_hemisphere_of(b, a), share));
  }

  const BodyModel& body_;
  float raised_ = 0;        // m
  Pose simulated_, shown_;  // of the tick before
};

class Shown {
 public:
  Shown(const BodyModel& body, const ImpactInput& input, const ImpactOutcome& outcome,
        std::span<const Pose> target, std::span<const Pose> lying)
      : body_(body),
        outcome_(outcome),
        tone_(input.tone),
        target_(target),
        lying_(lying),
        frame_(body, input),
        ragdoll_(body, frame_.pose(), frame_.before(), kTickSeconds,
                 {.whole_body_contacts = outcome.response == ResponseKind::knockdown}),
        balance_(body, frame_),
        mend_(body, frame_.pose()),
        feet_(body, frame_),
        braking_(body, frame_),
        limbs_(body, frame_),
        within_(frame_.pose()),
        into_clip_(seconds_to_clip(kIntoClip, 50)),
        meet_by_(kMeetFrom + seconds_to_clip(kMeetBy - kMeetFrom, 20)),
        lies_(ringcraft::lies(body, input.pose)),
        steps_of_blow_(input.blow.effective_mass > kKickMass ? kKickSteps : kPunchSteps) {}

  std::vector<Pose> run(Tick ticks) {
    std::vector<Pose> shown;
    const bool falls = outcome_.response == ResponseKind::knockdown;
    const Tick ran = falls ? ticks : ticks + kEased;
    shown.reserve(static_cast<std::size_t>(std::max(ran, 0)));
    const Tick most = falls && !lying_.empty() ? ran + kMostLater : ran;
    Tick rests = 0;
    for (Tick tick = 1; tick <= ran || (rests < kReposes && tick <= most); ++tick) {
      rests += rested_ ? 1 : 0;
      shown.push_back(falls ? fall_tick(tick) : stand_tick(tick));
    }
    return falls ? shown : eased(shown, static_cast<std::size_t>(std::max(ticks, 0)));
  }

 private:
  void step(int k) {
    keep_ranges();
    const float seconds = static_cast<float>(k) * kRagdollStep;
    braking_.brake(ragdoll_, seconds);
    if (outcome_.response != ResponseKind::knockdown) Braking::brake_spin(ragdoll_, seconds);
    if (k < steps_of_blow_) {
      strike(ragdoll_, body_, frame_, 1.0f / static_cast<float>(steps_of_blow_));
    }
    ragdoll_.step();
  }

  // A joint that is beyond its range is driven back: in a limp fall arms fly far.
  void keep_ranges() {
    const Pose pose = ragdoll_.pose();
    const auto violations = limit_violations(body_, pose, 0);
    std::array<bool, kPartCount> beyond{};
    for (const LimitViolation& v : violations) {
      const auto part = part_of(v.joint);
      if (!part) continue;
      beyond[index(*part)] = true;
      if (*part == Part::abdomen) beyond[index(Part::chest)] = true;
      if (*part == Part::neck) beyond[index(Part::head)] = true;
    }
    if (!stopped_ && violations.empty()) return;
    stopped_ = !violations.empty();
    ragdoll_.stop(stopped_ ? within_limits(body_, pose, 0, within_) : pose, beyond);
    within_ = pose;
  }

  // The clip in the canonical frame; without one, the cut action goes on.
  Pose clip(Tick tick) const {
    if (target_.empty()) return frame_.continued(tick);
    const auto last = static_cast<Tick>(target_.size()) - 1;
    return frame_.in(target_[static_cast<std::size_t>(std::clamp(tick, 0, last))]);
  }

  // On the way of a smoothstep over T s a distance d takes 6 d / T^2 of acceleration: where a limb
  // has far to go to the clip (a kick's leg), no less than that takes at `most_acceleration`, m/s2.
  float seconds_to_clip(float least, float most_acceleration) const {
    const float far = largest_joint_distance(world_pose(body_.skeleton, frame_.continued(0)),
                                             world_pose(body_.skeleton, clip(0)));
    return std::max(least, std::sqrt(6 * far / most_acceleration));
  }

  // The cut action, slowing from the blow on until it stands where the impulse step lets it go: a
  // limb in full swing that had to stop there would be thrown.
  Pose cut(Tick tick) const {
    constexpr float kKnown = kImpulseStepTicks;
    const float age = std::min(static_cast<float>(tick), 2 * kKnown);
    const float at = age - age * age / (4 * kKnown);
    const auto whole = static_cast<Tick>(at);
    return mix(frame_.continued(whole), frame_.continued(whole + 1),
               at - static_cast<float>(whole));
  }

  Pose aim(Tick tick) const {
    const float share = glm::smoothstep(0.0f, into_clip_, static_cast<float>(tick) * kTickSeconds);
    if (share >= 1) return clip(tick);
    return mix(cut(tick), clip(tick), share);
  }

  // How far the blow alone has moved the extrapolated centre of mass, m, as far as the body has not
  // felt that yet.
  Vec3 unfelt(float seconds) const {
    const Vec3 velocity = frame_.blow().impulse / body_.spec.mass;
    const float moved = seconds + 1 / pendulum_rate(body_);
    return Vec3{velocity.x, 0, velocity.z} * moved * (1 - glm::smoothstep(kReflex, kFirm, seconds));
  }

  Pose stand_tick(Tick tick) {
    const float now = static_cast<float>(tick) * kTickSeconds;
    const float meet = glm::smoothstep(kMeetFrom, meet_by_, now);
    if (meet >= 1) return frame_.out(clip(tick));
    const Pose from = aim(tick - 1), to = aim(tick);
    for (int half = 0; half < 2; ++half) {
      const float at = now - kTickSeconds + static_cast<float>(half) * kRagdollStep;
      ragdoll_.set_tone(standing_tone(at, tone_));
      ragdoll_.set_servo(.05f, at < kReflex);
      balance_.guide(ragdoll_, half == 0 ? from : mix(from, to, .5f), from, to, unfelt(at));
      step(2 * (tick - 1) + half);
    }
    Pose pose = ragdoll_.pose();
    // The start pose was let down onto the ground: shown, that comes gradually.
    pose.hips.y += frame_.lowered() * (1 - glm::smoothstep(0.0f, kIntoClip, now));
    Pose met = meet > 0 ? mix(pose, clip(tick), meet) : pose;
    // Trunk and arms set out at once: what flies off at the hand-over cannot be caught in a frame.
    const Pose above = mix(pose, clip(tick), glm::smoothstep(0.0f, kMeetBy, now));
    const Pose arms = mix(pose, clip(tick), glm::smoothstep(0.0f, kArmsMeetBy, now));
    for (std::size_t j = index(Joint::spine); j < index(Joint::left_upper_leg); ++j) {
      met.rotation[j] = j >= index(Joint::left_shoulder) ? arms.rotation[j] : above.rotation[j];
    }
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t j = index(arm(side).root);
      met.rotation[j] = mix_root(side, arm(side), pose.rotation[j], clip(tick).rotation[j],
                                 glm::smoothstep(0.0f, kArmsMeetBy, now));
    }
    limbs_.slow(now, met);
    Pose mended = mend_(met);
    feet_.hold(mended);
    return frame_.out(mended);
  }

  Tone fall_tone(float now) const {
    const float gone = landed_ < 0 ? 0 : std::clamp((now - landed_) / kFade, 0.0f, 1.0f);
    if (outcome_.knockout) return whole_body(glm::mix(kLimpTone, kLimpLyingTone, gone));
    Tone tone = now < kProtect && !lies_ ? standing_tone(now, tone_) : falling_tone();
    if (landed_ < 0) return tone;
    for (float& t : tone) t = glm::mix(t, std::min(t, kLyingTone), gone);
    const float since = now - landed_;
    // The legs are let down before they, too, let go.
    const float legs = glm::mix(
        kLetDownTone, kLyingTone,
        glm::smoothstep(0.0f, 1.0f, (since - (lying_.empty() ? kFade : kGatherUntil)) / kFade));
    for (std::size_t i = index(Part::left_thigh); i < kPartCount; ++i) tone[i] = legs;
    if (!lying_.empty()) {
      // It gathers itself: as it lies, limbs go to where the get-up will need them.
      const float gather = glm::smoothstep(kGatherFrom, kGatherFrom + kGatherIn, since) *
                           (1 - glm::smoothstep(kGatherUntil, kGatherUntil + kGatherIn, since));
      for (float& t : tone) t = glm::mix(t, kGatherTone, std::max(gather, astray_share_));
    }
    return tone;
  }

  // Whether the body has a fall before it in which to protect itself.
  bool protects() const { return !lies_ && !outcome_.knockout; }

  void aim_fall(Tick tick, float now) {
    if (now < kProtect && protects()) {
      balance_.guide(ragdoll_, frame_.continued(tick - 1), frame_.continued(tick - 1),
                     frame_.continued(tick));
      return;
    }
    if (!protecting_) {
      const Pose pose = ragdoll_.pose();
      const Vec3 going = ragdoll_.center_of_mass_velocity();
      const float facing = heading_of(pose.rotation[0]);
      const Vec3 flat{going.x, 0, going.z};
      const float way = glm::length(flat) > .05f ? yaw_of(flat) : frame_.in_yaw(outcome_.direction);
      protective_ = protects() ? protective_pose(pose, wrapped_angle(way - facing)) : pose;
      protecting_ = true;
      ragdoll_.set_servo(.10f, true);
    }
    if (landed_ >= 0 && !outcome_.knockout && !lying_.empty() && now - landed_ > kGatherFrom) {
      gather(now - landed_);
    }
    const float in = kTickSeconds / kGatherIn;
    astray_share_ = std::clamp(astray_share_ + (astray_ ? in : -in), 0.0f, 1.0f);
    const Pose aim = gathering_ ? arms_led(protective_) : protective_;
    ragdoll_.track(aim, aim, aim, kTickSeconds);
  }

  // An arm that has far to go is led round inside its shoulder's range: the shortest turn can end
  // at the end of that, and the arm would stay there.
  Pose arms_led(Pose aim) const {
    const Pose pose = ragdoll_.pose();
    for (const Side side : {Side::left, Side::right}) {
      const BallJoint shoulder = ball_joint(arm(side));
      const std::size_t j = index(arm(side).root);
      const float far = glm::distance(ball_turns(shoulder, side, pose.rotation[j]),
                                      ball_turns(shoulder, side, aim.rotation[j]));
      if (far <= kLed) continue;
      aim.rotation[j] = mix_root(side, arm(side), pose.rotation[j], aim.rotation[j], kLed / far);
    }
    return aim;
  }

  // Whether it has come to rest on knees or hands, its trunk off the ground: it lies down from
  // there.
  bool caught(const Pose& pose) const { return still_ >= kRestFor && !on_its_feet(body_, pose); }

  // Aims at the nearest lying pose. A body that comes no nearer lies on a limb that should go
  // there: for a while it aims at lying on its back, which rolls it off.
  void gather(float since_landing) {
    const NearestLying nearest = nearest_lying(body_.skeleton, lying_, frame_.out(ragdoll_.pose()));
    astray_ = nearest.apart > kAstray && since_landing < kMostGather;
    if (!astray_ || nearest.apart < apart_ - kNearer || stuck_ > kStuckFor + kRollsFor) {
      apart_ = nearest.apart;
      stuck_ = 0;
    }
    stuck_ += kTickSeconds;
    gathering_ = true;
    protective_ = frame_.in(lying_[stuck_ > kStuckFor ? on_back() : nearest.pose]);
  }

  // The lying pose whose chest faces up most.
  std::size_t on_back() const {
    const auto up = [&](const Pose& pose) {
      return (world_pose(body_.skeleton, pose).rotation[index(Joint::chest)] * kForward).y;
    };
    const auto most = std::max_element(lying_.begin(), lying_.end(),
                                       [&](const Pose& a, const Pose& b) { return up(a) < up(b); });
    return static_cast<std::size_t>(most - lying_.begin());
  }

  Pose fall_tick(Tick tick) {
    if (rested_) return *rested_;
    const float now = static_cast<float>(tick) * kTickSeconds;
    aim_fall(tick, now);
    for (int half = 0; half < 2; ++half) {
      ragdoll_.set_tone(fall_tone(now));
      step(2 * (tick - 1) + half);
    }
    const Pose pose = ragdoll_.pose();
    if (landed_ < 0 && (trunk_down(body_, pose) || caught(pose))) {
      landed_ = now;
      still_ = -kGatherFrom;  // at rest again no sooner than it gathers itself
      protective_ = lying_pose(body_, protective_, pose);
    }
    still_ = ragdoll_.fastest() < kResting && !astray_ ? still_ + kTickSeconds : 0;
    Pose lifted = pose;
    lifted.hips.y += frame_.lowered() * (1 - glm::smoothstep(0.0f, kIntoClip, now));
    Pose shown = frame_.out(mend_(lifted));
    const bool over = landed_ >= 0 && (still_ >= kRestFor || now - landed_ > kMostAfterLanding);
    if (over) rested_ = shown;
    return shown;
  }

  const BodyModel& body_;
  const ImpactOutcome& outcome_;
  float tone_;
  std::span<const Pose> target_, lying_;
  ImpactFrame frame_;
  Ragdoll ragdoll_;
  Balance balance_;
  Mender mend_;
  StandingFeet feet_;
  Braking braking_;
  FlungLimbs limbs_;
  bool stopped_ = false;       // some joint is being driven back
  Pose within_;                // the last pose looked at
  float into_clip_, meet_by_;  // s
  bool lies_;                  // at the contact
  int steps_of_blow_;
  bool protecting_ = false, gathering_ = false;
  bool astray_ = false;     // far from every lying pose
  float astray_share_ = 0;  // 0 .. 1: that, as it sets in
  Pose protective_;
  float apart_ = 1;    // m, from every lying pose: the least of late
  float stuck_ = 0;    // s for which it has come no nearer
  float landed_ = -1;  // s: when the trunk met the ground; before that negative
  float still_ = 0;    // s for which everything has been at rest
  std::optional<Pose> rested_;
};

}  // namespace

std::vector<Pose> simulate_response(const BodyModel& body, const ImpactInput& input,
                                    const ImpactOutcome& outcome, std::span<const Pose> target,
                                    Tick ticks, std::span<const Pose> lying) {
  return Shown(body, input, outcome, target, lying).run(ticks);
}

}  // namespace ringcraft
