#include "scene/bout.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "base/random.h"
#include "physics/impact.h"
#include "physics/penetration.h"
#include "physics/response.h"
#include "physics/tone.h"
#include "planner/tree.h"
#include "scene/answer.h"
#include "scene/hit_replay.h"
#include "scene/stand_clear.h"

namespace ringcraft {

namespace {

using Clock = std::chrono::steady_clock;

double microseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

constexpr Tick kOpeningTicks = 24;  // in guard before the first decision
constexpr Tick kAfterKnockout = 3 * kTicksPerSecond;
constexpr Tick kForeseenTicks = 6;        // a contact so far from when it was foreseen is another
constexpr float kTouchingDepth = 0.006f;  // m: bodies deeper than this push each other apart
constexpr float kFallingSpeed = 1.0f;     // m/s: slower, a falling body leans on another
constexpr float kMostErrors = 2.5f;       // standard deviations of an error of execution
constexpr float kMostPush = 0.012f;       // m a tick and fighter
constexpr float kLyingHips = 0.5f;  // m, of a canonical body: hips of one that falls are higher

std::vector<BodyModel> bodies_of(const SceneFile& scene) {
  std::vector<BodyModel> bodies;
  for (const SceneFighter& fighter : scene.fighters) bodies.push_back(make_body(fighter.body));
  return bodies;
}

// The idle that opens a bout; every library has one, the builder sees to it.
ActionId opening_action(const MotionLibrary& library, Stance stance) {
  ActionId first;
  for (const ActionId id : library.launchable()) {
    if (library.action(id).stance != stance) continue;
    if (library.action(id).kind == Kind::idle) return id;
    if (!first.valid()) first = id;
  }
  assert(first.valid() && "a southpaw needs a library of both stances: library_for()");
  return first;
}

}  // namespace

Bout::Bout(const MotionLibrary& library, const SceneFile& scene, const FightOptions& options)
    : library_(library),
      scene_(scene),
      options_(options),
      standing_(scene.fighters.size()),
      stage_(library, bodies_of(scene), Repetitions::varied),
      end_(scene.duration) {
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < scene.fighters.size(); ++i) {
    contenders.push_back(
        {stage_.body(FighterId(i)), scene.fighters[i].style, scene.fighters[i].team});
    FighterState state;
    state.health = scene.fighters[i].health;
    state.launch.action = opening_action(library, scene.fighters[i].stance);
    state.launch.placement = scene.fighters[i].placement;
    state.launch.end = kOpeningTicks;
    state_.fighters.push_back(state);
  }
  PlanSettings settings = scene.planner;
  settings.threads = options.threads;
  planner_ = std::make_unique<Planner>(library, contenders, settings, scene.seed, options.impacts);
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    begin(FighterId(i), state_.fighters[i].launch);
    state_.fighters[i].opponent = nearest_opponent(FighterId(i));
  }
  stage_.show(0);
  stage_.keep_out_and_record();
}

Bout::~Bout() = default;

bool Bout::over() const {
  return state_.now >= end_ ||
         (options_.interrupted != nullptr && options_.interrupted->load(std::memory_order_relaxed));
}

bool Bout::must_get_up(FighterId id) const {
  return !is_out(id) && action_of(id).ends_lying != Lying::none;
}

bool Bout::is_out(FighterId id) const {
  return standing_[id.at()].out;
}

const Action& Bout::action_of(FighterId id) const {
  return library_.action(state_.fighters[id.at()].launch.action);
}

Vec3 Bout::ground_position(FighterId id) const {
  const Vec3 hips = stage_.shown(id).hips;
  return {hips.x, 0, hips.z};
}

bool Bout::enemies(FighterId a, FighterId b) const {
  return a != b && scene_.fighters[a.at()].team != scene_.fighters[b.at()].team;
}

FighterId Bout::nearest_opponent(FighterId id) const {
  FighterId nearest;
  float least = 0;
  const auto place = [&](FighterId f) {
    return root_at(library_, state_.fighters[f.at()].launch, state_.now, stage_.body(f).scale)
        .position();
  };
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const FighterId other(i);
    if (!enemies(id, other)) continue;
    // Who may not be struck where it lies is an opponent only where nobody else stands, who is out
    // only where nobody else is left.
    const bool spared = state_.fighters[i].down() && !scene_.planner.hits_on_downed;
    const float later = is_out(other) ? 2000.0f : spared ? 1000.0f : 0.0f;  // m
    const float distance = glm::distance(place(id), place(other)) + later;
    if (!nearest.valid() || distance < least) {
      nearest = other;
      least = distance;
    }
  }
  return nearest;
}

