#include "scene/single_hit.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "motion/strike_fit.h"
#include "physics/response.h"
#include "physics/tone.h"
#include "scene/answer.h"
#include "scene/fitted_library.h"
#include "scene/hit_replay.h"
#include "scene/placed_strike.h"
#include "scene/stage.h"

namespace ringcraft {

namespace {

constexpr Tick kAfterwards = kTicksPerSecond;  // shown after the response
constexpr FighterId kStruck = StrikeQuery::kStruck, kAttacker = StrikeQuery::kAttacker;
constexpr float kFacingTurn = radians(15);  // most, toward the other, in one idle
constexpr std::size_t kMostTried = 40;      // places whose whole motion is tried
constexpr std::int32_t kNoHealth = std::numeric_limits<std::int32_t>::max();  // none is counted

// Where the impulse meets the part: on its surface, on the side it comes from.
Vec3 point_of(const BodyModel& body, const Pose& pose, Part part, Vec3 impulse) {
  const Capsule capsule = capsules(body, world_pose(body.skeleton, pose))[index(part)];
  return (capsule.a + capsule.b) * 0.5f - normalized_or(impulse, Vec3{}) * capsule.radius;
}

// An idle that can follow, for what is shown after the response: the one `before` it, if any.
ActionId resting_action(const MotionLibrary& library, ActionId after, ActionId before) {
  if (before.valid() && library.machine().edge(after, before) != nullptr) return before;
  for (const Edge& edge : library.machine().edges(after)) {
    if (library.action(edge.to).kind == Kind::idle) return edge.to;
  }
  for (const Edge& edge : library.machine().edges(after)) {
    if (library.action(edge.to).kind == Kind::transition) return edge.to;
  }
  return library.machine().edges(after).front().to;
}

// Who is on stage, and what each does when nothing else is asked of it.
class Showing {
 public:
  Showing(const MotionLibrary& library, std::vector<BodyModel> bodies)
      : library_(library), stage_(library, std::move(bodies)) {}

  Stage& stage() { return stage_; }
  Tick now() const { return now_; }

  void begin(FighterId id, ActionId action, Tick start, const Placement& placement) {
    Launch launch;
    launch.action = action;
    launch.start = start;
    launch.end = start + library_.action(action).length();
    launch.placement = placement;
    stage_.begin(id, launch);
    if (library_.action(action).kind == Kind::idle) rest_[id.at()] = action;
  }

  // Shows one tick, up to where contacts are looked for; `settle` completes it.
  void show_next() {
    ++now_;
    for (std::size_t i = 0; i < stage_.size(); ++i) go_on(FighterId(i));
    stage_.show(now_);
  }
  void show_first() { stage_.show(0); }
  void settle() { stage_.keep_out_and_record(); }
  ImpactInput input_of(FighterId id, std::vector<Pose>& continued) const {
    const Launch& launch = stage_.launch(id);
    ImpactInput input;
    input.pose = stage_.shown(id);
    input.pose_before = stage_.shown_before(id);
    const Action& action = library_.action(launch.action);
    input.contacts = action.clip.contacts_at(now_ - launch.start);
    input.tone = tone_left(action, now_ - launch.start);
    continued = stage_.continued(id, now_, kImpulseStepTicks + 2);
    input.continued = continued;
    return input;
  }

  float facing(FighterId id) const {
    return root_at(library_, stage_.launch(id), now_, stage_.body(id).scale).yaw;
  }

  // What the struck body does in place of what it was doing, once it was hit.
  void answer(Answer answer, bool knockout) {
    lies_ = lies_ || knockout;
    answers_until_ = answer.launch.end;
    stage_.begin(kStruck, answer.launch, std::move(answer.simulated), answer.sway);
  }
  // A moment after the last answer, and the get-up after a fall, are over.
  Tick end() const { return std::max(answers_until_, last_hit_) + kAfterwards; }
  void note_hit() { last_hit_ = now_; }
  bool lies() const { return lies_; }

