#include "scene/library_check_strikes.h"

#include <algorithm>
#include <cmath>

#include "motion/aim.h"
#include "motion/strike_fit.h"
#include "physics/contact.h"

namespace ringcraft {

namespace {

constexpr float kNear = 0.30f, kFar = 2.60f, kStep = 0.02f;  // m, distances that are tried
constexpr Tick kWindUp = 60;      // ticks before the peak in which a limb may start
constexpr Tick kStrokeEnds = 24;  // ticks after the peak in which a stroke ends
constexpr double kAimed = 0.03;   // m
constexpr double kStarts = 0.15;  // of the peak speed: slower is not under way yet

struct Motion {
  std::vector<WorldPose> world;
  std::vector<Vec3> tip, limb, limb_to_pelvis, tip_to_pelvis;
};

double speed(const std::vector<Vec3>& path, std::size_t i) {
  const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, path.size() - 1);
  return b > a ? glm::distance(path[b], path[a]) * kTicksPerSecond / static_cast<float>(b - a) : 0;
}

Motion motion_of(const Skeleton& skeleton, const Action& action, const Strike& strike) {
  Motion m;
  const Joint limb = tip_of(strike.joint);
  for (const Pose& pose : action.clip.frames) {
    m.world.push_back(world_pose(skeleton, pose));
    const WorldPose& world = m.world.back();
    m.tip.push_back(striking_point(strike, skeleton, world));
    m.limb.push_back(world.position[index(limb)]);
    m.limb_to_pelvis.push_back(m.limb.back() - world.position[0]);
    m.tip_to_pelvis.push_back(m.tip.back() - world.position[0]);
  }
  return m;
}

// The tick of the largest value within [from, to].
template <class Value>
std::size_t largest(std::size_t from, std::size_t to, Value value) {
  std::size_t best = from;
  for (std::size_t i = from; i <= to; ++i) {
    if (value(i) > value(best)) best = i;
  }
  return best;
}

void measure_chain(const Motion& m, const Strike& strike, std::size_t first, StrikeMeasures& out) {
  const auto count = m.world.size();
  const auto last = std::min<std::size_t>(static_cast<std::size_t>(strike.active_end), count - 2);
  const auto limb_speed = [&](std::size_t i) { return speed(m.limb_to_pelvis, i); };
  const auto begin = static_cast<std::size_t>(strike.active_begin);
  const std::size_t from = std::max<std::size_t>(first, begin > 24 ? begin - 24 : 1);
  const std::size_t peak = largest(from, last, limb_speed);
  const double most = limb_speed(peak);
  std::size_t start = peak;
  while (start > std::max<std::size_t>(first, 1) && peak - start < kWindUp &&
         limb_speed(start - 1) > kStarts * most) {
    --start;
  }
  const Vec3 way = normalized_or(m.limb_to_pelvis[peak + 1] - m.limb_to_pelvis[peak - 1], kForward);
  const std::size_t end =
      largest(peak, std::min<std::size_t>(peak + kStrokeEnds, count - 2),
              [&](std::size_t i) { return glm::dot(m.limb_to_pelvis[i], way); });
  if (end > start) {
    out.peak_fraction = static_cast<double>(peak - start) / static_cast<double>(end - start);
  }
  for (std::size_t i = start + 1; i <= end; ++i) {
    const double change = (limb_speed(i) - limb_speed(i - 1)) * kTicksPerSecond;
    if (i <= peak) out.push = std::max(out.push, change);
    if (i > peak) out.brake = std::max(out.brake, -change);
  }
  const auto rate = [&](std::size_t i, auto yaw) {
    return std::abs(wrapped_angle(yaw(m.world[i + 1]) - yaw(m.world[i - 1])));
  };
  const auto pelvis = [](const WorldPose& w) { return heading_of(w.rotation[0]); };
  const auto chest = [](const WorldPose& w) {
    const Vec3 line =
        w.position[index(Joint::left_upper_arm)] - w.position[index(Joint::right_upper_arm)];
    return yaw_of(Vec3(-line.z, 0, line.x));
  };
  const std::size_t chain_from = std::max<std::size_t>(first, peak > 36 ? peak - 36 : 1);
  const std::size_t at_pelvis =
      largest(chain_from, end, [&](std::size_t i) { return rate(i, pelvis); });
  const std::size_t at_chest =
      largest(chain_from, end, [&](std::size_t i) { return rate(i, chest); });
  const auto delay = [](std::size_t a, std::size_t b) {
    return (static_cast<double>(b) - static_cast<double>(a)) * kTickSeconds;
  };
  out.pelvis_to_chest_s = delay(at_pelvis, at_chest);
  out.chest_to_limb_s = delay(at_chest, peak);
  out.peak_to_pelvis =
      speed(m.tip_to_pelvis,
            largest(from, last, [&](std::size_t i) { return speed(m.tip_to_pelvis, i); }));
  out.peak_world =
      speed(m.tip, largest(from, last, [&](std::size_t i) { return speed(m.tip, i); }));
}

// The body that stands there: in the guard, `distance` away, looking back; its guard parts far off.
BodyCapsules standing(const BodyModel& body, const Pose& guard, float distance) {
  const Pose there = placed(scaled(guard, body.scale), {0, distance, kPi});
  BodyCapsules shapes = capsules(body, world_pose(body.skeleton, there));
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (!is_guard_part(part_at(i))) continue;
    shapes[i].a.y -= 100;
    shapes[i].b.y -= 100;
  }
  return shapes;
}