void Bout::begin(FighterId id, const Launch& launch, std::vector<Pose> simulated,
                 const Sway& sway) {
  if (fighter(id).launch.start < launch.start) note_open_strikes(id);
  fighter(id).launch = launch;
  launched_ = true;
  stage_.begin(id, launch, std::move(simulated), sway);
}

// What becomes of a planned launch: its blow goes aside, it is slower or faster, and slower still
// where the fighter is tired. The launch ends when its clip does.
Launch Bout::executed(FighterId id, Launch launch) const {
  if (launch.start != state_.now) return launch;  // goes on with what it does
  const Style& style = scene_.fighters[id.at()].style;
  const Action& action = library_.action(launch.action);
  Random random(derived_seed(scene_.seed, "execution", static_cast<std::uint64_t>(launch.start)),
                static_cast<std::uint64_t>(id.at()));
  const auto most = [](float value) { return std::clamp(value, -kMostErrors, kMostErrors); };
  const float aside = most(random.normal()) * radians(static_cast<float>(style.aim_error_deg));
  const float faster = most(random.normal()) * static_cast<float>(style.speed_error);
  if (action.attacks()) launch.aim += aside;
  launch.pace = Pace(action, (1 + faster) * standing_[id.at()].condition.pace());
  launch.end += launch.pace.reached(action.length()) - action.length();
  return launch;
}

// One tick of rest; the planner hears of it before its next decision.
void Bout::rest(FighterId id) {
  standing_[id.at()].condition.rest(static_cast<double>(kTickSeconds));
}

// Tells the planner what the fighter's launch looks like from now on.
void Bout::show_planner(FighterId id) {
  if (!id.valid()) return;
  MotionInFlight motion = stage_.in_flight(id, state_.now);
  motion.tone = standing_[id.at()].condition.tone();
  planner_->show(id, motion);
}

Plan Bout::decide(FighterId id) {
  fighter(id).opponent = nearest_opponent(id);
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    planner_->set_condition(FighterId(i), standing_[i].condition);
  }
  const auto begin = Clock::now();
  show_planner(id);
  show_planner(fighter(id).opponent);
  Plan plan = planner_->plan(state_, id);
  record_.decision_ms.push_back(microseconds_since(begin) / 1000);
  return plan;
}

DecisionTree Bout::tree(FighterId id, const Plan& plan, std::size_t most_nodes) const {
  return planner_->tree(state_, id, plan.record.horizon, most_nodes);
}

void Bout::commit(FighterId id, const Plan& plan) {
  note_expanded(state_, id);
  fighter(id).balance = 0;
  planner_->note_launch(id, plan.launch.action);
  planner_->note_habit(state_, id, plan.launch.action);
  const Launch launch = executed(id, plan.launch);
  begin(id, launch);
  standing_[id.at()].condition.launched(scene_.fighters[id.at()].style,
                                        planner_->work_of(id, launch.action));
  Event event;
  event.tick = state_.now;
  event.type = EventType::decision;
  event.who = id;
  event.whom = fighter(id).opponent;
  event.action = action_of(id).name;
  event.decision = plan.record;
  record_.timeline.events.push_back(std::move(event));
}

void Bout::commit_get_up(FighterId id) {
  note_expanded(state_, id);
  const Launch launch =
      get_up_from(library_, stage_.body(id), fighter(id).launch, state_.now, stage_.shown(id));
  begin(id, launch);
  Event event;
  event.tick = state_.now;
  event.type = EventType::getup;
  event.who = id;
  event.action = library_.action(launch.action).name;
  record_.timeline.events.push_back(std::move(event));
}

bool Bout::has_won(FighterId id) const {
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    if (enemies(id, FighterId(i)) && !is_out(FighterId(i))) return false;
  }
  return true;
}

