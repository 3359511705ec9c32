// Candidate moves: a quick score for every action that can follow, and the best k of a mixed list.
//
// k is the same at every depth: lists that narrow make a deeper search lose (planning.md).

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/duel.h"

namespace ringcraft {
namespace {

constexpr double kLookAhead = 1.0;  // s of location that a candidate is credited with
constexpr double kAnswerable =
    0.6;  // share of an attack's worth against a body that may still answer
// Share of a threat that a well-timed defense is expected to take, by where the blow goes: what
// `ringcraft sparring` says of the surest of each kind at its best timing. Where the body will have
// gone by then counts beside it.
struct Protects {
  double head, body, leg;
};
constexpr std::array<Protects, 7> kProtects = {{{.8, .5, .1},    // guard
                                                {.8, .7, .1},    // parry
                                                {.95, .5, 0},    // slip
                                                {1, .8, .6},     // duck
                                                {.9, .4, .05},   // sway
                                                {.5, .5, 1},     // check
                                                {.9, .9, .5}}};  // step away

double protects(DefenseKind kind, TargetZone zone) {
  const Protects& one = kProtects.at(static_cast<std::size_t>(kind));
  return zone == TargetZone::head ? one.head : zone == TargetZone::body ? one.body : one.leg;
}

constexpr double kFeintWorth = 3;  // points of the blow that follows, where the feint is answered

const float kSineAttack = std::sin(kMostAttackAim), kCosineAttack = std::cos(kMostAttackAim);
const float kSineOther = std::sin(kMostAim), kCosineOther = std::cos(kMostAim);

// `v` seen after turning by the aim that points +Z at `target`, clamped.
struct Aim {
  float sine = 0, cosine = 1;
  Aim(Vec3 target, bool attack) {
    const float most_sine = attack ? kSineAttack : kSineOther;
    const float most_cosine = attack ? kCosineAttack : kCosineOther;
    const float length = std::sqrt(target.x * target.x + target.z * target.z);
    if (length < 1e-5f) return;
    sine = target.x / length;
    cosine = target.z / length;
    if (cosine < most_cosine) {
      sine = target.x < 0 ? -most_sine : most_sine;
      cosine = most_cosine;
    }
  }
  Vec3 into(Vec3 v) const { return {cosine * v.x - sine * v.z, v.y, sine * v.x + cosine * v.z}; }
  Vec3 out(Vec3 v) const { return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x}; }
};

float falling(float x, float from, float to) {  // 1 up to `from`, 0 from `to` on
  return std::clamp((to - x) / (to - from), 0.0f, 1.0f);
}

// How well a strike reaches a body that stands at `target` of the aimed action space.
float reaching(const StrikeTable& strike, Vec3 target) {
  const float gap = target.z - strike.landing.z;
  const float aside = std::abs(target.x - 0.5f * strike.landing.x);
  return falling(gap, 0.08f, 0.28f) * falling(-gap, 0.45f, 0.75f) * falling(aside, 0.15f, 0.40f);
}

// How likely the opponent is, by what was seen of it, to answer what looks like an attack with a
// defense there.
double answers_attacks(const Habits& habits, const MotionLibrary& library, float distance,
                       Kind last) {
  const Situation situation = situation_of(distance, last, true);
  int defenses = 0;
  for (const Habits::Seen& seen : habits.seen(situation)) {
    if (library.action(seen.action).kind == Kind::defense) defenses += seen.count;
  }
  const int total = habits.total(situation);
  return total == 0 ? 0 : Habits::belief(total) * defenses / total;
}

// Preference among kinds of one list.
enum class Class { attack, defense, step, idle };
Class class_of(Kind kind) {
  switch (kind) {
    case Kind::attack:
    case Kind::combination:
      return Class::attack;
    case Kind::defense:
      return Class::defense;
    case Kind::idle:
      return Class::idle;
    default:
      return Class::step;
  }
}

}  // namespace

// What every candidate of one node is weighed against.
struct Duel::Aspect {
  struct Threat {  // a strike of the opponent that is still to come
    Tick begin = 0, end = 0;
    Vec3 from{}, to{};  // its line on the ground, world
    TargetZone zone = TargetZone::head;
    double worth = 0;  // points it would cost
  };
  const SideSetup* own = nullptr;
  const InFlight* opponent = nullptr;
  Tick opponent_still = 0;  // from when the opponent's root rests, where nothing follows
  Vec3 opponent_then{};     // world: where
  bool opponent_down = false;
  bool late = false;    // the opponent's attack is too young to be answered by a particular defense
  Tick now = 0;         // when the candidate starts: after its path
  Frame end;            // the own root
  Vec3 opponent_now{};  // world
  double rate_now = 0;  // F_loc
  double ring_half = 0;
  std::vector<Threat> threats;

