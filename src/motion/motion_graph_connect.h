#pragma once
// The layer between the motion graph and the action state machine: shortest ways through the graph
// from the end of one action to the start of another, as short transitions of their own.
//
// An action is entered at its start and left at its end; a way through the graph uses parts of
// clips. Where such a way is shorter than what the state machine has, it becomes a clip: its
// stretches of captured frames, stitched as playback stitches (playback.h). Planner and playback
// see a transition like any other, which `connects` and is never chosen for itself.

#include <string>
#include <vector>

#include "motion/motion_graph.h"
#include "motion/state_machine.h"

namespace ringcraft {

struct ConnectSettings {
  Tick shortest = 18;      // ticks played at least between two transitions
  Tick longest = 144;      // ticks of a whole way
  Tick seam = 12;          // ticks that a transition more has to save
  Tick gain = 24;          // ticks by which a way must be shorter than the present path
  std::size_t most = 192;  // ways that are made at most
  int threads = 1;         // never changes the result
};

// Frames first..last of one clip of the graph, played on the way.
struct GraphRun {
  std::int32_t clip = 0;
  Tick first = 0, last = 0;
  Placement placement;  // of frame `first`'s root, where the whole way starts at the identity
  bool operator==(const GraphRun&) const = default;
};

// The frames of a way as one clip, their seams stitched. `runs` are not empty.
Clip stitched(const Skeleton& skeleton, const std::vector<GraphSource>& sources,
              const std::vector<GraphRun>& runs);

// Ways that shorten the paths between `actions` (the first sources of the graph), as actions that
// connect; the greatest gain comes first.
std::vector<Action> connecting_actions(const Skeleton& skeleton, const std::vector<Action>& actions,
                                       const std::vector<GraphSource>& sources,
                                       const MotionGraph& graph,
                                       const StateMachineSettings& machine,
                                       const ConnectSettings& settings);

}  // namespace ringcraft
