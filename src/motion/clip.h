#pragma once
// A clip: poses at every tick (120 Hz), in action space.
//
// Action space: the origin is the ground under the fighter where the action starts, +Z the way the
// fighter faces (where the opponent stands), +X the own left. Root motion is part of the frames;
// the root track says where the placement is at each frame, relative to the start.

#include <string>
#include <vector>

#include "base/ticks.h"
#include "motion/pose.h"

namespace ringcraft {

// Which feet carry: the foot is planted and must not slide.
struct FootContacts {
  bool left = false, right = false;
  bool of(Side side) const { return side == Side::left ? left : right; }
  bool operator==(const FootContacts&) const = default;
};

// Rules: 1 at least two frames; 2 frames, root and contacts have one length; 3 root[0] is the
// identity placement; 4 every number is finite; 5 rotations are unit and neighbours share a
// hemisphere.
struct Clip {
  std::vector<Pose> frames;  // action space, one a tick
  std::vector<Placement> root;
  std::vector<FootContacts> contacts;

  // Ticks from the first frame to the last: an action of this clip ends `length()` ticks after its
  // start.
  Tick length() const { return static_cast<Tick>(frames.size()) - 1; }
  const Pose& at(Tick tick) const;            // clamped to the ends
  const Placement& root_at(Tick tick) const;  // clamped to the ends
  FootContacts contacts_at(Tick tick) const;  // clamped to the ends
};

// Breaks of the rules above, as text; empty when the clip is good.
std::vector<std::string> faults(const Clip& clip);

Clip mirrored(const Clip& clip);

// Frames first..last (both included), moved so that frame `first`'s root placement is the identity.
Clip cut(const Clip& clip, Tick first, Tick last);

// The clip as it looks at the given times, ticks of the source (fractions between its frames), one
// a tick of the result. They may run at any speed and back, and begin at the source's first frame.
Clip retimed(const Clip& clip, const std::vector<float>& times);

// Puts neighbouring rotations in one hemisphere.
void unroll_rotations(Clip& clip);

}  // namespace ringcraft
