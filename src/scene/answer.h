#pragma once
// The answer to a hit as motion: the forced launch that physics chose, and the simulated poses that
// are shown before its clip takes over (Zordan 2005: a second, active simulation aimed at the
// clip).

#include <vector>

#include "fight/state.h"
#include "physics/partial.h"

namespace ringcraft {

// Whether the struck body falls already, or lies: a blow moves it, and it comes to rest again.
bool falls_already(const MotionLibrary& library, const BodyModel& body, const Launch& cut,
                   const ImpactInput& input);

// Whether it is on the way up, neither lying nor on its feet: it goes on with that where it absorbs
// the blow.
bool rises(const MotionLibrary& library, const BodyModel& body, const Launch& cut,
           const ImpactInput& input);

struct Answer {
  Launch launch;                // of the response action, from where the cut action stands
  std::vector<Pose> simulated;  // world, one a tick from launch.start + 1 on
  Sway sway;                    // of who absorbs the blow
};

// `cut`: the interrupted launch, at tick `now`.
Answer answer_to(const MotionLibrary& library, const BodyModel& body, const Launch& cut, Tick now,
                 const ImpactInput& input, const ImpactOutcome& outcome);

// What a partial response is measured from, world: the first pose of its clip with the trunk, the
// head and the arms of the guard. A captured clip may begin with the head turned away.
Pose rest_of(const MotionLibrary& library, const Launch& response, float scale);

// What is shown of a pose of an answer's clip: the share of its way from `rest`, swayed.
Pose part_of_answer(const Skeleton& skeleton, const Pose& rest, const Pose& clip, float share,
                    Vec3 sway);

// The get-up that starts nearest to the pose that is shown, placed on it.
Launch get_up_from(const MotionLibrary& library, const BodyModel& body, const Launch& fallen,
                   Tick now, const Pose& shown);

}  // namespace ringcraft
