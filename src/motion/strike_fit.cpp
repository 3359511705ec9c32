#include "motion/strike_fit.h"

#include <algorithm>
#include <cmath>

#include "motion/aim.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {

namespace {

constexpr float kHandWindUp = 0.30f, kFootWindUp = 0.45f;           // s before the meeting, at most
constexpr float kLetsGo = 0.35f;                                    // s after it, at most
constexpr float kLeastRest = 0.12f, kShareSigma = 0.022f;           // s
constexpr float kTrunkLeads = 0.30f, kTrunkThere = 0.03f;           // s before the meeting
constexpr float kStraightestArm = 0.985f, kStraightestLeg = 0.99f;  // shares of their lengths
constexpr float kSoftArm = 0.93f;        // share beyond which an arm that is led straightens softly
constexpr int kFitRounds = 8;            // after which a strike meets, or never will
constexpr float kMet = 0.002f;           // m
constexpr float kAimed = 0.03f;          // m
constexpr float kReachStep = 0.01f;      // m
constexpr float kMostReachMove = 0.30f;  // m: how far a reach is looked for from the old one
constexpr int kSinkAround = 6;           // ticks
constexpr float kSinkSigma = 0.03f;      // s

// How the body helps the limb, per m of the limb's way; captured boxers who strike at the body sink
// by a third to a half of what the fist sinks, and lean over (docs/sources.md, C3).
constexpr float kSinks = 0.40f, kMostSink = 0.12f;         // m
constexpr float kLeansDown = 0.60f, kLeansUp = 0.30f;      // rad per m
constexpr float kRaises = 0.8f, kMostRaise = radians(12);  // rad per m, of a shoulder
constexpr float kLeansForward = 1.3f;                      // rad per m
constexpr float kComesAlong = 0.60f, kMostAlong = 0.07f;   // m, of the pelvis
constexpr float kTilts = 1.2f, kMostTilt = radians(22),
                kLeastTilt = radians(-8);  // rad per m, of who kicks
constexpr float kHighestElbow = 0.08f;     // m over the clip's
constexpr float kGirdleShare = 0.6f, kMostGirdle = radians(22);
constexpr float kMostDorsiflexion = radians(31);  // of a foot with its heel down
constexpr int kHeelRounds = 4;
constexpr float kKicks = 0.05f;  // m of way at which a foot is wholly one that kicks

bool by_foot(const Strike& strike) {
  const Joint tip = tip_of(strike.joint);
  return tip == Joint::left_foot || tip == Joint::right_foot;
}

Side side_of(const Strike& strike) {
  const Joint tip = tip_of(strike.joint);
  return tip == Joint::left_hand || tip == Joint::left_foot ? Side::left : Side::right;
}

Limb limb_of(const Strike& strike) {
  return by_foot(strike) ? leg(side_of(strike)) : arm(side_of(strike));
}

// Turns a joint by a rotation given in the space of the pose.
void turn(const Skeleton& skeleton, Joint joint, Quat rotation, Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  set_world_rotation(skeleton, joint, rotation * world.rotation[index(joint)], pose);
}

// What the body does for one strike, at its meeting.
struct Help {
  float sink = 0, along = 0;  // m, of the pelvis
  float lean = 0, side = 0;   // rad forward and to the right, of the trunk
  float tilt = 0;             // rad: how far the kicking hip rises over the standing one
};

Help operator*(Help h, float share) {
  return {h.sink * share, h.along * share, h.lean * share, h.side * share, h.tilt * share};
}
Help operator+(Help a, Help b) {
  return {a.sink + b.sink, a.along + b.along, a.lean + b.lean, a.side + b.side, a.tilt + b.tilt};
}

// One strike on its way to where it is to meet.
struct Led {
  Strike strike;
  Meeting meeting;
  Vec3 aim{};  // m: what is to be met, of which the forward part is free unless `holds`
  Vec3 by{};   // m: of the limb's end, beyond what the trunk takes along
  Help help;
  Tick from = 0, until = 0;  // ticks between which the limb is led
  std::vector<float> share;  // by tick
};

class Mover {
 public:
  Mover(const Skeleton& skeleton, const Action& action, const Pose& guard)
      : skeleton_(skeleton), action_(action) {
    const std::vector<Meeting> met = meetings(skeleton, action, guard);
    for (std::size_t i = 0; i < met.size(); ++i) {
      Led led;
      led.strike = action.strikes[i];
      led.meeting = met[i];
      led.aim = met[i].at;
      strikes_.push_back(std::move(led));
    }
    for (Led& led : strikes_) make_share(led);
    sink_.assign(action.clip.frames.size(), 0.0f);
  }

