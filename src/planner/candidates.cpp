// Candidate moves: a quick score for every action that can follow, and the best k of a mixed list.
//
// k is the same at every depth: lists that narrow make a deeper search lose (docs/planning.md).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/bearings.h"
#include "planner/duel.h"

namespace ringcraft {
namespace {

constexpr double kLookAhead = 1.0;  // s of location that a candidate is credited with
constexpr double kAnswerable =
    0.6;  // share of an attack's worth against a body that may still answer
constexpr float kOutOfReach = 1.5f;  // m short of the opponent: an attack from there is none
constexpr double kNoRopes = 1e6;     // m: so far away that nobody comes near them
constexpr std::size_t kMostReplies = 2;
constexpr double kUnusual = 1;     // points for each factor of e by which something is less seen
constexpr double kFeintWorth = 3;  // points that a feint is expected to bring who takes another in

const AimLimit kAttackLimit{std::sin(kMostAttackAim), std::cos(kMostAttackAim)};
const AimLimit kOtherLimit{std::sin(kMostAim), std::cos(kMostAim)};

// m from the middle of a square ring, along its sides.
float farther_out(float x, float z) {
  return std::max(std::abs(x), std::abs(z));
}

// Its yaw is not asked for.
Frame frame_of(float x, float z, float sine, float cosine) {
  Frame frame;
  frame.x = x, frame.z = z, frame.sine = sine, frame.cosine = cosine;
  return frame;
}

float falling(float x, float from, float to) {  // 1 up to `from`, 0 from `to` on
  return std::clamp((to - x) / (to - from), 0.0f, 1.0f);
}

// How well a strike reaches a body that stands at `target` of the aimed action space.
float reaching(const StrikeAim& strike, Vec3 target) {
  const float gap = target.z - strike.ahead;
  const float aside = std::abs(target.x - 0.5f * strike.aside);
  return falling(gap, 0.08f, kMostGap) * falling(-gap, 0.45f, kMostPast) *
         falling(aside, 0.15f, kMostAside);
}

// m: how far a root goes at most from where it is at `now`, from then on.
float roams_from(const InFlight& flight, Tick now) {
  constexpr float kRounding = 0.001f;
  if (flight.turning(now)) return 1e3f;
  const ActionTable& table = *flight.table;
  const Placement& here = table.root_at(flight.age(now));
  float farthest = 0;
  for (Tick age = std::max(0, flight.age(now)); age <= table.length; ++age) {
    const float x = table.root_at(age).x - here.x, z = table.root_at(age).z - here.z;
    farthest = std::max(farthest, x * x + z * z);
  }
  return std::sqrt(farthest) + kRounding;
}

}  // namespace

// What every candidate of one node is weighed against.
struct Duel::Aspect {
  struct Threat {  // a strike of the opponent that is still to come
    Tick begin = 0, end = 0;
    Vec3 from{}, line{};              // its way on the ground, world
    float length = 0;                 // m: of the line
    double worth = 0;                 // points it would cost
    std::span<const float> answered;  // by action of who is threatened (protection.h)
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
  float roams = 0;      // m: how far the opponent goes at most from there
  double rate_now = 0;  // F_loc
  double ropes_half = 0;  // m from the middle to the ropes
  float held_at = 0;      // m from the middle: the ropes let no root go farther, or farther out
  std::vector<Threat> threats;
  std::span<const Fallen> fallen;

