// What a blow costs.
#include <algorithm>
#include <cmath>

#include "physics/impact.h"
#include "physics/response.h"

namespace ringcraft {
namespace {

// Points per newton-second. One point is a third of a clean jab, 15 N s in the default library; its
// crosses and hooks of 21 N s cost about 5, a roundhouse of 45 to the body 7.5.
constexpr float kHead = .20f, kBody = .17f, kLeg = .125f;
constexpr float kBlocked = .35f;    // of what the passed-on impulse would cost
constexpr float kSlightest = 1.0f;  // N s: a touch costs nothing
constexpr float kPerSpin = .02f;    // points per rad/s of the head's spin: rotation hurts
constexpr float kKnockdown = 5, kKnockout = 25;  // points

}  // namespace

std::int32_t damage_of(const Blow& blow, const ImpactOutcome& outcome) {
  const TargetZone zone = zone_of(blow.part);
  const float rate = zone == TargetZone::head ? kHead : (zone == TargetZone::body ? kBody : kLeg);
  const float impulse = std::max(0.0f, glm::length(blow.impulse) - kSlightest);
  float points = rate * impulse;
  if (blow.blocked) {
    points *= kBlocked;
  } else if (zone == TargetZone::head) {
    points += kPerSpin * outcome.head_spin * std::min(1.0f, impulse / 10);
  }
  const bool felled = outcome.response == ResponseKind::knockdown &&
                      interrupts(blow.blocked, glm::length(blow.impulse), outcome);
  if (felled) {
    points += outcome.knockout ? kKnockout : kKnockdown;
  }
  return static_cast<std::int32_t>(std::lround(1000 * points));
}

}  // namespace ringcraft
