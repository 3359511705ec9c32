#include "planner/plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "planner/duel.h"
#include "planner/root_search.h"
#include "planner/soft_choice.h"
#include "planner/tally.h"
#include "planner/tree.h"

namespace ringcraft {
namespace {

constexpr std::size_t kMostLines = 6;
constexpr double kRarityKept = 0.9;     // phi <- 0.9 phi + 0.1 [launched]
constexpr Tick kHorizonStep = 30;       // 0.25 s
constexpr Tick kFirstHorizon = 90;      // 0.75 s
constexpr Tick kGrowthStep = 60;        // 0.5 s
constexpr Tick kFirstLiveHorizon = 60;  // under a time limit
constexpr double kFirstGrowth = 8;      // of the nodes per half second, before it is measured
constexpr Tick kLongestHorizon = 10 * kTicksPerSecond;

bool same_build(const BodySpec& a, const BodySpec& b) {
  return a.height == b.height && a.mass == b.mass && a.sex == b.sex && a.toughness == b.toughness;
}

// The attack that a feint begins like; none for anything else.
ActionId attack_of(const MotionLibrary& library, const Action& feint) {
  if (!feint.feint) return {};
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    const Action& action = library.actions()[i];
    if (action.name == feint.feint->of && action.stance == feint.stance) return ActionId(i);
  }
  return {};
}

using Roots = std::vector<RootMove<Duel>>;

struct Searched {
  Roots roots;
  Tick horizon = 0;  // ticks looked ahead
  DuelCounts root_counts;
  SearchCounts counts;  // of the horizon that was finished
};

}  // namespace

struct Planner::Inside {
  const MotionLibrary& library;
  std::vector<Contender> contenders;
  PlanSettings settings;
  std::uint64_t seed;
  std::vector<std::unique_ptr<MotionTables>> tables;  // one per different body
  std::vector<int> body_of;                           // contender -> tables
  std::unique_ptr<ImpactMemo> memo;
  // clean[attacker body][victim body][action][strike], thousandths.
  std::vector<std::vector<std::vector<std::vector<std::int32_t>>>> clean;
  std::vector<std::vector<double>> use;   // phi by contender and action
  std::vector<std::vector<double>> work;  // J by contender and action; empty where it never tires
  std::vector<Condition> condition;       // by contender
  std::vector<Habits> habits;             // by contender
  std::vector<ActionId> feigned;          // by action: the attack that a feint begins like
  SearchCost* cost = nullptr;

  Inside(const MotionLibrary& of, std::vector<Contender> who, PlanSettings how, std::uint64_t s,
         std::shared_ptr<ImpactStore> store);
  DuelSetup setup(const FightState& state, FighterId fighter, FighterId opponent,
                  Tick last_contact) const;
  SideSetup side_setup(FighterId fighter, FighterId other, double quiet) const;
  FighterId opponent_of(const FightState& state, FighterId fighter) const;
  FightState as_seen(const FightState& state, FighterId fighter, FighterId opponent) const;
  double work_of(FighterId fighter, ActionId action) const;
  Searched search(const DuelSetup& setup, const FightState& state, const SoftChoice& preference,
                  const PlanLimits& limits) const;
  Searched weighed_by_first_step(const DuelSetup& setup, const DuelNode& root,
                                 const SoftChoice& preference) const;
  SoftChoice preference(const FightState& state, FighterId fighter) const;
};

Planner::Inside::Inside(const MotionLibrary& of, std::vector<Contender> who, PlanSettings how,
                        std::uint64_t s, std::shared_ptr<ImpactStore> store)
    : library(of), contenders(std::move(who)), settings(how), seed(s) {
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Contender& one = contenders[i];
    const MotionLibrary& own = library.of(FighterId(i));
    const auto same = std::find_if(tables.begin(), tables.end(), [&](const auto& t) {
      return &t->library() == &own && same_build(t->body().spec, one.body.spec);
    });
    body_of.push_back(static_cast<int>(same - tables.begin()));
    if (same == tables.end()) tables.push_back(std::make_unique<MotionTables>(own, one.body));
  }
  std::vector<const MotionTables*> pointers;
  for (const auto& one : tables) pointers.push_back(one.get());
  memo = std::make_unique<ImpactMemo>(pointers, MemoSteps{}, std::move(store));
  clean.resize(tables.size());
  for (std::size_t a = 0; a < tables.size(); ++a) {
    clean[a].resize(tables.size());
    for (std::size_t v = 0; v < tables.size(); ++v) {
      for (std::size_t i = 0; i < library.actions().size(); ++i) {
        std::vector<std::int32_t> damages;
        for (std::size_t k = 0; k < library.actions()[i].strikes.size(); ++k) {
          damages.push_back(
              memo->clean_damage(static_cast<int>(a), ActionId(i), k, static_cast<int>(v)));
        }
        clean[a][v].push_back(std::move(damages));
      }
    }
  }
  use.assign(contenders.size(), std::vector<double>(library.actions().size(), 0.0));
  condition.resize(contenders.size());
  habits.resize(contenders.size());
  for (const Action& action : library.actions()) feigned.push_back(attack_of(library, action));
  work.resize(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    if (contenders[i].style.fatigue <= 0) continue;
    const MotionTables& own = *tables[static_cast<std::size_t>(body_of[i])];
    for (std::size_t a = 0; a < library.actions().size(); ++a) {
      work[i].push_back(kinetic_work(own.body(), own.at(ActionId(a)).pose));
    }
  }
}

