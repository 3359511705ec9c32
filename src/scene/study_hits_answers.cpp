// V4 and V7: what people see of an answer, and the failures that game makers report.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/quantile.h"
#include "base/random.h"
#include "base/tasks.h"
#include "motion/quality.h"
#include "physics/partial.h"
#include "physics/ragdoll.h"
#include "physics/response.h"
#include "physics/stances.h"
#include "scene/answer.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {

namespace {

// A random hit on a random pose of the library.
HitQuery random_query(const MotionLibrary& library, std::uint64_t seed, float least, float most) {
  Random random(seed);
  HitQuery query;
  const auto& launchable = library.launchable();
  const Action& action = library.action(
      launchable[static_cast<std::size_t>(random.below(static_cast<int>(launchable.size())))]);
  query.action = action.name;
  query.at_s = static_cast<double>(random.uniform(.1f, .9f)) * seconds(action.length());
  constexpr std::array<Part, 7> kParts{Part::head,          Part::head,       Part::chest,
                                       Part::abdomen,       Part::left_thigh, Part::right_thigh,
                                       Part::left_upper_arm};
  query.part = kParts[static_cast<std::size_t>(random.below(7))];
  const float way = random.uniform(-kPi, kPi);
  query.impulse = random.uniform(least, most) * (yaw_rotation(way) * kForward);
  query.tone = random.uniform(.6f, 1);
  return query;
}

struct Seam {
  double apart = 0;     // m by which a joint is elsewhere than its speed says, at 60 Hz
  double velocity = 0;  // m/s by which its velocity jumps between two frames at 60 Hz
  Joint joint = Joint::hips;
  Tick tick = 0;  // when it does
};

// The change of every joint's motion from one frame of 60 Hz to the next.
std::array<Vec3, kJointCount> jumps(const WorldPose& a, const WorldPose& b, const WorldPose& c) {
  std::array<Vec3, kJointCount> out;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    out[j] = c.position[j] - 2.0f * b.position[j] + a.position[j];
  }
  return out;
}

// The worst joint of the shown frames `from`..`to`, beyond what the clip that is shown does itself.
Seam seam_over(const MotionLibrary& library, const BodyModel& body, const FighterTrack& track,
               const Launch& launch, Tick from, Tick to) {
  Seam worst;
  const auto last = static_cast<Tick>(track.frames.size()) - 1;
  const auto shown = [&](Tick t) {
    return world_pose(body.skeleton, track.frames[static_cast<std::size_t>(t)]);
  };
  const Pose rest = rest_of(library, launch, body.scale);
  const auto clip = [&](Tick t) {
    Pose pose = pose_at(library, launch, t, body.scale);
    if (launch.share < 1) pose = partial_pose(body.skeleton, rest, pose, launch.share);
    return world_pose(body.skeleton, pose);
  };
  for (Tick t = std::max(from, 4); t <= std::min(to, last); ++t) {
    const auto is = jumps(shown(t - 4), shown(t - 2), shown(t));
    const auto own = t - 4 >= launch.start ? jumps(clip(t - 4), clip(t - 2), clip(t))
                                           : std::array<Vec3, kJointCount>{};
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const auto jump = static_cast<double>(glm::length(is[j]) - glm::length(own[j]));
      if (jump > worst.apart) worst = {jump, jump * 60, joint_at(j), t};
    }
  }
  return worst;
}

// The longest way, m, on which a foot is drawn along the floor from frame `from` on: its sole lower
// than 1 cm, and faster than 0.3 m/s.
double longest_drag(const BodyModel& body, std::span<const Pose> frames, std::size_t from) {
  constexpr float kLow = .01f, kMoves = .3f * kTickSeconds;
  double longest = 0;
  for (const Side side : {Side::left, Side::right}) {
    double way = 0;
    Vec3 last = world_pose(body.skeleton, frames[from]).position[index(toes(side))];
    for (std::size_t t = from + 1; t < frames.size(); ++t) {
      const WorldPose world = world_pose(body.skeleton, frames[t]);
      const Vec3 ball = world.position[index(toes(side))];
      const float moved = std::hypot(ball.x - last.x, ball.z - last.z);
      last = ball;
      const bool drags = moved > kMoves && sole_height(body, world, side) < kLow;
      way = drags ? way + static_cast<double>(moved) : 0;
      longest = std::max(longest, way);
    }
  }
  return longest;
}

