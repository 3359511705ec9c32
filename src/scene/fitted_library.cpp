#include "scene/fitted_library.h"

#include <algorithm>

#include "motion/strike_fit.h"
#include "physics/body.h"
#include "scene/library_check.h"
#include "scene/library_check_gates.h"

namespace ringcraft {

namespace {

constexpr float kTolerance = radians(2.5f);  // under what library check takes for a fault

void keep_in_ranges(const BodyModel& body, Clip& clip) {
  for (std::size_t i = 1; i + 1 < clip.frames.size(); ++i) {
    if (limit_violations(body, clip.frames[i], kTolerance).empty()) continue;
    clip.frames[i] = within_limits(body, clip.frames[i], kTolerance, clip.frames[i - 1]);
  }
  unroll_rotations(clip);
}

// Whether every blow that has an aim still meets it, and the body does what a body can.
bool can_be_thrown(const BodyModel& body, const Action& action) {
  const bool meets = std::all_of(
      action.strikes.begin(), action.strikes.end(),
      [](const Strike& strike) { return strike.aim.empty() || strike.farthest > strike.nearest; });
  if (!meets) return false;
  const ActionMeasures m = measure_action(body, action);
  return m.limit_violations == 0 && m.foot_skate <= kMostFootSkate &&
         (!m.authored || m.self_penetration_m <= kMostSelfPenetration);
}

}  // namespace

MotionLibrary fitted_library(const MotionLibrary& library, float ratio) {
  const MotionLibrary fit = fitted(library, ratio);
  const Pose* guard = standing_guard(library);
  BodySpec spec;
  spec.height = kCanonicalHeight;
  const BodyModel body = make_body(spec);
  std::vector<Action> actions = fit.actions();
  for (Action& action : actions) {
    if (!action.attacks() || guard == nullptr) continue;
    keep_in_ranges(body, action.clip);
    find_reaches(library.skeleton(), *guard, ratio, action);
    action.left_out = !can_be_thrown(body, action);
  }
  return fit.with(std::move(actions));
}

}  // namespace ringcraft