void measure_landing(const BodyModel& body, const BodyModel& opponent, const Pose& guard,
                     const Action& action, const Strike& strike, const Motion& m,
                     StrikeMeasures& out) {
  std::vector<BodyCapsules> own;
  for (Tick t = strike.active_begin; t <= std::min(strike.active_end, action.length()); ++t) {
    own.push_back(capsules(body, m.world[static_cast<std::size_t>(t)]));
  }
  for (float distance = kNear; distance < kFar; distance += kStep) {
    const BodyCapsules target = standing(opponent, guard, distance);
    for (std::size_t i = 1; i < own.size(); ++i) {
      const auto contact =
          strike_contact(SweptBody{own[i - 1], own[i]}, strike, SweptBody{target, target});
      if (!contact) continue;
      if (zone_of(contact->struck) != strike.zone) break;
      if (out.lands_to == 0) out.lands_from = distance;
      out.lands_to = distance;
      const std::size_t tick = static_cast<std::size_t>(strike.active_begin) + i;
      const double now = speed(m.tip, tick);
      if (distance >= out.aim_from && distance <= out.aim_to) {
        out.impact_aimed = std::max(out.impact_aimed, now);
      }
      if (now > out.impact) {
        out.impact = now;
        out.impact_at = distance;
        out.start_to_contact_s = seconds(static_cast<Tick>(tick));
      }
      break;
    }
  }
}

void measure_aim(const Pose& guard, float ratio, const Strike& strike, const Motion& m,
                 StrikeMeasures& out) {
  const AimPoint* point = aim_point(strike.aim);
  if (point == nullptr) return;
  const WorldPose there = world_pose(canonical_skeleton(), guard);
  const auto at = [&](float distance) -> double {
    return passes(strike, m.tip, opponent_aim(*point, there, ratio, distance));
  };
  out.aim_best_m = 1e9;
  for (float distance = kNear; distance < kFar; distance += 0.01f) {
    const double error = at(distance);
    out.aim_best_m = std::min(out.aim_best_m, error);
    if (error > kAimed) continue;
    if (out.aim_to == 0) out.aim_from = distance;
    out.aim_to = distance;
  }
  if (strike.farthest <= 0) return;
  for (float distance = strike.nearest; distance <= strike.farthest + 1e-4f; distance += 0.01f) {
    out.aim_worst_m = std::max(out.aim_worst_m, at(distance));
  }
}

}  // namespace

std::vector<StrikeMeasures> measure_strikes(const MotionLibrary& library, float ratio) {
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  spec.height *= ratio;
  const BodyModel opponent = make_body(spec);
  std::vector<StrikeMeasures> all;
  const Pose* guard = standing_guard(library);
  if (guard == nullptr) return all;
  for (const Action& action : library.actions()) {
    if (action.left_out) continue;
    std::size_t first = 1;
    for (std::size_t i = 0; i < action.strikes.size(); ++i) {
      const Strike& strike = action.strikes[i];
      StrikeMeasures out;
      out.action = action.name;
      out.number = i;
      out.strike = strike;
      out.authored = is_authored(action);
      const Motion m = motion_of(library.skeleton(), action, strike);
      measure_chain(m, strike, first, out);
      measure_aim(*guard, ratio, strike, m, out);
      measure_landing(body, opponent, *guard, action, strike, m, out);
      first = static_cast<std::size_t>(strike.active_begin);
      all.push_back(std::move(out));
    }
  }
  return all;
}

}  // namespace ringcraft