  std::vector<Led>& strikes() { return strikes_; }

  // An elbow is thrown a hand's breadth higher at most: beyond that the hand meets the own head.
  static void bound(Led& led) {
    const bool elbow = led.strike.joint == arm(side_of(led.strike)).middle;
    if (elbow) led.aim.y = std::min(led.aim.y, led.meeting.at.y + kHighestElbow);
  }

  // Leads every strike to its aim; forward too where `holds_distance`, else as far as it gets.
  void solve(bool holds_distance) {
    for (Led& led : strikes_) {
      bound(led);
      // A clip that is cut off at its blow has no time to come back from elsewhere.
      if (action_.length() - led.meeting.tick < ticks(kLeastRest)) led.aim = led.meeting.at;
    }
    for (Led& led : strikes_) led.help = help_for(led.strike, led.aim - led.meeting.at);
    for (int round = 0; round < kFitRounds; ++round) {
      find_sink();
      float worst = 0;
      for (Led& led : strikes_) {
        const Pose pose = moved(led.meeting.tick);
        const WorldPose world = world_pose(skeleton_, pose);
        Vec3 off = led.aim - striking_point(led.strike, skeleton_, world);
        if (!holds_distance) off.z = 0;
        led.by += off;
        led.by.z -= beyond(led);
        worst = std::max(worst, glm::length(off));
      }
      if (worst < kMet) break;
    }
    find_sink();
  }

  Clip clip() const {
    Clip result = action_.clip;
    for (Tick t = 1; t < action_.length(); ++t)
      result.frames[static_cast<std::size_t>(t)] = moved(t);
    unroll_rotations(result);
    return result;
  }

 private:
  const Clip& old() const { return action_.clip; }

  static Help help_for(const Strike& strike, Vec3 way) {
    Help help;
    const float down = std::max(0.0f, -way.y), up = std::max(0.0f, way.y);
    if (by_foot(strike)) {
      help.tilt = std::clamp(kTilts * way.y, kLeastTilt, kMostTilt);
      help.along = std::clamp(kComesAlong * way.z, -kMostAlong, kMostAlong);
      return help;
    }
    help.sink = std::min(kMostSink, kSinks * down);
    help.lean = kLeansDown * down - kLeansUp * up + kLeansForward * std::max(0.0f, way.z);
    // The shoulder of an arm that strikes higher rises over the other one.
    const float raise = std::min(kMostRaise, kRaises * up);
    help.side = side_of(strike) == Side::left ? raise : -raise;
    help.along = std::clamp(kComesAlong * way.z, -kMostAlong, kMostAlong);
    return help;
  }

  // Shares of the way by tick: mostly along the limb's own path to the meeting, over time after it.
  void make_share(Led& led) {
    const bool foot = by_foot(led.strike);
    Tick& from = led.from;
    from = std::max<Tick>(0, led.meeting.tick - ticks(foot ? kFootWindUp : kHandWindUp));
    led.until = std::min(action_.length(), led.meeting.tick + ticks(kLetsGo));
    const Limb limb = limb_of(led.strike);
    for (const Led& other : strikes_) {
      if (&other == &led || limb_of(other.strike).end != limb.end) continue;
      if (other.meeting.tick < led.meeting.tick) from = std::max(from, other.meeting.tick);
      if (other.meeting.tick > led.meeting.tick)
        led.until = std::min(led.until, other.meeting.tick);
    }
    if (foot) {  // a foot is led only while it is in the air
      const Side side = side_of(led.strike);
      for (Tick t = from; t < led.meeting.tick; ++t) {
        if (old().contacts_at(t).of(side)) from = t + 1;
      }
      for (Tick t = led.until; t > led.meeting.tick; --t) {
        if (old().contacts_at(t).of(side)) led.until = t - 1;
      }
    }
    led.share.assign(old().frames.size(), 0.0f);
    std::vector<float> way{0};
    Vec3 before = end_of(limb, from);
    for (Tick t = from + 1; t <= led.meeting.tick; ++t) {
      const Vec3 now = end_of(limb, t);
      way.push_back(way.back() + glm::distance(now, before));
      before = now;
    }
    const Tick lasts = std::max<Tick>(1, led.meeting.tick - from);
    for (Tick t = from; t <= led.meeting.tick; ++t) {
      const float along = way[static_cast<std::size_t>(t - from)] / std::max(way.back(), 1e-4f);
      const float over = static_cast<float>(t - from) / static_cast<float>(lasts);
      led.share[static_cast<std::size_t>(t)] =
          glm::smoothstep(0.0f, 1.0f, 0.7f * along + 0.3f * over);
    }
    const auto rest = static_cast<float>(std::max<Tick>(1, led.until - led.meeting.tick));
    for (Tick t = led.meeting.tick + 1; t <= led.until; ++t) {
      led.share[static_cast<std::size_t>(t)] =
          1 - glm::smoothstep(0.0f, 1.0f, static_cast<float>(t - led.meeting.tick) / rest);
    }
    led.share = smoothed(led.share, kShareSigma);
  }

