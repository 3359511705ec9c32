#include "planner/impact_memo.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "physics/partial.h"
#include "physics/response.h"

namespace ringcraft {
namespace {

int turn_step(float yaw, int steps) {
  const float turn = 2 * kPi / static_cast<float>(steps);
  const int step = static_cast<int>(std::lround(wrapped_angle(yaw) / turn));
  return (step % steps + steps) % steps;
}
float turn_of(int step, int steps) {
  return wrapped_angle(static_cast<float>(step) * 2 * kPi / static_cast<float>(steps));
}

int elevation_step(Vec3 direction) {
  const float sine = std::clamp(direction.y / std::max(1e-6f, glm::length(direction)), -1.0f, 1.0f);
  return static_cast<int>(std::clamp<long>(std::lround(std::asin(sine) / radians(45)), -1, 1)) + 1;
}

Vec3 direction_of(int azimuth, int azimuths, int elevation) {
  const float up = static_cast<float>(elevation - 1) * radians(45);
  return yaw_rotation(turn_of(azimuth, azimuths)) * Vec3(0, std::sin(up), std::cos(up));
}

int step_of(float value, float step, int most) {
  return static_cast<int>(std::clamp<long>(std::lround(value / step), 0, most));
}

// Appends the low `bits` bits of a field.
class Packer {
 public:
  Packer& add(std::int64_t value, int bits) {
    const auto field = static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << bits) - 1);
    if (used_ + bits > 64) word_ = &b_, used_ = 0;
    *word_ |= field << used_;
    used_ += bits;
    return *this;
  }
  std::uint64_t a() const { return a_; }
  std::uint64_t b() const { return b_; }

 private:
  std::uint64_t a_ = 0, b_ = 0;
  std::uint64_t* word_ = &a_;
  int used_ = 0;
};

// What an answer depends on beyond the steps: the actions, the body and the sizes of the steps.
std::uint64_t world_of(const MotionTables& tables, const MemoSteps& size) {
  const BodySpec& spec = tables.body().spec;
  Hasher hasher;
  hasher.add(tables.library().hash()).add(spec.height).add(spec.mass).add(spec.sex);
  hasher.add(spec.toughness).add(size.ticks).add(size.azimuths).add(size.impulse);
  return hasher.digest();
}

}  // namespace

ImpactMemo::Key ImpactMemo::key_of(const ImpulseSteps& steps) const {
  Packer p;
  p.add(steps.moment.action.value, 20).add(steps.moment.age, 12);
  p.add(static_cast<int>(steps.struck), 5).add(steps.blocked ? 1 : 0, 1);
  p.add(steps.azimuth, 5).add(steps.elevation, 3).add(steps.impulse, 10);
  p.add(steps.place.along, 2).add(steps.place.beside, 3).add(steps.tone, 7);
  return {p.a(), p.b(), worlds_[static_cast<std::size_t>(steps.victim)]};
}

ImpactMemo::ImpactMemo(std::vector<const MotionTables*> bodies, const MemoSteps& steps,
                       std::shared_ptr<ImpactStore> store)
    : bodies_(std::move(bodies)), size_(steps), store_(std::move(store)) {
  classes_.reserve(bodies_.size());
  worlds_.reserve(bodies_.size());
  for (const MotionTables* tables : bodies_) {
    classes_.emplace_back(*tables, size_.ticks);
    worlds_.push_back(world_of(*tables, size_));
  }
}

ImpactMemo::BlowPlace ImpactMemo::place_of(const Capsule& struck, Vec3 line, Vec3 point) {
  const Vec3 axis = struck.b - struck.a, from_middle = point - (struck.a + struck.b) * 0.5f;
  const float half = glm::length(axis) / 2;
  const Vec3 left = normalized_or(glm::cross(kUp, line), kLeft);
  const float along = half > 0.02f ? glm::dot(from_middle, axis) / (2 * half * half) : 0.0f;
  const float beside = glm::dot(from_middle, left) / struck.radius;
  return {static_cast<int>(std::lround(std::clamp(along, -1.0f, 1.0f))),
          static_cast<int>(std::lround(2 * std::clamp(beside, -1.0f, 1.0f)))};
}