  Vec3 opponent_at(Tick tick) const {
    if (tick >= opponent_still) return opponent_then;
    return opponent->frame_at(tick).to_outer(
        opponent->table->root_at(opponent->age(tick)).position());
  }
  // Adds the points that each candidate is expected to save of what is in flight against it.
  void add_protection(std::span<const NextAction> next, std::span<const BearingLanes> bearings,
                      Tick node_now, std::vector<double>& points) const;
  std::array<double, kLanes> rates(const BearingLanes& bearing) const;  // F_loc at the ends
  double location(Tick length, double rate) const;
  double attack(const NextAction& next, const Frame& start, const Frame& aim) const;
};

void Duel::Aspect::add_protection(std::span<const NextAction> next,
                                  std::span<const BearingLanes> bearings, Tick node_now,
                                  std::vector<double>& points) const {
  for (const Threat& threat : threats) {
    const Tick middle = (threat.begin + threat.end) / 2;
    const double whole = std::max<Tick>(1, threat.end - threat.begin);
    for (std::size_t block = 0; block < bearings.size(); ++block) {
      const BearingLanes& bearing = bearings[block];
      const std::size_t first = block * kLanes, count = std::min(kLanes, next.size() - first);
      // Where the body will have gone when the blow comes.
      Lanes root_x{}, root_z{}, away;
      for (std::size_t i = 0; i < count; ++i) {
        const NextAction& one = next[first + i];
        const Placement& root = one.root_at(middle - node_now - one.lead);
        root_x[i] = root.x, root_z[i] = root.z;
      }
      for (std::size_t i = 0; i < kLanes; ++i) {
        const float turned_x = bearing.aim_cosine[i] * root_x[i] + bearing.aim_sine[i] * root_z[i];
        const float turned_z = bearing.aim_cosine[i] * root_z[i] - bearing.aim_sine[i] * root_x[i];
        const float sine = bearing.start_sine[i], cosine = bearing.start_cosine[i];
        const float x = bearing.start_x[i] + cosine * turned_x + sine * turned_z - threat.from.x;
        const float z = bearing.start_z[i] - sine * turned_x + cosine * turned_z - threat.from.z;
        const float along = (x * threat.line.x + z * threat.line.z) / threat.length;
        const float across = std::abs(x * threat.line.z - z * threat.line.x) / threat.length;
        away[i] = std::max(1 - falling(along - threat.length, 0.08f, 0.28f),
                           1 - falling(across, 0.1f, 0.35f));
      }
      for (std::size_t i = 0; i < count; ++i) {
        const NextAction& one = next[first + i];
        double share = static_cast<double>(away[i]);
        if (const Defense* defense = one.defense) {
          const Tick start = node_now + one.lead;
          const Tick begin = std::max(threat.begin, start + defense->begin);
          const Tick end = std::min(threat.end, start + defense->end);
          share = std::max(share, static_cast<double>(threat.answered[one.to.at()]) *
                                      std::clamp((end - begin) / whole, 0.0, 1.0));
        }
        points[first + i] += threat.worth * share;
      }
    }
  }
}

std::array<double, kLanes> Duel::Aspect::rates(const BearingLanes& bearing) const {
  std::array<double, kLanes> rates, in_fallen{};
  if (!fallen.empty()) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      in_fallen[i] = overlap(fallen, bearing.x[i], bearing.z[i]);
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float out = farther_out(bearing.x[i], bearing.z[i]);
    rates[i] = location_rate(own->weights, bearing.apart[i], bearing.facing[i],
                             ropes_half - static_cast<double>(out), opponent_down, in_fallen[i]);
  }
  return rates;
}

double Duel::Aspect::location(Tick length_ticks, double rate) const {
  const double length = seconds(length_ticks);
  return 0.5 * (rate_now + rate) * length + rate * std::max(0.0, kLookAhead - length);
}

double Duel::Aspect::attack(const NextAction& next, const Frame& start, const Frame& aim) const {
  if (opponent_down) return 0;
  double points = 0;
  float best_reach = 0;
  for (std::size_t i = 0; i < next.strikes.size(); ++i) {
    const StrikeAim& strike = next.strikes[i];
    const Tick tick = now + strike.tick;
    const Vec3 target = aim.to_inner(start.to_inner(opponent_at(tick)));
    const float reach = reaching(strike, target);
    if (reach <= 0) continue;
    best_reach = std::max(best_reach, reach);
    const double sure = opponent->launch.end > tick ? 1.0 : kAnswerable;
    points +=
        sure * static_cast<double>(reach) *
        hit_points(own->weights, strike.kind, own->clean_damage[next.first_strike + i], false);
  }
  return points + reach_bonus(own->weights) * static_cast<double>(best_reach);
}

float Duel::reach_of(const Node& node, int who, const NextAction& next) const {
  const InFlight& self = duelist(node, who).flight;
  const Duelist& other = duelist(node, against(who));
  if (other.balance == 2 && !setup_->settings.hits_on_downed) return 0;
  Placement placement = (Frame(self.root_at(node.now)) * next.alignment).placement();
  placement.yaw += aim_at(*next.table->action, placement, other.flight.root_at(node.now).position(),
                          side(who).tables->body().scale, kMostAttackAim);
  const Frame aimed(placement);
  float reach = 0;
  for (const StrikeAim& strike : next.strikes) {
    const Tick tick = node.now + next.lead + strike.tick;
    reach =
        std::max(reach, reaching(strike, aimed.to_inner(other.flight.root_at(tick).position())));
  }
  return reach;
}

Duel::Aspect Duel::aspect_of(const Node& node, int who) const {
  const Duelist& self = duelist(node, who);
  const Duelist& other = duelist(node, against(who));
  Aspect aspect;
  aspect.own = &side(who);
  aspect.opponent = &other.flight;
  aspect.opponent_down = other.balance == 2 && !setup_->settings.hits_on_downed;
  aspect.end = Frame(self.flight.root_at(node.now));
  aspect.opponent_now = other.flight.root_at(node.now).position();
  aspect.roams = roams_from(other.flight, node.now);
  aspect.opponent_still =
      std::max(other.flight.aimed_from, other.flight.launch.start + other.flight.table->length);
  aspect.opponent_then = other.flight.root_at(aspect.opponent_still).position();
  const double ring_half = setup_->settings.ring_half_m;
  aspect.ropes_half = ring_half > 0 ? ring_half : kNoRopes;
  constexpr float kRounding = .001f;  // m: an idle at the ropes stays where it is
  aspect.held_at = std::max(static_cast<float>(aspect.ropes_half) - kInsideRopes,
                            farther_out(aspect.end.x, aspect.end.z)) +
                   kRounding;
  const Tick age = node.now - other.flight.launch.start;
  aspect.late =
      other.flight.table->action->attacks() && age < ticks(aspect.own->style->late_sight_s);
  const Vec3 at_now{aspect.end.x, 0, aspect.end.z};
  const Vec3 toward = aspect.end.to_inner(aspect.opponent_now);
  const float distance = std::sqrt(toward.x * toward.x + toward.z * toward.z);
  const float cosine = distance > 1e-4f ? toward.z / distance : 1.0f;
  const double to_ropes = aspect.ropes_half - static_cast<double>(farther_out(at_now.x, at_now.z));
  aspect.fallen = setup_->fallen;
  aspect.rate_now = location_rate(aspect.own->weights, distance, cosine, to_ropes,
                                  aspect.opponent_down, overlap(aspect.fallen, at_now.x, at_now.z));

  const SideSetup& their = side(against(who));
  const Launch& launch = other.flight.launch;
  const Frame& frame = other.flight.aimed;
  for (std::size_t i = 0; i < other.flight.table->strikes.size(); ++i) {
    const StrikeTable& strike = other.flight.table->strikes[i];
    if (launch.has_spent(i)) continue;
    if (launch.start + strike.strike.active_end <= node.now) continue;
    if (reaching(aim_of(strike), frame.to_inner(at_now)) <= 0.2f) continue;
    Aspect::Threat threat;
    threat.begin = launch.start + strike.strike.active_begin;
    threat.end = launch.start + strike.strike.active_end;
    threat.from = {frame.x, 0, frame.z};
    threat.line = frame.to_outer(strike.landing) - threat.from;
    threat.length = std::max(1e-3f, std::hypot(threat.line.x, threat.line.z));
    threat.answered = setup_->protection->against(other.flight.table->first_strike + i);
    threat.worth = aspect.own->weights.caution *
                   hit_points(their.weights, strike.strike.kind,
                              their.clean_damage[other.flight.table->first_strike + i], false);
    aspect.threats.push_back(threat);
  }
  return aspect;
}

void Duel::score_candidates(const Node& node, int who) {
  const CostSpan span(setup_->cost, CostPart::candidates);
  static const float kCosineBack = std::cos(kBackTurned);
  const Duelist& self = duelist(node, who);
  const SideSetup& own = side(who);
  Aspect aspect = aspect_of(node, who);
  const Followers& follow = own.launches().after(*self.flight.table);
  scored_.resize(follow.next.size());
  std::size_t count = 0;
  std::array<std::size_t, kChoices> choices{};  // how many of each
  float least_turned = -2, least_out = std::numeric_limits<float>::max();
  Scored spare{}, held{}, far{};
  const std::span<const NextAction> all = follow.next;
  const std::span<const NextLanes> lanes = follow.next_lanes;
  then_x_.resize(lanes.size()), then_z_.resize(lanes.size());
  for (std::size_t block = 0; block < lanes.size(); ++block) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 then = aspect.opponent_at(node.now + lanes[block].until[lane]);
      then_x_[block][lane] = then.x, then_z_[block][lane] = then.z;
    }
  }
  find_bearings(lanes, aspect.end, aspect.opponent_now, kAttackLimit, kOtherLimit, then_x_, then_z_,
                bearings_);
  saved_.assign(all.size(), 0);
  aspect.add_protection(all, bearings_, node.now, saved_);
  std::array<double, kLanes> rates;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const NextAction& next = all[i];  // looked at only where it must be: a hundred lie apart
    const NextLanes& in = lanes[i / kLanes];
    const BearingLanes& bearing = bearings_[i / kLanes];
    const std::size_t lane = i % kLanes;
    if (lane == 0) rates = aspect.rates(bearing);
    if (aspect.late && in.particular[lane]) continue;
    double points = aspect.location(in.until[lane], rates[lane]) +
                    0.001 * own.launch[static_cast<std::size_t>(in.to[lane])];
    const float within = in.within[lane], apart = bearing.target[lane];
    if (within > 0 && apart - aspect.roams <= within) {
      aspect.now = node.now + in.lead[lane];
      const Frame start = frame_of(bearing.start_x[lane], bearing.start_z[lane],
                                   bearing.start_sine[lane], bearing.start_cosine[lane]);
      const Frame aim = frame_of(0, 0, bearing.aim_sine[lane], bearing.aim_cosine[lane]);
      points += aspect.attack(next, start, aim);
    }
    points += saved_[i];
    const Scored one{thousandths(points), &next, false, bearing.apart[lane]};
    const float facing = bearing.facing[lane];
    if (setup_->settings.prune.out_of_reach && within > 0 && apart > within + kOutOfReach) {
      ++counts_.candidates;  // nobody boxes the air
      if (far.next == nullptr || one.better_than(far)) far = one;
      continue;
    }
    if (const float out = farther_out(bearing.x[lane], bearing.z[lane]); out > aspect.held_at) {
      ++counts_.candidates;  // nobody walks through the ropes
      if (out < least_out) least_out = out, held = one;
      continue;
    }
    if (setup_->settings.prune.back_turned && facing < kCosineBack) {
      ++counts_.back_turned;
      if (turned_ != nullptr) turned_->push_back(next.to);
      if (facing > least_turned) least_turned = facing, spare = one;
    } else {
      scored_[count++] = one;
      ++choices[static_cast<std::size_t>(in.choice[lane])];
    }
  }
  if (const auto& feint = setup_->feint; feint && who == 0 && feint->start == node.now) {
    for (Scored& one : std::span(scored_).first(count)) {
      if (one.next->to == feint->feint && one.next->lead == 0)
        one.score += thousandths(kFeintWorth);
    }
  }
  if (count == 0 && spare.next == nullptr) spare = held.next != nullptr ? held : far;
  if (count == 0 && spare.next != nullptr) {
    scored_[count++] = spare;
    ++choices[static_cast<std::size_t>(spare.next->choice)];
  }
  scored_.resize(count);
  if (who >= 2) return pick_replies(node, who, choices[static_cast<std::size_t>(Choice::attack)]);
  const auto most = static_cast<std::size_t>(std::max(1, own.style->candidates));
  pick_candidates(most, choices, !aspect.threats.empty());
  if (who == 1 && setup_->habits != nullptr) foresee_habit(node, most);
  if (who == 1 && setup_->feint) foresee_taken_in(node);
}