// How deep, m, a sole is in the floor from frame `from` on.
double deepest_sole(const BodyModel& body, std::span<const Pose> frames, std::size_t from) {
  float lowest = 0;
  for (const Pose& frame : frames.subspan(from)) {
    const WorldPose world = world_pose(body.skeleton, frame);
    for (const Side side : {Side::left, Side::right}) {
      lowest = std::min(lowest, sole_height(body, world, side));
    }
  }
  return static_cast<double>(-lowest);
}

// The longest time, s, from tick `from` of an answer on, in which neither foot carries where one of
// its clip's does: each off the floor, or on its way over it.
double longest_hop(const MotionLibrary& library, const BodyModel& body, const FighterTrack& track,
                   const Launch& launch, Tick from) {
  constexpr float kOff = .012f, kMoves = .4f * kTickSeconds;  // m: over the floor, and in a tick
  const std::vector<FootContacts>& clip = library.action(launch.action).clip.contacts;
  const Tick end = std::min(launch.end, static_cast<Tick>(track.frames.size()));
  Tick longest = 0, hop = 0;
  for (Tick t = from; t < end; ++t) {
    const auto at = static_cast<std::size_t>(t), age = static_cast<std::size_t>(launch.clip_age(t));
    if (age >= clip.size()) break;
    const WorldPose is = world_pose(body.skeleton, track.frames[at]),
                    was = world_pose(body.skeleton, track.frames[at - 1]);
    const auto carries = [&](Side side) {
      const std::size_t ball = index(toes(side));
      const Vec3 moved = is.position[ball] - was.position[ball];
      return sole_height(body, is, side) < kOff && std::hypot(moved.x, moved.z) < kMoves;
    };
    const bool stands = clip[age].left || clip[age].right;
    const bool hops = stands && !carries(Side::left) && !carries(Side::right);
    hop = hops ? hop + 1 : 0;
    longest = std::max(longest, hop);
  }
  return seconds(longest);
}

struct Answered {
  HitQuery query;
  Tick hit = 0;
  bool done = false, stays_up = false, falls = false, knocked_out = false, got_up = false;
  Seam into_clip, into_get_up, back_to_guard;
  double skate = 0;
  double drag = 0, sole = 0;  // m: along the floor, and in it
  double hop = 0;             // s: on no foot
  double off = -1;  // rad between the impulse and where the hips go; below 0 where they stay
  int answers = 0, steps = 0;
  double lifts = -1, lands = -1;  // s from the blow: the first step's foot; below 0 where none
};

// When the first foot of a body that stood on both is lifted, and when it is down again.
void first_step(const BodyModel& body, const FighterTrack& track, Tick hit, Answered& a) {
  constexpr float kStands = .012f, kOff = .025f;  // m: the lowest point of a sole that does, is not
  const auto low = [&](Tick t, Side side) {
    const Pose& pose = track.frames[static_cast<std::size_t>(t)];
    return sole_height(body, world_pose(body.skeleton, pose), side);
  };
  if (low(hit, Side::left) > kStands || low(hit, Side::right) > kStands) return;
  std::optional<Side> steps;
  for (Tick t = hit; t < static_cast<Tick>(track.frames.size()); ++t) {
    for (const Side side : {Side::left, Side::right}) {
      if (!steps && low(t, side) > kOff) {
        steps = side;
        a.lifts = seconds(t - hit);
      }
    }
    if (steps && low(t, *steps) < kStands) {
      a.lands = seconds(t - hit);
      return;
    }
  }
}

