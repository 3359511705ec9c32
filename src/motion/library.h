#pragma once
// The motion library: every action of one stance and the state machine over them. Immutable.

#include <string>
#include <vector>

#include "motion/state_machine.h"

namespace ringcraft {

class MotionLibrary {
 public:
  // Drops what is not strongly connected; `dropped()` says what and why.
  MotionLibrary(std::string name, std::vector<Action> actions,
                const StateMachineSettings& settings = {});

  const std::string& name() const { return name_; }
  const Skeleton& skeleton() const { return skeleton_; }  // of kCanonicalHeight
  const std::vector<Action>& actions() const { return actions_; }
  const Action& action(ActionId id) const { return actions_[id.at()]; }
  ActionId find(std::string_view name) const;  // invalid when there is none
  const StateMachine& machine() const { return machine_; }
  const std::vector<std::string>& dropped() const { return dropped_; }

  // Actions a fighter may choose: attacks, combinations, defenses, transitions, idles.
  const std::vector<ActionId>& launchable() const { return launchable_; }
  const std::vector<ActionId>& responses() const { return responses_; }
  const std::vector<ActionId>& get_ups() const { return get_ups_; }
  std::size_t count(Kind kind) const;
  std::uint64_t hash() const { return hash_; }

 private:
  std::string name_;
  Skeleton skeleton_;
  std::vector<Action> actions_;
  StateMachine machine_;
  std::vector<std::string> dropped_;
  std::vector<ActionId> launchable_, responses_, get_ups_;
  std::uint64_t hash_ = 0;
};

}  // namespace ringcraft