// The best attacks that may be launched at once and reach the planner, where it goes by itself.
void Duel::pick_replies(const Node& node, int who, std::size_t attacks) {
  picked_.clear();
  std::sort(scored_.begin(), scored_.begin() + static_cast<std::ptrdiff_t>(attacks),
            [](const Scored& a, const Scored& b) { return a.better_than(b); });
  for (std::size_t i = 0; i < attacks && picked_.size() < kMostReplies; ++i) {
    const NextAction& next = *scored_[i].next;
    if (next.path.empty() && reach_of(node, who, next) > 0) picked_.push_back(scored_[i]);
  }
}

// Who is taken in by a feint does what it would do about the attack, and knows no better.
void Duel::foresee_taken_in(const Node& node) {
  const FeintAnswer& feint = *setup_->feint;
  const Launch& met = node.side[0].flight.launch;
  if (feint.feint != met.action || feint.start != met.start || feint.acts != node.now) return;
  const auto answer = std::find_if(scored_.begin(), scored_.end(),
                                   [&](const Scored& one) { return one.next->to == feint.answer; });
  if (answer == scored_.end()) return;
  counts_.candidates += picked_.size() - 1;
  picked_.assign(1, *answer);
}

// Points of f that a launch seen `count` times costs who was seen to launch another `most_seen`
// times in the same situation: as if it chose with odds that grow e-fold for each point.
double Duel::unusual(int count, int most_seen) const {
  return setup_->learning * kUnusual * std::log((most_seen + 1.0) / (count + 1.0));
}

