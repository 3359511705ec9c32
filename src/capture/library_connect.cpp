// A library with its motion graph.

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/utf8.h"
#include "capture/library_builder.h"
#include "motion/motion_graph_connect.h"

namespace ringcraft {
namespace {

// Which actions stand on some path of the state machine.
std::vector<bool> on_paths(const MotionLibrary& library) {
  const std::size_t count = library.actions().size();
  std::vector<bool> used(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (library.action(ActionId(i)).connects) continue;
    for (const ActionId to : library.launchable()) {
      const Path* path = library.machine().path(ActionId(i), to);
      if (path == nullptr) continue;
      for (const ActionId via : path->via) used[via.at()] = true;
    }
  }
  return used;
}

}  // namespace

MotionLibrary connected_library(const std::string& name, std::vector<Action> actions,
                                std::vector<std::string> notes,
                                const LibraryBuildSettings& settings) {
  // What comes from paths need not be UTF-8; a library's text is.
  for (Action& action : actions) action.source = clean_name(action.source, std::string::npos);
  for (std::string& note : notes) note = clean_name(note, std::string::npos);
  const Skeleton skeleton = canonical_skeleton();
  const StateMachineSettings machine;
  // What ends in the other stance leads nowhere in this one.
  const auto first_switch = std::stable_partition(
      actions.begin(), actions.end(), [](const Action& action) { return !action.switches; });
  std::vector<Action> switches(std::make_move_iterator(first_switch),
                               std::make_move_iterator(actions.end()));
  actions.erase(first_switch, actions.end());
  // Blends follow what they are made of frame by frame: they lead where these do, by edges of their
  // own, and would only double the graph.
  const auto first_blend = std::stable_partition(
      actions.begin(), actions.end(), [](const Action& action) { return !is_blend(action); });
  std::vector<Action> blends(std::make_move_iterator(first_blend),
                             std::make_move_iterator(actions.end()));
  actions.erase(first_blend, actions.end());
  MotionGraph graph;
  if (settings.connect) {
    GraphSettings of_graph;
    of_graph.threads = settings.threads;
    const std::vector<GraphSource> sources = graph_sources(actions, of_graph);
    graph = build_motion_graph(skeleton, sources, of_graph);
    ConnectSettings of_ways;
    of_ways.threads = settings.threads;
    std::vector<Action> connecting =
        connecting_actions(skeleton, actions, sources, graph, machine, of_ways);
    for (Action& action : connecting) actions.push_back(std::move(action));
  }
  for (Action& action : blends) actions.push_back(std::move(action));
  MotionLibrary all(name, std::move(actions), machine);
  const std::vector<bool> used = on_paths(all);
  std::vector<Action> kept;
  kept.reserve(all.actions().size());
  for (std::size_t i = 0; i < all.actions().size(); ++i) {
    const Action& action = all.action(ActionId(i));
    if (!action.connects || used[i]) kept.push_back(action);
  }
  const MotionLibrary library(name, std::move(kept), machine);
  std::vector<std::string> dropped = all.dropped();
  dropped.insert(dropped.end(), library.dropped().begin(), library.dropped().end());
  return MotionLibrary(LibraryParts{name, library.actions(), library.machine(), std::move(graph),
                                    std::move(dropped), std::move(notes), std::move(switches)});
}

}  // namespace ringcraft
