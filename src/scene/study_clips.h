#pragma once
// Two motions before each other: how deep which parts of the bodies overlap, and when.

#include <string>
#include <vector>

#include "motion/action.h"
#include "physics/body.h"
#include "scene/study.h"

namespace ringcraft {

// One of the two. `action` is in action space; a capture is an action without strikes.
struct PlacedClip {
  std::string name;
  const Action* action = nullptr;
  const BodyModel* body = nullptr;
};

struct ClipPlacement {
  float distance = 0.95f;  // m between the two roots at the start; they face each other
  Tick later = 0;          // ticks by which the second begins after the first
  bool intended = true;  // leave out what a strike is meant to touch (striking_parts), while it is
                         // active and 0.1 s after
};

// Two parts that overlap somewhere.
struct PairDepth {
  Part a = Part::pelvis, b = Part::pelvis;
  Tick first = 0, worst = 0;  // ticks from the first motion's start
  Tick ticks = 0;             // over which they overlap
  float depth = 0;            // m, at the worst tick
};

struct ClipDepths {
  std::vector<PairDepth> pairs;             // deepest first
  std::vector<float> deepest;               // m, one a tick
  std::vector<std::vector<float>> by_pair;  // m, one a tick, for each of `pairs`
};

// From the first motion's start to the later of the two ends; who is done holds the last frame.
ClipDepths clip_depths(const PlacedClip& a, const PlacedClip& b, const ClipPlacement& placement);

// Moved and turned so that the first frame's hips stand over the origin and the chest faces +Z.
Clip from_origin(const Skeleton& skeleton, const Clip& clip);

Study clips_study(const PlacedClip& a, const PlacedClip& b, const ClipPlacement& placement,
                  float limit);

}  // namespace ringcraft