// Where one segment of a track gives way to the next: the tick of the first frame of the new one.
Answered answered(const MotionLibrary& library, const HitQuery& query) {
  Answered a;
  a.query = query;
  const auto answer = simulate_hit(library, query);
  if (!answer) return a;
  a.done = true;
  a.hit = answer->hit_tick;
  const FighterTrack& track = answer->timeline.tracks.front();
  const BodyModel& body = answer->bodies.front();
  const ImpactOutcome& outcome = answer->outcome;
  a.falls = outcome.response == ResponseKind::knockdown;
  a.stays_up = !a.falls;
  a.knocked_out = outcome.knockout;
  a.steps = outcome.steps;
  for (const Event& event : answer->timeline.events) {
    a.answers += event.type == EventType::response || event.type == EventType::knockdown ? 1 : 0;
  }
  constexpr Tick kSimulated = 18;
  // What is shown of a seam: until the difference has fallen to nothing (playback.h).
  constexpr Tick kBlend = 108, kShortBlend = 30;
  for (std::size_t i = 1; i < track.segments.size(); ++i) {
    const Segment& s = track.segments[i];
    const Tick start = s.launch.start;
    if (start < answer->hit_tick) continue;
    if (s.kind == Kind::response) {
      if (a.falls) continue;
      a.into_clip = seam_over(library, body, track, s.launch, start + kSimulated + 1,
                              start + kSimulated + kBlend);
      a.hop = longest_hop(library, body, track, s.launch, start + kSimulated);
    } else if (s.kind == Kind::get_up) {
      a.into_get_up = seam_over(library, body, track, s.launch, start, start + kBlend);
    } else {
      const Seam seam = seam_over(library, body, track, s.launch, start, start + kShortBlend);
      if (seam.apart > a.back_to_guard.apart) a.back_to_guard = seam;
    }
  }
  const float up = world_pose(body.skeleton, rest_pose(body.skeleton)).position[0].y;
  a.got_up = track.frames.back().hips.y > .75f * up;
  const auto from = static_cast<std::size_t>(answer->hit_tick);
  if (a.stays_up) {
    const auto simulated = std::min(from + kSimulated, track.frames.size() - 1);
    a.drag = longest_drag(body, track.frames, simulated);
    a.sole = deepest_sole(body, track.frames, simulated);
    a.skate =
        foot_skate_ratio(body.skeleton, std::span(track.frames).subspan(from), kTicksPerSecond);
  }
  const bool leg_struck = index(query.part) >= index(Part::left_thigh);
  if (outcome.response == ResponseKind::recovery_steps && !leg_struck) {
    first_step(body, track, answer->hit_tick, a);
  }
  constexpr Tick kGone = 48;  // 0.4 s: by then a step or a fall has gone somewhere
  const auto later = std::min(from + kGone, track.frames.size() - 1);
  const Vec3 went = track.frames[later].hips - track.frames[from].hips;
  const Vec3 ground{went.x, 0, went.z};
  constexpr float kLeast = .10f;  // m: less has no direction
  if (outcome.response != ResponseKind::absorb && glm::length(ground) > kLeast) {
    a.off = static_cast<double>(
        std::abs(wrapped_angle(yaw_of(ground) - yaw_of(answer->input.blow.impulse))));
  }
  return a;
}

std::vector<Answered> answers_of(const HitsAsked& asked, const char* purpose, float least,
                                 float most) {
  std::vector<Answered> all(static_cast<std::size_t>(asked.settings.count));
  run_tasks(all.size(), asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    all[i] = answered(
        asked.library,
        random_query(asked.library, derived_seed(asked.settings.seed, purpose, i), least, most));
  });
  std::erase_if(all, [](const Answered& a) { return !a.done; });
  return all;
}

