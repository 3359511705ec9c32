#include "motion/both_stances.h"

#include <algorithm>

namespace ringcraft {

namespace {

class Doubled {
 public:
  Doubled(const MotionLibrary& library, bool switching)
      : library_(library), count_(library.actions().size()), actions_(library.actions()) {
    const std::size_t own = switching ? library.switches().size() : 0;
    actions_.reserve(2 * (count_ + own));
    for (std::size_t i = 0; i < count_; ++i) actions_.push_back(southpaw(actions_[i]));
    for (std::size_t i = 0; i < own; ++i) {
      actions_.push_back(library.switches()[i]);
      actions_.push_back(southpaw(library.switches()[i]));
    }
    edges_.resize(actions_.size());
    paths_.resize(actions_.size(), std::vector<std::optional<Path>>(actions_.size()));
    copy_machine();
    for (std::size_t i = 2 * count_; i < actions_.size(); ++i) join(i);
  }

  MotionLibrary library() && {
    return MotionLibrary(LibraryParts{library_.name(),
                                      std::move(actions_),
                                      StateMachine(std::move(edges_), std::move(paths_)),
                                      {},
                                      library_.dropped(),
                                      library_.notes(),
                                      library_.switches()});
  }

 private:
  static Action southpaw(const Action& action) {
    Action result = mirrored(action);
    result.stance = Stance::southpaw;
    return result;
  }
  ActionId image(ActionId id) const { return ActionId(id.at() + count_); }

  void copy_machine() {
    for (std::size_t i = 0; i < count_; ++i) {
      const ActionId from(i);
      edges_[i] = library_.machine().edges(from);
      edges_[i + count_] = edges_[i];
      for (Edge& edge : edges_[i + count_]) {
        edge.to = image(edge.to);
        edge.alignment.placement = mirrored(edge.alignment.placement);
      }
      for (std::size_t j = 0; j < count_; ++j) {
        const Path* path = library_.machine().path(from, ActionId(j));
        if (path == nullptr) continue;
        paths_[i][j] = *path;
        Path other = *path;
        for (ActionId& via : other.via) via = image(via);
        paths_[i + count_][j + count_] = std::move(other);
      }
    }
  }

  void add_edge(std::size_t from, std::size_t to, float threshold) {
    const Action& last = actions_[from];
    if (last.ends_lying != Lying::none || !may_lead(last, actions_[to])) return;
    const Alignment alignment = aligned(library_.skeleton(), last.clip, actions_[to].clip);
    if (alignment.distance > threshold) return;
    const auto behind = std::upper_bound(
        edges_[from].begin(), edges_[from].end(), alignment.distance,
        [](float distance, const Edge& edge) { return distance < edge.alignment.distance; });
    edges_[from].insert(behind, {ActionId(to), alignment});
    paths_[from][to] = Path{};
  }

  // The switch `at`: from the actions of the stance that it leaves, to those of the other one, the
  // switches back among them.
  void join(std::size_t at) {
    const StateMachineSettings settings;
    const Stance leaves = actions_[at].stance;
    for (std::size_t i = 0; i < actions_.size(); ++i) {
      const Action& other = actions_[i];
      const bool answers = other.forced();
      if (other.stance != leaves && !answers) add_edge(at, i, settings.threshold);
      if (other.stance == leaves && !other.switches) {
        add_edge(i, at, answers ? settings.response_threshold : settings.threshold);
      }
    }
  }

  const MotionLibrary& library_;
  std::size_t count_;
  std::vector<Action> actions_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<std::vector<std::optional<Path>>> paths_;
};

}  // namespace

MotionLibrary both_stances(const MotionLibrary& library, bool switching) {
  const bool both =
      std::any_of(library.actions().begin(), library.actions().end(),
                  [](const Action& action) { return action.stance == Stance::southpaw; });
  return both ? library : Doubled(library, switching).library();
}

}  // namespace ringcraft
