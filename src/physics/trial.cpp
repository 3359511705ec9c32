#include "physics/trial.h"

#include <cmath>

#include "physics/impact_frame.h"
#include "physics/tone.h"

namespace ringcraft {

Standing simulate_standing(const BodyModel& body, const ImpactInput& input, float seconds) {
  const ImpactFrame frame(body, input);
  Ragdoll ragdoll(body, frame.pose(), frame.before(), kTickSeconds);
  ragdoll.set_tone(struck_tone(input.tone));
  strike(ragdoll, body, frame, 1);
  Balance balance(body, frame);
  const float height = ragdoll.center_of_mass().y;
  const int steps = static_cast<int>(std::lround(seconds / kRagdollStep));
  for (int k = 0; k < steps; ++k) {
    balance.guide(ragdoll, frame, k);
    ragdoll.step();
    if (ragdoll.center_of_mass().y < kFallen * height) {
      return {true};
    }
  }
  return {};
}

Vec3 change_in_free_flight(const BodyModel& body, const ImpactInput& input) {
  const ImpactFrame frame(body, input);
  Ragdoll ragdoll(body, frame.pose(), frame.before(), kTickSeconds,
                  {.gravity = false, .ground = false});
  ragdoll.set_tone(whole_body(0));
  const Vec3 before = ragdoll.center_of_mass_velocity();
  strike(ragdoll, body, frame, 1);
  for (int k = 0; k < 24; ++k) ragdoll.step();
  ImpactOutcome turned;  // back into the world
  turned.com_velocity = ragdoll.center_of_mass_velocity() - before;
  return frame.out(turned).com_velocity;
}

std::array<Vec3, kPartCount> parts_after(const BodyModel& body, const ImpactInput& input,
                                         float step) {
  const ImpactFrame frame(body, input);
  Ragdoll ragdoll(body, frame.pose(), frame.before(), kTickSeconds, {.step = step});
  ragdoll.set_tone(struck_tone(input.tone));
  strike(ragdoll, body, frame, 1);
  Balance balance(body, frame);
  const int steps = static_cast<int>(std::lround(.1f / step));
  for (int k = 0; k < steps; ++k) {
    const float tick = static_cast<float>(k) * step / kTickSeconds;
    balance.guide(ragdoll, frame, static_cast<int>(2 * tick));
    ragdoll.step();
  }
  std::array<Vec3, kPartCount> at;
  for (std::size_t i = 0; i < kPartCount; ++i) at[i] = ragdoll.motion(part_at(i)).origin;
  return at;
}

float bare_loop(const BodyModel& body, const ImpactInput& input) {
  const ImpactFrame frame(body, input);
  Ragdoll ragdoll(body, frame.pose(), frame.before(), kTickSeconds);
  ragdoll.set_tone(struck_tone(input.tone));
  strike(ragdoll, body, frame, 1);
  for (int k = 0; k < 24; ++k) ragdoll.step();
  return ragdoll.center_of_mass().y;
}

}  // namespace ringcraft
