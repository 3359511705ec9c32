#include "scene/answer.h"

#include <algorithm>

#include "motion/decay.h"
#include "physics/partial.h"
#include "physics/response.h"

namespace ringcraft {

namespace {

// Ticks of simulation before the clip is in charge, where the body keeps its feet: inside the 150
// ms after which viewers doubt a reaction (docs/sources.md, V4).
constexpr Tick kSimulatedTicks = 18;
constexpr Tick kAhead = 9;  // of the clip, that the end of the simulation is eased with

// Moves a launch so that at `tick` its clip's hips are over the ground where the shown body's are.
void carry(const MotionLibrary& library, float scale, const Pose& shown, Tick tick,
           Launch& launch) {
  const Vec3 from = pose_at(library, launch, launch.start, scale).hips;
  const Vec3 clip = glm::mix(from, pose_at(library, launch, tick, scale).hips, launch.share);
  const Vec3 off = shown.hips - clip;
  launch.placement.x += off.x;
  launch.placement.z += off.z;
}

// How far the body has spun by the end of its simulation, where it would come to a stop, off the
// way that the clip faces there, beyond what is brought back.
float spun_away(const Pose& before, const Pose& shown, const Pose& clip) {
  const float heading = heading_of(shown.rotation[0]);
  const float spin = wrapped_angle(heading - heading_of(before.rotation[0])) / kTickSeconds;
  const float off = wrapped_angle(heading - heading_of(clip.rotation[0]));
  return not_brought_back(off + spin * kSpinCarries);
}

// The answer, begun `turned` rad from where the cut action would have it begin. Who is spun farther
// than an answer brings back is asked once more, for one that begins as far round.
Answer answer_turned(const MotionLibrary& library, const BodyModel& body, const Launch& cut,
                     Tick now, const ImpactInput& input, const ImpactOutcome& decided,
                     float turned) {
  const Stance stance = library.action(cut.action).stance;
  const float facing = wrapped_angle(answers_from(library, cut, now, body.scale).yaw + turned);
  ImpactOutcome outcome = decided;
  const bool down = falls_already(library, body, cut, input);
  if (down) outcome.response = ResponseKind::knockdown;
  const ActionId response = choose_response(library, body, outcome, facing, stance);
  Answer answer;
  answer.launch = forced_response(library, cut, response, now, body.scale);
  answer.launch.placement.yaw = facing;
  // Who steps goes from where it is, not from where the cut action stood, and so does who lies; who
  // keeps its feet where they are comes back over them.
  const bool steps = outcome.response == ResponseKind::recovery_steps;
  if (steps || down) carry(library, body.scale, input.pose, now, answer.launch);
  const bool falls = outcome.response == ResponseKind::knockdown;
  const Tick ticks = falls ? answer.launch.end - now : kSimulatedTicks;
  std::vector<Pose> target;
  const Tick clip = answer.launch.end - now;
  for (Tick t = 0; t <= std::max(clip, ticks + kAhead); ++t) {
    target.push_back(pose_at(library, answer.launch, now + t, body.scale));
  }
  const Pose rest = rest_of(library, answer.launch, body.scale);
  if (!falls) {
    const std::vector<float> left =
        way_left(body.skeleton, std::span(target).first(static_cast<std::size_t>(clip) + 1));
    const Clip& steps_of = library.action(response).clip;
    if (steps) {
      answer.launch.share =
          share_of_steps(body, outcome, strides_of(library.skeleton(), steps_of, body.scale));
    } else {
      const Absorbed shows = absorbed(body, input, outcome, rest, target);
      answer.launch.share = shows.share;
      answer.sway = shows.sway;
    }
    answer.launch.end = now + free_again(left, answer.launch.share);
  }
  target.resize(static_cast<std::size_t>(ticks + kAhead) + 1);
  for (std::size_t t = 0; t < target.size(); ++t) {
    target[t] = part_of_answer(body.skeleton, rest, target[t], answer.launch.share,
                               answer.sway.at(static_cast<Tick>(t)));
  }
  answer.simulated = simulate_response(body, input, outcome, target, ticks,
                                       lying_poses(library, body.skeleton, stance));
  if (!falls && turned == 0) {
    const auto end = answer.simulated.end();
    const float spun = spun_away(end[-2], end[-1], target[static_cast<std::size_t>(ticks)]);
    if (spun != 0) return answer_turned(library, body, cut, now, input, decided, spun);
  }
  if (steps) carry(library, body.scale, answer.simulated.back(), now + ticks, answer.launch);
  if (falls) answer.launch.end = now + static_cast<Tick>(answer.simulated.size());
  return answer;
}

}  // namespace

bool falls_already(const MotionLibrary& library, const BodyModel& body, const Launch& cut,
                   const ImpactInput& input) {
  return lies(body, input.pose) || library.action(cut.action).ends_lying != Lying::none;
}

bool rises(const MotionLibrary& library, const BodyModel& body, const Launch& cut,
           const ImpactInput& input) {
  return library.action(cut.action).kind == Kind::get_up && !lies(body, input.pose) &&
         !on_its_feet(body, input.pose);
}

Answer answer_to(const MotionLibrary& library, const BodyModel& body, const Launch& cut, Tick now,
                 const ImpactInput& input, const ImpactOutcome& outcome) {
  return answer_turned(library, body, cut, now, input, outcome, 0);
}

Pose part_of_answer(const Skeleton& skeleton, const Pose& rest, const Pose& clip, float share,
                    Vec3 sway) {
  Pose pose = share < 1 ? partial_pose(skeleton, rest, clip, share) : clip;
  return sway == Vec3{} ? pose : swayed(skeleton, pose, sway);
}

Pose rest_of(const MotionLibrary& library, const Launch& response, float scale) {
  Pose rest = pose_at(library, response, response.start, scale);
  put_in_guard(library, library.action(response.action), rest);
  return rest;
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