void Bout::commit_idle(FighterId id) {
  fighter(id).balance = 0;
  const BodyModel& body = stage_.body(id);
  const std::vector<Launch> ways =
      ways_to_stand(library_, fighter(id).launch, state_.now, ground_position(fighter(id).opponent),
                    body.scale, scene_.ring);
  Tick until = state_.now;
  for (const Launch& way : ways) until = std::max(until, way.end);
  std::vector<Bystanding> others;
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const FighterId other(i);
    if (other == id) continue;
    others.push_back({&stage_.body(other), fighter(other).down(),
                      stage_.continued(other, state_.now, until - state_.now + 1)});
  }
  Launch launch = clearest(library_.of(id), body, state_.now, ways, others);
  launch.forced = true;  // nobody decides on it
  begin(id, launch);
}

void Bout::advance_one_tick() {
  if (launched_ || strikes_now()) foresee();
  ++state_.now;
  stage_.show(state_.now);
  if (options_.progress && state_.now % kTicksPerSecond == 0) options_.progress(state_.now, end_);
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    rest(FighterId(i));
    note_strikes(FighterId(i));
  }
  const std::vector<Touch> touching = touches();
  // First of all: who is struck and answers in this tick has landed its own blow all the same.
  for (const Touch& touch : touching) fighter(touch.attacker).launch.spend(touch.strike);
  for (const Touch& touch : touching) commit_touch(touch);
  commit_falls();
  stage_.keep_out_and_record();
  push_apart();
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) hold_in_ring(FighterId(i));
}

// Says when a blow is thrown, and when its time is over without a contact.
void Bout::note_strikes(FighterId id) {
  Launch& launch = fighter(id).launch;
  const Action& action = action_of(id);
  const Tick age = launch.clip_age(state_.now);
  const Tick before = launch.clip_age(state_.now - 1);
  for (std::size_t i = 0; i < action.strikes.size(); ++i) {
    const Strike& strike = action.strikes[i];
    const auto reached = [&](Tick tick) { return before < tick && age >= tick; };
    const bool begins = reached(strike.active_begin);
    const bool missed = reached(strike.active_end) && !launch.has_spent(i);
    if (begins || missed)
      note_strike(begins ? EventType::strike : EventType::miss, id, action, strike);
    if (missed) launch.spend(i);
  }
}

// An action is over, cut short it may be, or the bout is: its blows that are on their way land no
// more.
void Bout::note_open_strikes(FighterId id) {
  Launch& launch = fighter(id).launch;
  const Action& action = action_of(id);
  const Tick age = launch.clip_age(state_.now);
  for (std::size_t i = 0; i < action.strikes.size(); ++i) {
    if (!action.strikes[i].active(age) || launch.has_spent(i)) continue;
    note_strike(EventType::miss, id, action, action.strikes[i]);
    launch.spend(i);
  }
}

void Bout::note_strike(EventType type, FighterId id, const Action& action, const Strike& strike) {
  Event event;
  event.tick = state_.now;
  event.type = type;
  event.who = id;
  event.whom = fighter(id).opponent;
  event.action = action.name;
  event.strike = strike.kind;
  event.fatigue = static_cast<float>(standing_[id.at()].condition.fatigue());
  record_.timeline.events.push_back(std::move(event));
}

// Nobody strikes a team mate, nor, where the scene says so, whoever is down.
bool Bout::may_strike(FighterId attacker, FighterId target) const {
  const bool spared = state_.fighters[target.at()].down() && !scene_.planner.hits_on_downed;
  return enemies(attacker, target) && !spared;
}

// Whoever it is that the strike meets first.
std::optional<Bout::Touch> Bout::touch_of(FighterId attacker, std::size_t strike) const {
  std::optional<Touch> first;
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const FighterId target(i);
    if (target == attacker) continue;
    const auto contact = strike_contact(stage_.swept(attacker), action_of(attacker).strikes[strike],
                                        stage_.swept(target));
    if (contact && (!first || contact->share < first->contact.share)) {
      first =
          Touch{attacker, target, state_.fighters[attacker.at()].launch.action, strike, *contact};
    }
  }
  return first;
}