// Percent; nothing of nothing.
std::optional<double> share(std::size_t part, std::size_t all) {
  if (all == 0) return std::nullopt;
  return 100 * static_cast<double>(part) / static_cast<double>(all);
}

std::optional<double> quantile_of(const std::vector<double>& values, double share) {
  if (values.empty()) return std::nullopt;
  return quantile(values, share);
}

// How the shown body differs from the undisturbed one after the hit.
double onset_seconds(const MotionLibrary& library, const HitQuery& query) {
  const auto hit = simulate_hit(library, query);
  HitQuery none = query;
  none.impulse = {};
  const auto calm = simulate_hit(library, none);
  if (!hit || !calm) return 0;
  const Skeleton& skeleton = hit->bodies.front().skeleton;
  const auto& a = hit->timeline.tracks.front().frames;
  const auto& b = calm->timeline.tracks.front().frames;
  const std::size_t j = index(joint_of(query.part));
  for (auto t = static_cast<std::size_t>(hit->hit_tick); t < std::min(a.size(), b.size()); ++t) {
    const Vec3 p = world_pose(skeleton, a[t]).position[j],
               q = world_pose(skeleton, b[t]).position[j];
    const Vec3 tip{0, .1f, 0};  // a turn shows, too
    const Vec3 p1 = world_pose(skeleton, a[t]).rotation[j] * tip,
               q1 = world_pose(skeleton, b[t]).rotation[j] * tip;
    if (glm::distance(p, q) + glm::distance(p1, q1) > .001f) {
      return seconds(static_cast<Tick>(t) - hit->hit_tick);
    }
  }
  return 9;
}

void seen_rows(const HitsAsked& asked, const std::vector<Answered>& all, HitRows& rows) {
  rows.group("V4 what people see");
  double latest = 0;
  for (const Part part : {Part::head, Part::chest, Part::abdomen, Part::left_thigh}) {
    for (const float way : {0.0f, kPi / 2, kPi}) {
      HitQuery query;
      query.at_s = .1;
      query.part = part;
      query.impulse = 20.0f * (yaw_rotation(way) * kForward);
      latest = std::max(latest, onset_seconds(asked.library, query));
    }
  }
  rows.held("onset, latest of 12 hits of 20 N s", "ms", 1000 * latest, "one frame of 60 Hz",
            at_most(17));
  std::vector<double> off;
  std::size_t within = 0;
  for (const Answered& a : all) {
    if (a.off < 0) continue;
    off.push_back(static_cast<double>(degrees(static_cast<float>(a.off))));
    within += off.back() <= 30 ? 1 : 0;
  }
  rows.held(fmt::format("hips go within 30 degrees of the impulse in 0.4 s, {} steps and falls",
                        off.size()),
            "%", share(within, off.size()), "a wrong one is accepted less", at_least(90));
  rows.said("hips off the impulse, median", "deg", quantile_of(off, .5), "");
}

// Of all hits that are answered by steps.
void count_rows(const std::vector<Answered>& all, HitRows& rows) {
  rows.group("V2 recovery steps");
  std::size_t recoveries = 0, two = 0;
  for (const Answered& a : all) {
    recoveries += a.steps > 0 ? 1 : 0;
    two += a.steps > 0 && a.steps <= 2 ? 1 : 0;
  }
  if (recoveries == 0) return;
  rows.held(fmt::format("{} recoveries: two steps at most", recoveries), "%",
            share(two, recoveries), "back within two steps", at_least(90));
}

// Of a blow above the legs on a body that stands on both feet, until the shown foot lifts and is
// down again.
void step_rows(const std::vector<Answered>& all, HitRows& rows) {
  rows.group("V2 first recovery step, as shown");
  std::vector<double> lifts, lands;
  for (const Answered& a : all) {
    if (a.lands < 0) continue;
    lifts.push_back(a.lifts);
    lands.push_back(a.lands);
  }
  if (lifts.empty()) return;
  rows.held(fmt::format("lifts off, mean of {} (sd {:.2g})", lifts.size(), deviation(lifts)), "s",
            mean(lifts), "0.337 +- 0.088", {.2, .35});
  rows.held(fmt::format("lands, mean of {} (sd {:.2g})", lands.size(), deviation(lands)), "s",
            mean(lands), "0.637 +- 0.099", {.35, .65});
}

