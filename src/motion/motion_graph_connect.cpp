#include "motion/motion_graph_connect.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>

#include <fmt/format.h>

#include "base/tasks.h"
#include "motion/playback.h"

namespace ringcraft {

namespace {

constexpr Tick kNever = std::numeric_limits<Tick>::max() / 4;
constexpr int kRounds = 10;
constexpr std::size_t kTriesAtOnce = 600;
constexpr std::size_t kAtOnce = 24;             // ways made before paths are looked at again
constexpr Tick kRootEases = 24;                 // ticks in which the root track makes good a seam
constexpr Tick kNoPath = 10 * kTicksPerSecond;  // what an action that cannot be reached counts for

// A way from the end of one action to the start of another.
struct Way {
  ActionId from, to;
  Tick ticks = 0;
  std::vector<GraphRun> runs;
};

// Shortest ways out of one action's end (Dijkstra over transitions).
class WaySearch {
 public:
  WaySearch(const std::vector<GraphSource>& sources, const MotionGraph& graph,
            const ConnectSettings& settings)
      : sources_(sources), graph_(graph), settings_(settings), out_of_(sources.size()) {
    for (std::size_t t = 0; t < graph.transitions.size(); ++t) {  // in order of their ticks
      out_of_[static_cast<std::size_t>(graph.transitions[t].from_clip)].push_back(t);
    }
  }

  // One way to each action that is reached over at least one stretch of frames.
  std::vector<Way> from(ActionId action, std::size_t actions) const {
    const auto& transitions = graph_.transitions;
    std::vector<Tick> cost(transitions.size(), kNever), played(transitions.size(), 0);
    std::vector<std::size_t> before(transitions.size(), kNone);
    using Entry = std::pair<Tick, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const Tick end = sources_[action.at()].clip->length();
    for (const std::size_t t : out_of_[action.at()]) {
      if (transitions[t].from != end) continue;
      cost[t] = 0;
      open.emplace(0, t);
    }
    std::vector<std::vector<Arrival>> arrivals(sources_.size());
    while (!open.empty()) {
      const auto [ticks, at] = open.top();
      open.pop();
      if (ticks > cost[at]) continue;
      const Transition& in = transitions[at];
      const auto clip = static_cast<std::size_t>(in.to_clip);
      const Tick last = quiet_until(in.to_clip, in.to);
      if (!worth_it(arrivals[clip], {in.to, last, ticks - in.to})) continue;
      const auto first =
          std::lower_bound(out_of_[clip].begin(), out_of_[clip].end(), in.to + settings_.shortest,
                           [&](std::size_t t, Tick tick) { return transitions[t].from < tick; });
      for (auto t = first; t != out_of_[clip].end() && transitions[*t].from <= last; ++t) {
        const Tick run = transitions[*t].from - in.to;
        const Tick now = played[at] + run;
        const Tick total = ticks + run + settings_.seam;
        if (now > settings_.longest || total >= cost[*t]) continue;
        cost[*t] = total;
        played[*t] = now;
        before[*t] = at;
        open.emplace(total, *t);
      }
    }
    return best_ways(action, actions, cost, played, before);
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  // Where a clip was entered, how far it is quiet from there, and its cost less that tick: what it
  // costs to be at a later tick by this arrival is the tick more.
  struct Arrival {
    Tick tick = 0, last = 0, offset = 0;
  };

  // False where an earlier arrival in the same span is at every later tick for no more.
  static bool worth_it(std::vector<Arrival>& arrivals, const Arrival& now) {
    for (const Arrival& other : arrivals) {
      if (other.last == now.last && other.tick <= now.tick && other.offset <= now.offset) {
        return false;
      }
    }
    arrivals.push_back(now);
    return true;
  }

  // The last tick of the span that holds `tick`: until there nothing but quiet motion is played.
  Tick quiet_until(std::int32_t clip, Tick tick) const {
    for (const GraphSource::Span& span : sources_[static_cast<std::size_t>(clip)].spans) {
      if (tick >= span.first && tick <= span.last) return span.last;
    }
    return tick;
  }

  std::vector<Way> best_ways(ActionId action, std::size_t actions, const std::vector<Tick>& cost,
                             const std::vector<Tick>& played,
                             const std::vector<std::size_t>& before) const {
    std::vector<std::size_t> best(actions, kNone);
    for (std::size_t t = 0; t < cost.size(); ++t) {
      const Transition& last = graph_.transitions[t];
      const auto to = static_cast<std::size_t>(last.to_clip);
      if (cost[t] == kNever || before[t] == kNone || last.to != 0 || to >= actions) continue;
      if (best[to] == kNone || cost[t] < cost[best[to]]) best[to] = t;
    }
    std::vector<Way> ways;
    for (std::size_t to = 0; to < actions; ++to) {
      if (best[to] == kNone) continue;
      ways.push_back({action, ActionId(to), played[best[to]], runs_to(best[to], before)});
    }
    return ways;
  }

  std::vector<GraphRun> runs_to(std::size_t last, const std::vector<std::size_t>& before) const {
    std::vector<std::size_t> chain;
    for (std::size_t t = last; t != kNone; t = before[t]) chain.push_back(t);
    std::reverse(chain.begin(), chain.end());
    std::vector<GraphRun> runs;
    Placement at;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Transition &in = graph_.transitions[chain[i]], &out = graph_.transitions[chain[i + 1]];
      if (i > 0) at = at * in.alignment.placement;
      runs.push_back({in.to_clip, in.to, out.from, at});
      const Clip& clip = *sources_[static_cast<std::size_t>(in.to_clip)].clip;
      at = at * inverse(clip.root_at(in.to)) * clip.root_at(out.from);
    }
    return runs;
  }

