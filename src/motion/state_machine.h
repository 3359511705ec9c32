#pragma once
// The action state machine: which action can follow which, and how the second is placed.
//
// An edge stands only where an action may lead to another (Action::leads_to) and its end is near
// the other's start: the point clouds of
// joints over a window of 5 ticks, aligned on the floor in closed form (Kovar, Gleicher, Pighin
// 2002, eq. 2-4), differ by less than a threshold. Where there is no edge, the shortest path leads
// over transitions. Stitching is by inertialization (playback.h), so an edge itself takes no time.

#include <optional>
#include <vector>

#include "motion/action.h"
#include "motion/point_cloud.h"

namespace ringcraft {

// Best floor-plane alignment of the start of `second` to the end of `first`; feet weigh most.
Alignment aligned(const Skeleton& skeleton, const Clip& first, const Clip& second);

// Best floor-plane placement of the start of `clip` on a pose that is given in the world.
Alignment aligned(const Skeleton& skeleton, const Pose& world, const Clip& clip);

// Whether an edge may lead from the one to the other: only a get-up follows a fall, and nothing
// else leads to what is forced.
bool may_follow(const Action& from, const Action& to);

struct Edge {
  ActionId to;
  Alignment alignment;
};

// A way from the end of one action to the start of another.
struct Path {
  std::vector<ActionId> via;  // actions played in full on the way; empty for a direct edge
  Tick ticks = 0;             // their lengths
};

struct StateMachineSettings {
  float threshold = 0.14f;           // m rms: largest distance of an edge
  float response_threshold = 0.25f;  // m rms: the same out of responses and get-ups
};

class StateMachine {
 public:
  StateMachine() = default;
  StateMachine(const Skeleton& skeleton, const std::vector<Action>& actions,
               const StateMachineSettings& settings);
  // As found before: one list of edges and one of paths (to every action) for each action.
  StateMachine(std::vector<std::vector<Edge>> edges,
               std::vector<std::vector<std::optional<Path>>> paths)
      : edges_(std::move(edges)), paths_(std::move(paths)) {}

  // Edges out of the end of `from`, nearest first. Responses and falls are entered by physics only
  // and never stand as a target here.
  const std::vector<Edge>& edges(ActionId from) const { return edges_[from.at()]; }
  // The direct edge, if there is one.
  const Edge* edge(ActionId from, ActionId to) const;
  // Shortest path by ticks, over transitions and idles (out of a fall over its get-up first),
  // precomputed to the starts of all actions that can be launched. Never null for those targets in
  // a library that was built, an action's own start included.
  const Path* path(ActionId from, ActionId to) const;

 private:
  std::vector<std::vector<Edge>> edges_;
  std::vector<std::vector<std::optional<Path>>> paths_;
};

// Actions to drop, by index, so that every kept one has a path to every kept one that can be
// launched; the largest such set is kept, the builder says what it dropped. Responses and
// knockdowns count as reachable (physics enters them), they must lead back.
std::vector<ActionId> unconnected(const Skeleton& skeleton, const std::vector<Action>& actions,
                                  const StateMachineSettings& settings);

}  // namespace ringcraft