double Planner::Inside::work_of(FighterId fighter, ActionId action) const {
  const std::vector<double>& own = work[fighter.at()];
  return own.empty() ? 0 : own[action.at()];
}

FighterId Planner::Inside::opponent_of(const FightState& state, FighterId fighter) const {
  const FighterState& self = state.fighters[fighter.at()];
  if (self.opponent.valid() && self.opponent != fighter &&
      self.opponent.at() < state.fighters.size()) {
    return self.opponent;
  }
  FighterId nearest;
  float least = std::numeric_limits<float>::max();
  const auto root = [&](std::size_t i) {
    return InFlight(*tables[static_cast<std::size_t>(body_of[i])], state.fighters[i].launch)
        .root_at(state.now);
  };
  const Placement own = root(fighter.at());
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    if (i == fighter.at()) continue;
    const float distance = glm::distance(own.position(), root(i).position());
    if (distance < least) least = distance, nearest = FighterId(i);
  }
  return nearest;
}

// The state as `fighter` takes it to be: an opponent's feint is the attack that it begins like,
// until it has parted from it for `late_sight_s`; who learns is no longer taken in when most of
// what began so were feints.
FightState Planner::Inside::as_seen(const FightState& state, FighterId fighter,
                                    FighterId opponent) const {
  FightState seen = state;
  Launch& launch = seen.fighters[opponent.at()].launch;
  const ActionId attack = feigned[launch.action.at()];
  const Style& style = contenders[fighter.at()].style;
  if (!attack.valid() || !looks_like_attack(library.action(launch.action), state.now - launch.start,
                                            style.late_sight_s)) {
    return seen;
  }
  if (style.learning * habits[opponent.at()].feint_expected(attack) > 0.5) return seen;
  launch.action = attack;
  launch.end = std::max(state.now, launch.start + library.action(attack).length());
  return seen;
}

SideSetup Planner::Inside::side_setup(FighterId fighter, FighterId other, double quiet) const {
  SideSetup side;
  side.body = body_of[fighter.at()];
  side.tables = tables[static_cast<std::size_t>(side.body)].get();
  side.id = fighter;
  side.style = &contenders[fighter.at()].style;
  side.weights = weights_at(*side.style, quiet);
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    const Action& action = library.actions()[i];
    const double points = launch_points(side.weights, *side.style, action, use[fighter.at()][i]);
    side.launch.push_back(
        thousandths(points - condition_cost(condition[fighter.at()], *side.style, action,
                                            work_of(fighter, ActionId(i)))));
  }
  side.clean_damage =
      clean[static_cast<std::size_t>(side.body)][static_cast<std::size_t>(body_of[other.at()])];
  return side;
}

DuelSetup Planner::Inside::setup(const FightState& state, FighterId fighter, FighterId opponent,
                                 Tick last_contact) const {
  const double quiet = seconds(std::max(0, state.now - last_contact));
  DuelSetup setup;
  setup.side[0] = side_setup(fighter, opponent, quiet);
  setup.side[1] = side_setup(opponent, fighter, quiet);
  setup.learning = setup.side[0].style->learning;
  if (setup.learning > 0) setup.habits = &habits[opponent.at()];
  setup.factors = leaf_factors(setup.side[0].weights);
  setup.settings = settings;
  setup.memo = memo.get();
  setup.cost = cost;
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    if (FighterId(i) == fighter || FighterId(i) == opponent) continue;
    Bystander one;
    one.body = body_of[i];
    one.id = FighterId(i);
    one.flight = InFlight(*tables[static_cast<std::size_t>(one.body)], state.fighters[i].launch);
    setup.others.push_back(one);
  }
  return setup;
}