  const std::vector<GraphSource>& sources_;
  const MotionGraph& graph_;
  const ConnectSettings& settings_;
  std::vector<std::vector<std::size_t>> out_of_;
};

// A frame of a run, placed where the way has it.
Pose frame_of(const GraphSource& source, const GraphRun& run, Tick tick) {
  return placed(source.clip->at(tick), run.placement * inverse(source.clip->root_at(run.first)));
}

std::string source_text(const std::vector<GraphSource>& sources,
                        const std::vector<GraphRun>& runs) {
  std::string text = "motion graph:";
  for (const GraphRun& run : runs) {
    text += fmt::format(" {} {:.2f}-{:.2f} s", sources[static_cast<std::size_t>(run.clip)].name,
                        seconds(run.first), seconds(run.last));
  }
  return text;
}

Action made(const Skeleton& skeleton, const std::vector<Action>& actions,
            const std::vector<GraphSource>& sources, const Way& way) {
  Action action;
  action.name = fmt::format("{}_to_{}", actions[way.from.at()].name, actions[way.to.at()].name);
  action.kind = Kind::transition;
  action.connects = true;
  action.clip = stitched(skeleton, sources, way.runs);
  action.source = source_text(sources, way.runs);
  return action;
}

// What a way saves against the path of the state machine, ticks.
Tick gain_of(const Way& way, const StateMachine& machine) {
  const Path* path = machine.path(way.from, way.to);
  return (path == nullptr ? kNoPath : path->ticks) - way.ticks;
}

// Whether the state machine will have edges on both sides of it.
bool fits(const Skeleton& skeleton, const Action& from, const Action& way, const Action& to,
          float threshold) {
  return faults(way.clip).empty() && aligned(skeleton, from.clip, way.clip).distance <= threshold &&
         aligned(skeleton, way.clip, to.clip).distance <= threshold;
}

}  // namespace

Clip stitched(const Skeleton& skeleton, const std::vector<GraphSource>& sources,
              const std::vector<GraphRun>& runs) {
  Playback playback(skeleton);
  Clip clip;
  for (const GraphRun& run : runs) {
    const GraphSource& source = sources[static_cast<std::size_t>(run.clip)];
    const Placement to_way = run.placement * inverse(source.clip->root_at(run.first));
    // Where the roots of two clips differ at a seam, the track goes over by and by.
    Placement off;
    const Tick first = clip.frames.empty() ? run.first : run.first + 1;
    if (!clip.frames.empty()) {
      off = inverse(to_way * source.clip->root_at(run.first)) * clip.root.back();
      playback.stitch(frame_of(source, run, first), frame_of(source, run, first + 1));
    }
    for (Tick tick = first; tick <= run.last; ++tick) {
      clip.frames.push_back(
          playback.next(frame_of(source, run, tick), source.clip->contacts_at(tick)));
      clip.contacts.push_back(playback.held());
      const float t =
          std::min(1.0f, static_cast<float>(tick - run.first) / static_cast<float>(kRootEases));
      const float left = 1 - t * t * (3 - 2 * t);
      clip.root.push_back(to_way * source.clip->root_at(tick) *
                          Placement{off.x * left, off.z * left, wrapped_angle(off.yaw) * left});
    }
  }
  clip.root.front() = {};
  unroll_rotations(clip);
  return clip;
}

std::vector<Action> connecting_actions(const Skeleton& skeleton, const std::vector<Action>& actions,
                                       const std::vector<GraphSource>& sources,
                                       const MotionGraph& graph,
                                       const StateMachineSettings& machine_settings,
                                       const ConnectSettings& settings) {
  const WaySearch search(sources, graph, settings);
  std::vector<std::vector<Way>> found(actions.size());
  run_tasks(actions.size(), settings.threads, [&](std::size_t i) {
    if (actions[i].ends_lying == Lying::none) found[i] = search.from(ActionId(i), actions.size());
  });
  std::vector<Way> ways;
  for (std::vector<Way>& of_one : found) {
    for (Way& way : of_one) {
      if (!actions[way.to.at()].forced()) ways.push_back(std::move(way));
    }
  }
  std::vector<Action> all = actions;
  std::vector<Action> connecting;
  std::set<std::pair<ActionId, ActionId>> tried;
  for (int round = 0; round < kRounds && connecting.size() < settings.most; ++round) {
    const StateMachine machine(skeleton, all, machine_settings);
    std::vector<std::pair<Tick, const Way*>> open;
    for (const Way& way : ways) {
      const Tick gain = gain_of(way, machine);
      if (gain >= settings.gain && !tried.contains({way.from, way.to})) {
        open.emplace_back(gain, &way);
      }
    }
    std::stable_sort(open.begin(), open.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    const std::size_t before = connecting.size();
    std::size_t tries = 0;
    std::set<ActionId> from, to;  // each once, then the paths are looked at again
    for (const auto& [gain, way] : open) {
      if (connecting.size() >= std::min(settings.most, before + kAtOnce)) break;
      if (from.contains(way->from) || to.contains(way->to)) continue;
      if (++tries > kTriesAtOnce) break;
      tried.insert({way->from, way->to});
      Action action = made(skeleton, actions, sources, *way);
      if (!fits(skeleton, actions[way->from.at()], action, actions[way->to.at()],
                machine_settings.threshold)) {
        continue;
      }
      from.insert(way->from);
      to.insert(way->to);
      all.push_back(action);
      connecting.push_back(std::move(action));
    }
    if (connecting.size() == before) break;
  }
  return connecting;
}

}  // namespace ringcraft
