// From one decision to the next: contacts, evasions, the location integral and penetration.

#include <algorithm>
#include <cmath>

#include "physics/response.h"
#include "physics/tone.h"
#include "planner/duel.h"

namespace ringcraft {
namespace {

constexpr float kBodyRadius =
    0.25f;  // m: a blow that passes nearer to where a body stood was in reach
constexpr std::int32_t kHitFault = 1'000;

// Distance on the ground from `point` to the segment a-b.
float ground_distance(Vec3 point, Vec3 a, Vec3 b) {
  const Vec2 p(point.x - a.x, point.z - a.z), d(b.x - a.x, b.z - a.z);
  const float length2 = glm::dot(d, d);
  const float t = length2 > 1e-9f ? std::clamp(glm::dot(p, d) / length2, 0.0f, 1.0f) : 0.0f;
  return glm::length(p - d * t);
}

// The first multiple of `every` after `tick`.
Tick next_multiple(Tick tick, Tick every) {
  return (tick / every + 1) * every;
}

// Of a move under which bodies get so deep, m: in mm.
std::int32_t fault_of(float depth) {
  return 1 + static_cast<std::int32_t>(depth * 1000);
}

// What it does at `tick`. A pace of its own changes when a body is where, and so how fast it goes
// there, not what it offers to a blow.
BodyMoment moment_of(const InFlight& flight, Tick tick) {
  const ActionTable& table = *flight.table;
  const Tick age = table.clamped(flight.age(tick));
  if (table.clip == nullptr) return {&table, age};
  return {table.clip, table.clip->clamped(table.clip_age(age))};
}

}  // namespace

void Duel::find_windows(const Node& node, Tick end) {
  windows_.clear();
  const auto add = [&](int attacker, const InFlight& flight, int victim) {
    const InFlight& target = flight_of(node, victim);
    for (std::size_t i = 0; i < flight.table->strikes.size(); ++i) {
      const StrikeTable& strike = flight.table->strikes[i];
      if (flight.launch.has_spent(i)) continue;
      if (attacker >= 2 &&
          (i >= 4 || (node.threats_met >> (4 * (attacker - 2) + static_cast<int>(i)) & 1u) != 0))
        continue;
      const Tick from = std::max(node.now + 1, flight.launch.start + strike.strike.active_begin);
      const Tick last =
          std::min(flight.launch.end, flight.launch.start + strike.strike.active_end - 1);
      const Tick to = std::min(end, last);
      if (from > to || !may_reach(flight, strike, target)) continue;
      windows_.push_back({attacker, victim, i, &flight, from, to});
    }
  };
  const auto spared = [&](std::size_t side) {
    return node.side[side].balance == 2 && !setup_->settings.hits_on_downed;
  };
  if (!spared(1)) add(0, node.side[0].flight, 1);
  if (!spared(0)) add(1, node.side[1].flight, 0);
  for (std::size_t k = 0; k < setup_->others.size(); ++k) {
    const int other = 2 + static_cast<int>(k);
    for (std::size_t i = 0; i < 2; ++i) {
      const int one = static_cast<int>(i);
      if (!may_strike_each_other(one, k)) {
        add(one, node.side[i].flight, other);  // a team mate in the way stops a blow
      } else if (!spared(i)) {
        add(other, bystander(node, k), one);
      }
    }
  }
}

// The contact as physics is asked about it.
DuelEvent Duel::event_of(const Node& node, const Met& met) const {
  const Window& window = met.window;
  const InFlight& flight = *window.flight;
  const InFlight& struck = node.side[static_cast<std::size_t>(window.victim)].flight;
  DuelEvent event;
  event.tick = met.tick;
  event.attacker = window.attacker;
  event.victim = window.victim;
  event.attack = flight.launch.action;
  event.strike = window.strike;
  event.kind = met.contact.blocked ? DuelEvent::Kind::block : DuelEvent::Kind::hit;
  LandedBlow& blow = event.blow;
  blow.attacker = window.attacker < 2
                      ? side(window.attacker).body
                      : setup_->others[static_cast<std::size_t>(window.attacker - 2)].body;
  blow.victim = side(window.victim).body;
  blow.attack = moment_of(flight, met.tick);
  blow.struck = moment_of(struck, met.tick);
  const float tone = struck.table->in_flight() ? struck.table->tone : side(window.victim).tone;
  const Tick struck_at = struck.table->clip_age(struck.age(met.tick));
  blow.tone = tone * tone_left(*struck.table->action, struck_at);
  blow.kind = flight.table->strikes[window.strike].strike.kind;
  blow.contact = met.contact;
  const Frame seen = relative(struck.frame_at(met.tick), flight.frame_at(met.tick));
  blow.attacker_yaw = seen.yaw;
  blow.striking = seen.to_inner(met.contact.point);
  return event;
}

// Points of a landed blow, to the attacker and to whoever blocked it; the strike is spent.
void Duel::credit_landed(Node& node, const DuelEvent& event, bool knocks_down) {
  const std::int32_t damage = event.answer.damage;
  if (event.attacker >= 2) {
    node.threats_met |= std::uint64_t{1}
                        << (4 * (event.attacker - 2) + static_cast<int>(event.strike));
    if (event.victim != 0) return;
  } else {
    node.side[static_cast<std::size_t>(event.attacker)].flight.launch.spend(event.strike);
  }
  // A bystander's blow on the planner counts as if the opponent had struck.
  const int winner = std::min(event.attacker, 1);
  const SideSetup& attacker = side(winner);
  credit(node, winner, hit_points(attacker.weights, event.blow.kind, damage, knocks_down),
         Term::hit);
  const Duelist& victim = node.side[static_cast<std::size_t>(event.victim)];
  if (event.attacker < 2 && event.kind == DuelEvent::Kind::block &&
      victim.flight.table->action->defense) {
    const std::int32_t full =
        attacker.clean_damage[event.blow.attack.table->first_strike + event.strike];
    credit(node, event.victim, defense_points(side(event.victim).weights, full - damage),
           Term::defense);
  }
}

// Whether the mover has let a blow land that it could see coming.
bool Duel::unanswered(const Node& node, const DuelEvent& event, const InFlight& attacker,
                      const Move& move) const {
  if (move.forced || event.victim != move.side || event.kind != DuelEvent::Kind::hit) return false;
  const InFlight& struck = node.side[move.side].flight;
  const Tick known = struck.launch.start - attacker.launch.start;
  return !struck.table->action->defense && known >= ticks(side(move.side).style->late_sight_s);
}

void Duel::land(Node& node, const Met& met, const Move& move, std::int32_t& fault) {
  if (met.window.victim >= 2) {
    node.side[static_cast<std::size_t>(met.window.attacker)].flight.launch.spend(met.window.strike);
    return;
  }
  Duelist& victim = node.side[static_cast<std::size_t>(met.window.victim)];
  if (victim.pending.valid()) return;  // struck already at this tick
  DuelEvent event = event_of(node, met);
  ImpactAnswer& answer = event.answer;
  {
    const CostSpan span(setup_->cost, CostPart::response, CostPart::contact);
    answer = setup_->memo->answer(event.blow);
  }
  victim.health -= answer.damage;
  const bool out = victim.health <= 0;  // nobody stands without health, nor gets up
  const bool rises = victim.balance == 2 && victim.flight.table->action->kind == Kind::get_up;
  if (out && (rises || victim.balance != 2)) {
    answer.outcome.response = ResponseKind::knockdown;
    answer.outcome.knockout = true;
    const MotionTables& tables = *side(event.victim).tables;
    answer.response = choose_response(tables.library(), tables.body(), answer.outcome,
                                      event.blow.struck.faces(tables.library()),
                                      victim.flight.table->action->stance);
  }
  // Who gets up goes on with that unless the blow fells it or it is on its feet again.
  const bool felled = answer.outcome.response == ResponseKind::knockdown;
  const bool lies =
      victim.balance == 2 && !(rises && (felled || on_its_feet(side(event.victim).tables->body(),
                                                               event.blow.struck.pose())));
  if (events_ != nullptr) events_->push_back(event);
  if (setup_->settings.prune.unanswered_hit && unanswered(node, event, *met.window.flight, move)) {
    ++counts_.unanswered_hit;
    fault += kHitFault + answer.damage / 10;
  }
  credit_landed(node, event, !lies && felled);
  if (out && lies) {
    victim.knocked_out = true;
    victim.flight.launch.end = kNever;
  }
  const bool cut = interrupts(met.contact.blocked, answer.impulse, answer.outcome);
  if (lies || !cut) return;
  victim.pending = answer.response;
  victim.pending_share = answer.share;
  victim.queue = {};
  victim.knocked_out = answer.outcome.knockout;
  victim.flight.launch.end = met.tick;
  if (answer.outcome.response == ResponseKind::knockdown && !setup_->settings.hits_on_downed) {
    InFlight& other = node.side[static_cast<std::size_t>(1 - event.victim)].flight;
    other.launch.end = free_after_fall(*other.table->action, other.launch, met.tick);
  }
}

// One strike lands once, on whom it meets first.
void Duel::note_met(const Met& met) {
  const auto same = std::find_if(
      met_.begin(), met_.end(), [&](const Met& one) { return one.window.same_strike(met.window); });
  if (same == met_.end()) {
    met_.push_back(met);
  } else if (met.contact.share < same->contact.share) {
    *same = met;
  }
}

// Walks the windows tick by tick; returns the tick of the first hit that cuts an action, else
// `end`.
Tick Duel::meet(Node& node, Tick end, const Move& move, std::int32_t& fault) {
  const CostSpan span(setup_->cost, CostPart::contact);
  find_windows(node, end);
  if (windows_.empty()) return end;
  Tick first = end, last = 0;
  for (const Window& window : windows_) {
    first = std::min(first, window.from);
    last = std::max(last, window.to);
  }
  for (Tick tick = first; tick <= last; ++tick) {
    met_.clear();
    for (const Window& window : windows_) {
      if (tick < window.from || tick > window.to) continue;
      const auto contact = contact_at(*window.flight, window.flight->table->strikes[window.strike],
                                      flight_of(node, window.victim), tick);
      if (contact) note_met({window, *contact, tick});
    }
    for (const Met& one : met_) {
      for (Window& window : windows_) {
        if (window.same_strike(one.window)) window.to = tick - 1;
      }
    }
    for (const Met& one : met_) land(node, one, move, fault);
    if (node.side[0].pending.valid() || node.side[1].pending.valid()) return tick;
  }
  return end;
}

// A strike whose active window has passed without contact, against a body that was defending and
// would have been in reach: evaded.
void Duel::judge_evasions(Node& node, Tick from, Tick to) {
  for (int i = 0; i < 2; ++i) {
    Duelist& attacker = node.side[static_cast<std::size_t>(i)];
    const Duelist& victim = node.side[static_cast<std::size_t>(1 - i)];
    const InFlight& flight = attacker.flight;
    const auto& defense = victim.flight.table->action->defense;
    for (std::size_t s = 0; s < flight.table->strikes.size(); ++s) {
      const StrikeTable& strike = flight.table->strikes[s];
      const Tick begin = flight.launch.start + strike.strike.active_begin;
      const Tick over = flight.launch.start + strike.strike.active_end;
      if (over <= from || over > to || flight.launch.has_spent(s) || victim.pending.valid())
        continue;
      if (!defense || victim.balance == 2) continue;
      const Tick guarded = victim.flight.launch.when(defense->begin);
      const Tick open = victim.flight.launch.when(defense->end);
      if (open <= begin || guarded >= over) continue;
      const Frame frame = flight.frame_at(flight.launch.start + strike.landing_tick);
      const Vec3 stood = victim.flight.launch.placement.position();
      if (ground_distance(stood, {frame.x, 0, frame.z}, frame.to_outer(strike.landing)) >
          kBodyRadius)
        continue;
      const std::int32_t full = side(i).clean_damage[flight.table->first_strike + s];
      credit(node, 1 - i, defense_points(side(1 - i).weights, full), Term::defense);
      attacker.flight.launch.spend(s);
      if (events_ != nullptr) {
        DuelEvent event;
        event.tick = over;
        event.attacker = i;
        event.victim = 1 - i;
        event.attack = flight.launch.action;
        event.strike = s;
        event.kind = DuelEvent::Kind::evaded;
        events_->push_back(event);
      }
    }
  }
}

// F_loc over (from, to], sampled at multiples of kLocationEvery ticks, so that it adds up along a
// route however the route is cut into edges.
void Duel::add_location(Node& node, Tick from, Tick to) const {
  const CostSpan span(setup_->cost, CostPart::location);
  constexpr double kSpan = kLocationEvery * static_cast<double>(kTickSeconds);
  for (Tick tick = next_multiple(from, kLocationEvery); tick <= to; tick += kLocationEvery) {
    const Placement roots[2] = {node.side[0].flight.root_at(tick),
                                node.side[1].flight.root_at(tick)};
    for (int i = 0; i < 2; ++i) {
      if (setup_->factors.rest[i] == 0 && terms_ == nullptr) continue;
      const Placement &own = roots[i], &their = roots[1 - i];
      const float dx = their.x - own.x, dz = their.z - own.z;
      const float distance = std::sqrt(dx * dx + dz * dz);
      const float ahead = dx * std::sin(own.yaw) + dz * std::cos(own.yaw);
      const float cosine = distance > 1e-4f ? ahead / distance : 1.0f;
      double to_ropes = 1e3;
      if (setup_->settings.ring_half_m > 0) {
        to_ropes = setup_->settings.ring_half_m -
                   static_cast<double>(std::max(std::abs(own.x), std::abs(own.z)));
      }
      const bool down = !setup_->settings.hits_on_downed &&
                        node.side[static_cast<std::size_t>(1 - i)].balance == 2;
      credit(node, i,
             kSpan * location_rate(side(i).weights, distance, cosine, to_ropes, down,
                                   overlap(setup_->fallen, own.x, own.z)),
             Term::location);
    }
  }
}

std::int32_t Duel::penetration_fault(const Node& node, int mover, Tick from, Tick to) const {
  const CostSpan span(setup_->cost, CostPart::penetration);
  const PruneSettings& prune = setup_->settings.prune;
  const InFlight& self = duelist(node, mover).flight;
  const Tick every = std::max<Tick>(1, prune.penetration_every);
  const auto least = static_cast<float>(prune.penetration_m);
  float most = least;
  for (Tick tick = next_multiple(from, every); tick <= to; tick += every) {
    for (int i = 0; i < 2; ++i) {
      if (i == mover) continue;
      most = std::max(most, penetration_at(self, duelist(node, i).flight, tick, most));
    }
    for (std::size_t k = 0; k < setup_->others.size(); ++k) {
      if (setup_->others[k].lies() || mover == 2 + static_cast<int>(k)) continue;
      const bool foes = may_strike_each_other(mover, k);
      most = std::max(most, penetration_at(self, bystander(node, k), tick, most, foes));
    }
  }
  return most > least ? fault_of(most) : 0;
}

// A launch is looked at as a whole: its edge ends where the opponent acts, and whoever moves then
// is not to blame for where it leads. Who is in a body already may come out of it.
std::int32_t Duel::launch_fault(const Node& node, int who) const {
  const CostSpan span(setup_->cost, CostPart::penetration);
  const PruneSettings& prune = setup_->settings.prune;
  const InFlight& mover = duelist(node, who).flight;
  const Tick from = mover.launch.start, every = std::max<Tick>(1, prune.penetration_every);
  const auto least = static_cast<float>(prune.penetration_m);
  std::int32_t fault = 0;
  for (std::size_t k = 0; k < setup_->others.size(); ++k) {
    const bool foes = may_strike_each_other(who, k);
    if (who == 2 + static_cast<int>(k) || (foes && !setup_->others[k].lies())) continue;
    const InFlight& one = bystander(node, k);
    float most = std::max(least, penetration_at(mover, one, from, least, foes));
    const Tick to = std::min(mover.launch.end, one.launch.end);
    for (Tick tick = next_multiple(from, every); tick <= to; tick += every) {
      const float depth = penetration_at(mover, one, tick, most, foes);
      if (depth <= 0) continue;
      most = depth;
      fault = std::max(fault, fault_of(depth));
    }
  }
  return fault;
}

void Duel::play_on(Node& node) {
  Move nobody;
  nobody.forced = true;
  advance(node, nobody);
}

std::int32_t Duel::advance(Node& node, const Move& move) {
  if (node.side[0].pending.valid() || node.side[1].pending.valid()) return 0;
  const Tick from = node.now;
  const Tick end = std::min(next_end(node), next_reply(node));
  if (end <= from) return 0;
  std::int32_t fault = 0;
  const Tick to = meet(node, end, move, fault);
  judge_evasions(node, from, to);
  add_location(node, from, to);
  node.now = to;
  return fault;
}

}  // namespace ringcraft