 private:
  // Gets up from where it was felled, and rests where its action is over.
  void go_on(FighterId id) {
    const Launch last = stage_.launch(id);
    const Tick shown = now_ - 1;
    if (shown < last.end || (id == kStruck && lies_)) return;
    if (library_.action(last.action).ends_lying != Lying::none) {
      if (!last.forced) return;
      const Launch up = get_up_from(library_, stage_.body(id), last, shown, stage_.shown(id));
      answers_until_ = up.end;
      stage_.begin(id, up);
      return;
    }
    if (library_.machine().edges(last.action).empty()) return;
    const float scale = stage_.body(id).scale;
    const Placement root = root_at(library_, last, shown, scale);
    Vec3 ahead = root * kForward;
    if (stage_.size() > 1) ahead = stage_.shown(FighterId(1 - id.at())).hips;
    stage_.begin(
        id, following(library_, last, resting_action(library_, last.action, rest_[id.at()]), shown,
                      ahead, scale, stage_.size() > 1 ? kFacingTurn : 0));
  }

  const MotionLibrary& library_;
  Stage stage_;
  std::array<ActionId, 2> rest_{};  // the idle that each was in, if any
  Tick now_ = 0;
  Tick answers_until_ = 0, last_hit_ = 0;
  bool lies_ = false;  // knocked out
};

struct Interrupted {
  ActionId action;
  Tick at = 0;
};

Result<Interrupted> interrupted_action(const MotionLibrary& library, const HitQuery& query) {
  const ActionId action = library.find(query.action);
  if (!action.valid()) {
    return usage_error("", "--pose",
                       fmt::format("no action '{}' in library {}", query.action, library.name()),
                       "`ringcraft library inspect` lists them");
  }
  const double length = seconds(library.action(action).length());
  if (!(query.at_s >= 0 && query.at_s <= length)) {
    return usage_error(
        "", "--pose",
        fmt::format("{} s is outside {}, which lasts {:.2f} s", query.at_s, query.action, length),
        "give a time inside it");
  }
  return Interrupted{action, ticks(query.at_s)};
}

// What the blow does: the impulse step, the record, the answer. The first one of `answer` is what
// it tells in numbers.
void strike(const MotionLibrary& library, const HitQuery& query, Showing& showing,
            const ImpactInput& input, StrikeKind kind, HitAnswer& answer) {
  Stage& stage = showing.stage();
  const Launch cut = stage.launch(kStruck);
  const BodyModel& body = answer.bodies.front();
  ImpactOutcome outcome = impulse_step(body, input);

  Event event;
  event.tick = showing.now();
  event.type = input.blow.blocked ? EventType::block : EventType::hit;
  event.who = query.strike.empty() ? kStruck : kAttacker;
  event.whom = kStruck;
  event.action = query.strike.empty() ? query.action : query.strike;
  event.part = std::string(name_of(input.blow.part));
  event.strike = kind;
  event.point = input.blow.point;
  event.impulse = input.blow.impulse;
  event.speed = input.blow.speed;
  event.effective_mass = input.blow.effective_mass;
  event.head_spin = outcome.head_spin;
  event.damage = static_cast<float>(damage_of(input.blow, outcome)) / 1000;
  std::string replay = replay_text(body, input, outcome, kNoHealth);
  // Who is only touched goes on, and so does a guard that holds a blow.
  const bool cuts = interrupts(input.blow.blocked, glm::length(input.blow.impulse), outcome);
  outcome = answered(cuts, outcome);
  event.response = outcome.response;
  event.steps = outcome.steps;
  event.direction = outcome.direction;
  event.knockout = outcome.knockout;
  answer.timeline.events.push_back(event);
  answer.timeline.events.back().replay = std::move(replay);
  showing.note_hit();

  std::string response = library.action(cut.action).name;
  const bool goes_on =
      !cuts || (outcome.response == ResponseKind::absorb && rises(library, body, cut, input));
  if (!goes_on) {
    const bool down = falls_already(library, body, cut, input);
    ImpactOutcome shows = outcome;
    shows.knockout = shows.knockout || showing.lies();  // who is out stays limp
    Answer shown = answer_to(library, body, cut, showing.now(), input, shows);
    response = library.action(shown.launch.action).name;
    const bool falls = event.response == ResponseKind::knockdown && !down;
    event.type = falls ? EventType::knockdown : EventType::response;
    event.who = kStruck;
    event.whom = {};
    event.action = response;
    answer.timeline.events.push_back(event);
    showing.answer(std::move(shown), outcome.knockout);
  } else if (!cuts && is_guard_part(input.blow.part)) {
    stage.drive_back(kStruck, input.blow.part, struck_velocity(input.blow));
  }
  if (++answer.hits > 1) return;
  answer.hit_tick = showing.now();
  answer.at_s = static_cast<float>(seconds(answer.hit_tick - cut.start));
  answer.outcome = outcome;
  answer.response = response;
  answer.input = input;
  answer.input.continued = {};
}

void take(Showing& showing, HitAnswer& answer) {
  answer.timeline.end = showing.now();
  answer.timeline.tracks = showing.stage().take_tracks();
}

// The stage with the body at its pose, contacts of this tick not yet settled.
void show_pose(Showing& showing, const Interrupted& cut) {
  showing.begin(kStruck, cut.action, 0, {});
  showing.show_first();
  while (showing.now() < cut.at) {
    showing.settle();
    showing.show_next();
  }
}

// Tries one place in the whole motion. Nothing where the blow does not meet as wished after all.
std::optional<HitAnswer> strike_from(const MotionLibrary& library, const HitQuery& query,
                                     const Interrupted& cut, const StrikePlace& place, Met least) {
  HitAnswer answer;
  answer.bodies = {make_body(query.body), make_body(query.attacker)};
  const ActionId attack = library.find(query.strike);
  const std::vector<Strike>& strikes = library.of(kAttacker).action(attack).strikes;
  const Tick hit = std::max(cut.at, place.age);
  Launch target;
  target.action = cut.action;
  const Placement root = root_at(library.of(kStruck), target, cut.at, answer.bodies[0].scale);

  Showing showing(library, answer.bodies);
  Stage& stage = showing.stage();
  const Tick attack_start = hit - place.age;
  showing.begin(kStruck, cut.action, hit - cut.at, {});
  showing.begin(kAttacker, attack, attack_start, attacker_placement(root, place.distance));
  showing.show_first();
  std::vector<bool> landed(strikes.size());
  showing.settle();
  while (answer.hits == 0 || showing.now() < showing.end()) {
    const Tick age = showing.now() + 1 - attack_start;
    if (answer.hits == 0 && age >= strikes.front().active_end) return std::nullopt;
    showing.show_next();
    for (std::size_t s = 0; s < strikes.size(); ++s) {
      if (landed[s] || !strikes[s].active(age)) continue;
      const auto contact = strike_contact(stage.swept(kAttacker), strikes[s], stage.swept(kStruck));
      if (!contact) continue;
      // The first one has to meet as wished, the others what they meet.
      if (answer.hits == 0 && (s > 0 || met_by(*contact, strikes[s], query.part) > least)) {
        return std::nullopt;
      }
      landed[s] = true;
      std::vector<Pose> continued;
      ImpactInput input = showing.input_of(kStruck, continued);
      input.tone *= query.tone;
      input.blow = blow_of(answer.bodies[1], stage.shown(kAttacker), answer.bodies[0], input.pose,
                           *contact, strikes[s].kind);
      stage.land(kAttacker, *contact);
      strike(library, query, showing, input, strikes[s].kind, answer);
    }
    showing.settle();
  }
  answer.distance = place.distance;
  take(showing, answer);
  return answer;
}

// Impulse times speed of the blow as the clips alone would have it, J: what an attacker looks for.
float work_of(const StrikeQuery& where, const StrikePlace& place) {
  const MotionLibrary &struck_does = where.library.of(kStruck),
                      &attacker_does = where.library.of(kAttacker);
  Launch target, attacker;
  target.action = where.target_action;
  attacker.action = where.attack;
  attacker.placement = attacker_placement(
      root_at(struck_does, target, where.target_age, where.target.scale), place.distance);
  const Pose struck = pose_at(struck_does, target, where.target_age, where.target.scale);
  const Pose striking = pose_at(attacker_does, attacker, place.age, where.attacker.scale);
  const StrikeKind kind = where.library.action(where.attack).strikes.front().kind;
  const Blow blow = blow_of(where.attacker, striking, where.target, struck, place.contact, kind);
  return glm::length(blow.impulse) * blow.speed;
}

// Bodies of unequal height do what is fitted to the other, as in a fight (library_for).
std::optional<MotionLibrary> fitted_pair(const MotionLibrary& library, const HitQuery& query) {
  const float ratio = query.body.height / query.attacker.height;  // as the attacker sees it
  if (as_tall(ratio) && as_tall(1 / ratio)) return std::nullopt;
  const auto fit = [&](float seen) {
    return std::make_shared<const MotionLibrary>(fitted_library(library, seen));
  };
  return library.with_fits({fit(1 / ratio), fit(ratio)});
}

Result<HitAnswer> simulate_strike(const MotionLibrary& library, const HitQuery& query,
                                  const Interrupted& cut) {
  const ActionId attack = library.find(query.strike);
  if (!attack.valid() || library.action(attack).strikes.empty()) {
    return usage_error(
        "", "--strike",
        fmt::format("{} '{}' in library {}", attack.valid() ? "no blow in the action" : "no action",
                    query.strike, library.name()),
        "`ringcraft library inspect` lists the attacks");
  }
  if (library.of(kAttacker).action(attack).left_out) {
    return usage_error("", "--strike",
                       fmt::format("{} cannot be thrown by a body of {:.2f} m at one of {:.2f} m",
                                   query.strike, query.attacker.height, query.body.height),
                       "choose another attack, or bodies that are more alike");
  }
  const BodyModel target = make_body(query.body), attacker = make_body(query.attacker);
  const StrikeQuery where{library, target, attacker, cut.action, cut.at, attack};
  const Strike& strike = library.of(kAttacker).action(attack).strikes.front();
  struct Candidate {
    Met met;
    float work;
    StrikePlace place;
  };
  std::vector<Candidate> candidates;
  const std::vector<StrikePlace> places = strike_places(where, query.distance);
  for (const StrikePlace& place : places) {
    const Met met = met_by(place.contact, strike, query.part);
    if (met == Met::anything && !query.distance) continue;
    candidates.push_back({met, work_of(where, place), place});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.met != b.met ? a.met < b.met : a.work > b.work;
  });
  if (candidates.size() > kMostTried) candidates.resize(kMostTried);
  for (const Candidate& c : candidates) {
    const Met least = query.distance ? Met::anything : c.met;
    if (auto answer = strike_from(library, query, cut, c.place, least)) return std::move(*answer);
  }
  const std::string all = met_parts(query.distance ? strike_places(where, {}) : places);
  const std::string from = query.distance
                               ? fmt::format("from {} m", *query.distance)
                               : fmt::format("from any distance up to {} m", kFarthestPlace);
  std::string remedy = "it meets nothing of that pose; choose another one";
  if (!all.empty()) remedy = "it meets " + all;
  // From where the clips alone would meet, a limb in the way has held the blow off.
  if (!candidates.empty()) {
    remedy = "on its way it is held off; the clip alone meets " + all + ": choose another moment";
  }
  return usage_error(
      "", "--strike",
      fmt::format("{} does not land on the {} of {} at {:.2f} s {}", query.strike,
                  query.distance ? "body" : name_of(query.part), query.action, query.at_s, from),
      remedy);
}

}  // namespace