std::vector<Bout::Touch> Bout::touches() const {
  std::vector<Touch> found;
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const Launch& launch = state_.fighters[i].launch;
    const Action& action = library_.action(launch.action);
    const Tick age = launch.clip_age(state_.now);
    for (std::size_t s = 0; s < action.strikes.size(); ++s) {
      if (!action.strikes[s].active(age) || launch.has_spent(s)) continue;
      if (auto touch = touch_of(FighterId(i), s)) found.push_back(*touch);
    }
  }
  return found;
}

// A blow on somebody, or one that a body which nobody strikes stops: it is over there.
void Bout::commit_touch(const Touch& touch) {
  const FighterId attacker = touch.attacker, target = touch.target;
  const Action& attack = library_.action(touch.action);
  const Strike strike = attack.strikes.at(touch.strike);
  if (!may_strike(attacker, target)) {
    note_strike(EventType::miss, attacker, attack, strike);
    if (fighter(attacker).launch.action == touch.action) stage_.land(attacker, touch.contact);
    return;
  }
  Event event;
  event.action = attack.name;
  event.strike = strike.kind;
  deliver(attacker, target,
          blow_of(stage_.body(attacker), stage_.shown(attacker), stage_.body(target),
                  stage_.shown(target), touch.contact, strike.kind),
          event);
  if (fighter(attacker).launch.action == touch.action) stage_.land(attacker, touch.contact);
}

// A body that falls upon another hits it, once a fall.
void Bout::commit_falls() {
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const FighterId faller(i);
    if (!fighter(faller).down() || !stage_.simulated(faller)) continue;
    for (std::size_t j = 0; j < state_.fighters.size(); ++j) {
      const FighterId other(j);
      std::uint32_t& met = standing_[i].fell_upon;
      if (i == j || fighter(other).down() || (met >> j & 1u)) continue;
      const auto contact = fall_contact(stage_.swept(faller), stage_.swept(other), kFallingSpeed);
      if (!contact) continue;
      const Blow blow = blow_of_fall(stage_.body(faller), stage_.shown(faller), stage_.body(other),
                                     stage_.shown(other), *contact);
      if (glm::length(blow.impulse) < kTouchImpulse) continue;
      met |= 1u << j;
      Event event;
      event.action = action_of(faller).name;
      event.fall = true;
      deliver(faller, other, blow, event);
    }
  }
}

// The blow as an event, what it costs, and the response.
void Bout::deliver(FighterId attacker, FighterId target, const Blow& blow, Event event) {
  fighter(attacker).last_contact = fighter(target).last_contact = state_.now;

  // 1. What the struck body does with the impulse in 100 ms.
  ImpactInput input;
  input.pose = stage_.shown(target);
  input.pose_before = stage_.shown_before(target);
  const std::vector<Pose> continued = stage_.continued(target, state_.now, kImpulseStepTicks + 2);
  input.continued = continued;
  input.blow = blow;
  const Tick age = fighter(target).launch.clip_age(state_.now);
  input.contacts = action_of(target).clip.contacts_at(age);
  input.tone = standing_[target.at()].condition.tone() * tone_left(action_of(target), age);
  const auto begin = Clock::now();
  ImpactOutcome outcome = impulse_step(stage_.body(target), input);
  record_.impulse_step_us.push_back(microseconds_since(begin));
  ++record_.counts.impacts;
  std::string replay = replay_text(stage_.body(target), input, outcome, fighter(target).health);

  // 2. What it costs. Nobody stands without health.
  const std::int32_t damage = damage_of(input.blow, outcome);
  fighter(target).health = std::max(0, fighter(target).health - damage);
  standing_[target.at()].condition.struck(scene_.fighters[target.at()].style, blow.part,
                                          damage / 1000.0);
  if (fighter(target).health == 0) {
    outcome.response = ResponseKind::knockdown;
    outcome.knockout = true;
  }

  const bool cuts = interrupts(blow.blocked, glm::length(input.blow.impulse), outcome);
  outcome = answered(cuts, outcome);

  // 3. The record, and the response as the struck fighter's next action.
  event.tick = state_.now;
  event.type = blow.blocked ? EventType::block : EventType::hit;
  event.who = attacker;
  event.whom = target;
  event.part = std::string(name_of(input.blow.part));
  event.point = input.blow.point;
  event.impulse = input.blow.impulse;
  event.speed = input.blow.speed;
  event.effective_mass = input.blow.effective_mass;
  event.head_spin = outcome.head_spin;
  event.damage = static_cast<float>(damage) / 1000;
  event.response = outcome.response;
  event.steps = outcome.steps;
  event.direction = outcome.direction;
  event.knockout = outcome.knockout;
  event.fatigue = static_cast<float>(standing_[attacker.at()].condition.fatigue());
  note_foreseen(event);
  record_.timeline.events.push_back(event);
  record_.timeline.events.back().replay = std::move(replay);
  if (!cuts && is_guard_part(blow.part)) {
    stage_.drive_back(target, blow.part, struck_velocity(blow));
  }
  const bool goes_on =
      !cuts || (outcome.response == ResponseKind::absorb &&
                rises(library_, stage_.body(target), fighter(target).launch, input));
  if (goes_on) return;
  respond(target, input, outcome, event);
  standing_[target.at()].fell_upon = 1u << attacker.at();  // whose own blow still presses on
}

