// Plans one exchange: what the tree of one fighter looks like, move by move.
//
//   plan_one_exchange [horizon in seconds]
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "base/file.h"
#include "capture/library_builder.h"
#include "planner/plan.h"

using namespace ringcraft;

namespace {

// Red has just come to rest; blue has begun a front kick or, where the library has none, its first
// attack.
FightState exchange(const MotionLibrary& library, float distance) {
  ActionId rest = library.launchable().front(), attack = rest;
  for (const ActionId id : library.launchable()) {
    if (library.action(id).kind == Kind::idle) rest = id;
    if (library.action(id).kind == Kind::attack &&
        library.action(id).length() > library.action(attack).length())
      attack = id;
  }
  FightState state;
  for (int i = 0; i < 2; ++i) {
    const ActionId action = i == 0 ? rest : attack;
    FighterState fighter;
    fighter.launch.action = action;
    const Action& what = library.action(action);
    fighter.launch.start = i == 0 ? -what.length() : -what.strikes.front().active_begin * 2 / 3;
    fighter.launch.end = fighter.launch.start + library.action(action).length();
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
    fmt::print(stderr, "{}\n", to_string(!library ? library.error() : style.error()));
    return 3;
  }
  Contender red{make_body({}), *style};
  if (count > 1) red.style.horizon_s = std::clamp(std::atof(arguments[1]), 0.1, 3.0);
  Planner planner(*library, {red, red}, {}, 1);

  const FightState state = exchange(*library, 1.1f);
  fmt::print("blue is {} ticks into {}; red decides\n", state.now - state.fighters[1].launch.start,
             library->action(state.fighters[1].launch.action).name);
  const Plan plan = planner.plan(state, FighterId(0), 0);
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