  Vec3 opponent_at(Tick tick) const {
    return tick >= opponent_still ? opponent_then : opponent->root_at(tick).position();
  }
  double ropes(Vec3 at) const {
    return ring_half > 0 ? ring_half - static_cast<double>(std::max(std::abs(at.x), std::abs(at.z)))
                         : 1e3;
  }
  double protection(const ActionTable& table, const Frame& start, const Aim& aim) const;
  struct Ending {        // where the candidate leaves its fighter
    Vec3 root{};         // world
    float distance = 0;  // to the opponent's root by then, m
    float cosine = 1;    // of the opponent's bearing off the facing
  };
  Ending ending(const NextAction& next, const Frame& start, const Aim& aim) const;
  double location(const NextAction& next, const Ending& end) const;
  double attack(const ActionTable& table, ActionId id, const Frame& start, const Aim& aim) const;
};

// Points that the candidate is expected to save of what is in flight against the fighter.
double Duel::Aspect::protection(const ActionTable& table, const Frame& start,
                                const Aim& aim) const {
  const Action& action = *table.action;
  double saved = 0;
  for (const Threat& threat : threats) {
    double share = 0;
    if (action.defense) {
      const Tick begin = std::max(threat.begin, now + action.defense->begin);
      const Tick end = std::min(threat.end, now + action.defense->end);
      const double whole = std::max<Tick>(1, threat.end - threat.begin);
      share =
          protects(action.defense->kind, threat.zone) * std::clamp((end - begin) / whole, 0.0, 1.0);
    }
    // Where the body will have gone when the blow comes.
    const Placement& root = table.root_at((threat.begin + threat.end) / 2 - now);
    const Vec3 at = start.to_outer(aim.out(root.position()));
    const Vec3 line = threat.to - threat.from;
    const float length = std::max(1e-3f, std::sqrt(line.x * line.x + line.z * line.z));
    const float along =
        ((at.x - threat.from.x) * line.x + (at.z - threat.from.z) * line.z) / length;
    const float across =
        std::abs((at.x - threat.from.x) * line.z - (at.z - threat.from.z) * line.x) / length;
    const float away =
        std::max(1 - falling(along - length, 0.08f, 0.28f), 1 - falling(across, 0.1f, 0.35f));
    saved += threat.worth * std::max(share, static_cast<double>(away));
  }
  return saved;
}

Duel::Aspect::Ending Duel::Aspect::ending(const NextAction& next, const Frame& start,
                                          const Aim& aim) const {
  Ending end;
  end.root = start.to_outer(aim.out({next.end.x, 0, next.end.z}));
  const Vec3 then = opponent_at(now + next.length) - end.root;
  end.distance = std::sqrt(then.x * then.x + then.z * then.z);
  // Facing at the end: the start's, turned by the aim and by the clip.
  const Vec3 ahead = aim.out({next.end.sine, 0, next.end.cosine});
  const float facing_x = start.cosine * ahead.x + start.sine * ahead.z;
  const float facing_z = start.cosine * ahead.z - start.sine * ahead.x;
  if (end.distance > 1e-4f) end.cosine = (then.x * facing_x + then.z * facing_z) / end.distance;
  return end;
}

double Duel::Aspect::location(const NextAction& next, const Ending& end) const {
  const double rate = location_rate(own->weights, end.distance, end.cosine, ropes(end.root));
  const double length = seconds(next.lead + next.length);
  return 0.5 * (rate_now + rate) * length + rate * std::max(0.0, kLookAhead - length);
}

double Duel::Aspect::attack(const ActionTable& table, ActionId id, const Frame& start,
                            const Aim& aim) const {
  if (opponent_down) return 0;
  double points = 0;
  for (std::size_t i = 0; i < table.strikes.size(); ++i) {
    const StrikeTable& strike = table.strikes[i];
    const Tick tick = now + strike.landing_tick;
    const Vec3 target = aim.into(start.to_inner(opponent_at(tick)));
    const float reach = reaching(strike, target);
    if (reach <= 0) continue;
    const double sure = opponent->launch.end > tick ? 1.0 : kAnswerable;
    points += sure * static_cast<double>(reach) *
              hit_points(own->weights, strike.strike.kind, own->clean_damage[id.at()][i], false);
  }
  return points;
}