  Vec3 end_of(const Limb& limb, Tick t) const {
    return world_pose(skeleton_, old().at(t)).position[index(limb.end)];
  }

  // The trunk comes first and stays until the limb has met.
  Help help_at(Tick t) const {
    Help sum;
    float total = 0;
    for (const Led& led : strikes_) {
      const auto since = static_cast<float>(t - led.meeting.tick) * kTickSeconds;
      const auto left = static_cast<float>(led.meeting.tick) * kTickSeconds;
      const auto rest = static_cast<float>(action_.length() - led.meeting.tick) * kTickSeconds;
      const float lead = std::min(kTrunkLeads, left), back = std::min(kLetsGo, rest);
      const float share =
          since < 0
              ? glm::smoothstep(0.0f, 1.0f, (since + lead) / std::max(lead - kTrunkThere, 0.02f))
              : 1 - glm::smoothstep(0.0f, 1.0f,
                                    (since - kTrunkThere) / std::max(back - kTrunkThere, 0.02f));
      sum = sum + led.help * share;
      total += share;
    }
    return total > 1 ? sum * (1 / total) : sum;
  }

  // The body without its striking limbs' own way: pelvis and trunk.
  Pose with_help(Tick t) const {
    const Help help = help_at(t);
    Pose pose = old().at(t);
    pose.hips.y -= help.sink + sink_[static_cast<std::size_t>(t)];
    pose.hips.z += help.along;
    tilt(help.tilt, pose);
    if (help.lean != 0 || help.side != 0) {
      const Quat third = from_rotation_vector(Vec3(help.lean, 0, help.side) / 3.0f);
      for (const Joint joint : {Joint::spine, Joint::chest, Joint::upper_chest}) {
        turn(skeleton_, joint, third, pose);
      }
      turn(skeleton_, Joint::neck, from_rotation_vector(Vec3(help.lean, 0, help.side) * -0.7f),
           pose);
    }
    return pose;
  }

  // Turns the pelvis about the standing hip so that the kicking one rises; the trunk takes half.
  void tilt(float angle, Pose& pose) const {
    const auto kick = std::find_if(strikes_.begin(), strikes_.end(),
                                   [](const Led& led) { return by_foot(led.strike); });
    if (angle == 0 || kick == strikes_.end()) return;
    const Limb kicks = leg(side_of(kick->strike)), stands = leg(other(side_of(kick->strike)));
    const WorldPose world = world_pose(skeleton_, pose);
    const WorldPose meets = world_pose(skeleton_, old().at(kick->meeting.tick));
    Vec3 way = meets.position[index(kicks.end)] - meets.position[index(stands.root)];
    way.y = 0;
    const Quat turned = glm::angleAxis(angle, glm::cross(normalized_or(way, kForward), kUp));
    const Vec3 hip = world.position[index(stands.root)];
    pose.hips = hip + turned * (pose.hips - hip);
    pose.rotation[0] = glm::normalize(turned * pose.rotation[0]);
    turn(skeleton_, Joint::spine, glm::inverse(glm::slerp(Quat(1, 0, 0, 0), turned, 0.5f)), pose);
  }

  Vec3 way_of(const Limb& limb, Tick t) const {
    Vec3 way{};
    for (const Led& led : strikes_) {
      if (limb_of(led.strike).end != limb.end) continue;
      way += led.by * led.share[static_cast<std::size_t>(t)];
    }
    return way;
  }

  bool strikes_with(const Limb& limb) const {
    return std::any_of(strikes_.begin(), strikes_.end(),
                       [&](const Led& led) { return limb_of(led.strike).end == limb.end; });
  }