// What the opponent was seen to do in such a situation comes first in its list, as much of it as is
// believed, and what it could do besides comes after, at a price. The list stays as long as ever:
// a shorter one would make the planner hope.
void Duel::foresee_habit(const Node& node, std::size_t most) {
  const Duelist& self = node.side[1];
  const float apart = glm::distance(node.side[0].flight.root_at(node.now).position(),
                                    self.flight.root_at(node.now).position());
  const InFlight& met = node.side[0].flight;
  const Situation situation = situation_of(
      apart, self.flight.table->action->kind,
      looks_like_attack(*met.table->action, met.launch, node.now, side(1).style->late_sight_s));
  const int total = setup_->habits->total(situation);
  if (total == 0) return;
  const auto begins = [](const Scored& one) {
    return one.next->path.empty() ? one.next->to : one.next->path.front();
  };
  const double believed = setup_->learning * Habits::belief(total) * total;
  foreseen_.clear();
  int covered = 0;
  for (const Habits::Seen& seen : setup_->habits->seen(situation)) {
    if (foreseen_.size() >= most || covered >= believed) break;
    covered += seen.count;
    const Scored* best = nullptr;  // of those that begin with what was seen
    for (const Scored& one : scored_) {
      if (begins(one) == seen.action && (best == nullptr || one.better_than(*best))) best = &one;
    }
    if (best != nullptr) foreseen_.push_back(*best);
  }
  for (const Scored& one : picked_) {
    if (foreseen_.size() >= most) break;
    const bool known = std::any_of(foreseen_.begin(), foreseen_.end(),
                                   [&](const Scored& f) { return f.next == one.next; });
    if (!known) foreseen_.push_back(one);
  }
  picked_.swap(foreseen_);
  int most_seen = 0;  // of what can follow here
  for (const Scored& one : picked_) {
    most_seen = std::max(most_seen, setup_->habits->count(situation, begins(one)));
  }
  for (Scored& one : picked_) {
    one.unusual = thousandths(unusual(setup_->habits->count(situation, begins(one)), most_seen));
  }
}