// The command that shows a hit.
std::string hit_command(const HitQuery& query) {
  return fmt::format("ringcraft hit --pose {}@{} --part {} --impulse={},{},{} --tone {}",
                     query.action, query.at_s, name_of(query.part), query.impulse.x,
                     query.impulse.y, query.impulse.z, query.tone);
}

// Which hits to look at: those with the largest `badness`, each with what is `told` of it.
template <class Badness, class Told>
void say_worst(const StudyRun& run, std::vector<const Answered*> all, Badness badness, Told told) {
  constexpr std::size_t kShown = 5;
  const std::size_t shown = std::min(kShown, all.size());
  std::partial_sort(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), all.end(),
      [&](const Answered* a, const Answered* b) { return badness(*a) > badness(*b); });
  for (std::size_t i = 0; i < shown && badness(*all[i]) > 0; ++i) {
    run.say(fmt::format("{}: {}", told(*all[i]), hit_command(all[i]->query)));
  }
}

void seam_rows(const HitsAsked& asked, const std::vector<Answered>& all, HitRows& rows) {
  const auto worst = [&](const std::string& name, auto field, auto wanted) {
    std::vector<double> velocity, apart;
    std::vector<const Answered*> looked_at;
    for (const Answered& a : all) {
      if (!wanted(a)) continue;
      looked_at.push_back(&a);
      velocity.push_back((a.*field).velocity);
      apart.push_back((a.*field).apart);
    }
    if (velocity.empty()) return;
    rows.held(fmt::format("pop {}: velocity jump, worst of {} (median {:.2f})", name,
                          velocity.size(), quantile(velocity, .5)),
              "m/s", quantile(velocity, 1), "real captures 2.0-2.7", at_most(1.5));
    rows.said(fmt::format("pop {}: seams under 1.5 m/s", name), "%",
              share(static_cast<std::size_t>(std::count_if(velocity.begin(), velocity.end(),
                                                           [](double v) { return v <= 1.5; })),
                    velocity.size()),
              "");
    rows.held(fmt::format("pop {}: joint jump beyond its motion, worst", name), "m",
              quantile(apart, 1), "", at_most(.025));
    say_worst(
        asked.run, std::move(looked_at), [&](const Answered& a) { return (a.*field).velocity; },
        [&](const Answered& a) {
          const Seam& seam = a.*field;
          return fmt::format("{}: {:.2f} m/s, {} {:.2f} s after", name, seam.velocity,
                             vrm_name(seam.joint), seconds(seam.tick - a.hit));
        });
  };
  worst("simulation to clip", &Answered::into_clip, [](const Answered& a) { return a.stays_up; });
  worst("fall to get-up", &Answered::into_get_up,
        [](const Answered& a) { return a.falls && !a.knocked_out; });
  worst("answer to guard", &Answered::back_to_guard, [](const Answered&) { return true; });
}