Duel::Aspect Duel::aspect_of(const Node& node, int who) const {
  const Duelist& self = node.side[static_cast<std::size_t>(who)];
  const Duelist& other = node.side[static_cast<std::size_t>(1 - who)];
  Aspect aspect;
  aspect.own = &side(who);
  aspect.opponent = &other.flight;
  aspect.opponent_down = other.balance == 2 && !setup_->settings.hits_on_downed;
  aspect.end = Frame(self.flight.root_at(node.now));
  aspect.opponent_now = other.flight.root_at(node.now).position();
  aspect.opponent_still =
      std::max(other.flight.aimed_from, other.flight.launch.start + other.flight.table->length);
  aspect.opponent_then = other.flight.root_at(aspect.opponent_still).position();
  aspect.ring_half = setup_->settings.ring_half_m;
  const Tick age = node.now - other.flight.launch.start;
  aspect.late =
      other.flight.table->action->attacks() && age < ticks(aspect.own->style->late_sight_s);
  const Vec3 at_now{aspect.end.x, 0, aspect.end.z};
  const Vec3 toward = aspect.end.to_inner(aspect.opponent_now);
  const float distance = std::sqrt(toward.x * toward.x + toward.z * toward.z);
  const float cosine = distance > 1e-4f ? toward.z / distance : 1.0f;
  aspect.rate_now = location_rate(aspect.own->weights, distance, cosine, aspect.ropes(at_now));

  const SideSetup& their = side(1 - who);
  const Launch& launch = other.flight.launch;
  const Frame& frame = other.flight.aimed;
  for (std::size_t i = 0; i < other.flight.table->strikes.size(); ++i) {
    const StrikeTable& strike = other.flight.table->strikes[i];
    if (i < 8 && ((launch.spent >> i) & 1u) != 0) continue;
    if (launch.start + strike.strike.active_end <= node.now) continue;
    if (reaching(strike, frame.to_inner(at_now)) <= 0.2f) continue;
    Aspect::Threat threat;
    threat.begin = launch.start + strike.strike.active_begin;
    threat.end = launch.start + strike.strike.active_end;
    threat.from = {frame.x, 0, frame.z};
    threat.to = frame.to_outer(strike.landing);
    threat.zone = strike.strike.zone;
    threat.worth =
        aspect.own->weights.caution * hit_points(their.weights, strike.strike.kind,
                                                 their.clean_damage[launch.action.at()][i], false);
    aspect.threats.push_back(threat);
  }
  return aspect;
}

void Duel::score_candidates(const Node& node, int who) {
  const CostSpan span(setup_->cost, CostPart::candidates);
  static const float kCosineBack = std::cos(kBackTurned);
  const Duelist& self = node.side[static_cast<std::size_t>(who)];
  const SideSetup& own = side(who);
  Aspect aspect = aspect_of(node, who);
  scored_.resize(self.flight.table->next.size());
  std::size_t count = 0;
  float least_turned = -2;
  Scored spare{};
  double feint = 0;  // points that a feint is expected to bring
  if (who == 0 && setup_->habits != nullptr) {
    const InFlight& other = node.side[1].flight;
    const Vec3 apart = aspect.opponent_now - Vec3(aspect.end.x, 0, aspect.end.z);
    feint = kFeintWorth * setup_->learning *
            answers_attacks(*setup_->habits, own.tables->library(), std::hypot(apart.x, apart.z),
                            other.table->action->kind);
  }
  for (const NextAction& next : self.flight.table->next) {
    if (aspect.late && next.particular) continue;
    aspect.now = node.now + next.lead;
    const Frame start = aspect.end * next.alignment;
    // The aim of an attack points its start at the opponent, that of anything else its end.
    Vec3 target = start.to_inner(aspect.opponent_now);
    if (!next.attacks) target = next.end.to_inner(target);
    const Aim aim(target, next.attacks);
    const Aspect::Ending end = aspect.ending(next, start, aim);
    double points = aspect.location(next, end) + 0.001 * own.launch[next.to.at()];
    if (next.attacks) points += aspect.attack(*next.table, next.to, start, aim);
    if (!aspect.threats.empty()) points += aspect.protection(*next.table, start, aim);
    const Scored one{thousandths(points), next.kind, &next, false, end.distance};
    if (setup_->settings.prune.back_turned && end.cosine < kCosineBack) {
      ++counts_.back_turned;
      if (turned_ != nullptr) turned_->push_back(next.to);
      if (end.cosine > least_turned) least_turned = end.cosine, spare = one;
    } else {
      scored_[count++] = one;
    }
  }
  Scored* feigned = nullptr;  // the best feint: one is enough to weigh
  for (std::size_t i = 0; feint > 0 && i < count; ++i) {
    Scored& one = scored_[i];
    if (!one.next->table->action->feint) continue;
    if (feigned == nullptr || one.score > feigned->score) feigned = &one;
  }
  if (feigned != nullptr) feigned->score += thousandths(feint);
  if (count == 0 && spare.next != nullptr) scored_[count++] = spare;
  scored_.resize(count);
  const auto most = static_cast<std::size_t>(std::max(1, own.style->candidates));
  pick_candidates(most, !aspect.threats.empty());
  if (who == 1 && setup_->habits != nullptr) foresee_habit(node, most);
}

