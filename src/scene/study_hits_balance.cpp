// V2: what a body holds, by the rule and simulated to its end.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/quantile.h"
#include "base/random.h"
#include "base/tasks.h"
#include "physics/balance.h"
#include "physics/ragdoll.h"
#include "physics/stances.h"
#include "physics/trial.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {

namespace {

constexpr std::array<float, 4> kWays{0, kPi, kPi / 2, -kPi / 2};
constexpr std::array<const char*, 4> kWayNames{"fore", "aft", "left", "right"};
constexpr float kHardestTried = 150;  // N s

// The largest impulse, N s, for which `holds` is still true.
template <class Holds>
float threshold(const Holds& holds) {
  float low = 0, high = kHardestTried;
  for (int i = 0; i < 8; ++i) {
    const float middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

struct Zone {
  Part part;
  std::array<float, 4> square, fighting;  // N s, simulated to the end (docs/sources.md, R3)
};
// The published row of the shin holds the lead shin.
constexpr std::array<Zone, 5> kZones{{{Part::chest, {29, 25, 32, 32}, {44, 43, 25, 33}},
                                      {Part::head, {25, 21, 26, 25}, {36, 31, 19, 27}},
                                      {Part::pelvis, {40, 36, 51, 58}, {71, 67, 47, 57}},
                                      {Part::left_thigh, {71, 49, 63, 67}, {101, 49, 50, 64}},
                                      {Part::left_shin, {39, 36, 53, 37}, {37, 68, 34, 39}}}};

void no_step_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V2 held without a step, N s");
  const BodyModel body = make_body({});
  const std::array<Pose, 2> stances{square_stance(body), fighting_stance(body)};
  constexpr std::size_t kCount = kZones.size() * 2 * kWays.size();
  struct Pair {
    float simulated, rule;
  };
  std::vector<Pair> found(kCount);
  run_tasks(kCount, asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    const Zone& zone = kZones[i / 8];
    const Pose& pose = stances[i / 4 % 2];
    const float way = kWays[i % 4];
    found[i].simulated = threshold([&](float impulse) {
      return !simulate_standing(body, StillHit(body, pose, zone.part, way, impulse).input).fell;
    });
    found[i].rule = threshold([&](float impulse) {
      return impulse_step(body, StillHit(body, pose, zone.part, way, impulse).input).margin <= 0;
    });
  });
  for (std::size_t i = 0; i < kCount; ++i) {
    const Zone& zone = kZones[i / 8];
    const bool square = i / 4 % 2 == 0;
    const auto published = static_cast<double>((square ? zone.square : zone.fighting)[i % 4]);
    const std::string name = fmt::format("{} {} {}", square ? "square" : "fighting",
                                         name_of(zone.part), kWayNames[i % 4]);
    rows.held(name + ", simulated to the end", "N s", static_cast<double>(found[i].simulated),
              fmt::format("{}", published), {.75 * published, 1.25 * published});
    rows.said(name + ", by the decision", "N s", static_cast<double>(found[i].rule),
              fmt::format("{}", published));
  }
  asked.run.say("thresholds without a step found");
}

void step_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V2 held with steps, N s");
  const BodyModel body = make_body({});
  const Pose pose = square_stance(body);
  struct Row {
    int steps;
    std::array<double, 3> derived;  // fore, aft, side, for a point mass
  };
  for (const Row& row : {Row{1, {109, 78, 66}}, Row{2, {132, 94, 76}}, Row{3, {142, 101, 79}}}) {
    for (std::size_t d = 0; d < 3 && !asked.run.stopped(); ++d) {
      const float held = threshold([&](float impulse) {
        return severity(impulse_step(
                   body, StillHit(body, pose, Part::chest, kWays[d], impulse).input)) <= row.steps;
      });
      rows.held(fmt::format("square chest {}, {} step{}, by the decision", kWayNames[d], row.steps,
                            row.steps > 1 ? "s" : ""),
                "N s", static_cast<double>(held), fmt::format("{} (derived)", row.derived[d]),
                {.75 * row.derived[d], 1.25 * row.derived[d]});
    }
  }
  asked.run.say("thresholds with steps found");
}

