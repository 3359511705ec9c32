// Plans one exchange: what the tree of one fighter looks like, move by move.
//
//   plan_one_exchange [horizon in seconds]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "base/file.h"
#include "capture/library_builder.h"
#include "planner/plan.h"

using namespace ringcraft;

namespace {

// Red has just come to rest; blue is two thirds of the way to the blow of the library's longest
// attack. Nothing where the library has no idle or no attack.
std::optional<FightState> exchange(const MotionLibrary& library, float distance) {
  ActionId rest, attack;
  for (const ActionId id : library.launchable()) {
    const Action& action = library.action(id);
    if (action.kind == Kind::idle) rest = id;
    if (action.kind == Kind::attack && !action.strikes.empty() &&
        (!attack.valid() || action.length() > library.action(attack).length()))
      attack = id;
  }
  if (!rest.valid() || !attack.valid()) return std::nullopt;
  FightState state;
  for (int i = 0; i < 2; ++i) {
    const ActionId action = i == 0 ? rest : attack;
    FighterState fighter;
    fighter.launch.action = action;
    const Action& what = library.action(action);
    fighter.launch.start = i == 0 ? -what.length() : -what.strikes.front().active_begin * 2 / 3;
    fighter.launch.end = fighter.launch.start + what.length();
    fighter.launch.placement = {0, i == 0 ? -distance / 2 : distance / 2, i == 0 ? 0 : kPi};
    fighter.opponent = FighterId(1 - i);
    state.fighters.push_back(fighter);
  }
  return state;
}

}  // namespace

int main(int count, char** arguments) {
  const auto library = build_library(assets_folder() / "kickboxing" / "library.toml");
  const auto style = read_style(assets_folder() / "styles" / "balanced.toml");
  if (!library || !style) {
    const Error& error = !library ? library.error() : style.error();
    fmt::print(stderr, "{}\n", to_string(error));
    return static_cast<int>(error.kind);
  }
  Contender red{make_body({}), *style};
  if (count > 1) red.style.horizon_s = std::clamp(std::atof(arguments[1]), 0.1, 3.0);
  Planner planner(*library, {red, red}, {}, 1);

  const std::optional<FightState> begun = exchange(*library, 1.1f);
  if (!begun) {
    fmt::print(stderr, "the library has no idle or no attack\n");
    return static_cast<int>(ErrorKind::input);
  }
  const FightState& state = *begun;
  fmt::print("blue is {} ticks into {}; red decides\n", state.now - state.fighters[1].launch.start,
             library->action(state.fighters[1].launch.action).name);
  const Plan plan = planner.plan(state, FighterId(0));
  const DecisionRecord& record = plan.record;
  fmt::print("looked {:.2f} s ahead: {} nodes, {} leaves, {} forced\n", seconds(record.horizon),
             record.nodes, record.leaves, record.forced_nodes);
  fmt::print("pruned: {} unanswered hits, {} backs turned, {} penetrations, {} beyond the list\n",
             record.pruned_unanswered_hit, record.pruned_back_turned, record.pruned_penetration,
             record.pruned_candidates);
  for (std::size_t i = 0; i < record.lines.size(); ++i) {
    const Line& line = record.lines[i];
    const bool chosen = record.chosen == static_cast<std::int32_t>(i);
    fmt::print("{} {:+7.2f}", chosen ? '>' : ' ', line.score / 1000.0);
    for (std::size_t k = 0; k < line.actions.size(); ++k) {
      fmt::print("  {}:{}", line.actors[k] == 0 ? "red" : "blue", line.actions[k]);
    }
    fmt::print("\n");
  }
  for (const Event& event : plan.foreseen) {
    fmt::print("foreseen at {:.2f} s: {} by {} with {} on {}, {:.1f} points, {}\n",
               seconds(event.tick), name_of(event.type), event.who.value == 0 ? "red" : "blue",
               event.action, event.part.empty() ? "nothing" : event.part, event.damage,
               name_of(event.response));
  }
  return record.lines.empty() ? 4 : 0;
}