// The best of each choice that must not be missing, then the best of the rest; in order of score.
// A few are wanted of many: they are looked for one by one, and only they are sorted.
void Duel::pick_candidates(std::size_t most, const std::array<std::size_t, kChoices>& choices,
                           bool threatened) {
  picked_.clear();
  std::size_t left = std::min(most, scored_.size());
  counts_.candidates += scored_.size() - left;
  const auto take = [&](std::span<Scored> among, const auto& better) {
    Scored* best = nullptr;
    for (Scored& one : among) {
      if (!one.taken && (best == nullptr || better(one, *best))) best = &one;
    }
    if (best == nullptr || left == 0) return;
    best->taken = true;
    picked_.push_back(*best);
    --left;
  };
  const auto higher = [](const Scored& a, const Scored& b) { return a.better_than(b); };
  const auto farther = [](const Scored& a, const Scored& b) {
    return a.apart != b.apart ? a.apart > b.apart : a.better_than(b);
  };
  std::array<std::span<Scored>, kChoices> among;
  for (std::size_t i = 0, first = 0; i < kChoices; first += choices[i++]) {
    among[i] = std::span(scored_).subspan(first, choices[i]);
  }
  const auto [attacks, steps, defenses, idles] = among;
  take(attacks, higher);
  take(steps, higher);
  // The step that leads farthest from the opponent. Every score is that of standing well, so of two
  // who trade blows neither would ever look at the step that ends it.
  take(steps, farther);
  take(defenses, higher);
  if (threatened) take(defenses, higher);
  take(idles, higher);
  while (left > 0) take(scored_, higher);
  std::sort(picked_.begin(), picked_.end(), higher);  // no two are equal
}

}  // namespace ringcraft
