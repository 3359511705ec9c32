#pragma once
// One hit on one body: a pose, an impulse or a blow of a placed attacker, the response, as numbers
// and as a timeline to look at.

#include <optional>
#include <string>
#include <vector>

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
  float tone = 1.0f;  // 0 limp .. 1 full; the action leaves as much of it as it does (tone_left)

  std::string strike;  // an attack instead of the impulse: its first blow meets the part, those
                       // that follow in a combination whatever they meet
  BodySpec attacker;   // who throws it
  std::optional<float>
      distance;  // m between the two roots at the hit; else where it does most work
};

// In numbers the first hit; the timeline has them all.
struct HitAnswer {
  ImpactInput input;              // without `continued`
  ImpactOutcome outcome;          // its direction is a world yaw; the fighter starts facing +Z
  std::string response;           // the action that answers; the interrupted one where a guard held
  Timeline timeline;              // the action, the hit, the response and the guard again
  std::vector<BodyModel> bodies;  // the struck one, then the attacker where there is one
  int hits = 0;                   // and blocks: 0 to begin with, more than 1 of a combination
  Tick hit_tick = 0;
  float at_s = 0;      // seconds into the interrupted action at the hit
  float distance = 0;  // m between the roots of the two; 0 without an attacker
};

// An unknown action, a time outside it, or a blow that cannot land is a usage error.
Result<HitAnswer> simulate_hit(const MotionLibrary& library, const HitQuery& query);

// A body on which many impulses can be tried.
struct PosedBody {
  BodyModel body;
  ImpactInput input;  // without blow and `continued`; the tone that the action leaves
  std::vector<Pose> continued;
  float facing = 0;  // rad: world yaw of its own fore
};
Result<PosedBody> posed_body(const MotionLibrary& library, const HitQuery& query);

// What an impulse on the middle of a part, on the side that it comes from, does to the posed body.
// `impulse` in the fighter's own axes, N s.
ImpactInput with_impulse(const PosedBody& posed, Part part, Vec3 impulse, float tone);

}  // namespace ringcraft
