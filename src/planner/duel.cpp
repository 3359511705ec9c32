#include "planner/duel.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/partial.h"

namespace ringcraft {
namespace {

// splitmix64's finalizer over a running value.
class Mixer {
 public:
  Mixer& add(std::uint64_t value) {
    state_ += 0x9e3779b97f4a7c15ULL + value;
    state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9ULL;
    state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebULL;
    state_ ^= state_ >> 31;
    return *this;
  }
  Mixer& add(float a, float b) {
    return add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(a)) << 32 |
               std::bit_cast<std::uint32_t>(b));
  }
  Mixer& add(std::int32_t a, std::int32_t b) {
    return add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 |
               static_cast<std::uint32_t>(b));
  }
  std::uint64_t digest() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace

DuelCounts& DuelCounts::operator+=(const DuelCounts& o) {
  unanswered_hit += o.unanswered_hit;
  back_turned += o.back_turned;
  penetration += o.penetration;
  candidates += o.candidates;
  return *this;
}

DuelCounts DuelCounts::operator-(const DuelCounts& o) const {
  return {unanswered_hit - o.unanswered_hit, back_turned - o.back_turned,
          penetration - o.penetration, candidates - o.candidates};
}

Duel::Duel(const DuelSetup& setup, Tick horizon) : setup_(&setup), horizon_(horizon) {
  for (std::size_t i = 0; i < 2; ++i) {
    const SideSetup& own = setup.side[i];
    LaunchRange& range = launches_[i];
    for (const std::int32_t points : own.launch) {
      range.least = std::min(range.least, points / 1000.0);
      range.most = std::max(range.most, points / 1000.0);
    }
    range.most += reach_bonus(own.weights);
    range.least -=
        own.weights.control * own.weights.duration * seconds(own.launches().longest_lead());
  }
}

DuelNode Duel::root(const DuelSetup& setup, const FightState& state) {
  Node node;
  node.now = state.now;
  for (std::size_t i = 0; i < 2; ++i) {
    const FighterState& fighter = state.fighters[setup.side[i].id.at()];
    Duelist& duelist = node.side[i];
    duelist.flight = InFlight(*setup.side[i].tables, fighter.launch);
    if (setup.side[i].in_flight != nullptr) duelist.flight.table = setup.side[i].in_flight;
    duelist.flight.launch.end = std::max(fighter.launch.end, state.now);
    duelist.health = fighter.health;
    duelist.balance = fighter.balance;
    duelist.last_at_tie = fighter.last_at_tie;
    duelist.knocked_out = fighter.launch.end >= kNever;
  }
  node.side[0].flight.launch.end = state.now;  // the planner acts now, first where both do
  if (node.side[1].flight.launch.end == state.now) {
    node.side[0].last_at_tie = true;
    node.side[1].last_at_tie = false;
  }
  return node;
}

int Duel::next_side(const Node& node) const {
  const Duelist &a = node.side[0], &b = node.side[1];
  if (a.flight.launch.end != b.flight.launch.end) {
    return a.flight.launch.end < b.flight.launch.end ? 0 : 1;
  }
  if (a.last_at_tie != b.last_at_tie) return a.last_at_tie ? 0 : 1;
  return side(0).id < side(1).id ? 0 : 1;
}

Actor Duel::actor(const Node& node) const {
  if (node.side[0].pending.valid() || node.side[1].pending.valid()) return Actor::forced;
  if (asks(node)) return Actor::minimizer;
  const int next = next_side(node);
  const Duelist& one = node.side[static_cast<std::size_t>(next)];
  if (one.queue[0].valid() || one.flight.table->get_up.valid()) return Actor::forced;
  return next == 0 ? Actor::maximizer : Actor::minimizer;
}

std::uint64_t Duel::hash(const Node& node) const {
  Mixer mixer;
  mixer.add(node.now, 0).add(node.threats_met);
  const auto add = [&](const Duelist& one) {
    const Launch& launch = one.flight.launch;
    mixer.add(launch.action.value, launch.start).add(launch.end, one.pending.value);
    mixer.add(launch.placement.x, launch.placement.z).add(launch.placement.yaw, launch.aim);
    mixer.add(launch.share, one.pending.valid() ? one.pending_share : 1.0f);
    mixer.add(one.balance * 4 + (one.last_at_tie ? 2 : 0) + (one.knocked_out ? 1 : 0),
              launch.spent);
    mixer.add(one.health, 0);
    for (const ActionId queued : one.queue) mixer.add(queued.value, 0);
  };
  for (const Duelist& one : node.side) add(one);
  if (node.asked > 0) mixer.add(node.asked, node.replier);
  if (node.replier >= 0) add(node.reply);
  return mixer.digest();
}

bool Duel::may_strike_each_other(int who, std::size_t other) const {
  const int team = who < 2 ? setup_->side[static_cast<std::size_t>(who)].team
                           : setup_->others[static_cast<std::size_t>(who - 2)].team;
  return !of_one_team(team, setup_->others[other].team);
}

