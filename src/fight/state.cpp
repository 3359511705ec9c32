#include "fight/state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/hash.h"
#include "motion/strike_fit.h"

namespace ringcraft {
namespace {

Launch launched(const MotionLibrary& library, ActionId action, Tick start,
                const Placement& placement) {
  Launch launch;
  launch.action = action;
  launch.start = start;
  launch.end = start + library.action(action).length();
  launch.placement = placement;
  return launch;
}

// The frame of the clip that a launch is at, and how far it is on the way to the next one, 0..1.
std::pair<Tick, float> frame_of(const Launch& launch, Tick tick) {
  const float age = launch.age(tick), whole = std::floor(age);
  return {static_cast<Tick>(whole), age - whole};
}

}  // namespace

std::uint64_t FightState::hash() const {
  Hasher hasher;
  hasher.add(now).add(fighters.size());
  for (const FighterState& fighter : fighters) {
    const Launch& launch = fighter.launch;
    hasher.add(launch.action.value).add(launch.start).add(launch.end).add(launch.placement.x);
    hasher.add(launch.placement.z).add(launch.placement.yaw).add(launch.aim).add(launch.forced);
    hasher.add(launch.spent)
        .add(launch.share)
        .add(launch.pace.factor())
        .add(fighter.health)
        .add(fighter.balance)
        .add(fighter.opponent.value);
    hasher.add(fighter.last_contact).add(fighter.last_at_tie);
  }
  return hasher.digest();
}

Tick Launch::clip_age(Tick tick) const {
  return pace.as_the_clip() ? tick - start : static_cast<Tick>(std::lround(age(tick)));
}

Placement scaled(const Placement& placement, float factor) {
  return {placement.x * factor, placement.z * factor, placement.yaw};
}

Tick aim_ticks(const Action& action) {
  const Tick whole = action.attacks() ? action.strikes.front().active_begin : action.length();
  return std::max<Tick>(1, whole / 2);
}

Tick free_after_fall(const Action& action, const Launch& launch, Tick now) {
  constexpr Tick kTakenIn = 12, kTakenBack = 6;  // ticks: to see the fall; for the limb's way back
  if (!action.attacks()) return launch.end;
  const Tick age = launch.clip_age(now);
  Tick until = now + kTakenIn;
  for (const Strike& strike : action.strikes) {
    const bool thrown = age >= strike.active_begin && age < strike.active_end;
    if (thrown) until = std::max(until, launch.when(strike.active_end) + kTakenBack);
  }
  return std::min(launch.end, until);
}

float aim_share(const Action& action, float age) {
  return glm::smoothstep(0.0f, static_cast<float>(aim_ticks(action)), age);
}

Placement placement_at(const MotionLibrary& library, const Launch& launch, Tick tick) {
  if (launch.aim == 0) return launch.placement;
  Placement turned = launch.placement;
  const float share = aim_share(library.action(launch.action), launch.age(tick));
  turned.yaw = wrapped_angle(turned.yaw + launch.aim * share);
  return turned;
}

Placement root_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale) {
  const Clip& clip = library.action(launch.action).clip;
  const auto [frame, into_next] = frame_of(launch, tick);
  Placement root = clip.root_at(frame);
  if (into_next > 0) root = mix(root, clip.root_at(frame + 1), into_next);
  root = scaled(root, scale);
  if (launch.share < 1) root = mix(Placement{}, root, launch.share);
  return placement_at(library, launch, tick) * root;
}

Pose pose_at(const MotionLibrary& library, const Launch& launch, Tick tick, float scale) {
  const Clip& clip = library.action(launch.action).clip;
  const auto [frame, into_next] = frame_of(launch, tick);
  const Placement placement = placement_at(library, launch, tick);
  Pose pose = placed(scaled(clip.at(frame), scale), placement);
  if (into_next == 0) return pose;
  return mix(pose, placed(scaled(clip.at(frame + 1), scale), placement), into_next);
}

float aim_at(const Action& action, const Placement& placement, Vec3 target, float scale,
             float most_aim) {
  // A blow goes along +Z of its action space; everything else ends facing the target.
  const Placement faces = action.attacks()
                              ? placement
                              : placement * scaled(action.clip.root_at(action.length()), scale);
  return std::clamp(bearing(faces, target), -most_aim, most_aim);
}

Launch following(const MotionLibrary& library, const Launch& last, ActionId next, Tick start,
                 Vec3 target, float scale, float most_aim) {
  const Edge* edge = library.machine().edge(last.action, next);
  assert(edge != nullptr);
  const Placement placement =
      root_at(library, last, start, scale) * scaled(edge->alignment.placement, scale);
  Launch launch = launched(library, next, start, placement);
  launch.aim = aim_at(library.action(next), placement, target, scale, most_aim);
  return launch;
}

float not_brought_back(float turn) {
  constexpr float kBroughtBack = radians(90);
  return turn - std::clamp(turn, -kBroughtBack, kBroughtBack);
}

float turned_away(const MotionLibrary& library, const Action& action, Tick age) {
  const Pose* guard = standing_guard(library, action.stance);
  const float faces = guard == nullptr ? 0.0f : heading_of(guard->rotation[0]);
  return not_brought_back(wrapped_angle(heading_of(action.clip.at(age).rotation[0]) -
                                        action.clip.root_at(age).yaw - faces));
}

Placement answers_from(const MotionLibrary& library, const Launch& cut, Tick tick, float scale) {
  Placement placement = root_at(library, cut, tick, scale);
  placement.yaw = wrapped_angle(
      placement.yaw + turned_away(library, library.action(cut.action), cut.clip_age(tick)));
  return placement;
}

Launch forced_response(const MotionLibrary& library, const Launch& cut, ActionId response,
                       Tick start, float scale) {
  Launch launch = launched(library, response, start, answers_from(library, cut, start, scale));
  launch.forced = true;
  if (library.action(response).ends_lying != Lying::none) launch.end += kLyingTicks;
  return launch;
}

Launch forced_get_up(const MotionLibrary& library, const Launch& fallen, ActionId get_up,
                     Tick start, float scale) {
  Placement placement = root_at(library, fallen, start, scale);
  if (const Edge* edge = library.machine().edge(fallen.action, get_up)) {
    placement = placement * scaled(edge->alignment.placement, scale);
  }
  Launch launch = launched(library, get_up, start, placement);
  launch.forced = true;
  return launch;
}

FighterId next_to_act(const FightState& state) {
  FighterId next;
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    const FighterState& fighter = state.fighters[i];
    if (!next.valid()) {
      next = FighterId(i);
      continue;
    }
    const FighterState& first = state.fighters[next.at()];
    const bool earlier = fighter.launch.end < first.launch.end;
    const bool due =
        fighter.launch.end == first.launch.end && fighter.last_at_tie && !first.last_at_tie;
    if (earlier || due) next = FighterId(i);
  }
  return next;
}

void note_expanded(FightState& state, FighterId expanded) {
  const Tick end = state.fighters[expanded.at()].launch.end;
  bool tie = false;
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    if (i == expanded.at() || state.fighters[i].launch.end != end) continue;
    state.fighters[i].last_at_tie = true;
    tie = true;
  }
  if (tie) state.fighters[expanded.at()].last_at_tie = false;
}

}  // namespace ringcraft
