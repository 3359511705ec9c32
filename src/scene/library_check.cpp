#include "scene/library_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "motion/quality.h"
#include "physics/body.h"

namespace ringcraft {

namespace {

constexpr float kLimitTolerance = radians(3);
constexpr double kMostFootSkate = 0.02;

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

std::size_t frames_beyond_limits(const BodyModel& body, const Action& action) {
  std::size_t count = 0;
  for (const Pose& pose : action.clip.frames) {
    count += limit_violations(body, pose, kLimitTolerance).empty() ? 0u : 1u;
  }
  return count;
}

bool has_response(const MotionLibrary& library, ResponseKind kind, int steps) {
  return std::any_of(library.responses().begin(), library.responses().end(), [&](ActionId id) {
    const Response& response = *library.action(id).response;
    return response.kind == kind &&
           (kind != ResponseKind::recovery_steps || response.steps == steps);
  });
}

}  // namespace

std::vector<ActionMeasures> measure(const MotionLibrary& library) {
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  std::vector<ActionMeasures> all;
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    const Action& action = library.actions()[i];
    const Placement& end = action.clip.root_at(action.length());
    ActionMeasures m;
    m.name = action.name;
    m.kind = action.kind;
    m.seconds = seconds(action.length());
    m.peak_speed_mps = peak_speed(library.skeleton(), action);
    if (action.attacks()) m.strike_begin_s = seconds(action.strikes.front().active_begin);
    m.travel_m = glm::length(end.position());
    m.turn_rad = end.yaw;
    m.foot_skate = foot_skate_ratio(library.skeleton(), action.clip.frames, kTicksPerSecond);
    m.limit_violations = frames_beyond_limits(body, action);
    m.leads_to = library.machine().edges(ActionId(i)).size();
    m.source = action.source;
    all.push_back(std::move(m));
  }
  return all;
}

std::vector<std::string> library_faults(const MotionLibrary& library) {
  std::vector<std::string> found;
  for (const Action& action : library.actions()) {
    for (const std::string& fault : faults(action.clip)) {
      found.push_back(fmt::format("{}: broken clip: {}", action.name, fault));
    }
  }
  for (const ActionMeasures& m : measure(library)) {
    if (m.limit_violations > 0) {
      found.push_back(
          fmt::format("{}: joints beyond their range in {} frames", m.name, m.limit_violations));
    }
    if (m.foot_skate > kMostFootSkate) {
      found.push_back(fmt::format("{}: feet slide, ratio {:.3f}", m.name, m.foot_skate));
    }
  }
  if (!has_response(library, ResponseKind::absorb, 0))
    found.emplace_back("no response that absorbs");
  for (int steps = 1; steps <= 3; ++steps) {
    if (!has_response(library, ResponseKind::recovery_steps, steps)) {
      found.push_back(fmt::format("no response of {} recovery step(s)", steps));
    }
  }
  if (!has_response(library, ResponseKind::knockdown, 0)) found.emplace_back("no knockdown");
  if (library.get_ups().empty()) found.emplace_back("no get-up");
  if (library.count(Kind::idle) == 0) found.emplace_back("no idle");
  for (const std::string& dropped : library.dropped()) found.push_back("dropped: " + dropped);
  return found;
}

}  // namespace ringcraft