// What the opponent was seen to do in such a situation takes the place of what it could do: the
// usual list shrinks as the counts come to be believed, and the habits cover as much of what was
// seen. A list that is no longer than what is known of the opponent is no pathology: it is not
// expected to do anything else.
void Duel::foresee_habit(const Node& node, std::size_t most) {
  const Duelist& self = node.side[1];
  const float apart = glm::distance(node.side[0].flight.root_at(node.now).position(),
                                    self.flight.root_at(node.now).position());
  const InFlight& met = node.side[0].flight;
  const Situation situation =
      situation_of(apart, self.flight.table->action->kind,
                   looks_like_attack(*met.table->action, node.now - met.launch.start,
                                     side(1).style->late_sight_s));
  const int total = setup_->habits->total(situation);
  if (total == 0) return;
  const double belief = setup_->learning * Habits::belief(total);
  const auto others =
      static_cast<std::size_t>(std::lround((1 - belief) * static_cast<double>(most)));
  foreseen_.clear();
  int covered = 0;
  for (const Habits::Seen& seen : setup_->habits->seen(situation)) {
    if (foreseen_.size() >= most || covered >= belief * total) break;
    covered += seen.count;
    for (const Scored& one : scored_) {  // the best of those that begin with what was seen
      const NextAction& next = *one.next;
      if ((next.path.empty() ? next.to : next.path.front()) != seen.action) continue;
      foreseen_.push_back(one);
      break;
    }
  }
  if (foreseen_.empty()) return;  // nothing of it can follow here
  std::size_t left = others;
  for (const Scored& one : picked_) {
    if (left == 0) break;
    const bool known = std::any_of(foreseen_.begin(), foreseen_.end(),
                                   [&](const Scored& f) { return f.next == one.next; });
    if (known) continue;
    foreseen_.push_back(one);
    --left;
  }
  picked_.swap(foreseen_);
}

// The best of each class that must not be missing, then the best of the rest; in order of score.
// A few are wanted of many: they are looked for one by one, and only they are sorted.
void Duel::pick_candidates(std::size_t most, bool threatened) {
  const auto better = [](const Scored& a, const Scored& b) {
    return a.score != b.score ? a.score > b.score : a.next->to < b.next->to;
  };
  picked_.clear();
  std::size_t left = std::min(most, scored_.size());
  counts_.candidates += scored_.size() - left;
  const auto take = [&](int how_many, const auto& wanted) {
    for (; how_many > 0 && left > 0; --how_many, --left) {
      Scored* best = nullptr;
      for (Scored& one : scored_) {
        if (one.taken || !wanted(class_of(one.kind))) continue;
        if (best == nullptr || better(one, *best)) best = &one;
      }
      if (best == nullptr) return;
      best->taken = true;
      picked_.push_back(*best);
    }
  };
  // The step that leads farthest from the opponent. Every score is that of standing well, so of two
  // who trade blows neither would ever look at the step that ends it.
  const auto take_way_out = [&] {
    Scored* farthest = nullptr;
    for (Scored& one : scored_) {
      if (one.taken || class_of(one.kind) != Class::step || left == 0) continue;
      const bool farther = farthest == nullptr || one.apart > farthest->apart ||
                           (one.apart == farthest->apart && better(one, *farthest));
      if (farther) farthest = &one;
    }
    if (farthest == nullptr) return;
    farthest->taken = true;
    picked_.push_back(*farthest);
    --left;
  };
  take(1, [](Class c) { return c == Class::attack; });
  take(1, [](Class c) { return c == Class::step; });
  take_way_out();
  take(threatened ? 2 : 1, [](Class c) { return c == Class::defense; });
  take(1, [](Class c) { return c == Class::idle; });
  take(static_cast<int>(left), [](Class) { return true; });
  std::sort(picked_.begin(), picked_.end(), better);  // no two are equal
}

}  // namespace ringcraft
