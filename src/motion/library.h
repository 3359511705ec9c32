#pragma once
// The motion library: every action of one stance (of both: both_stances.h) and the state machine
// over them. Immutable.

#include <memory>
#include <string>
#include <vector>

#include "motion/motion_graph.h"
#include "motion/state_machine.h"

namespace ringcraft {

class MotionLibrary;

// What a library is made of, once it is built.
struct LibraryParts {
  std::string name;
  std::vector<Action> actions;  // all of them connected
  StateMachine machine;
  MotionGraph graph;
  std::vector<std::string> dropped, notes;
  std::vector<Action> switches;
  // The library as each fighter of a scene does it (strike_fit.h), null: as it is here. The same
  // actions in the same order, of which clips and reaches differ. Never in a file.
  std::vector<std::shared_ptr<const MotionLibrary>> fits = {};
};

class MotionLibrary {
 public:
  // Drops what is not strongly connected; `dropped()` says what and why.
  MotionLibrary(std::string name, std::vector<Action> actions,
                const StateMachineSettings& settings = {});
  // As it was built before: nothing is looked for and nothing dropped.
  explicit MotionLibrary(LibraryParts parts);

  // The same machine over the same actions in the same order, of which only clips and reaches
  // differ; without the graph, which is for building.
  MotionLibrary with(std::vector<Action> actions) const;

  const std::string& name() const { return name_; }
  const Skeleton& skeleton() const { return skeleton_; }  // of kCanonicalHeight
  const std::vector<Action>& actions() const { return actions_; }
  const Action& action(ActionId id) const { return actions_[id.at()]; }
  // As each of several fighters does it, null: as it is here (LibraryParts::fits).
  MotionLibrary with_fits(std::vector<std::shared_ptr<const MotionLibrary>> fits) const;
  // The library whose clips that fighter of the scene shows.
  const MotionLibrary& of(FighterId fighter) const {
    const std::size_t i = fighter.at();
    return i < fits_.size() && fits_[i] != nullptr ? *fits_[i] : *this;
  }
  // Invalid when there is none; of both stances, the orthodox one.
  ActionId find(std::string_view name) const;
  const StateMachine& machine() const { return machine_; }
  const MotionGraph& graph() const { return graph_; }  // empty where none was built
  const std::vector<std::string>& dropped() const { return dropped_; }
  // What the builder has to say about where actions come from.
  const std::vector<std::string>& notes() const { return notes_; }

  // Actions a fighter may choose: attacks, combinations, defenses, transitions, idles. Not those
  // that only connect.
  const std::vector<ActionId>& launchable() const { return launchable_; }
  const std::vector<ActionId>& responses() const { return responses_; }
  const std::vector<ActionId>& get_ups() const { return get_ups_; }
  // Actions that end in the other stance: of no use before both_stances() makes that one.
  const std::vector<Action>& switches() const { return switches_; }
  std::size_t count(Kind kind) const;
  std::uint64_t hash() const { return hash_; }

 private:
  void sort_actions();

  std::string name_;
  Skeleton skeleton_;
  std::vector<Action> actions_;
  StateMachine machine_;
  MotionGraph graph_;
  std::vector<std::string> dropped_, notes_;
  std::vector<Action> switches_;
  std::vector<std::shared_ptr<const MotionLibrary>> fits_;
  std::vector<ActionId> launchable_, responses_, get_ups_;
  std::uint64_t hash_ = 0;
};

}  // namespace ringcraft