// One random push: stance, zone, tone, size and direction.
struct RandomPush {
  explicit RandomPush(std::uint64_t seed) {
    Random random(seed);
    stance = static_cast<std::size_t>(random.below(3));
    constexpr std::array<Part, 9> kParts{Part::head,      Part::chest,      Part::abdomen,
                                         Part::pelvis,    Part::left_thigh, Part::right_thigh,
                                         Part::left_shin, Part::right_shin, Part::left_upper_arm};
    part = kParts[static_cast<std::size_t>(random.below(9))];
    way = random.uniform(-kPi, kPi);
    impulse = random.uniform(5, 65);
    tone = random.uniform(.5f, 1);
  }
  std::size_t stance;
  Part part;
  float way, impulse, tone;
};

}  // namespace

void decision_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V2 decision against the body simulated to its end");
  const BodyModel body = make_body({});
  const std::array<Pose, 3> stances{square_stance(body), fighting_stance(body),
                                    mirrored(fighting_stance(body))};
  const auto count = static_cast<std::size_t>(asked.settings.count);
  std::vector<std::array<bool, 2>> held(count);  // said, simulated
  run_tasks(count, asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    const RandomPush push(derived_seed(asked.settings.seed, "agreement", i));
    const StillHit hit(body, stances[push.stance], push.part, push.way, push.impulse, push.tone);
    held[i] = {impulse_step(body, hit.input).margin <= 0, !simulate_standing(body, hit.input).fell};
  });
  double agreed = 0, said_held = 0, said_lost = 0;
  for (const auto& [said, simulated] : held) {
    agreed += said == simulated ? 1 : 0;
    said_held += said && !simulated ? 1 : 0;
    said_lost += !said && simulated ? 1 : 0;
  }
  const double all = static_cast<double>(count);
  rows.held(fmt::format("agreement over {} random hits, 2.5 s", count), "%", 100 * agreed / all,
            "96 in trials before (docs/sources.md, R2)", at_least(95));
  rows.said("said held, fell", "%", 100 * said_held / all, "");
  rows.said("said not held, stood", "%", 100 * said_lost / all, "");
  asked.run.say("decisions compared with simulated ends");
}

namespace {

// The largest lean, degrees, from which one step brings the body back: released at rest.
double release_angle(const BodyModel& body, const Pose& pose, float way) {
  const Base base = base_of(body, world_pose(body.skeleton, pose), {true, true});
  const Vec3 com = center_of_mass(body, world_pose(body.skeleton, pose));
  const Vec3 direction = yaw_rotation(way) * kForward;
  double low = 0, high = 80;
  for (int i = 0; i < 20; ++i) {
    const double lean = (low + high) / 2;
    const Vec3 at = com + direction * (com.y * std::sin(radians(static_cast<float>(lean))));
    const Base::Beyond beyond = base.beyond(at);
    (beyond.distance <= step_allowance(body, 1, way) ? low : high) = lean;
  }
  return low;
}

void lean_rows(HitRows& rows) {
  rows.group("V2 lean release");
  const BodyModel body = make_body({});
  const Pose pose = square_stance(body);
  const double fore = release_angle(body, pose, 0), aft = release_angle(body, pose, kPi),
               side = release_angle(body, pose, kPi / 2);
  rows.held("forward, one step", "deg", fore, "30.7 young women, men alike", {27, 34});
  rows.said("backward, one step", "deg", aft, "");
  rows.said("sideways, one step", "deg", side, "");
  rows.held("forward over backward", "", fore / aft, "1.22", {1.22 * .75, 1.22 * 1.25});
  rows.held("forward over sideways", "", fore / side, "1.23", {1.23 * .75, 1.23 * 1.25});
}

// When the first step's foot lifts and lands, over the library's recoveries.
void step_time_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V2 first recovery step");
  std::vector<double> lifts, lands;
  for (const ActionId id : asked.library.responses()) {
    const Action& action = asked.library.action(id);
    if (!action.response || action.response->kind != ResponseKind::recovery_steps) continue;
    const Clip& clip = action.clip;
    const FootContacts start = clip.contacts_at(0);
    Tick lift = 0, land = 0;
    Side side = Side::left;
    for (Tick t = 1; t <= clip.length() && lift == 0; ++t) {
      for (const Side one : {Side::left, Side::right}) {
        if (!start.of(one) || clip.contacts_at(t).of(one)) continue;
        side = one;
        lift = t;
        break;
      }
    }
    for (Tick t = lift; lift > 0 && t <= clip.length() && land == 0; ++t) {
      if (clip.contacts_at(t).of(side)) land = t;
    }
    if (land == 0) continue;
    lifts.push_back(seconds(lift));
    lands.push_back(seconds(land));
    rows.said(fmt::format("{}: lands {:.2f} s, lifts", action.name, lands.back()), "s",
              lifts.back(), "");
  }
  if (lifts.empty()) return;
  rows.held(fmt::format("lifts off, mean of {} (sd {:.2g})", lifts.size(), deviation(lifts)), "s",
            mean(lifts), "0.337 +- 0.088", {.2, .35});
  rows.held(fmt::format("lands, mean of {} (sd {:.2g})", lands.size(), deviation(lands)), "s",
            mean(lands), "0.637 +- 0.099", {.35, .65});
}

