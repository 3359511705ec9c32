#pragma once
// Partial responses: an absorbed blow is answered by as much of its clip as the blow moves the
// body, recovery steps are as long as it takes to catch it.

#include <span>
#include <vector>

#include "motion/library.h"
#include "physics/impact.h"

namespace ringcraft {

// How the hips of who absorbs a blow give to it and come back over the feet: a critically damped
// spring that was struck, farthest 0.2 s after the blow.
struct Sway {
  Vec3 far{};  // world, over the ground, m
  Vec3 at(Tick after_blow) const;
};

// What a body shows of a blow that it absorbs.
struct Absorbed {
  // 0..1, of the response's clip: how far the blow moves the simulated body against how far the
  // clip moves one. Zero impulse has none of it, 1 where the body goes as far as the clip does.
  // Both are the largest way of what the blow moves: a knee where it meets a leg, else head, face,
  // chest or hips.
  float share = 0;
  Sway sway;  // as far as the blow moves the simulated hips and the share of the clip does not
};

// `clip`: the response's poses, world, one a tick from the contact on. The simulated body is the
// one that tracks `rest`, with the blow and without it.
Absorbed absorbed(const BodyModel& body, const ImpactInput& input, const ImpactOutcome& outcome,
                  const Pose& rest, std::span<const Pose> clip);

// The pose with its hips moved over the ground by `offset`, m, and its feet where they are: the
// hips sink rather than straighten a leg.
Pose swayed(const Skeleton& skeleton, const Pose& pose, Vec3 offset);

// Takes a pose of an absorbing response's first frame to what its shares are measured from: the
// same hips and legs, the rest of the body in the library's guard. As it is where there is no
// guard.
void put_in_guard(const MotionLibrary& library, const Action& response, Pose& pose);

// How far a clip moves what a blow to the zone moves, m: the largest way, from `rest` on, of a knee
// for a leg, else of head, face, chest or hips. One space, one scale.
float way_of_clip(const Skeleton& skeleton, const Pose& rest, std::span<const Pose> clip,
                  TargetZone zone);

// How far the body has still to go from each pose of the clip to its last one, m: the largest way
// of head, face, chest, hips and feet.
std::vector<float> way_left(const Skeleton& skeleton, std::span<const Pose> clip);

// The tick of a response, from the contact on, from which a body that shows `share` of its clip and
// stays up may act again: it had time to choose, and what is left of its way is less than 3 cm.
// `left`: way_left of the whole clip.
Tick free_again(std::span<const float> left, float share);

// How far a recovery's clip takes the hips over the ground, m: shown in part, which would not leave
// the floor if it were less, and as a whole. A clip that does not end in the stance in which it
// begins is only shown as a whole: a part of it would end in no stance.
struct Strides {
  float shortest = 0, longest = 0;
};
Strides strides_of(const Skeleton& skeleton, const Clip& clip, float scale);

// The share 0..1 of a recovery's clip that answers the blow: how far the feet have to go
// (stride_to_catch, physics/balance.h) against how far they go in the clip.
float share_of_steps(const BodyModel& body, const ImpactOutcome& outcome, const Strides& strides);

// Absorbed::share as an impulse step tells it, 100 ms on, without a second simulation; the
// body's own way off its action counts as well. `way_of_clip`: for the zone that was struck.
float share_foreseen(const ImpactOutcome& outcome, float way_of_clip);

// The pose that lies `share` of the way from `rest` to `pose`; ankles and the turns of feet go that
// share of their own way, so that what stands in both stands.
Pose partial_pose(const Skeleton& skeleton, const Pose& rest, const Pose& pose, float share);

}  // namespace ringcraft