// One step of every move: what is left when the node limit does not pay for the shortest horizon.
Searched Planner::Inside::weighed_by_first_step(const DuelSetup& setup, const DuelNode& root,
                                                const SoftChoice& preference) const {
  Searched result;
  result.horizon = kHorizonStep;
  Duel game(setup, root.now + kHorizonStep);
  std::vector<DuelMove> moves;
  game.moves(root, moves);
  for (const DuelMove& move : moves) {
    const Child<DuelNode> child = game.apply(root, move);
    result.roots.push_back({move,
                            child,
                            game.value(child.node),
                            preference(game.key(move)),
                            true,
                            {},
                            {1, 1, 0, 0, 0},
                            game});
  }
  std::stable_sort(result.roots.begin(), result.roots.end(),
                   [](const auto& a, const auto& b) { return a.sum() > b.sum(); });
  result.counts.nodes = result.counts.leaves = moves.size();
  return result;
}

// Iterative deepening by time: a short horizon first, whose best moves order the next and whose
// growth tells how far a limit will carry.
Searched Planner::Inside::search(const DuelSetup& setup, const FightState& state,
                                 const SoftChoice& preference, const PlanLimits& limits) const {
  const Style& style = *setup.side[0].style;
  const Tick wanted = std::clamp<Tick>(ticks(style.horizon_s), 1, kLongestHorizon);
  const DuelNode root = Duel::root(setup, state);
  SearchSettings search_settings;
  search_settings.cost = setup.cost;
  SearchStop stop;
  stop.set_flag(limits.stop);
  const auto begin = SearchStop::Clock::now();
  if (limits.seconds > 0) {
    stop.set_deadline(begin + std::chrono::duration_cast<SearchStop::Clock::duration>(
                                  std::chrono::duration<double>(limits.seconds)));
  }
  if (limits.any()) search_settings.stop = &stop;
  RootSearch<Duel> search(search_settings, settings.threads, settings.alpha_beta);
  const std::uint64_t limit = settings.node_limit;
  Searched best;
  Tick horizon = std::min(wanted, limits.any() ? kFirstLiveHorizon : kFirstHorizon);
  double growth = kFirstGrowth;
  std::uint64_t nodes_before = 0;
  while (true) {
    Duel game(setup, state.now + horizon);
    Roots roots = search.run(game, root, preference, limit);
    if (roots.empty()) break;
    const Tick before = best.horizon;
    best.roots = std::move(roots);
    best.horizon = horizon;
    best.root_counts = game.counts();
    best.counts = {};
    for (const RootMove<Duel>& move : best.roots) best.counts += move.counts;
    if (horizon >= wanted) break;
    const auto nodes = static_cast<double>(std::max<std::uint64_t>(1, search.spent()));
    if (before > 0 && nodes_before > 0) {
      const double half_seconds = 2 * seconds(horizon - before);
      growth = std::max(2.0, std::pow(nodes / static_cast<double>(nodes_before), 1 / half_seconds));
    }
    nodes_before = search.spent();
    // The next step, where what is left should pay for it.
    const double after =
        std::pow(growth, static_cast<double>(kHorizonStep) / static_cast<double>(kGrowthStep));
    if (limit != 0 && after > static_cast<double>(limit) / nodes) break;
    if (limits.seconds > 0) {
      const std::chrono::duration<double> spent = SearchStop::Clock::now() - begin;
      if (spent.count() * (1 + after) > limits.seconds) break;
    }
    horizon = std::min(wanted, horizon + kHorizonStep);
  }
  return best.roots.empty() ? weighed_by_first_step(setup, root, preference) : std::move(best);
}

SoftChoice Planner::Inside::preference(const FightState& state, FighterId fighter) const {
  const std::uint64_t moment = derived_seed(seed, "choice", static_cast<std::uint64_t>(state.now));
  return {contenders[fighter.at()].style.temperature,
          derived_seed(moment, "fighter", static_cast<std::uint64_t>(fighter.value))};
}

