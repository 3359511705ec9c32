#pragma once
// The motion graph: which frame of a clip can be followed by which frame of another (Kovar,
// Gleicher, Pighin 2002).
//
// Two frames are compared as point clouds (point_cloud.h). A transition stands where their distance
// has a local minimum in the map over all frames of both clips and lies under the threshold of
// their kinds of motion. A clip is never left or entered while its blow or defense is on: it is
// left from then on, and entered until then. What is not in the largest strongly connected
// component is dropped.

#include <string>
#include <vector>

#include "motion/action.h"
#include "motion/point_cloud.h"

namespace ringcraft {

// What the graph is built over: an action, or a stretch of capture between actions.
struct GraphClip {
  std::string name;
  Tick length = 0;
};

// From frame `from` of one clip straight to frame `to` of another (or of the same one). It takes no
// time: the difference decays while the second clip plays (playback.h).
struct Transition {
  std::int32_t from_clip = 0;
  Tick from = 0;
  std::int32_t to_clip = 0;
  Tick to = 0;
  Alignment alignment;  // of the second frame's root to the first one's
};

struct MotionGraph {
  std::vector<GraphClip> clips;  // the actions first, in their order
  std::vector<Transition> transitions;
  std::uint64_t pairs = 0;    // of frames that were compared on the coarse map
  std::uint32_t minima = 0;   // local minima of the maps under the threshold
  std::uint32_t dropped = 0;  // of these: not in the largest strongly connected component
};

// A clip and the parts of it that may be left and entered.
struct GraphSource {
  struct Span {
    Tick first = 0, last = 0;  // both included
    bool leave = true, enter = true;
  };
  std::string name;
  const Clip* clip = nullptr;
  std::vector<Span> spans;  // in order, apart from each other
  float threshold = 0;      // m rms: largest distance of a transition out of it or into it
  bool starts = true;       // can be played from its first frame to its last
};

struct GraphSettings {
  float stepping = 0.13f;   // m rms: threshold of transitions and idles, where feet are seen
  float striking = 0.14f;   // of attacks and defenses
  float answering = 0.25f;  // out of responses and get-ups
  Tick stride = 4;          // of the coarse map; its minima are refined to the tick
  Tick apart = 24;          // ticks between two frames of one clip that may be joined
  std::size_t most = 2;     // minima of one sort kept for 3 s of one clip against 3 s of another
  int threads = 1;          // never changes the result
};

// Actions as sources: what is quiet in them may be left and entered. Responses and get-ups are left
// at their end only and never entered.
std::vector<GraphSource> graph_sources(const std::vector<Action>& actions,
                                       const GraphSettings& settings);

MotionGraph build_motion_graph(const Skeleton& skeleton, const std::vector<GraphSource>& sources,
                               const GraphSettings& settings);

// The distance of every `stride`-th frame of `rows` to that of `columns`, m: the map that minima
// are sought in, for looking. Row by row.
struct DistanceMap {
  std::size_t rows = 0, columns = 0;
  std::vector<float> distance;
};
DistanceMap distance_map(const Skeleton& skeleton, const Clip& rows, const Clip& columns,
                         Tick stride);

}  // namespace ringcraft
