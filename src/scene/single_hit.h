#pragma once
// One hit on one body: a pose, an impulse, the response, as numbers and as a timeline to look at.

#include <string>

#include "base/error.h"
#include "fight/timeline.h"
#include "physics/impact.h"

namespace ringcraft {

struct HitQuery {
  BodySpec body;
  std::string action = "idle_guard_bounce";  // the interrupted action
  double at_s = 0;                           // seconds into it
  Part part = Part::head;
  Vec3 impulse{};     // N s, in the fighter's own axes: x to its left, y up, z the way it faces
  float tone = 1.0f;  // 0 limp .. 1 full
};

struct HitAnswer {
  ImpactInput input;      // without `continued`
  ImpactOutcome outcome;  // its direction is a world yaw; the fighter faces +Z
  std::string response;   // the action that answers
  Timeline timeline;      // the action, the hit, the response and the guard again
  BodyModel body;
  Tick hit_tick = 0;
};

// An unknown action or a time outside it is a usage error.
Result<HitAnswer> simulate_hit(const MotionLibrary& library, const HitQuery& query);

}  // namespace ringcraft
