// A duel inside a game's loop: frames of 1/60 s, decisions under a time limit, and a planner that
// can be interrupted. What it prints depends on the clock.
//
//   live_duel [seconds of fight] [milliseconds a decision]
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>

#include "base/file.h"
#include "capture/library_builder.h"
#include "planner/impact_store.h"
#include "planner/plan.h"

using namespace ringcraft;

namespace {

using Clock = std::chrono::steady_clock;

constexpr Tick kFrame = 2;  // ticks of 1/120 s a frame

FightState opening(const MotionLibrary& library) {
  FightState state;
  ActionId rest = library.launchable().front();
  for (const ActionId id : library.launchable()) {
    if (library.action(id).kind == Kind::idle) rest = id;
  }
  for (int i = 0; i < 2; ++i) {
    FighterState fighter;
    fighter.launch.action = rest;
    fighter.launch.end = 12;
    fighter.launch.placement = {0, i == 0 ? -0.7f : 0.7f, i == 0 ? 0 : kPi};
    fighter.opponent = FighterId(1 - i);
    state.fighters.push_back(fighter);
  }
  return state;
}

struct Shown {  // what a game would draw
  int decisions = 0, unfinished = 0;
  double most_ms = 0, sum_ms = 0, horizon_s = 0;
};

// One frame: whoever has come to the end of an action decides, within the limits.
void frame(const MotionLibrary& library, Planner& planner, FightState& state,
           const PlanLimits& limits, Shown& shown) {
  const Tick end = state.now + kFrame;
  while (state.now < end) {
    const FighterId fighter = next_to_act(state);
    const Tick due = state.fighters[fighter.at()].launch.end;
    if (due > end) break;
    state.now = std::max(state.now, due);
    const auto begin = Clock::now();
    const Plan plan = planner.plan(state, fighter, limits);
    const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
    note_expanded(state, fighter);
    planner.note_launch(fighter, plan.launch.action);
    state.fighters[fighter.at()].launch = plan.launch;
    fmt::print("{:5.2f} s  {}  {:28s} {:6.1f} ms, {:4.2f} s ahead{}\n", seconds(state.now),
               fighter.value == 0 ? "red " : "blue", library.action(plan.launch.action).name,
               took.count(), seconds(plan.record.horizon),
               plan.reproducible ? "" : "  (not reproducible)");
    ++shown.decisions;
    shown.unfinished += plan.reproducible ? 0 : 1;
    shown.sum_ms += took.count();
    shown.most_ms = std::max(shown.most_ms, took.count());
    shown.horizon_s += seconds(plan.record.horizon);
  }
  state.now = end;
}

}  // namespace

int main(int count, char** arguments) {
  const double length = count > 1 ? std::clamp(std::atof(arguments[1]), 0.1, 600.0) : 4;
  const double ms = count > 2 ? std::clamp(std::atof(arguments[2]), 0.5, 1000.0) : 12;
  const auto library = build_library(assets_folder() / "kickboxing" / "library.toml");
  const auto style = read_style(assets_folder() / "styles" / "balanced.toml");
  if (!library || !style) {
    const Error& error = !library ? library.error() : style.error();
    fmt::print(stderr, "{}\n", to_string(error));
    return static_cast<int>(error.kind);
  }
  const Contender fighter{make_body({}), *style};
  PlanSettings settings;
  settings.node_limit = 0;  // the clock alone ends a search
  // One store for the life of the program: a second fight finds the first one's impulse steps.
  const auto store = std::make_shared<ImpactStore>();
  Planner planner(*library, {fighter, fighter}, settings, 1, store);

  std::atomic<bool> paused{false};  // set from another thread, ends a search within a few nodes
  const PlanLimits limits{ms / 1000, &paused};
  FightState state = opening(*library);
  Shown shown;
  while (state.now < ticks(length)) frame(*library, planner, state, limits, shown);

  paused = true;
  const Plan hurried = planner.plan(state, next_to_act(state), limits);
  fmt::print("interrupted at once: {} after {:.2f} s of look-ahead\n",
             library->action(hurried.launch.action).name, seconds(hurried.record.horizon));
  fmt::print(
      "{} decisions under {} ms, {:.1f} ms on the average, {:.1f} at most, {:.2f} s ahead; "
      "{} impulse steps are known\n",
      shown.decisions, ms, shown.sum_ms / std::max(1, shown.decisions), shown.most_ms,
      shown.horizon_s / std::max(1, shown.decisions), store->answers.size());
  return shown.decisions > 0 && hurried.launch.action.valid() ? 0 : 4;
}