void Bout::respond(FighterId id, const ImpactInput& input, ImpactOutcome outcome, Event& event) {
  Launch& cut = fighter(id).launch;
  cut.end = state_.now;
  const bool down = falls_already(library_, stage_.body(id), cut, input);
  const bool falls = down || outcome.response == ResponseKind::knockdown;
  outcome.knockout = outcome.knockout || is_out(id);  // who is out stays limp
  Answer answer = answer_to(library_, stage_.body(id), cut, state_.now, input, outcome);
  const Launch launch = answer.launch;
  begin(id, launch, std::move(answer.simulated), answer.sway);
  if (falls && !down) let_off(id);
  fighter(id).balance = falls ? 2 : outcome.response == ResponseKind::recovery_steps ? 1 : 0;

  event.fall = false;
  event.type = falls && !down ? EventType::knockdown : EventType::response;
  event.who = id;
  event.whom = {};
  event.action = library_.action(launch.action).name;
  event.damage = 0;
  record_.timeline.events.push_back(event);
  if (outcome.knockout) put_out(id);
}

// Who is out lies to the end of the bout, which comes soon where nobody has an enemy left.
void Bout::put_out(FighterId id) {
  Tick& end = fighter(id).launch.end;
  const Tick at_rest = std::exchange(end, kNever);
  if (is_out(id)) return;
  standing_[id.at()].out = true;
  bool over = true;
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    over = over && (is_out(FighterId(i)) || has_won(FighterId(i)));
  }
  if (over) end_ = std::min(end_, at_rest + kAfterKnockout);
}

// Whoever fights `fallen` throws no more at it than what is on its way.
void Bout::let_off(FighterId fallen) {
  if (scene_.planner.hits_on_downed) return;
  for (FighterState& one : state_.fighters) {
    if (one.opponent != fallen) continue;
    one.launch.end = free_after_fall(library_.action(one.launch.action), one.launch, state_.now);
  }
}

// Whether a blow may land in the next tick.
bool Bout::strikes_now() const {
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    const Tick age = state_.fighters[i].launch.clip_age(state_.now + 1);
    const std::vector<Strike>& strikes = action_of(FighterId(i)).strikes;
    for (std::size_t s = 0; s < strikes.size(); ++s) {
      if (strikes[s].active(age) && !state_.fighters[i].launch.has_spent(s)) return true;
    }
  }
  return false;
}

// What the tree says of the strikes in flight: when somebody has begun something new, and anew
// before every tick in which a blow may land, since where the bodies are has changed by then.
void Bout::foresee() {
  for (std::size_t i = 0; i < standing_.size(); ++i) show_planner(FighterId(i));
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    standing_[i].foreseen = planner_->foresee(state_, FighterId(i));
    if (launched_) standing_[i].foreseen_at_launch = standing_[i].foreseen;
  }
  launched_ = false;
}