void failure_rows(const HitsAsked& asked, const std::vector<Answered>& all, HitRows& rows) {
  rows.group("V7 what game makers report wrong");
  std::vector<double> skate, drag, sole, hop;
  std::vector<const Answered*> stood;
  std::size_t once = 0, falls = 0, up = 0;
  for (const Answered& a : all) {
    if (a.stays_up) {
      skate.push_back(a.skate);
      drag.push_back(a.drag);
      sole.push_back(a.sole);
      hop.push_back(a.hop);
      stood.push_back(&a);
    }
    once += a.answers == 1 ? 1 : 0;
    falls += a.falls && !a.knocked_out ? 1 : 0;
    up += a.falls && !a.knocked_out && a.got_up ? 1 : 0;
  }
  rows.held(fmt::format("feet slide under a body that stays up, worst of {}", skate.size()), "",
            quantile_of(skate, 1), "0.000-0.005 real boxing", at_most(.02));
  say_worst(
      asked.run, std::move(stood), [](const Answered& a) { return a.skate; },
      [](const Answered& a) { return fmt::format("feet slide, {:.3f}", a.skate); });
  if (!drag.empty()) {
    const auto far = std::count_if(drag.begin(), drag.end(), [](double way) { return way > .25; });
    rows.said("a foot drawn along the floor for over 25 cm", "%",
              share(static_cast<std::size_t>(far), drag.size()), "");
    rows.said("the same, longest way", "m", quantile(drag, 1), "");
    const auto deep = std::count_if(sole.begin(), sole.end(), [](double in) { return in > .03; });
    rows.said("a sole deeper than 3 cm in the floor after the simulation", "%",
              share(static_cast<std::size_t>(deep), sole.size()), "");
    rows.said("the same, deepest", "m", quantile(sole, 1), "");
    const auto long_hop = std::count_if(hop.begin(), hop.end(), [](double t) { return t > .15; });
    rows.said("neither foot carries for over 0.15 s where one of the clip's does", "%",
              share(static_cast<std::size_t>(long_hop), hop.size()), "");
    rows.said("the same, longest time", "s", quantile(hop, 1), "");
  }
  rows.held("hits with exactly one answer", "%", share(once, all.size()), "", at_least(100));
  if (falls > 0) {
    rows.held(fmt::format("{} falls: stands after one get-up", falls), "%", share(up, falls), "",
              at_least(100));
  }
  seam_rows(asked, all, rows);

  const BodyModel body = make_body({});
  const std::array<Pose, 3> stances{square_stance(body), fighting_stance(body),
                                    mirrored(fighting_stance(body))};
  int tapped = 0, taps = 0, toppled = 0, sweeps = 0;
  for (const Pose& pose : stances) {
    for (std::size_t part = 0; part < kPartCount; ++part) {
      for (int d = 0; d < 8; ++d) {
        const float way = static_cast<float>(d) * kPi / 4;
        tapped +=
            severity(impulse_step(body, StillHit(body, pose, part_at(part), way, 5).input)) > 0 ? 1
                                                                                                : 0;
        ++taps;
      }
    }
  }
  rows.held(fmt::format("taps of 5 N s that are not absorbed, of {}", taps), "",
            static_cast<double>(tapped), "", at_most(0));
  // The leg that carries, swept across from under the body; and the only one that stands.
  int crossed = 0;
  for (const float way : {kPi / 2, -kPi / 2, kPi, 0.0f}) {
    StillHit hit(body, fighting_stance(body), Part::left_shin, way, 72);
    const bool falls = severity(impulse_step(body, hit.input)) == 4;
    crossed += falls && std::abs(std::abs(way) - kPi / 2) < .01f ? 1 : 0;
    hit.input.contacts = {true, false};
    toppled += severity(impulse_step(body, hit.input)) == 4 ? 1 : 0;
    ++sweeps;
  }
  rows.held("sweeps across of the lead leg, 72 N s, that topple, of 2", "",
            static_cast<double>(crossed), "", at_least(2));
  rows.held(fmt::format("sweeps of the only standing leg that topple, of {}", sweeps), "",
            static_cast<double>(toppled), "", at_least(sweeps));
}

}  // namespace

void answer_rows(const HitsAsked& asked, HitRows& rows) {
  const std::vector<Answered> all = answers_of(asked, "answers", 10, 150);
  seen_rows(asked, all, rows);
  count_rows(all, rows);
  step_rows(all, rows);
  failure_rows(asked, all, rows);
  asked.run.say("answers looked at");
}

}  // namespace ringcraft
