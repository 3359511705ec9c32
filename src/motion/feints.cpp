#include "motion/feints.h"

#include <algorithm>

namespace ringcraft {
namespace {

constexpr float kTurn = 10;       // ticks in which time comes to a halt, and in which it runs again
constexpr float kShowing = 0.9f;  // of the way to the first tick that can hit: where the halt is
constexpr float kBack = 0.8f;     // how fast the way back is, times the way there

// Source time by shown tick: on at full speed, a halt at `farthest`, and back to the first frame,
// where it ends at rest as well.
std::vector<float> there_and_back(float farthest) {
  std::vector<float> times{0};
  const float turning = std::min(farthest, kTurn / 2);  // a steady brake takes half as far
  while (times.back() < farthest - turning) times.push_back(times.back() + 1);
  const float from = times.back();
  for (float t = 1; t <= kTurn; ++t) {
    const float left = 1 - t / kTurn;
    times.push_back(from + turning * (1 - left * left));
  }
  float speed = 0;
  while (times.back() > 0) {
    const float stop = times.back() * 2 * kBack / kTurn;  // speed that a steady brake still takes
    speed = std::min({speed + kBack / kTurn, kBack, std::max(stop, 0.5f * kBack / kTurn)});
    times.push_back(std::max(0.0f, times.back() - speed));
  }
  return times;
}

}  // namespace

bool can_be_feigned(const Action& action) {
  return action.attacks() && !action.switches &&
         action.strikes.front().active_begin >= kEarliestFeint;
}

Action feint_of(const Action& attack) {
  const auto blow = static_cast<float>(attack.strikes.front().active_begin);
  const std::vector<float> times = there_and_back(kShowing * blow);
  Action feint;
  feint.name = attack.name + "_feint";
  feint.kind = Kind::transition;
  feint.clip = retimed(attack.clip, times);
  const auto parted = std::find_if(times.begin(), times.end(), [&](const float& time) {
    return time < static_cast<float>(&time - times.data());
  });
  feint.feint = Feint{attack.name, static_cast<Tick>(parted - times.begin())};
  feint.stance = attack.stance;
  feint.source = attack.source;
  return feint;
}

MotionLibrary with_feints(MotionLibrary library, std::span<const std::string> attacks) {
  std::vector<Action> actions = library.actions();
  for (const std::string& name : attacks) {
    const ActionId attack = library.find(name);
    if (!attack.valid() || !can_be_feigned(library.action(attack))) continue;
    actions.push_back(feint_of(library.action(attack)));
  }
  if (actions.size() == library.actions().size()) return library;
  MotionLibrary built(library.name(), std::move(actions));
  return MotionLibrary(LibraryParts{built.name(),
                                    built.actions(),
                                    built.machine(),
                                    {},
                                    built.dropped(),
                                    library.notes(),
                                    library.switches()});
}

}  // namespace ringcraft