Result<HitAnswer> simulate_hit(const MotionLibrary& library, const HitQuery& query) {
  const auto cut = interrupted_action(library, query);
  if (!cut) return tl::unexpected(cut.error());
  if (!query.strike.empty()) {
    const auto pair = fitted_pair(library, query);
    return simulate_strike(pair ? *pair : library, query, *cut);
  }
  HitAnswer answer;
  answer.bodies = {make_body(query.body)};
  Showing showing(library, answer.bodies);
  show_pose(showing, *cut);
  std::vector<Pose> continued;
  ImpactInput input = showing.input_of(kStruck, continued);
  input.tone *= query.tone;
  input.blow.part = query.part;
  input.blow.impulse = yaw_rotation(showing.facing(kStruck)) * query.impulse;
  input.blow.point = point_of(answer.bodies[0], input.pose, query.part, input.blow.impulse);
  strike(library, query, showing, input, {}, answer);
  showing.settle();
  while (showing.now() < showing.end()) {
    showing.show_next();
    showing.settle();
  }
  take(showing, answer);
  return answer;
}

Result<PosedBody> posed_body(const MotionLibrary& library, const HitQuery& query) {
  const auto cut = interrupted_action(library, query);
  if (!cut) return tl::unexpected(cut.error());
  PosedBody posed;
  posed.body = make_body(query.body);
  Showing showing(library, {posed.body});
  show_pose(showing, *cut);
  posed.input = showing.input_of(kStruck, posed.continued);
  posed.input.continued = {};
  posed.facing = showing.facing(kStruck);
  return posed;
}

ImpactInput with_impulse(const PosedBody& posed, Part part, Vec3 impulse, float tone) {
  ImpactInput input = posed.input;
  input.continued = posed.continued;
  input.tone *= tone;
  input.blow.part = part;
  input.blow.impulse = yaw_rotation(posed.facing) * impulse;
  input.blow.point = point_of(posed.body, input.pose, part, input.blow.impulse);
  return input;
}

}  // namespace ringcraft