Vec3 ImpactMemo::point_of(const Capsule& struck, Vec3 line, BlowPlace place) {
  constexpr float kEnd = 0.7f;  // of the half axis, where a blow meets an end of the part
  const Vec3 left = normalized_or(glm::cross(kUp, line), kLeft);
  const float beside = std::min(0.9f, std::abs(static_cast<float>(place.beside)) / 2);
  const Vec3 middle = (struck.a + struck.b) * 0.5f +
                      (struck.b - struck.a) * (0.5f * kEnd * static_cast<float>(place.along));
  return middle + left * (std::copysign(beside, static_cast<float>(place.beside)) * struck.radius) -
         line * (std::sqrt(1 - beside * beside) * struck.radius);
}

// Both bodies are rigid pictures of their tables: what they offer is asked in their action spaces.
template <class Mobility>
Blow ImpactMemo::exact(const LandedBlow& blow, const Mobility& mobility) const {
  const Contact& contact = blow.contact;
  const Vec3 line = line_of_blow(contact);
  const Vec3 at = knuckles(blow.attack.part(contact.striker), blow.striking);
  const PartMobility striker =
      mobility(blow.attacker, blow.attack, contact.striker, striking_tone(blow.kind));
  const PartMobility struck = mobility(blow.victim, blow.struck, contact.struck, kStruckTone);
  return blow_of(contact, blow.kind,
                 striker.mass_along(at, yaw_rotation(-blow.attacker_yaw) * line),
                 struck.mass_along(contact.point, line));
}

Blow ImpactMemo::exact(const LandedBlow& blow) const {
  return exact(blow, [&](int body, const BodyMoment& moment, Part part, float tone) {
    return mobility_of(bodies_[static_cast<std::size_t>(body)]->body(), moment.pose(), part, tone);
  });
}

Blow ImpactMemo::kept(const LandedBlow& blow) {
  return exact(blow, [&](int body, const BodyMoment& moment, Part part, float tone) {
    const auto b = static_cast<std::size_t>(body);
    const auto compute = [&] { return mobility_of(bodies_[b]->body(), moment.pose(), part, tone); };
    if (moment.table->in_flight()) return compute();  // no two moments of those are the same
    Packer p;
    p.add(moment.table->id.value, 20).add(moment.age, 12).add(static_cast<int>(part), 5);
    p.add(std::lround(tone * 1000), 10);
    return looked_up(mobilities_, &ImpactStore::mobilities, {p.a(), p.b(), worlds_[b]}, compute);
  });
}

std::uint64_t ImpactMemo::begin_motion() {
  for (auto& shard : in_flight_answers_) shard.entries.clear();
  for (auto& shard : in_flight_own_motions_) shard.entries.clear();
  return ++motions_;
}

ImpactMemo::ImpulseSteps ImpactMemo::steps_of(const LandedBlow& blow, Vec3 impulse) const {
  ImpulseSteps steps{};
  steps.victim = blow.victim;
  steps.moment = classes_[static_cast<std::size_t>(blow.victim)].of(
      blow.struck.table->id, blow.struck.age + size_.ticks / 2);
  steps.struck = blow.contact.struck;
  steps.blocked = blow.contact.blocked;
  steps.place = place_of(blow.struck.part(steps.struck), impulse, blow.contact.point);
  steps.azimuth = turn_step(yaw_of(impulse) - blow.struck.root().yaw, size_.azimuths);
  steps.elevation = elevation_step(impulse);
  steps.tone = static_cast<int>(std::lround(100 * blow.tone));
  const float size = glm::length(impulse);
  if (size >= kTouchImpulse) steps.impulse = step_of(size, size_.impulse, 1000);
  return steps;
}

ImpactAnswer ImpactMemo::answer_of(const ImpulseSteps& steps, const KeptOwnMotion& own) const {
  const MotionTables& victim = *bodies_[static_cast<std::size_t>(steps.victim)];
  const ActionTable& action = victim.at(steps.moment.action);
  const BodyMoment struck{&action, action.clamped(steps.moment.age)};
  const float facing = struck.root().yaw;
  const Vec3 line =
      yaw_rotation(facing) * direction_of(steps.azimuth, size_.azimuths, steps.elevation);
  Blow blow;
  blow.part = steps.struck;
  blow.point = point_of(struck.part(steps.struck), line, steps.place);
  blow.impulse = line * (static_cast<float>(steps.impulse) * size_.impulse);
  blow.blocked = steps.blocked;
  const float tone = static_cast<float>(steps.tone) / 100;
  return turned(stepped(victim, struck, tone, blow, own), -facing);
}