  // A joint that strikes by itself: elbow or knee.
  bool by_middle(const Limb& limb, Tick t) const {
    return std::any_of(strikes_.begin(), strikes_.end(), [&](const Led& led) {
      return led.strike.joint == limb.middle && led.share[static_cast<std::size_t>(t)] > 0;
    });
  }

  // The shoulder goes where the hand or elbow goes, a third of the way.
  void turn_girdle(Side side, Joint end, Vec3 way, Pose& pose) const {
    const Joint girdle = side == Side::left ? Joint::left_shoulder : Joint::right_shoulder;
    const WorldPose world = world_pose(skeleton_, pose);
    const Vec3 reach = world.position[index(end)] - world.position[index(girdle)];
    Vec3 angle = rotation_vector(rotation_between(reach, reach + way)) * kGirdleShare;
    const float most = kMostGirdle / std::max(glm::length(angle), kMostGirdle);
    turn(skeleton_, girdle, from_rotation_vector(angle * most), pose);
  }

  // Elbow or knee led by itself; what hangs from it goes along.
  void lead_middle(const Limb& limb, Vec3 to, Pose& pose) const {
    const WorldPose world = world_pose(skeleton_, pose);
    const Vec3 root = world.position[index(limb.root)];
    const Vec3 bone = world.position[index(limb.middle)] - root;
    turn(skeleton_, limb.root, rotation_between(bone, to - root), pose);
  }

  void lead_arm(Side side, Tick t, Pose& pose) const {
    const Limb limb = arm(side);
    const Vec3 way = way_of(limb, t);
    if (glm::length(way) < 1e-6f) return;
    const Joint led = by_middle(limb, t) ? limb.middle : limb.end;
    const Vec3 to = world_pose(skeleton_, pose).position[index(led)] + way;
    turn_girdle(side, led, way, pose);
    if (led == limb.middle) {
      lead_middle(limb, to, pose);
      return;
    }
    const Quat wrist = pose.rotation[index(limb.end)];
    move_limb_end(skeleton_, limb, to, straightest(limb, t), pose);
    pose.rotation[index(limb.end)] = wrist;
  }

  // Share of its length to which a limb may straighten: as far as it does in the clip, or a little.
  float straightest(const Limb& limb, Tick t) const {
    const float was = reach_share(skeleton_, limb, world_pose(skeleton_, old().at(t)));
    return std::clamp(was, kSoftArm, 0.9999f);
  }

  // How far the shin leans over the foot, rad.
  static float dorsiflexion(const Limb& limb, const Pose& pose) {
    const Quat& turn = pose.rotation[index(limb.end)];
    return -wrapped_angle(2 * std::atan2(turn.x, turn.w));
  }

  void lead_leg(Side side, Tick t, Pose& pose) const {
    const Limb limb = leg(side);
    const WorldPose clip = world_pose(skeleton_, old().at(t));
    const Vec3 way = way_of(limb, t), ankle = clip.position[index(limb.end)];
    if (by_middle(limb, t)) {
      const Vec3 knee = clip.position[index(limb.middle)];
      lead_middle(limb, knee + way, pose);
      return;
    }
    const Vec3 now = world_pose(skeleton_, pose).position[index(limb.end)];
    if (glm::distance(now, ankle + way) < 1e-6f) return;
    // A foot that stands keeps its turn in the world, one that kicks the one to its shin.
    const Quat to_shin = old().at(t).rotation[index(limb.end)];
    const float kicks = std::min(1.0f, glm::length(way) / kKicks);
    const float bends = std::max(kMostDorsiflexion, dorsiflexion(limb, old().at(t)));
    Quat turned = clip.rotation[index(limb.end)];
    Vec3 to = ankle + way;
    for (int i = 0; i < kHeelRounds; ++i) {
      move_limb_end(skeleton_, limb, to, 0.9999f, pose);
      set_world_rotation(skeleton_, limb.end, turned, pose);
      const float excess = dorsiflexion(limb, pose) - bends;
      if (kicks > 0 || excess < 1e-3f) break;
      // An ankle that is bent to its end lifts the heel; the ball stays, and the toes lie flat.
      const Vec3 ball = to + turned * skeleton_.offset[index(toes(side))];
      turned = turned * glm::angleAxis(excess, kLeft);
      to = ball - turned * skeleton_.offset[index(toes(side))];
      Quat& toe = pose.rotation[index(toes(side))];
      toe = glm::angleAxis(-excess, kLeft) * toe;
    }
    Quat& foot = pose.rotation[index(limb.end)];
    foot = glm::slerp(foot, in_hemisphere_of(to_shin, foot), kicks);
  }

