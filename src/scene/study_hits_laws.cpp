// The laws that hits obey, and robustness over many random ones.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/quantile.h"
#include "base/random.h"
#include "base/tasks.h"
#include "physics/ragdoll.h"
#include "physics/stances.h"
#include "physics/trial.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {

namespace {

constexpr std::array<Part, 6> kStruckParts{Part::head,      Part::chest,
                                           Part::pelvis,    Part::left_thigh,
                                           Part::left_shin, Part::right_upper_arm};

// Any moment of any action that a fighter may choose.
HitQuery random_moment(const MotionLibrary& library, Random& random) {
  const auto& launchable = library.launchable();
  const Action& action = library.action(
      launchable[static_cast<std::size_t>(random.below(static_cast<int>(launchable.size())))]);
  HitQuery query;
  query.action = action.name;
  query.at_s = static_cast<double>(random.uniform()) * seconds(action.length());
  return query;
}

void free_flight_row(const BodyModel& body, const Pose& pose, HitRows& rows) {
  double worst = 0;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    for (const float way : {0.0f, 1.1f, 2.9f}) {
      const StillHit hit(body, pose, part_at(i), way, 30);
      const Vec3 gained = change_in_free_flight(body, hit.input) * body.spec.mass;
      worst =
          std::max(worst, static_cast<double>(glm::distance(gained, hit.input.blow.impulse)) / 30);
    }
  }
  rows.held("momentum gained in free flight off that given, worst", "%", 100 * worst, "0",
            at_most(1));
}

void mirror_row(const HitsAsked& asked, const BodyModel& body, const Pose& pose, HitRows& rows) {
  int unlike = 0;
  for (int i = 0; i < asked.settings.count; ++i) {
    Random random(derived_seed(asked.settings.seed, "mirror", static_cast<std::uint64_t>(i)));
    const Part part = part_at(static_cast<std::size_t>(random.below(kPartCount)));
    const float way = random.uniform(-kPi, kPi), impulse = random.uniform(5, 120);
    const ImpactOutcome a = impulse_step(body, StillHit(body, pose, part, way, impulse).input);
    const ImpactOutcome b =
        impulse_step(body, StillHit(body, mirrored(pose), mirrored(part), -way, impulse).input);
    const bool same = a.response == b.response && a.steps == b.steps && a.knockout == b.knockout &&
                      std::abs(a.margin - b.margin) < 1e-4f &&
                      std::abs(wrapped_angle(a.direction + b.direction)) < 1e-3f;
    unlike += same ? 0 : 1;
  }
  rows.held(fmt::format("mirrored hits with another answer, of {}", asked.settings.count), "",
            unlike, "0", at_most(0));
}

void step_size_rows(const BodyModel& body, const Pose& pose, HitRows& rows) {
  const StillHit hit(body, pose, Part::chest, kPi, 30);
  const auto finest = parts_after(body, hit.input, 1.0f / 3840);
  std::optional<double> last;  // of the step twice as long
  for (const float rate : {120.0f, 240.0f, 480.0f, 960.0f}) {
    double off = 0;
    const auto parts = parts_after(body, hit.input, 1 / rate);
    for (std::size_t i = 0; i < kPartCount; ++i) {
      off += static_cast<double>(glm::distance(parts[i], finest[i])) / kPartCount;
    }
    const std::string what =
        fmt::format("parts after 100 ms at {:.0f} Hz, mean distance to 3840 Hz", rate);
    if (last) {
      rows.held(what, "mm", 1000 * off, "less than at half the rate", at_most(1000 * *last));
    } else {
      rows.said(what, "mm", 1000 * off, "");
    }
    last = off;
  }
}

// Of a ladder of impulses, the rungs on which a harder hit is answered by less.
void ladder_row(const HitsAsked& asked, const BodyModel& body, HitRows& rows) {
  const std::array<Pose, 2> stances{square_stance(body), fighting_stance(body)};
  std::vector<int> less(kStruckParts.size() * stances.size() * 8);
  std::vector<std::string> where(less.size());
  run_tasks(less.size(), asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    const Part part = kStruckParts[i / 16];
    const Pose& pose = stances[i / 8 % 2];
    const float way = static_cast<float>(i % 8) * kPi / 4 + .01f;
    int highest = 0;
    for (float impulse = 0; impulse <= 160; impulse += 8) {
      const int now = severity(impulse_step(body, StillHit(body, pose, part, way, impulse).input));
      if (now < highest) {
        ++less[i];
        if (where[i].empty()) {
          where[i] = fmt::format("{} {} {:.0f} deg at {} N s: {} after {}", name_of(part),
                                 i / 8 % 2 == 0 ? "square" : "fighting", degrees(way), impulse, now,
                                 highest);
        }
      }
      highest = std::max(highest, now);
    }
  });
  int sum = 0;
  std::string first;
  for (std::size_t i = 0; i < less.size(); ++i) {
    sum += less[i];
    if (first.empty()) first = where[i];
  }
  rows.held(fmt::format("harder hits answered by less, of {}", less.size() * 20), "", sum,
            first.empty() ? "0" : "0; " + first, at_most(0));
}