ImpactAnswer ImpactMemo::stepped(const MotionTables& victim, const BodyMoment& struck, float tone,
                                 const Blow& blow, const KeptOwnMotion& own) {
  const ActionTable& action = *struck.table;
  ImpactAnswer answer;
  answer.impulse = glm::length(blow.impulse);
  ImpactInput input;
  input.pose = struck.pose();
  input.pose_before = action.pose_seen(struck.age - 1, struck.age);
  std::array<Pose, kImpulseStepTicks + 1> continued;
  for (Tick t = 0; t <= kImpulseStepTicks; ++t) {
    continued[static_cast<std::size_t>(t)] = action.pose_seen(struck.age + t, struck.age);
  }
  input.continued = continued;
  input.blow = blow;
  input.tone = tone;
  input.contacts = action.action->clip.contacts_at(action.clip_age(struck.age));
  // The muscles take up a touch, whatever the body is doing: no impulse step is needed to know.
  const bool touch = answer.impulse < kTouchImpulse;
  if (!touch) answer.outcome = impulse_step(victim.body(), input, own);
  answer.response = choose_response(victim.library(), victim.body(), answer.outcome,
                                    struck.faces(victim.library()), action.action->stance);
  if (answer.outcome.response == ResponseKind::absorb) {
    const ActionTable& shown = victim.at(answer.response);
    const bool leg = answer.outcome.zone == TargetZone::leg;
    answer.share = share_foreseen(answer.outcome, leg ? shown.leg_way : shown.way);
  } else if (answer.outcome.response == ResponseKind::recovery_steps) {
    answer.share =
        share_of_steps(victim.body(), answer.outcome, victim.at(answer.response).strides);
  }
  return answer;
}

ImpactAnswer ImpactMemo::in_flight_answer(const LandedBlow& landed, const Blow& blow,
                                          const KeptOwnMotion& own) const {
  ImpactAnswer answer = stepped(*bodies_[static_cast<std::size_t>(landed.victim)], landed.struck,
                                landed.tone, blow, own);
  answer.damage = damage_of(blow, answer.outcome);
  return answer;
}

ImpactAnswer ImpactMemo::kept_in_flight_answer(const LandedBlow& landed, const Blow& blow) {
  const std::uint64_t motion = landed.struck.table->motion;
  const Tick age = landed.struck.age;
  Packer moment;
  moment.add(age, 16).add(static_cast<int>(blow.part), 5).add(blow.blocked ? 1 : 0, 1);
  Hasher exactly;
  for (const Vec3& v : {blow.point, blow.impulse}) exactly.add(v.x).add(v.y).add(v.z);
  const KeptOwnMotion own = [&](bool mirrored, const std::function<OwnMotion()>& run) {
    Packer side;
    side.add(age, 16).add(mirrored ? 1 : 0, 1);
    return remembered(in_flight_own_motions_, {side.a(), 0, motion}, run);
  };
  return remembered(in_flight_answers_, {moment.a(), exactly.digest(), motion},
                    [&] { return in_flight_answer(landed, blow, own); });
}

ImpactAnswer ImpactMemo::carried(const ImpactAnswer& found, const LandedBlow& landed,
                                 const Blow& blow) const {
  ImpactAnswer answer = turned(found, landed.struck.root().yaw);
  answer.impulse = glm::length(blow.impulse);
  answer.damage = damage_of(blow, answer.outcome);
  return answer;
}

ImpactAnswer ImpactMemo::turned(ImpactAnswer answer, float yaw) {
  ImpactOutcome& outcome = answer.outcome;
  const Quat turn = yaw_rotation(yaw);
  outcome.direction = wrapped_angle(outcome.direction + yaw);
  outcome.com_velocity = turn * outcome.com_velocity;
  for (Vec3& m : outcome.moved) m = turn * m;
  return answer;
}

KeptOwnMotion ImpactMemo::own_motion(const ImpulseSteps& steps) {
  return [this, steps](bool mirrored, const std::function<OwnMotion()>& run) {
    Packer p;
    p.add(steps.moment.action.value, 20).add(steps.moment.age, 12).add(mirrored ? 1 : 0, 1);
    p.add(steps.tone, 7);
    const Key key{p.a(), 0, worlds_[static_cast<std::size_t>(steps.victim)]};
    return looked_up(own_motions_, &ImpactStore::own_motions, key, run);
  };
}

template <class Value, class Compute>
Value ImpactMemo::kept(ImpactShelf<Value> ImpactStore::*shelf, const Key& key,
                       const Compute& compute) {
  if (store_ == nullptr) return compute();
  ImpactShelf<Value>& values = (*store_).*shelf;
  if (const auto found = values.find(key)) return *found;
  Value value = compute();
  values.add(key, value);
  return value;
}