// Whether one of its strikes may still land or be judged; one that has landed counts as well.
bool Duel::may_strike(const InFlight& flight, Tick after) const {
  const std::vector<StrikeTable>& strikes = flight.table->strikes;
  return std::any_of(strikes.begin(), strikes.end(), [&](const StrikeTable& one) {
    return flight.launch.start + one.strike.active_begin <= horizon_ &&
           flight.launch.start + one.strike.active_end > after;
  });
}

ValueRange Duel::range(const Node& node) const {
  if (node.side[0].pending.valid() || node.side[1].pending.valid()) return {};
  if (next_reply(node) < horizon_) return {};
  for (std::size_t k = 0; k < setup_->others.size(); ++k) {
    if (!may_strike_each_other(0, k) && !may_strike_each_other(1, k)) continue;
    if (may_strike(bystander(node, k), node.now)) return {};
  }
  constexpr double kSpan = kLocationEvery * static_cast<double>(kTickSeconds);
  constexpr double kRounding = 0.001;  // points: every credit is rounded by itself
  const Tick samples = (horizon_ - node.now) / kLocationEvery + 1;
  double least = 0, most = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const SideSetup& own = setup_->side[i];
    const InFlight& flight = node.side[i].flight;
    if (flight.launch.end + own.launches().lull() < horizon_ || may_strike(flight, node.now)) {
      return {};
    }
    const int launches = flight.launch.end < horizon_ ? 1 : 0;
    const double rate = least_location_rate(own.weights, setup_->fallen.size());
    const double low = static_cast<double>(samples) * (kSpan * rate - kRounding) +
                       launches * (launches_[i].least - 2 * kRounding);
    const double high = launches * (launches_[i].most + kRounding);
    const double factor = setup_->factors.rest[i];
    least += std::min(factor * low, factor * high);
    most += std::max(factor * low, factor * high);
    if (i == 1 && setup_->habits != nullptr) {
      most += launches * (unusual(0, setup_->habits->most()) + kRounding);
    }
  }
  return {node.gained + static_cast<std::int32_t>(std::floor(1000 * least)),
          node.gained + static_cast<std::int32_t>(std::ceil(1000 * most))};
}

void Duel::note_term(int who, Term term, double points, std::int32_t credited) const {
  if (terms_ == nullptr) return;
  const std::size_t i = who == 0 ? 0 : 1;  // who replies is an opponent
  TermSum& sum = (*terms_)[i][static_cast<std::size_t>(term)];
  sum.points += points;
  sum.credited += credited;
}

void Duel::credit(Node& node, int who, double points, Term term) const {
  const std::size_t i = who == 0 ? 0 : 1;  // who replies is an opponent
  const bool event = term == Term::hit || term == Term::defense;
  const std::int32_t credited =
      thousandths(points * (event ? setup_->factors.events[i] : setup_->factors.rest[i]));
  node.gained += credited;
  note_term(who, term, points, credited);
}

void Duel::launch_forced(Node& node, int who, ActionId action) const {
  Duelist& duelist = node.side[static_cast<std::size_t>(who)];
  const MotionTables& tables = *side(who).tables;
  const MotionLibrary& library = tables.library();
  const float scale = tables.body().scale;
  const Action& what = library.action(action);
  const Launch& last = duelist.flight.launch;
  Launch next = what.kind == Kind::get_up ? forced_get_up(library, last, action, node.now, scale)
                                          : forced_response(library, last, action, node.now, scale);
  if (what.response && what.response->kind != ResponseKind::knockdown) {
    next.share = duelist.pending_share;
    next.end = next.start + free_again(tables.at(action).way_left, next.share);
  }
  duelist.flight = InFlight(tables, next);
  duelist.pending = {};
  if (what.kind == Kind::get_up) {
    duelist.balance = 2;
  } else if (what.response) {
    const ResponseKind kind = what.response->kind;
    duelist.balance = kind == ResponseKind::knockdown        ? 2
                      : kind == ResponseKind::recovery_steps ? 1
                                                             : 0;
    const bool stays = kind == ResponseKind::knockdown && !duelist.flight.table->get_up.valid();
    if (duelist.knocked_out || stays) duelist.flight.launch.end = kNever;
  }
}

// An action out of the own stance, by a direct edge, aimed at the opponent.
void Duel::launch_aimed(Node& node, int who, const NextAction& next) const {
  Duelist& self = who < 2 ? node.side[static_cast<std::size_t>(who)] : node.reply;
  const Duelist& opponent = duelist(node, against(who));
  const SideSetup& own = side(who);
  const Placement placement = (Frame(self.flight.root_at(node.now)) * next.alignment).placement();
  const Action& what = *next.table->action;
  Launch launch;
  launch.action = next.to;
  launch.start = node.now;
  launch.end = node.now + next.length;
  launch.pace = next.table->pace;
  launch.placement = placement;
  launch.aim = aim_at(what, placement, opponent.flight.root_at(node.now).position(),
                      own.tables->body().scale, what.attacks() ? kMostAttackAim : kMostAim);
  self.flight = InFlight(own.launches(), launch);
  self.balance = 0;
}