Event event_of(const DuelEvent& foreseen, const DuelSetup& setup, const MotionLibrary& library,
               const DuelNode& node) {
  const auto id = [&](int who) {
    return who < 2 ? setup.side[static_cast<std::size_t>(who)].id
                   : setup.others[static_cast<std::size_t>(who - 2)].id;
  };
  const ImpactAnswer& answer = foreseen.answer;
  const Frame frame =
      node.side[static_cast<std::size_t>(foreseen.victim)].flight.frame_at(foreseen.tick);
  Event event;
  event.tick = foreseen.tick;
  event.type = foreseen.kind == DuelEvent::Kind::hit     ? EventType::hit
               : foreseen.kind == DuelEvent::Kind::block ? EventType::block
                                                         : EventType::miss;
  event.who = id(foreseen.attacker);
  event.whom = id(foreseen.victim);
  event.action = library.action(foreseen.attack).name;
  event.strike = library.action(foreseen.attack).strikes[foreseen.strike].kind;
  if (foreseen.kind == DuelEvent::Kind::evaded) return event;
  event.part = name_of(foreseen.blow.contact.struck);
  event.point = frame.to_outer(foreseen.blow.contact.point);
  event.speed = -glm::dot(foreseen.blow.contact.velocity, foreseen.blow.contact.normal);
  event.damage = static_cast<float>(answer.damage) / 1000;
  event.response = answer.outcome.response;
  event.steps = answer.outcome.steps;
  event.direction = wrapped_angle(frame.yaw + answer.outcome.direction);
  event.knockout = answer.outcome.knockout;
  event.head_spin = answer.outcome.head_spin;
  return event;
}

namespace {

// What the line says will happen: the moves are played again and their events written down.
std::vector<Event> foreseen_events(const DuelSetup& setup, const MotionLibrary& library,
                                   const FightState& state, const RootMove<Duel>& chosen,
                                   Tick horizon) {
  std::vector<Event> events;
  Duel game(setup, state.now + horizon);
  DuelNode node = Duel::root(setup, state);
  std::vector<DuelMove> line{chosen.move};
  line.insert(line.end(), chosen.line.begin(), chosen.line.end());
  for (const DuelMove& move : line) {
    std::vector<DuelEvent> met;
    game.record_into(&met);
    node = game.apply(node, move).node;
    for (const DuelEvent& one : met) events.push_back(event_of(one, setup, library, node));
  }
  return events;
}

// The terms along a line that was kept, where they add up to its score: the table may have known
// the rest of it without the moves.
std::optional<std::array<LineTerms, 2>> terms_of(const RootMove<Duel>& root, const DuelSetup& setup,
                                                 const FightState& state, Tick horizon) {
  if (!root.exact) return std::nullopt;
  Duel game(setup, state.now + horizon);
  DuelTerms terms{};
  game.record_terms_into(&terms);
  DuelNode node = game.step(Duel::root(setup, state), root.move).node;
  for (const DuelMove& move : root.line) node = game.step(node, move).node;
  if (node.gained != root.value) return std::nullopt;
  std::array<LineTerms, 2> result;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto credited = [&](Term term) {
      return terms[i][static_cast<std::size_t>(term)].credited;
    };
    result[i] = {credited(Term::location), credited(Term::hit), credited(Term::defense),
                 credited(Term::control)};
  }
  return result;
}

// The first moves that rules struck off, in the order of the candidates.
std::vector<StruckOff> struck_off(const Roots& roots, const DuelSetup& setup,
                                  const MotionLibrary& library, const FightState& state,
                                  Tick horizon) {
  Duel game(setup, state.now + horizon);
  const DuelNode root = Duel::root(setup, state);
  std::vector<ActionId> turned;
  std::vector<DuelMove> moves;
  game.record_turned_into(&turned);
  game.moves(root, moves);
  game.record_turned_into(nullptr);
  std::vector<StruckOff> all;
  for (const DuelMove& move : moves) {
    const bool kept = std::any_of(roots.begin(), roots.end(), [&](const RootMove<Duel>& one) {
      return game.key(one.move) == game.key(move);
    });
    if (kept) continue;
    const DuelCounts before = game.counts();
    game.apply(root, move);
    StruckOff one{library.action(move.action).name, {}};
    for (const Pruned rule : reasons_between(before, game.counts())) {
      one.rules.emplace_back(name_of(rule));
    }
    all.push_back(std::move(one));
  }
  for (const ActionId one : turned) {
    all.push_back({library.action(one).name, {std::string(name_of(Pruned::back_turned))}});
  }
  return all;
}

