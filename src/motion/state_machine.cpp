#include "motion/state_machine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace ringcraft {

namespace {

Cloud start_cloud(const Skeleton& skeleton, const Clip& clip) {
  return cloud_at(skeleton, clip, 0);
}
Cloud end_cloud(const Skeleton& skeleton, const Clip& clip) {
  return cloud_at(skeleton, clip, clip.length());
}

bool edge_allowed(const Action& from, const Action& to, float distance,
                  const StateMachineSettings& settings) {
  if (!may_follow(from, to)) return false;
  if (from.ends_lying != Lying::none) return true;  // whatever way it lies
  if (!may_lead(from, to)) return false;
  return distance <= (from.forced() ? settings.response_threshold : settings.threshold);
}

using Edges = std::vector<std::vector<Edge>>;

Edges find_edges(const Skeleton& skeleton, const std::vector<Action>& actions,
                 const StateMachineSettings& settings) {
  std::vector<Cloud> starts, ends;
  for (const Action& action : actions) {
    starts.push_back(start_cloud(skeleton, action.clip));
    ends.push_back(end_cloud(skeleton, action.clip));
  }
  Edges edges(actions.size());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    for (std::size_t j = 0; j < actions.size(); ++j) {
      const Alignment alignment = align(ends[i], starts[j]);
      if (edge_allowed(actions[i], actions[j], alignment.distance, settings)) {
        edges[i].push_back({ActionId(j), alignment});
      }
    }
    std::stable_sort(edges[i].begin(), edges[i].end(), [](const Edge& a, const Edge& b) {
      return a.alignment.distance < b.alignment.distance;
    });
  }
  return edges;
}

// What a path between launched actions may lead over: motion that asks nothing of the opponent.
bool connects(const Action& action) {
  return !action.feint && (action.kind == Kind::transition || action.kind == Kind::idle);
}

// The same out of a fall, which a get-up must follow first. Only falls have edges to get-ups.
bool leads_on(const Action& action) {
  return connects(action) || action.kind == Kind::get_up;
}

// Dijkstra from the end of `from`; ties go to the lower index.
std::vector<std::optional<Path>> paths_from(ActionId from, const std::vector<Action>& actions,
                                            const Edges& edges) {
  constexpr Tick kFar = std::numeric_limits<Tick>::max();
  std::vector<Tick> cost(actions.size(), kFar);  // ticks until the action can start
  std::vector<ActionId> before(actions.size());
  using Entry = std::pair<Tick, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto relax = [&](ActionId over, Tick ticks) {
    for (const Edge& edge : edges[over.at()]) {
      if (ticks < cost[edge.to.at()]) {
        cost[edge.to.at()] = ticks;
        before[edge.to.at()] = over;
        open.emplace(ticks, edge.to.value);
      }
    }
  };
  relax(from, 0);
  while (!open.empty()) {
    const auto [ticks, value] = open.top();
    open.pop();
    const ActionId at(value);
    if (ticks > cost[at.at()] || !leads_on(actions[at.at()]) || at == from) continue;
    relax(at, ticks + actions[at.at()].length());
  }
  std::vector<std::optional<Path>> paths(actions.size());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (cost[i] == kFar) continue;
    Path path;
    path.ticks = cost[i];
    for (ActionId over = before[i]; over != from; over = before[over.at()])
      path.via.push_back(over);
    std::reverse(path.via.begin(), path.via.end());
    paths[i] = std::move(path);
  }
  return paths;
}

bool stands(const Edges& edges, std::size_t from, std::size_t to) {
  return std::any_of(edges[from].begin(), edges[from].end(),
                     [&](const Edge& edge) { return edge.to == ActionId(to); });
}

// Strongly connected components of the transitions and idles, by each action's component number;
// -1 for the others and for a lone one that cannot follow itself.
std::vector<int> connecting_components(const std::vector<Action>& actions, const Edges& edges) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Graph graph(actions.size());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    for (const Edge& edge : edges[i]) {
      if (connects(actions[i]) && connects(actions[edge.to.at()])) {
        boost::add_edge(i, edge.to.at(), graph);
      }
    }
  }
  std::vector<int> component(actions.size());
  const int count = boost::strong_components(graph, component.data());
  std::vector<int> size(static_cast<std::size_t>(count));
  for (const int c : component) ++size[static_cast<std::size_t>(c)];
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const bool lone = size[static_cast<std::size_t>(component[i])] == 1 && !stands(edges, i, i);
    if (!connects(actions[i]) || lone) component[i] = -1;
  }
  return component;
}

