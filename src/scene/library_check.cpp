#include "scene/library_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "motion/quality.h"
#include "motion/strike_fit.h"
#include "physics/body.h"
#include "physics/penetration.h"
#include "scene/library_check_gates.h"

namespace ringcraft {

namespace {

constexpr float kStill = 0.15f;  // m/s

double peak_speed(const Skeleton& skeleton, const Action& action) {
  double peak = 0;
  for (const Strike& strike : action.strikes) {
    Vec3 before{};
    for (std::size_t i = 0; i < action.clip.frames.size(); ++i) {
      const WorldPose world = world_pose(skeleton, action.clip.frames[i]);
      const Vec3 now = world.position[index(strike.joint)] - world.position[0];
      if (i > 0) peak = std::max<double>(peak, glm::distance(now, before) / kTickSeconds);
      before = now;
    }
  }
  return peak;
}

void measure_limits(const BodyModel& body, const Action& action, ActionMeasures& m) {
  for (const Pose& pose : action.clip.frames) {
    bool beyond = false;
    for (const LimitViolation& violation : limit_violations(body, pose, 0)) {
      const double excess = degrees(violation.excess);
      beyond = beyond || excess > kMostBeyondDegrees;
      if (excess <= m.worst_limit_deg) continue;
      m.worst_limit_deg = excess;
      m.worst_joint = fmt::format("{} by {:.0f} degrees", vrm_name(violation.joint), excess);
    }
    m.limit_violations += beyond ? 1u : 0u;
  }
}

// Pairs of parts that may come to lie on each other: neighbours in the body, and those that touch
// in the rest pose.
std::array<std::uint32_t, kPartCount> touching(const BodyModel& body) {
  std::array<std::uint32_t, kPartCount> pairs{};
  const auto join = [&](std::size_t a, std::size_t b) {
    pairs[a] |= 1u << b;
    pairs[b] |= 1u << a;
  };
  for (std::size_t i = 0; i < kPartCount; ++i) {
    join(i, i);
    const int parent = parent_of(part_at(i));
    if (parent < 0) continue;
    join(i, static_cast<std::size_t>(parent));
    const int before = parent_of(part_at(static_cast<std::size_t>(parent)));
    if (before >= 0) join(i, static_cast<std::size_t>(before));
    for (std::size_t k = 0; k < i; ++k) {
      if (parent_of(part_at(k)) == parent) join(i, k);
    }
  }
  const BodyCapsules rest = capsules(body, world_pose(body.skeleton, rest_pose(body.skeleton)));
  for (const Penetration& p : penetrations(rest, rest, 0)) join(index(p.a), index(p.b));
  return pairs;
}

void measure_self_penetration(const BodyModel& body, const Action& action, ActionMeasures& m) {
  const auto allowed = touching(body);
  std::vector<float>& depths = m.self_depths_m;
  depths.reserve(action.clip.frames.size());
  float most = 0;
  for (const Pose& pose : action.clip.frames) {
    const BodyCapsules shapes = capsules(body, world_pose(body.skeleton, pose));
    float depth = 0;
    for (const Penetration& p : penetrations(shapes, shapes, 0)) {
      if ((allowed[index(p.a)] >> index(p.b) & 1u) != 0) continue;
      depth = std::max(depth, p.depth);
      if (p.depth <= most) continue;
      most = p.depth;
      m.worst_pair = fmt::format("{} and {}", name_of(p.a), name_of(p.b));
    }
    depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  m.self_penetration_m = depths[depths.size() * 99 / 100];
}

double still_hands(const Skeleton& skeleton, const Action& action) {
  std::size_t still = 0;
  WorldPose before = world_pose(skeleton, action.clip.frames.front());
  for (std::size_t i = 1; i < action.clip.frames.size(); ++i) {
    const WorldPose now = world_pose(skeleton, action.clip.frames[i]);
    for (const Joint hand : {Joint::left_hand, Joint::right_hand}) {
      const float moved = glm::distance(now.position[index(hand)], before.position[index(hand)]);
      still += moved * kTicksPerSecond < kStill ? 1u : 0u;
    }
    before = now;
  }
  return static_cast<double>(still) / static_cast<double>(2 * action.clip.length());
}

double head_moves(const Skeleton& skeleton, const Action& action) {
  const auto head = [&](Tick t) {
    const WorldPose world = world_pose(skeleton, action.clip.at(t));
    return inverse(action.clip.root_at(t)) * world.position[index(Joint::head)];
  };
  const Vec3 start = head(0);
  double most = 0;
  for (Tick t = 0; t <= action.length(); ++t) {
    most = std::max<double>(most, glm::distance(head(t), start));
  }
  return most;
}

bool has_response(const MotionLibrary& library, ResponseKind kind, int steps) {
  return std::any_of(library.responses().begin(), library.responses().end(), [&](ActionId id) {
    const Response& response = *library.action(id).response;
    return response.kind == kind &&
           (kind != ResponseKind::recovery_steps || response.steps == steps);
  });
}

}  // namespace

ActionMeasures measure_action(const BodyModel& body, const Action& action) {
  const Skeleton& skeleton = body.skeleton;
  const Placement& end = action.clip.root_at(action.length());
  ActionMeasures m;
  m.name = action.name;
  m.kind = action.kind;
  m.authored = is_authored(action);
  m.steps_or_rises = action.ends_lying == Lying::none &&
                     (action.kind == Kind::transition || action.kind == Kind::response ||
                      action.kind == Kind::get_up);
  m.left_out = action.left_out;
  m.seconds = seconds(action.length());
  m.peak_speed_mps = peak_speed(skeleton, action);
  if (action.attacks()) m.strike_begin_s = seconds(action.strikes.front().active_begin);
  m.travel_m = glm::length(end.position());
  m.turn_rad = end.yaw;
  m.foot_skate = foot_skate_ratio(skeleton, action.clip.frames, kTicksPerSecond);
  m.own_jump_mps = own_jump(skeleton, action.clip);
  measure_limits(body, action, m);
  measure_self_penetration(body, action, m);
  m.still_hands = still_hands(skeleton, action);
  m.head_moves_m = head_moves(skeleton, action);
  m.may_lead_to = action.leads_to;
  m.source = action.source;
  return m;
}

std::vector<ActionMeasures> measure(const MotionLibrary& library) {
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  std::vector<ActionMeasures> all;
  all.reserve(library.actions().size() + library.switches().size());
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    all.push_back(measure_action(body, library.actions()[i]));
    all.back().leads_to = library.machine().edges(ActionId(i)).size();
  }
  for (const Action& action : library.switches()) all.push_back(measure_action(body, action));
  return all;
}

namespace {

void add_action_faults(const MotionLibrary& library, LibraryCheck& check) {
  for (const Action& action : library.actions()) {
    for (const std::string& fault : faults(action)) {
      check.faults.push_back(fmt::format("{}: broken clip: {}", action.name, fault));
    }
  }
  for (const Action& action : library.switches()) {
    for (const std::string& fault : faults(action)) {
      check.faults.push_back(fmt::format("{}: broken clip: {}", action.name, fault));
    }
  }
  for (const ActionMeasures& m : check.actions) {
    if (m.left_out) continue;
    if (m.limit_violations > 0) {
      check.faults.push_back(fmt::format("{}: joints beyond their range in {} frames, {}", m.name,
                                         m.limit_violations, m.worst_joint));
    }
    if (m.foot_skate > kMostFootSkate) {
      check.faults.push_back(fmt::format("{}: feet slide, ratio {:.3f}", m.name, m.foot_skate));
    }
    if (m.authored && m.steps_or_rises && m.own_jump_mps > kMostOwnJump) {
      check.faults.push_back(fmt::format(
          "{}: a joint jumps by {:.1f} m/s from one frame to the next", m.name, m.own_jump_mps));
    }
    if (m.authored && m.self_penetration_m > kMostSelfPenetration) {
      check.faults.push_back(fmt::format("{}: the body is {:.3f} m inside itself, {}", m.name,
                                         m.self_penetration_m, m.worst_pair));
    }
  }
  for (const StrikeMeasures& m : check.strikes) {
    if (m.authored && m.lands_to == 0) {
      check.faults.push_back(
          fmt::format("{}: strike {} meets its zone from nowhere", m.action, m.number + 1));
    }
    if (m.authored && (m.aim_best_m < 0 || m.strike.farthest <= 0)) {
      check.faults.push_back(fmt::format(
          "{}: strike {} does not say what it aims at, or from where", m.action, m.number + 1));
    }
    if (m.aim_worst_m > kMostAimError) {
      check.faults.push_back(fmt::format("{}: strike {} passes {:.3f} m from the {}", m.action,
                                         m.number + 1, m.aim_worst_m, m.strike.aim));
    }
  }
}

// A seam that jumps is a fault of the two actions that meet in it; the worst one out of each.
void add_seam_faults(const MotionLibrary& library, LibraryCheck& check) {
  std::vector<const SeamMeasures*> worst(library.actions().size(), nullptr);
  for (const SeamMeasures& seam : check.seams) {
    const SeamMeasures*& known = worst[seam.from.at()];
    if (seam.jump > kMostSeamJump && (known == nullptr || seam.jump > known->jump)) known = &seam;
  }
  for (const SeamMeasures* seam : worst) {
    if (seam == nullptr) continue;
    check.faults.push_back(
        fmt::format("{}: the seam to {} jumps, {} by {:.1f} m/s", library.action(seam->from).name,
                    library.action(seam->to).name, vrm_name(seam->joint), seam->jump));
  }
}

void add_kind_faults(const MotionLibrary& library, LibraryCheck& check) {
  if (!has_response(library, ResponseKind::absorb, 0))
    check.faults.emplace_back("no response that absorbs");
  for (int steps = 1; steps <= 3; ++steps) {
    if (!has_response(library, ResponseKind::recovery_steps, steps)) {
      check.faults.push_back(fmt::format("no response of {} recovery step(s)", steps));
    }
  }
  if (!has_response(library, ResponseKind::knockdown, 0)) check.faults.emplace_back("no knockdown");
  if (library.get_ups().empty()) check.faults.emplace_back("no get-up");
  if (library.count(Kind::idle) == 0) check.faults.emplace_back("no idle");
  for (const std::string& dropped : library.dropped())
    check.faults.push_back("dropped: " + dropped);
}

}  // namespace

LibraryCheck check_library(const MotionLibrary& library, std::optional<Yardstick> yardstick,
                           float ratio) {
  LibraryCheck check;
  check.actions = measure(library);
  check.strikes = measure_strikes(library, ratio);
  check.seams = measure_seams(library);
  check.yardstick = std::move(yardstick);
  add_action_faults(library, check);
  add_seam_faults(library, check);
  add_kind_faults(library, check);
  add_gates(check);
  for (const Gate& gate : check.gates) {
    if (gate.passed()) continue;
    check.faults.push_back(fmt::format("gate: {} is {:.3g} {}, asked {:g} to {:g}", gate.name,
                                       gate.value, gate.unit, gate.least, gate.most));
  }
  return check;
}

}  // namespace ringcraft