Line line_of(const RootMove<Duel>& root, const DuelSetup& setup, const MotionLibrary& library) {
  Line line;
  line.score = root.value;
  line.at_most = !root.exact;
  const auto add = [&](const DuelMove& move) {
    const std::string& name = library.action(move.first()).name;
    line.actions.push_back(move.forced ? "*" + name : name);
    line.actors.push_back(setup.side[move.side].id.value);
  };
  add(root.move);
  for (const DuelMove& move : root.line) add(move);
  return line;
}

// The best first, those of which only an upper bound is known behind the others.
void add_lines(DecisionRecord& record, const Roots& roots, const DuelSetup& setup,
               const MotionLibrary& library, const FightState& state) {
  std::vector<const RootMove<Duel>*> order;
  order.reserve(roots.size());
  for (const RootMove<Duel>& root : roots) order.push_back(&root);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return a->exact != b->exact ? a->exact : a->value > b->value;
  });
  for (const RootMove<Duel>* root : order) {
    const bool chosen = root == &roots.front();
    if (record.lines.size() >= kMostLines && !chosen) continue;
    if (chosen) record.chosen = static_cast<std::int32_t>(record.lines.size());
    record.lines.push_back(line_of(*root, setup, library));
    record.lines.back().terms = terms_of(*root, setup, state, record.horizon);
  }
}

DecisionRecord record_of(const Searched& searched) {
  DecisionRecord record;
  record.horizon = searched.horizon;
  record.nodes = searched.counts.nodes;
  record.leaves = searched.counts.leaves;
  record.forced_nodes = searched.counts.forced;
  DuelCounts pruned = searched.root_counts;
  for (const RootMove<Duel>& move : searched.roots) pruned += move.game.counts();
  record.pruned_unanswered_hit = pruned.unanswered_hit;
  record.pruned_back_turned = pruned.back_turned;
  record.pruned_penetration = pruned.penetration;
  record.pruned_candidates = pruned.candidates;
  return record;
}

}  // namespace

Planner::Planner(const MotionLibrary& library, std::vector<Contender> contenders,
                 PlanSettings settings, std::uint64_t seed, std::shared_ptr<ImpactStore> store)
    : inside_(std::make_unique<Inside>(library, std::move(contenders), settings, seed,
                                       std::move(store))) {}

Planner::~Planner() = default;

namespace {

// Nobody to fight, or nothing that can follow: the action nearest to the end of the last one, else
// the last one held for half a second.
Plan resting(const MotionLibrary& library, const FightState& state, FighterId fighter,
             float scale) {
  const Launch& last = state.fighters[fighter.at()].launch;
  const std::vector<Edge>& edges = library.machine().edges(last.action);
  Plan plan;
  plan.launch = last;
  plan.launch.end = state.now + kTicksPerSecond / 2;
  if (!edges.empty()) {
    const Vec3 ahead = root_at(library, last, state.now, scale) * kForward;
    plan.launch = following(library, last, edges.front().to, state.now, ahead, scale, 0);
  }
  return plan;
}

}  // namespace

Plan Planner::plan(const FightState& state, FighterId fighter, Tick last_contact) {
  return plan(state, fighter, last_contact, {});
}

Plan Planner::plan(const FightState& truth, FighterId fighter, Tick last_contact,
                   const PlanLimits& limits) {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(truth, fighter);
  const float scale = in.tables[static_cast<std::size_t>(in.body_of[fighter.at()])]->body().scale;
  if (!opponent.valid()) return resting(in.library, truth, fighter, scale);
  const FightState state = in.as_seen(truth, fighter, opponent);
  const DuelSetup setup = in.setup(state, fighter, opponent, last_contact);
  const Searched searched = in.search(setup, state, in.preference(state, fighter), limits);
  if (searched.roots.empty()) return resting(in.library, state, fighter, scale);
  Plan plan;
  plan.record = record_of(searched);
  plan.reproducible = !limits.any();
  const RootMove<Duel>& move = searched.roots.front();
  add_lines(plan.record, searched.roots, setup, in.library, state);
  plan.record.struck_off = struck_off(searched.roots, setup, in.library, state, searched.horizon);
  const FighterState& self = state.fighters[fighter.at()];
  if (move.move.forced) {
    plan.launch = forced_get_up(in.library, self.launch, move.move.action, state.now, scale);
  } else {
    const InFlight other(*setup.side[1].tables, state.fighters[opponent.at()].launch);
    // Where a path leads to the chosen action, its first transition is launched; the fight may play
    // the rest (plan.then) or let the fighter decide anew.
    const ActionId action = move.move.first();
    for (const ActionId queued : move.child.node.side[0].queue) {
      if (queued.valid()) plan.then.push_back(queued);
    }
    plan.launch =
        following(in.library, self.launch, action, state.now, other.root_at(state.now).position(),
                  scale, in.library.action(action).attacks() ? kMostAttackAim : kMostAim);
  }
  plan.foreseen = foreseen_events(setup, in.library, state, move, searched.horizon);
  return plan;
}