template <class Value, class Compute>
const Value& ImpactMemo::looked_up(Shards<Value>& shards, ImpactShelf<Value> ImpactStore::*shelf,
                                   const Key& key, const Compute& compute) {
  return remembered(shards, key, [&] { return kept(shelf, key, compute); });
}

template <class Value, class Compute>
const Value& ImpactMemo::remembered(Shards<Value>& shards, const Key& key, const Compute& compute) {
  Shard<Value>& shard = shards[(ImpactKeyHash()(key) >> 8) % shards.size()];
  {
    const std::lock_guard lock(shard.mutex);
    ++shard.lookups;
    const auto found = shard.entries.find(key);
    if (found != shard.entries.end()) return found->second;
  }
  // Outside the lock: it takes long, and twice gives the same.
  const Value value = compute();
  const std::lock_guard lock(shard.mutex);
  const auto [place, added] = shard.entries.try_emplace(key, value);
  shard.made += added ? 1u : 0u;
  return place->second;
}

ImpactAnswer ImpactMemo::answer(const LandedBlow& landed) {
  const Blow blow = kept(landed);
  if (landed.struck.table->in_flight()) return kept_in_flight_answer(landed, blow);
  const ImpulseSteps steps = steps_of(landed, blow.impulse);
  const ImpactAnswer& found = looked_up(answers_, &ImpactStore::answers, key_of(steps),
                                        [&] { return answer_of(steps, own_motion(steps)); });
  return carried(found, landed, blow);
}

ImpactAnswer ImpactMemo::recomputed(const LandedBlow& landed) const {
  const Blow blow = exact(landed);
  if (landed.struck.table->in_flight()) return in_flight_answer(landed, blow, {});
  return carried(answer_of(steps_of(landed, blow.impulse), {}), landed, blow);
}

std::int32_t ImpactMemo::clean_damage(int attacker, ActionId attack, std::size_t strike,
                                      int victim) {
  const MotionTables& tables = *bodies_[static_cast<std::size_t>(attacker)];
  const ActionTable& action = tables.at(attack);
  const StrikeTable& blow = action.strikes[strike];
  float speed = 0;
  Tick fastest = blow.strike.active_begin;
  for (Tick t = std::max<Tick>(1, blow.strike.active_begin); t < blow.strike.active_end; ++t) {
    const Capsule& now = action.capsules_at(t)[index(blow.main)];
    const Capsule& before = action.capsules_at(t - 1)[index(blow.main)];
    const float gone = glm::distance(now.b, before.b) / kTickSeconds;
    if (gone > speed) speed = gone, fastest = t;
  }
  // The struck body: the start of the first idle of the library (else of the attack itself).
  const MotionLibrary& library = tables.library();
  ActionId standing = attack;
  for (std::size_t i = library.actions().size(); i-- > 0;) {
    if (library.actions()[i].kind == Kind::idle) standing = ActionId(i);
  }
  LandedBlow landed;
  landed.attacker = attacker;
  landed.victim = victim;
  landed.attack = {&action, fastest};
  landed.struck = {&bodies_[static_cast<std::size_t>(victim)]->at(standing), 0};
  landed.kind = blow.strike.kind;
  landed.contact.striker = blow.main;
  landed.contact.struck = blow.strike.zone == TargetZone::head   ? Part::head
                          : blow.strike.zone == TargetZone::body ? Part::abdomen
                                                                 : Part::left_thigh;
  landed.contact.normal = kForward;
  landed.contact.velocity = -kForward * speed;
  landed.attacker_yaw = kPi;
  landed.contact.point = point_of(landed.struck.part(landed.contact.struck), -kForward, {0, 0});
  const Capsule striker = landed.attack.part(blow.main);
  landed.striking = (striker.a + striker.b) * 0.5f;
  const Blow clean = kept(landed);
  const ImpulseSteps steps = steps_of(landed, clean.impulse);
  return carried(kept(&ImpactStore::answers, key_of(steps),
                      [&] {  // beside the memo, which counts
                        return answer_of(steps, own_motion(steps));
                      }),
                 landed, clean)
      .damage;
}

ImpactMemo::Counts ImpactMemo::counts() const {
  Counts counts;
  for (const Shards<ImpactAnswer>* shards : {&answers_, &in_flight_answers_}) {
    for (const Shard<ImpactAnswer>& shard : *shards) {
      const std::lock_guard lock(shard.mutex);
      counts.lookups += shard.lookups;
      counts.entries += shard.made;
    }
  }
  return counts;
}

}  // namespace ringcraft
