#include "scene/single_hit.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/answer.h"
#include "scene/stage.h"

namespace ringcraft {

namespace {

constexpr Tick kAfterwards = kTicksPerSecond;  // shown after the response
constexpr FighterId kOnly{0};

// Where the impulse meets the part: on its surface, on the side it comes from.
Vec3 point_of(const BodyModel& body, const Pose& pose, Part part, Vec3 impulse) {
  const Capsule capsule = capsules(body, world_pose(body.skeleton, pose))[index(part)];
  return (capsule.a + capsule.b) * 0.5f - normalized_or(impulse, Vec3{}) * capsule.radius;
}

// An idle that can follow, for what is shown after the response.
ActionId resting_action(const MotionLibrary& library, ActionId after) {
  for (const Edge& edge : library.machine().edges(after)) {
    if (library.action(edge.to).kind == Kind::idle) return edge.to;
  }
  for (const Edge& edge : library.machine().edges(after)) {
    if (library.action(edge.to).kind == Kind::transition) return edge.to;
  }
  return library.machine().edges(after).front().to;
}

void show_to(Stage& stage, Tick& now, Tick end) {
  while (now < end) {
    stage.show(++now);
    stage.keep_out_and_record();
  }
}

}  // namespace

Result<HitAnswer> simulate_hit(const MotionLibrary& library, const HitQuery& query) {
  const ActionId action = library.find(query.action);
  if (!action.valid()) {
    return usage_error("", "--pose",
                       fmt::format("no action '{}' in library {}", query.action, library.name()),
                       "`ringcraft library inspect` lists them");
  }
  const Tick at = ticks(query.at_s);
  if (at < 0 || at > library.action(action).length()) {
    return usage_error("", "--pose",
                       fmt::format("{} s is outside {}, which lasts {:.2f} s", query.at_s,
                                   query.action, seconds(library.action(action).length())),
                       "give a time inside it");
  }
  HitAnswer answer;
  answer.body = make_body(query.body);
  Stage stage(library, {answer.body});
  Launch launch;
  launch.action = action;
  launch.end = library.action(action).length();
  Tick now = 0;
  stage.begin(kOnly, launch);
  stage.show(0);
  stage.keep_out_and_record();
  show_to(stage, now, at);

  ImpactInput& input = answer.input;
  input.pose = stage.shown(kOnly);
  input.pose_before = stage.shown_before(kOnly);
  input.tone = query.tone;
  input.contacts = library.action(action).clip.contacts_at(at);
  input.blow.part = query.part;
  input.blow.impulse = query.impulse;
  input.blow.point = point_of(answer.body, input.pose, query.part, query.impulse);
  const std::vector<Pose> continued = stage.continued(kOnly, now, kImpulseStepTicks + 2);
  input.continued = continued;
  answer.hit_tick = now;
  answer.outcome = impulse_step(answer.body, input);

  Answer shown = answer_to(library, answer.body, launch, now, input, answer.outcome);
  answer.response = library.action(shown.launch.action).name;
  Launch last = shown.launch;
  stage.begin(kOnly, last, std::move(shown.simulated));
  show_to(stage, now, last.end);
  if (answer.outcome.response == ResponseKind::knockdown && !answer.outcome.knockout) {
    last = get_up_from(library, answer.body, last, now, stage.shown(kOnly));
    stage.begin(kOnly, last);
    show_to(stage, now, last.end);
  }
  if (!answer.outcome.knockout) {
    const Vec3 ahead = root_at(library, last, now, answer.body.scale) * kForward;
    stage.begin(kOnly, following(library, last, resting_action(library, last.action), now, ahead,
                                 answer.body.scale, 0));
  }
  show_to(stage, now, now + kAfterwards);

  Event event;
  event.tick = answer.hit_tick;
  event.type = EventType::hit;
  event.who = kOnly;
  event.whom = kOnly;
  event.action = query.action;
  event.part = std::string(name_of(query.part));
  event.point = input.blow.point;
  event.impulse = query.impulse;
  event.head_spin = answer.outcome.head_spin;
  event.response = answer.outcome.response;
  event.steps = answer.outcome.steps;
  event.direction = answer.outcome.direction;
  event.knockout = answer.outcome.knockout;
  answer.timeline.events.push_back(event);
  event.type =
      event.response == ResponseKind::knockdown ? EventType::knockdown : EventType::response;
  event.action = answer.response;
  answer.timeline.events.push_back(event);
  answer.timeline.end = now;
  answer.timeline.tracks = stage.take_tracks();
  answer.input.continued = {};
  return answer;
}

}  // namespace ringcraft
