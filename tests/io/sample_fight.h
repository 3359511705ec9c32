#pragma once
// A short hand-made fight for the tests of the outputs: a jab lands and is absorbed, a second one
// is blocked, a knockdown and a get-up.

#include <string>
#include <vector>

#include "fight/synthetic_library.h"
#include "fight/timeline.h"
#include "io/outputs.h"

namespace ringcraft::sample {

inline const MotionLibrary& library() {
  static const MotionLibrary kLibrary = synthetic::library();
  return kLibrary;
}

inline std::vector<FighterLook> looks() {
  std::vector<FighterLook> looks(2);
  looks[0].name = "Ana \"the Anvil\"";
  looks[0].body = make_body({"lightweight", 1.68f, 58.0f, Sex::female, 1.0f});
  looks[1].name = "Bo";
  looks[1].body = make_body({"middleweight", 1.80f, 77.0f, Sex::male, 1.0f});
  return looks;
}

// Plays the named actions one after the other from a placement.
inline FighterTrack track_of(const std::vector<std::string>& names, const Placement& placement,
                             float scale) {
  FighterTrack track;
  Launch launch;
  launch.placement = placement;
  for (const std::string& name : names) {
    launch.action = library().find(name);
    const Action& action = library().action(launch.action);
    launch.end = launch.start + action.length();
    launch.forced = action.forced();
    track.segments.push_back({launch, name, action.kind});
    for (Tick tick = launch.start; tick < launch.end; ++tick) {
      track.frames.push_back(pose_at(library(), launch, tick, scale));
      track.contacts.push_back(action.clip.contacts_at(tick - launch.start));
    }
    launch.placement = root_at(library(), launch, launch.end, scale);
    launch.start = launch.end;
  }
  return track;
}

inline Event event(Tick tick, EventType type, int who, int whom, const std::string& action) {
  Event event;
  event.tick = tick;
  event.type = type;
  event.who = FighterId(who);
  event.whom = FighterId(whom);
  event.action = action;
  return event;
}

inline std::vector<Event> events() {
  Event decision = event(36, EventType::decision, 0, 1, "jab");
  decision.decision.lines = {{{"jab", "*absorb_back", "cross"}, {0, 1, 0}, 4250, false, {}},
                             {{"cross", "duck"}, {0, 1}, -1500, false, {}}};
  decision.decision.nodes = 120;
  decision.decision.leaves = 64;
  decision.decision.forced_nodes = 5;
  decision.decision.pruned_unanswered_hit = 3;
  decision.decision.pruned_back_turned = 2;
  decision.decision.pruned_penetration = 1;
  decision.decision.pruned_candidates = 7;
  Event hit = event(58, EventType::hit, 0, 1, "jab");
  hit.part = "head";
  hit.point = {0.01f, 1.6f, 0.4f};
  hit.impulse = {3, 0, 4};
  hit.speed = 6.5f;
  hit.effective_mass = 2.4f;
  hit.damage = 3.1f;
  hit.foreseen = true;
  Event response = hit;
  response.type = EventType::response;
  response.who = FighterId(1);
  response.whom = FighterId();
  response.response = ResponseKind::recovery_steps;
  response.steps = 2;
  Event block = hit;
  block.tick = 120;
  block.type = EventType::block;
  block.part = "leftForearm";
  block.impulse = {0, 0, 1};
  block.foreseen = false;
  block.knockout = true;
  Event down = event(200, EventType::knockdown, 1, -1, "knockdown_back");
  down.response = ResponseKind::knockdown;
  down.knockout = true;
  return {decision,
          event(50, EventType::strike, 0, 1, "jab"),
          hit,
          response,
          event(110, EventType::strike, 0, 1, "cross"),
          block,
          event(150, EventType::strike, 1, 0, "cross"),
          event(160, EventType::miss, 1, 0, "cross"),
          down,
          event(350, EventType::getup, 1, -1, "get_up_back")};
}

inline Timeline timeline() {
  const std::vector<FighterLook> bodies = looks();
  Timeline timeline;
  timeline.tracks = {
      track_of({"idle", "jab", "guard_high", "cross", "step_back", "duck", "turn_left"}, {0, 0, 0},
               bodies[0].body.scale),
      track_of({"idle", "absorb_back", "slip_right", "knockdown_back", "get_up_back"},
               {0, 1.1f, kPi}, bodies[1].body.scale)};
  // Both tracks are as long as the shorter one, as the fight loop records them.
  const std::size_t frames =
      std::min(timeline.tracks[0].frames.size(), timeline.tracks[1].frames.size());
  for (FighterTrack& track : timeline.tracks) {
    track.frames.resize(frames);
    track.contacts.resize(frames);
  }
  timeline.end = static_cast<Tick>(frames) - 1;
  timeline.events = events();
  return timeline;
}

}  // namespace ringcraft::sample
