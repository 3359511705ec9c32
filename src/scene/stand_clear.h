#pragma once
// What who has nobody left to fight does: it stands in guard, clear of who lies.

#include <vector>

#include "fight/state.h"
#include "physics/body.h"

namespace ringcraft {

// Somebody else in the ring.
struct Bystanding {
  const BodyModel* body = nullptr;
  bool down = false;
  std::vector<Pose> poses;  // that it will show, world, one a tick from now on
};

// What may follow `last` at tick `now`: the idle that follows best, toward `opponent` (world, m),
// and then every step that ends inside a ring of that width (m; 0: no ring).
std::vector<Launch> ways_to_stand(const MotionLibrary& library, const Launch& last, Tick now,
                                  Vec3 opponent, float scale, float ring);

// The first of them where that is in nobody and not astride who lies, else the one that leads
// farthest clear. `others` show a pose for every tick of every launch, from `now` on.
Launch clearest(const MotionLibrary& library, const BodyModel& body, Tick now,
                const std::vector<Launch>& launches, const std::vector<Bystanding>& others);

}  // namespace ringcraft