// In mid-action, where the action itself may carry the body out of its base.
void no_blow_row(const HitsAsked& asked, HitRows& rows) {
  std::vector<int> answered(static_cast<std::size_t>(asked.settings.count));
  std::vector<std::string> where(answered.size());
  run_tasks(answered.size(), asked.run.threads, [&](std::size_t i) {
    if (asked.run.stopped()) return;
    Random random(derived_seed(asked.settings.seed, "no blow", i));
    const HitQuery query = random_moment(asked.library, random);
    const auto posed = posed_body(asked.library, query);
    if (!posed) return;
    const float tone = random.uniform(.5f, 1);
    for (const Part part : kStruckParts) {
      if (severity(impulse_step(posed->body, with_impulse(*posed, part, {}, tone))) == 0) continue;
      ++answered[i];
      where[i] = fmt::format("{}@{} {}", query.action, query.at_s, name_of(part));
    }
  });
  int sum = 0;
  std::string first;
  for (std::size_t i = 0; i < answered.size(); ++i) {
    sum += answered[i];
    if (first.empty()) first = where[i];
  }
  rows.held(fmt::format("zero impulse in mid-action: answers other than absorb, of {}",
                        answered.size() * kStruckParts.size()),
            "", sum, first.empty() ? "0" : "0; " + first, at_most(0));
}

struct Ran {
  bool broken = false;  // not a number, or a part faster than 60 m/s, or metres away
  double beyond = 0;    // deg: the worst joint's excess
  double under = 0;     // m: the deepest part under the ground
};

Ran random_run(const HitsAsked& asked, std::size_t i) {
  Random random(derived_seed(asked.settings.seed, "robust", i));
  const BodySpec spec{"random", random.uniform(1.5f, 2.1f), random.uniform(50, 130),
                      i % 3 ? Sex::male : Sex::female};
  HitQuery query = random_moment(asked.library, random);
  query.body = spec;
  const auto posed = posed_body(asked.library, query);
  Ran ran;
  if (!posed) return ran;
  const float way = random.uniform(-kPi, kPi), size = random.uniform(0, 300);
  const auto part = part_at(static_cast<std::size_t>(random.below(kPartCount)));
  ImpactInput input = with_impulse(
      *posed, part, size * Vec3{std::sin(way), random.uniform(-.4f, .4f), std::cos(way)},
      random.uniform(0, 1));
  input.blow.effective_mass = random.uniform(1, 12);
  const ImpactOutcome outcome = impulse_step(posed->body, input);
  const bool falls = outcome.response == ResponseKind::knockdown;
  const auto poses = simulate_response(posed->body, input, outcome, {}, falls ? 240 : 18);
  WorldPose last = world_pose(posed->body.skeleton, input.pose);
  for (const Pose& pose : poses) {
    const WorldPose world = world_pose(posed->body.skeleton, pose);
    const float far = glm::distance(pose.hips, input.pose.hips);
    const float fast = largest_joint_distance(world, last) * kTicksPerSecond;
    if (!std::isfinite(far + fast) || far > 8 || fast > 60) ran.broken = true;
    for (const Capsule& c : capsules(posed->body, world)) {
      ran.under = std::max(ran.under, static_cast<double>(c.radius - std::min(c.a.y, c.b.y)));
    }
    for (const LimitViolation& v : limit_violations(posed->body, pose, 0)) {
      ran.beyond = std::max(ran.beyond, static_cast<double>(degrees(v.excess)));
    }
    last = world;
  }
  return ran;
}

}  // namespace

void law_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("laws");
  const BodyModel body = make_body({});
  const Pose pose = fighting_stance(body);
  double spin = 0, speed = 0;
  int answered = 0;
  for (const Part part : kStruckParts) {
    const ImpactOutcome o = impulse_step(body, StillHit(body, pose, part, 0, 0).input);
    answered += severity(o) > 0 ? 1 : 0;
    spin = std::max(spin, static_cast<double>(o.head_spin));
    speed = std::max(speed, static_cast<double>(glm::length(o.com_velocity)));
  }
  rows.held("zero impulse: answers other than absorb", "", answered, "0", at_most(0));
  rows.held("zero impulse: speed of the centre of mass after 100 ms", "m/s", speed, "0",
            at_most(.05));
  rows.held("zero impulse: head spin", "rad/s", spin, "0", at_most(.5));
  no_blow_row(asked, rows);
  free_flight_row(body, pose, rows);
  mirror_row(asked, body, pose, rows);
  step_size_rows(body, pose, rows);
  ladder_row(asked, body, rows);
  asked.run.say("laws tried");
}

void robustness_rows(const HitsAsked& asked, HitRows& rows) {
  rows.group("robustness");
  std::vector<Ran> all(static_cast<std::size_t>(asked.settings.count));
  run_tasks(all.size(), asked.run.threads, [&](std::size_t i) {
    if (!asked.run.stopped()) all[i] = random_run(asked, i);
  });
  std::vector<double> beyond, under;
  int broken = 0, left = 0;
  for (const Ran& ran : all) {
    broken += ran.broken ? 1 : 0;
    left += ran.under > .10 ? 1 : 0;
    beyond.push_back(ran.beyond);
    under.push_back(ran.under);
  }
  const std::string of = fmt::format("{} random hits, 0-300 N s, 50-130 kg, 1.5-2.1 m", all.size());
  rows.held(of + ": not a number, or exploded", "", broken, "0", at_most(0));
  rows.held("worst joint beyond its range, median of runs", "deg", quantile(beyond, .5), "",
            at_most(5));
  rows.held("worst joint beyond its range, 99 % of runs", "deg", quantile(beyond, .99), "",
            at_most(30));
  rows.held("deepest part under the ground, 99 % of runs", "m", quantile(under, .99), "",
            at_most(.04));
  rows.held("deepest part under the ground, worst", "m", quantile(under, 1), "", at_most(.10));
  rows.held("runs that leave the ground plane by 10 cm", "", left, "0", at_most(0));
  asked.run.say("random hits run");
}

}  // namespace ringcraft