  Pose moved(Tick t) const {
    Pose pose = with_help(t);
    for (const Side side : {Side::left, Side::right}) {
      lead_leg(side, t, pose);
      lead_arm(side, t, pose);
    }
    return pose;
  }

  // How far a strike at its meeting asks for more than the limb's length, m along +Z.
  float beyond(const Led& led) const {
    const Limb limb = limb_of(led.strike);
    if (led.strike.joint == limb.middle) return 0;
    const Tick t = led.meeting.tick;
    const WorldPose world = world_pose(skeleton_, with_help(t));
    const Vec3 root = world.position[index(limb.root)];
    const WorldPose clip = world_pose(skeleton_, old().at(t));
    const Vec3 start = (by_foot(led.strike) ? clip : world).position[index(limb.end)];
    const Vec3 off = start + way_of(limb, t) - root;
    const float length = skeleton_.bone(limb.middle) + skeleton_.bone(limb.end);
    const float was =
        glm::distance(clip.position[index(limb.end)], clip.position[index(limb.root)]);
    const float most =
        std::max(was, (by_foot(led.strike) ? kStraightestLeg : kStraightestArm) * length);
    if (glm::length(off) <= most) return 0;
    const float room = most * most - off.x * off.x - off.y * off.y;
    return off.z - std::sqrt(std::max(0.0f, room));
  }

  // How much lower the pelvis has to go so that standing legs reach their feet.
  void find_sink() {
    std::vector<float> needs(old().frames.size(), 0.0f);
    std::fill(sink_.begin(), sink_.end(), 0.0f);
    const float longest = kStraightestLeg * skeleton_.leg_length();
    for (Tick t = 0; t <= action_.length(); ++t) {
      const WorldPose clip = world_pose(skeleton_, old().at(t));
      const WorldPose now = world_pose(skeleton_, with_help(t));
      for (const Side side : {Side::left, Side::right}) {
        const Limb limb = leg(side);
        if (strikes_with(limb) && !old().contacts_at(t).of(side)) continue;
        const Vec3 ankle = clip.position[index(limb.end)], hip = now.position[index(limb.root)];
        const float most = std::max(longest, glm::distance(ankle, clip.position[index(limb.root)]));
        const Vec3 off = hip - ankle;
        const float up = std::sqrt(std::max(0.0f, most * most - off.x * off.x - off.z * off.z));
        float& need = needs[static_cast<std::size_t>(t)];
        need = std::max(need, off.y - up);
      }
    }
    sink_ = smoothed(widened(needs, kSinkAround), kSinkSigma);
    sink_.front() = sink_.back() = 0;
  }

  const Skeleton& skeleton_;
  const Action& action_;
  std::vector<Led> strikes_;
  std::vector<float> sink_;  // m by tick
};

std::vector<Vec3> way_of_tip(const Skeleton& skeleton, const Action& action, const Strike& strike) {
  std::vector<Vec3> tip;
  for (const Pose& pose : action.clip.frames) {
    tip.push_back(striking_point(strike, skeleton, world_pose(skeleton, pose)));
  }
  return tip;
}

// The part of the reach, moved by `by` or near there, in which the strike passes its aim.
void find_reach(const Skeleton& skeleton, const Action& action, const WorldPose& guard, float ratio,
                Strike& strike) {
  const AimPoint* point = aim_point(strike.aim);
  if (point == nullptr || strike.farthest <= 0) return;
  const std::vector<Vec3> tip = way_of_tip(skeleton, action, strike);
  float from = 0, to = 0, best_from = 0, best_to = 0;
  const float last = strike.farthest + kMostReachMove;
  for (float d = std::max(0.1f, strike.nearest - kMostReachMove); d <= last; d += kReachStep) {
    if (passes(strike, tip, opponent_aim(*point, guard, ratio, d)) > kAimed) {
      from = 0;
      continue;
    }
    if (from == 0) from = d;
    to = d;
    if (best_to == 0 || to - from > best_to - best_from) best_from = from, best_to = to;
  }
  strike.nearest = best_from;
  strike.farthest = best_to;
}

}  // namespace