bool reaches(const std::vector<Edge>& edges, const std::vector<int>& component, int core) {
  return std::any_of(edges.begin(), edges.end(),
                     [&](const Edge& edge) { return component[edge.to.at()] == core; });
}
void mark(const std::vector<Edge>& edges, std::vector<bool>& marked) {
  for (const Edge& edge : edges) marked[edge.to.at()] = true;
}

// The largest set of launchable actions in which every action has a path to every other and to
// itself over members of the set. Paths lead over transitions and idles only, so the set is one of
// their strongly connected components and all that has an edge both from it and into it.
std::vector<bool> largest_playable(const std::vector<Action>& actions, const Edges& edges) {
  const std::vector<int> component = connecting_components(actions, edges);
  const int count = actions.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<bool> best(actions.size());
  for (int core = 0; core < count; ++core) {
    // An action that only connects leads into the core without being of it: nothing else need come
    // to it than the one action that it was made for.
    std::vector<bool> leads(actions.size()), led_to(actions.size());
    for (std::size_t i = 0; i < actions.size(); ++i) {
      leads[i] =
          component[i] == core || (actions[i].connects && reaches(edges[i], component, core));
    }
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (component[i] == core) mark(edges[i], led_to);
    }
    std::vector<bool> out_of = led_to;
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (actions[i].connects && leads[i] && led_to[i]) mark(edges[i], out_of);
    }
    std::vector<bool> kept(actions.size());
    for (std::size_t i = 0; i < actions.size(); ++i) {
      const bool into = std::any_of(edges[i].begin(), edges[i].end(),
                                    [&](const Edge& edge) { return leads[edge.to.at()]; });
      kept[i] = !actions[i].forced() && into && out_of[i] &&
                (!connects(actions[i]) || component[i] == core);
      if (actions[i].connects && leads[i]) kept[i] = true;
    }
    if (std::count(kept.begin(), kept.end(), true) > std::count(best.begin(), best.end(), true)) {
      best = std::move(kept);
    }
  }
  if (count > 0) return best;
  // Nothing to lead over: what follows itself and all the others directly, first come first kept.
  for (std::size_t i = 0; i < actions.size(); ++i) {
    bool fits = !actions[i].forced() && stands(edges, i, i);
    for (std::size_t j = 0; j < i && fits; ++j) {
      if (best[j]) fits = stands(edges, i, j) && stands(edges, j, i);
    }
    best[i] = fits;
  }
  return best;
}

}  // namespace

bool may_follow(const Action& from, const Action& to) {
  return from.ends_lying != Lying::none ? to.kind == Kind::get_up : !to.forced();
}

Alignment aligned(const Skeleton& skeleton, const Clip& first, const Clip& second) {
  return align(end_cloud(skeleton, first), start_cloud(skeleton, second));
}

Alignment aligned(const Skeleton& skeleton, const Pose& world, const Clip& clip) {
  const WorldPose from = world_pose(skeleton, world);
  const WorldPose to = world_pose(skeleton, scaled(clip.at(0), skeleton.height / kCanonicalHeight));
  std::array<float, kJointCount> weights{};
  weights.fill(1);
  return align(from.position, to.position, weights);
}

StateMachine::StateMachine(const Skeleton& skeleton, const std::vector<Action>& actions,
                           const StateMachineSettings& settings)
    : edges_(find_edges(skeleton, actions, settings)) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    paths_.push_back(paths_from(ActionId(i), actions, edges_));
  }
}

const Edge* StateMachine::edge(ActionId from, ActionId to) const {
  for (const Edge& edge : edges_[from.at()]) {
    if (edge.to == to) return &edge;
  }
  return nullptr;
}

const Path* StateMachine::path(ActionId from, ActionId to) const {
  const auto& path = paths_[from.at()][to.at()];
  return path ? &*path : nullptr;
}

std::vector<ActionId> unconnected(const Skeleton& skeleton, const std::vector<Action>& actions,
                                  const StateMachineSettings& settings) {
  const auto edges = find_edges(skeleton, actions, settings);
  std::vector<bool> kept = largest_playable(actions, edges);
  // Get-ups must lead into it, responses too; falls lead to get-ups.
  const auto leads_into = [&](std::size_t i) {
    return std::any_of(edges[i].begin(), edges[i].end(),
                       [&](const Edge& e) { return kept[e.to.at()]; });
  };
  for (const Kind kind : {Kind::get_up, Kind::response}) {
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (actions[i].kind == kind) kept[i] = leads_into(i);
    }
  }
  std::vector<ActionId> dropped;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!kept[i]) dropped.emplace_back(i);
  }
  return dropped;
}

}  // namespace ringcraft