// Launch costs count in full at the choice; a path costs its duration on top.
void Duel::launch_chosen(Node& node, const Move& move) const {
  const SideSetup& own = side(move.side);
  const std::vector<ActionId>& path = move.next->path;
  const Followers& follow = own.launches().after(*duelist(node, move.side).flight.table);
  const double bonus = reach_bonus(own.weights);
  const double reach = bonus > 0 && !move.next->strikes.empty()
                           ? static_cast<double>(reach_of(node, move.side, *move.next))
                           : 0.0;
  launch_aimed(node, move.side, path.empty() ? *move.next : *follow.find(path.front()));
  for (std::size_t i = 0; i < path.size(); ++i) {
    node.side[move.side].queue[i] = i + 1 < path.size() ? path[i + 1] : move.action;
  }
  credit(node, move.side, own.launch[move.action.at()] / 1000.0, Term::control);
  node.gained += move.unusual;
  note_term(move.side, Term::control, 0, move.unusual);
  credit(node, move.side, bonus * reach, Term::control);
  credit(node, move.side, -own.weights.control * own.weights.duration * seconds(move.next->lead),
         Term::control);
}

Child<DuelNode> Duel::apply(const Node& node, const Move& move) {
  Child<Node> child = step(node, move);
  check(node, move, child);
  return child;
}

void Duel::check(const Node& /*node*/, const Move& move, Child<Node>& child) {
  if (move.forced || move.passes() || !setup_->settings.prune.penetration) return;
  const InFlight& self = duelist(child.node, move.side).flight;
  // Who is asked for a reply cuts the edge, and is not to blame for where its mover goes on to.
  const Tick to = move.side < 2 && asks(child.node) ? sides_end(child.node) : child.node.now;
  std::int32_t& deep = child.node.too_deep;
  if (child.node.checked == self.launch.start) deep = launch_fault(child.node, move.side);
  deep = std::max(deep, penetration_fault(child.node, move.side, child.node.checked, to));
  if (deep > 0) ++counts_.penetration;
  child.fault += deep;
  child.node.checked = to;
}

bool Duel::resume(const Node& /*node*/, const Move& move, Child<Node>& child) {
  const auto struck = [&] {
    return child.node.side[0].pending.valid() || child.node.side[1].pending.valid();
  };
  if (struck()) return true;
  const DuelCounts before = counts_;
  child.fault += advance(child.node, move);
  // A hit that cuts an action takes back what the edge was credited with for earlier evasions.
  if (struck()) counts_ = before;
  return !struck();
}

Child<DuelNode> Duel::step(const Node& node, const Move& move) {
  Child<Node> child{node, 0};
  child.node.checked = node.now, child.node.too_deep = 0;
  if (move.side >= 2) {
    reply(child.node, move);
    child.fault = advance(child.node, move);
    return child;
  }
  Duelist& self = child.node.side[move.side];
  Duelist& other = child.node.side[static_cast<std::size_t>(1 - move.side)];
  const bool responds = self.pending.valid();
  if (!responds && !other.pending.valid() &&
      self.flight.launch.end == other.flight.launch.end) {  // a tie: the other goes first next time
    self.last_at_tie = false;
    other.last_at_tie = true;
  }
  if (move.forced && self.queue[0].valid()) {
    std::rotate(self.queue.begin(), self.queue.begin() + 1, self.queue.end());
    self.queue.back() = {};
    const Followers& follow = side(move.side).launches().after(*self.flight.table);
    launch_aimed(child.node, move.side, *follow.find(move.action));
  } else if (move.forced) {
    launch_forced(child.node, move.side, move.action);
  } else {
    launch_chosen(child.node, move);
  }
  child.fault = advance(child.node, move);
  return child;
}

void Duel::moves(const Node& node, std::vector<Move>& moves) {
  moves.clear();
  for (std::uint8_t i = 0; i < 2; ++i) {
    if (node.side[i].pending.valid()) {
      moves.push_back({node.side[i].pending, i, true, nullptr});
      return;
    }
  }
  if (asks(node)) return find_replies(node, moves);
  const auto next = static_cast<std::uint8_t>(next_side(node));
  const ActionId queued = node.side[next].queue[0];
  if (queued.valid()) {
    moves.push_back({queued, next, true, nullptr});
    return;
  }
  const ActionId get_up = node.side[next].flight.table->get_up;
  if (get_up.valid()) {
    moves.push_back({get_up, next, true, nullptr});
    return;
  }
  score_candidates(node, next);
  for (const Scored& one : picked_) {
    moves.push_back({one.next->to, next, false, one.next, one.unusual});
  }
}

}  // namespace ringcraft
