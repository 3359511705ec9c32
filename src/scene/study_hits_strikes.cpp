// V1: the library's blows against a standing body.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/tasks.h"
#include "motion/strike_fit.h"
#include "scene/placed_strike.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {

namespace {

constexpr double kPunchSeconds = .012;  // half-sine that a straight's force and impulse give (V1)
constexpr double kKickSeconds = .050;   // of a kick: that of the shown response

struct Landed {
  std::string action;
  StrikeKind kind = StrikeKind::straight;
  bool lead = false;
  TargetZone zone = TargetZone::head;
  double speed = 0, mass = 0, impulse = 0, force = 0;  // m/s, kg, N s, N
  double head_g = 0, head_alpha = 0;                   // g, rad/s2; of blows to the head
  double time = 0;                                     // s from the launch to the contact
};

// The head as a free body that carries the neck: within 10 % of the simulated head
// (docs/sources.md, R4).
void head_motion(const BodyModel& body, const ImpactInput& input, Landed& landed) {
  const WorldPose world = world_pose(body.skeleton, input.pose);
  const PartModel& head = body.parts[index(Part::head)];
  const std::size_t j = index(Joint::head);
  const Vec3 center = world.position[j] + world.rotation[j] * head.center;
  const Vec3 line = normalized_or(input.blow.impulse, kForward);
  const double mass =
      static_cast<double>(head.mass) + static_cast<double>(body.parts[index(Part::neck)].mass);
  landed.head_g = landed.force / mass / static_cast<double>(kGravity);
  const Vec3 moment =
      glm::conjugate(world.rotation[j]) * glm::cross(input.blow.point - center, line);
  landed.head_alpha = landed.force * static_cast<double>(glm::length(moment / head.inertia));
}

Part aimed_at(const Strike& strike) {
  switch (strike.zone) {
    case TargetZone::head:
      return Part::head;
    case TargetZone::body:
      return Part::abdomen;
    case TargetZone::leg:
      return Part::left_thigh;
  }
  return Part::head;
}

// A body that stands as the library's fighters do, since that is what their blows aim at, with its
// arms hanging, as a dummy has none; faces +Z.
Pose dummy_pose(const MotionLibrary& library, const BodyModel& body) {
  const Pose* guard = standing_guard(library);
  Pose pose = guard == nullptr ? rest_pose(body.skeleton) : scaled(*guard, body.scale);
  for (const Side side : {Side::left, Side::right}) {
    const Limb limb = arm(side);
    pose.rotation[index(limb.middle)] = pose.rotation[index(limb.end)] = Quat(1, 0, 0, 0);
    const Vec3 out = side == Side::left ? kLeft : -kLeft;
    const WorldPose world = world_pose(body.skeleton, pose);
    const Quat shoulder =
        world.rotation[index(limb.root)] * glm::inverse(pose.rotation[index(limb.root)]);
    const Vec3 outward = shoulder * out;
    const Vec3 down = .15f * Vec3{outward.x, 0, outward.z} - kUp;
    pose.rotation[index(limb.root)] = rotation_between(out, glm::inverse(shoulder) * down);
  }
  return pose;
}

// A place of the attack: the first contact of its blow, as the clips alone have it.
struct Meeting {
  Contact contact;
  Pose pose;  // of the attacker
  Tick age = 0;
};

// The first contact from `distance` m in front.
std::optional<Meeting> meeting(const MotionLibrary& library, ActionId attack, const BodyModel& body,
                               const BodyCapsules& dummy, float distance) {
  const Strike& strike = library.action(attack).strikes.front();
  Launch launch;
  launch.action = attack;
  launch.placement = attacker_placement({}, distance);
  SweptBody attacker, target;
  target.before = target.after = dummy;
  Pose pose = pose_at(library, launch, strike.active_begin - 1, body.scale);
  attacker.after = capsules(body, world_pose(body.skeleton, pose));
  for (Tick age = strike.active_begin; age < strike.active_end; ++age) {
    attacker.before = attacker.after;
    pose = pose_at(library, launch, age, body.scale);
    attacker.after = capsules(body, world_pose(body.skeleton, pose));
    if (const auto contact = strike_contact(attacker, strike, target)) {
      return Meeting{*contact, pose, age};
    }
  }
  return std::nullopt;
}

// The blow at its best: from the distance at which impulse times speed is largest, on the part that
// it is made for (or its zone).
std::optional<Landed> landed(const MotionLibrary& library, ActionId attack) {
  const Action& action = library.action(attack);
  const Strike& strike = action.strikes.front();
  const BodyModel body = make_body({});
  ImpactInput input;
  input.pose = dummy_pose(library, body);
  const BodyCapsules dummy = capsules(body, world_pose(body.skeleton, input.pose));
  const Part aim = aimed_at(strike);
  std::optional<Landed> best;
  for (float distance = kNearestPlace; distance <= kFarthestPlace; distance += kPlaceStep) {
    const auto met = meeting(library, attack, body, dummy, distance);
    if (!met || met->contact.blocked || zone_of(met->contact.struck) != strike.zone) continue;
    if (aim == Part::head && met->contact.struck != aim) continue;
    input.blow = blow_of(body, met->pose, body, input.pose, met->contact, strike.kind);
    Landed l;
    l.action = action.name;
    l.kind = strike.kind;
    l.lead = strike.joint == Joint::left_hand || strike.joint == Joint::left_foot;
    l.zone = strike.zone;
    l.speed = static_cast<double>(input.blow.speed);
    l.mass = static_cast<double>(input.blow.effective_mass);
    l.impulse = static_cast<double>(glm::length(input.blow.impulse));
    if (best && best->impulse * best->speed >= l.impulse * l.speed) continue;
    const bool kicks = strike.kind == StrikeKind::front_kick ||
                       strike.kind == StrikeKind::roundhouse ||
                       strike.kind == StrikeKind::side_kick;
    l.force = l.impulse * static_cast<double>(kPi) / 2 / (kicks ? kKickSeconds : kPunchSeconds);
    l.time = seconds(met->age);
    if (input.blow.part == Part::head) head_motion(body, input, l);
    best = l;
  }
  return best;
}

using Picked = std::vector<const Landed*>;

std::vector<double> values(const Picked& picked, double Landed::*field) {
  std::vector<double> out;
  out.reserve(picked.size());
  for (const Landed* l : picked) out.push_back(l->*field);
  return out;
}

struct Published {  // mean and standard deviation
  double mean, deviation;
};

class StrikeRows {
 public:
  StrikeRows(const std::vector<Landed>& all, HitRows& rows) : all_(all), rows_(rows) {}