// Did the tree foresee this contact, and the same kind of response?
void Bout::note_foreseen(Event& event) {
  if (event.fall) return;  // the tree knows strikes only
  const auto told = [&](const std::vector<Event>& foreseen) {
    const auto found = std::find_if(foreseen.begin(), foreseen.end(), [&](const Event& one) {
      return one.type != EventType::miss && one.whom == event.whom && one.strike == event.strike &&
             std::abs(one.tick - event.tick) <= kForeseenTicks;
    });
    return found != foreseen.end() ? &*found : nullptr;
  };
  const Standing& standing = standing_[event.who.at()];
  if (const Event* one = told(standing.foreseen)) {
    ++record_.counts.foreseen;
    event.foreseen = one->response == event.response;
  }
  const Event* early = told(standing.foreseen_at_launch);
  if (early != nullptr && early->response == event.response) ++record_.counts.agreed_at_launch;
}

void Bout::shift(FighterId id, Vec3 offset) {
  stage_.shift(id, offset);
  fighter(id).launch.placement = stage_.launch(id).placement;
}

// A body comes after a foot of its own that had to stand beside another one.
void Bout::follow_feet(FighterId id) {
  Vec3& left = standing_[id.at()].aside;
  left += stage_.taken_aside(id);
  const float far = glm::length(left);
  if (far == 0) return;
  const Vec3 step = left * std::min(1.0f, kMostPush / far);
  left -= step;
  shift(id, step);
}

// The ropes hold whom steps or a blow carry into them; who lies is let be.
void Bout::hold_in_ring(FighterId id) {
  if (scene_.ring <= 0 || !gives_way(id)) return;
  const float inside = scene_.ring / 2 - kInsideRopes;
  const Vec3 at = ground_position(id);
  const auto back = [&](float x) {
    return std::clamp(std::clamp(x, -inside, inside) - x, -kMostPush, kMostPush);
  };
  const Vec3 offset{back(at.x), 0, back(at.z)};
  if (offset != Vec3{}) shift(id, offset);
}

// Who stands, and who is on the way down; not who lies or gets up.
bool Bout::gives_way(FighterId id) const {
  if (!state_.fighters[id.at()].down()) return true;
  return stage_.simulated(id) && stage_.shown(id).hips.y > kLyingHips * stage_.body(id).scale;
}

// Bodies that press into each other, or of which one wedges a limb of the other, give way on the
// ground, each by half, or the one that can by all; a strike's own contact is left to its impulse.
void Bout::push_apart() {
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) follow_feet(FighterId(i));
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    for (std::size_t j = i + 1; j < state_.fighters.size(); ++j) {
      const FighterId a(i), b(j);
      const auto excepted = [&](FighterId id, FighterId other) {
        if (!may_strike(id, other)) return 0u;
        const Tick age = fighter(id).launch.clip_age(state_.now);
        std::uint32_t parts = 0;
        for (const Strike& strike : action_of(id).strikes) {
          if (age < strike.active_end) parts |= striking_parts(strike);
        }
        return parts;
      };
      const Penetration deepest = deepest_penetration(stage_.swept(a).after, stage_.swept(b).after,
                                                      excepted(a, b), excepted(b, a));
      const float press =
          std::max({deepest.depth - kTouchingDepth, stage_.wedged(a, b), stage_.wedged(b, a)});
      if (press <= 0) continue;
      const Vec3 apart = normalized_or(ground_position(b) - ground_position(a), kForward);
      const float shares = (gives_way(a) ? 1.0f : 0.0f) + (gives_way(b) ? 1.0f : 0.0f);
      for (const auto& [id, sign] : {std::pair{a, -1.0f}, std::pair{b, 1.0f}}) {
        if (!gives_way(id)) continue;
        const float push = std::min(kMostPush, press / shares);
        shift(id, apart * (push * sign));
      }
    }
  }
}

FightRecord Bout::record() {
  record_.interrupted = options_.interrupted != nullptr && options_.interrupted->load();
  record_.timeline.end = state_.now;
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) note_open_strikes(FighterId(i));
  record_.timeline.tracks = stage_.take_tracks();
  for (std::size_t i = 0; i < state_.fighters.size(); ++i) {
    record_.bodies.push_back(stage_.body(FighterId(i)));
    record_.condition.push_back(standing_[i].condition);
  }
  const Planner::MemoCounts memo = planner_->memo_counts();
  record_.counts.memo_hits = memo.hits;
  record_.counts.memo_misses = memo.misses;
  record_.counts.impulse_steps = record_.counts.impacts + memo.misses;
  return std::move(record_);
}

}  // namespace ringcraft