// From a blow that just topples a body in a stance to its trunk on the ground, as it is shown.
void fall_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("V2 fall from stance");
  const BodyModel body = make_body({});
  const std::array<Pose, 2> stances{square_stance(body), fighting_stance(body)};
  constexpr std::array<Part, 3> kStruck{Part::head, Part::chest, Part::pelvis};
  constexpr std::size_t kWayCount = 8, kCount = 2 * kStruck.size() * kWayCount;
  constexpr float kJustTopples = 1.1f;  // of the impulse that steps still hold
  constexpr Tick kWatched = 240;
  std::vector<double> landed(kCount, -1);
  run_tasks(kCount, asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    const Pose& pose = stances[i % 2];
    const Part part = kStruck[i / 2 % kStruck.size()];
    const std::size_t turn = i / 2 / kStruck.size();
    const float way = static_cast<float>(turn) * 2 * kPi / kWayCount;
    const auto hit = [&](float impulse) { return StillHit(body, pose, part, way, impulse); };
    const float held = threshold(
        [&](float impulse) { return severity(impulse_step(body, hit(impulse).input)) < 4; });
    const StillHit topples = hit(kJustTopples * held);
    const ImpactOutcome outcome = impulse_step(body, topples.input);
    if (outcome.response != ResponseKind::knockdown || outcome.knockout) return;
    const auto poses = simulate_response(body, topples.input, outcome, {}, kWatched);
    for (std::size_t t = 0; t < poses.size() && landed[i] < 0; ++t) {
      if (trunk_down(body, poses[t])) landed[i] = seconds(static_cast<Tick>(t) + 1);
    }
  });
  std::erase_if(landed, [](double s) { return s < 0; });
  if (landed.empty()) return;
  rows.held(
      fmt::format("trunk on the ground, mean of {} (sd {:.2g})", landed.size(), deviation(landed)),
      "s", mean(landed), "about 0.7", {.5, .9});
  rows.said("the quickest tenth", "s", quantile(landed, .1), "");
  rows.said("the slowest tenth", "s", quantile(landed, .9), "");
}

}  // namespace

void balance_rows(const HitsAsked& asked, HitRows& rows) {
  no_step_rows(asked, rows);
  step_rows(asked, rows);
}

void recovery_rows(const HitsAsked& asked, HitRows& rows) {
  lean_rows(rows);
  step_time_rows(asked, rows);
  fall_rows(asked, rows);
}

}  // namespace ringcraft
