#include "scene/answer.h"

#include "physics/response.h"

namespace ringcraft {

namespace {

// Ticks of simulation before the clip is in charge, where the body keeps its feet: inside the 150
// ms after which viewers doubt a reaction (validation table V4).
constexpr Tick kSimulatedTicks = 18;

}  // namespace

Answer answer_to(const MotionLibrary& library, const BodyModel& body, const Launch& cut, Tick now,
                 const ImpactInput& input, const ImpactOutcome& outcome) {
  const float facing = root_at(library, cut, now, body.scale).yaw;
  const Stance stance = library.action(cut.action).stance;
  const ActionId response = choose_response(library, outcome, facing, stance);
  Answer answer;
  answer.launch = forced_response(library, cut, response, now, body.scale);
  const bool falls = outcome.response == ResponseKind::knockdown;
  const Tick ticks = falls ? answer.launch.end - now : kSimulatedTicks;
  std::vector<Pose> target;
  for (Tick t = 0; t <= ticks; ++t) {
    target.push_back(pose_at(library, answer.launch, now + t, body.scale));
  }
  answer.simulated = simulate_response(body, input, outcome, target, ticks,
                                       lying_poses(library, body.skeleton, stance));
  return answer;
}

Launch get_up_from(const MotionLibrary& library, const BodyModel& body, const Launch& fallen,
                   Tick now, const Pose& shown) {
  const ActionId action =
      choose_get_up(library, body.skeleton, shown, library.action(fallen.action).stance);
  Launch launch = forced_get_up(library, fallen, action, now, body.scale);
  launch.placement = aligned(body.skeleton, shown, library.action(action).clip).placement;
  return launch;
}

}  // namespace ringcraft