  template <class Wanted>
  Picked pick(const Wanted& wanted) const {
    Picked out;
    for (const Landed& l : all_) {
      if (wanted(l)) out.push_back(&l);
    }
    return out;
  }

  void row(const std::string& name, const std::string& what, const std::string& unit,
           const Picked& picked, double Landed::*field, const std::optional<Published>& published,
           const std::string& otherwise = "") {
    if (picked.empty()) return;
    const std::vector<double> v = values(picked, field);
    const std::string label =
        fmt::format("{}: {} (sd {:.3g} of {})", name, what, deviation(v), v.size());
    if (!published) return rows_.said(label, unit, mean(v), otherwise);
    rows_.held(label, unit, mean(v),
               fmt::format("{:.4g} +- {:.4g}", published->mean, published->deviation),
               {published->mean - published->deviation, published->mean + published->deviation});
  }

  // `a` over `b`.
  void order(const std::string& what, const Picked& a, const Picked& b, double Landed::*field,
             const std::string& published, const HitBar& bar) {
    if (a.empty() || b.empty()) return;
    rows_.held(what, "", mean(values(a, field)) / mean(values(b, field)), published, bar);
  }

 private:
  const std::vector<Landed>& all_;
  HitRows& rows_;
};

void punch_rows(StrikeRows& t) {
  const auto head = [&](StrikeKind kind, int lead) {
    return t.pick([=](const Landed& l) {
      return l.kind == kind && l.zone == TargetZone::head && (lead < 0 || l.lead == (lead == 1));
    });
  };
  const Picked rear = head(StrikeKind::straight, 0), lead = head(StrikeKind::straight, 1),
               hooks = head(StrikeKind::hook, -1), straights = head(StrikeKind::straight, -1);
  const std::string walilko = "straight, rear hand, head";
  t.row(walilko, "speed", "m/s", rear, &Landed::speed, Published{9.14, 2.06});
  t.row(walilko, "effective mass", "kg", rear, &Landed::mass, Published{2.9, 2.0});
  t.row(walilko, "impulse", "N s", rear, &Landed::impulse, {}, "26 (derived)");
  t.row(walilko, "peak force", "N", rear, &Landed::force, Published{3427, 811});
  t.row(walilko, "head acceleration", "g", rear, &Landed::head_g, Published{58, 13});
  t.row(walilko, "head rotation", "rad/s2", rear, &Landed::head_alpha, Published{6343, 1789});
  const std::string jab = "straight, lead hand, head";
  t.row(jab, "speed", "m/s", lead, &Landed::speed, {}, "7.5-8.0 in a combination");
  t.row(jab, "effective mass", "kg", lead, &Landed::mass, {}, "2.62 trained, 1.33 untrained");
  t.row(jab, "impulse", "N s", lead, &Landed::impulse, {}, "");
  t.row(jab, "peak force", "N", lead, &Landed::force, {}, "2082 amateurs at speed");
  const std::string hook = "hook, head";
  t.row(hook, "speed", "m/s", hooks, &Landed::speed, Published{11.0, 3.4});
  t.row(hook, "effective mass", "kg", hooks, &Landed::mass, {}, "");
  t.row(hook, "impulse", "N s", hooks, &Landed::impulse, {}, "34 (derived)");
  t.row(hook, "peak force", "N", hooks, &Landed::force, Published{4405, 2318});
  t.row(hook, "head acceleration", "g", hooks, &Landed::head_g, Published{71.2, 32.2});
  t.row(hook, "head rotation", "rad/s2", hooks, &Landed::head_alpha, Published{9306, 4485});
  t.order("hooks are faster than straights: ratio", hooks, straights, &Landed::speed, "> 1",
          at_least(1));
  t.order("straights arrive sooner than hooks: ratio of times", straights, hooks, &Landed::time,
          "< 1", at_most(1));
  t.order("rear over lead straight: force", rear, lead, &Landed::force, "1.26", at_least(1));
}

void kick_rows(StrikeRows& t) {
  const auto kicks = [&](StrikeKind kind, bool to_leg) {
    return t.pick(
        [=](const Landed& l) { return l.kind == kind && (to_leg || l.zone != TargetZone::leg); });
  };
  const Picked front = kicks(StrikeKind::front_kick, false),
               round = kicks(StrikeKind::roundhouse, false), low = t.pick([](const Landed&l) {
                 return l.kind == StrikeKind::roundhouse && l.zone == TargetZone::leg;
               });
  for (const auto& [name, picked] : {std::pair{std::string("front kick"), front},
                                     std::pair{std::string("roundhouse, body and head"), round},
                                     std::pair{std::string("roundhouse, leg"), low}}) {
    t.row(name, "speed", "m/s", picked, &Landed::speed, Published{11.75, 6.55});
    t.row(name, "effective mass", "kg", picked, &Landed::mass, {}, "");
    t.row(name, "impulse", "N s", picked, &Landed::impulse, {},
          name[0] == 'f' ? "" : "49-74 (derived)");
    t.row(name, "peak force (50 ms)", "N", picked, &Landed::force, {}, "123-9015, five kicks");
  }
  t.order("roundhouse over front kick: speed", round, front, &Landed::speed, "1.44-1.48",
          at_least(1));
  t.order("front kick over roundhouse: force", front, round, &Landed::force, "1.47-2.20",
          at_least(1));
}

}  // namespace

void strike_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V1 strikes");
  std::vector<ActionId> attacks;
  for (std::size_t i = 0; i < asked.library.actions().size(); ++i) {
    const Action& action = asked.library.actions()[i];
    if (action.kind == Kind::attack && action.strikes.size() == 1) attacks.emplace_back(i);
  }
  std::vector<std::optional<Landed>> tried(attacks.size());
  run_tasks(attacks.size(), asked.run.threads, [&](std::size_t i) {
    if (!asked.run.stopped()) tried[i] = landed(asked.library, attacks[i]);
  });
  if (asked.run.stopped()) return;
  std::vector<Landed> all;
  for (const auto& one : tried) {
    if (one) all.push_back(*one);
  }
  rows.said("attacks of one blow that meet a standing body", "", static_cast<double>(all.size()),
            fmt::format("of {}", attacks.size()));
  StrikeRows t(all, rows);
  punch_rows(t);
  kick_rows(t);
  for (const Landed& l : all) {
    rows.said(fmt::format("{}: {:.1f} m/s, {:.1f} kg, {:.0f} N, {:.2f} s", l.action, l.speed,
                          l.mass, l.force, l.time),
              "N s", l.impulse, "");
  }
  asked.run.say("strikes measured");
}

}  // namespace ringcraft