std::vector<Meeting> meetings(const Skeleton& skeleton, const Action& action, const Pose& guard) {
  const WorldPose standing = world_pose(skeleton, guard);
  std::vector<Meeting> result;
  for (const Strike& strike : action.strikes) {
    const std::vector<Vec3> tip = way_of_tip(skeleton, action, strike);
    const AimPoint* point = aim_point(strike.aim);
    Meeting meeting;
    if (point != nullptr && strike.farthest > 0) {
      const float middle = (strike.nearest + strike.farthest) * 0.5f;
      passes(strike, tip, opponent_aim(*point, standing, 1, middle), &meeting.tick);
    } else {
      meeting.tick = strike.active_begin;
      for (Tick t = strike.active_begin; t < strike.active_end && t <= action.length(); ++t) {
        const auto at = [&](Tick tick) { return tip[static_cast<std::size_t>(tick)].z; };
        if (at(t) > at(meeting.tick)) meeting.tick = t;
      }
    }
    meeting.at = tip[static_cast<std::size_t>(meeting.tick)];
    result.push_back(meeting);
  }
  return result;
}

Action fitted(const Skeleton& skeleton, const Action& action, const Pose& guard, float ratio) {
  if (!action.attacks()) return action;
  const WorldPose standing = world_pose(skeleton, guard);
  Mover mover(skeleton, action, guard);
  for (Led& led : mover.strikes()) {
    const AimPoint* point = aim_point(led.strike.aim);
    if (point != nullptr) {
      const Vec3 own = opponent_aim(*point, standing, 1, 0);
      const Vec3 theirs = opponent_aim(*point, standing, ratio, 0);
      led.aim += Vec3(theirs.x - own.x, theirs.y - own.y, 0);
    } else {
      led.aim.y *= ratio;
    }
  }
  mover.solve(false);
  Action result = action;
  result.clip = mover.clip();
  find_reaches(skeleton, guard, ratio, result);
  return result;
}

Action moved_reach(const Skeleton& skeleton, const Action& action, const Pose& guard, float by) {
  Mover mover(skeleton, action, guard);
  for (Led& led : mover.strikes()) led.aim.z += by;
  mover.solve(true);
  Action result = action;
  result.clip = mover.clip();
  find_reaches(skeleton, guard, 1, result);
  return result;
}

Action aimed(const Skeleton& skeleton, const Action& action, const Pose& guard) {
  const WorldPose standing = world_pose(skeleton, guard);
  Mover mover(skeleton, action, guard);
  for (Led& led : mover.strikes()) {
    const AimPoint* point = aim_point(led.strike.aim);
    if (point == nullptr) continue;
    const Vec3 theirs = opponent_aim(*point, standing, 1, 0);
    led.aim.x = theirs.x;
    led.aim.y = theirs.y;
  }
  mover.solve(false);
  Action result = action;
  result.clip = mover.clip();
  const std::vector<Meeting> met = meetings(skeleton, result, guard);
  for (std::size_t i = 0; i < met.size(); ++i) {
    Strike& strike = result.strikes[i];
    strike.nearest = strike.farthest = met[i].at.z;
    find_reach(skeleton, result, standing, 1, strike);
    if (strike.farthest <= 0) strike.aim.clear();
  }
  return result;
}

void find_reaches(const Skeleton& skeleton, const Pose& guard, float ratio, Action& action) {
  const WorldPose standing = world_pose(skeleton, guard);
  for (Strike& strike : action.strikes) find_reach(skeleton, action, standing, ratio, strike);
}

MotionLibrary fitted(const MotionLibrary& library, float ratio) {
  const Pose* guard = standing_guard(library);
  std::vector<Action> actions = library.actions();
  for (Action& action : actions) {
    if (guard != nullptr) action = fitted(library.skeleton(), action, *guard, ratio);
  }
  return library.with(std::move(actions));
}

bool as_tall(float ratio) {
  return std::abs(ratio - 1) <= 0.01f;
}

const Pose* standing_guard(const std::vector<Action>& actions, Stance stance) {
  const Action* idle = nullptr;
  for (const Action& action : actions) {
    if (action.kind != Kind::idle || action.stance != stance) continue;
    if (idle == nullptr || (!is_authored(*idle) && is_authored(action))) idle = &action;
  }
  return idle == nullptr ? nullptr : &idle->clip.frames.front();
}

const Pose* standing_guard(const MotionLibrary& library, Stance stance) {
  return standing_guard(library.actions(), stance);
}

}  // namespace ringcraft