std::vector<Event> Planner::foresee(const FightState& state, FighterId fighter) const {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(state, fighter);
  if (!opponent.valid()) return {};
  const DuelSetup setup = in.setup(state, fighter, opponent, state.now);
  Duel game(setup, state.now + kLongestHorizon);
  std::vector<DuelEvent> met;
  game.record_into(&met);
  DuelNode node = Duel::root(setup, state);
  node.side[0].flight.launch.end = state.fighters[fighter.at()].launch.end;  // nobody acts now
  game.play_on(node);
  std::vector<Event> events;
  for (const DuelEvent& one : met) {
    if (one.attacker == 0) events.push_back(event_of(one, setup, in.library, node));
  }
  return events;
}

DecisionTree Planner::tree(const FightState& state, FighterId fighter, Tick last_contact,
                           Tick horizon, std::size_t most_nodes) const {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(state, fighter);
  if (!opponent.valid()) return {};
  const FightState seen = in.as_seen(state, fighter, opponent);
  return expand_tree(in.setup(seen, fighter, opponent, last_contact), seen, horizon, most_nodes);
}

SearchTally Planner::tally(const FightState& state, FighterId fighter, Tick last_contact,
                           Tick horizon, const SearchTrial& trial) const {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(state, fighter);
  if (!opponent.valid()) return {};
  const FightState seen = in.as_seen(state, fighter, opponent);
  const DuelSetup setup = in.setup(seen, fighter, opponent, last_contact);
  return tally_of(setup, seen, horizon, trial, in.preference(state, fighter));
}

TreeShape Planner::shape(const FightState& state, FighterId fighter, Tick last_contact,
                         Tick horizon, int dives) const {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(state, fighter);
  if (!opponent.valid()) return {};
  const auto seed = derived_seed(in.seed, "shape", static_cast<std::uint64_t>(state.now));
  const FightState seen = in.as_seen(state, fighter, opponent);
  return shape_of(in.setup(seen, fighter, opponent, last_contact), seen, horizon, dives, seed);
}

void Planner::measure(SearchCost* cost) {
  assert(cost == nullptr || inside_->settings.threads <= 1);
  inside_->cost = cost;
}

void Planner::note_launch(FighterId fighter, ActionId action) {
  std::vector<double>& use = inside_->use[fighter.at()];
  for (double& share : use) share *= kRarityKept;
  use[action.at()] += 1 - kRarityKept;
}

void Planner::note_habit(const FightState& state, FighterId fighter, ActionId action) {
  const Inside& in = *inside_;
  const FighterId other = in.opponent_of(state, fighter);
  if (!other.valid()) return;
  const auto root = [&](FighterId who) {
    const MotionTables& tables = *in.tables[static_cast<std::size_t>(in.body_of[who.at()])];
    return InFlight(tables, state.fighters[who.at()].launch).root_at(state.now).position();
  };
  const Kind last = in.library.action(state.fighters[fighter.at()].launch.action).kind;
  const float apart = glm::distance(root(fighter), root(other));
  const Launch& met = state.fighters[other.at()].launch;
  const bool attacked = looks_like_attack(in.library.action(met.action), state.now - met.start,
                                          in.contenders[fighter.at()].style.late_sight_s);
  Habits& habits = inside_->habits[fighter.at()];
  habits.note(situation_of(apart, last, attacked), action);
  const ActionId feigned = in.feigned[action.at()];
  const bool attacks = in.library.action(action).attacks();
  if (attacks || feigned.valid()) habits.note_begun(feigned.valid() ? feigned : action, !attacks);
}

void Planner::set_condition(FighterId fighter, const Condition& condition) {
  inside_->condition[fighter.at()] = condition;
}

double Planner::work_of(FighterId fighter, ActionId action) const {
  return inside_->work_of(fighter, action);
}

Planner::MemoCounts Planner::memo_counts() const {
  const ImpactMemo::Counts counts = inside_->memo->counts();
  return {counts.lookups - counts.entries, counts.entries};
}

}  // namespace ringcraft
