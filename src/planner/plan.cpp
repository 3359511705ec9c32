#include "planner/plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/random.h"
#include "planner/decision_record.h"
#include "planner/horizon_search.h"
#include "planner/tally.h"
#include "planner/tree.h"

namespace ringcraft {
namespace {

constexpr double kRarityKept = 0.9;  // phi <- 0.9 phi + 0.1 [launched]

// Steps of fatigue between which a search does not tell: of 3 % of the clips' speed. An error of
// as much costs nothing that shows (docs/planning.md), and this one is half of it at most.
constexpr int kFatigueSteps = 5;

double seen_fatigue(int step) {
  return static_cast<double>(step) / kFatigueSteps;
}
int fatigue_step(const Condition& condition) {
  return static_cast<int>(std::lround(kFatigueSteps * condition.fatigue()));
}

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

// Whether a fighter of that style no longer falls for what an opponent of those habits feigns.
bool sees_through(const Style& style, const Habits& opponent, ActionId attack) {
  return style.learning * opponent.feint_expected(attack) > 0.5;
}

}  // namespace

struct Planner::Inside {
  const MotionLibrary& library;
  std::vector<Contender> contenders;
  PlanSettings settings;
  std::uint64_t seed;
  std::vector<std::unique_ptr<MotionTables>> tables;  // one per different body
  std::vector<int> body_of;                           // contender -> tables
  // By body and step of fatigue: made where somebody comes to be so tired, then kept.
  std::vector<std::map<int, std::unique_ptr<MotionTables>>> paced;
  std::optional<Protection> protection;  // of the first body: the actions are the same for all
  std::unique_ptr<ImpactMemo> memo;
  // clean[attacker body][victim body][strike of the attacker's tables], thousandths.
  std::vector<std::vector<std::vector<std::int32_t>>> clean;
  std::vector<std::vector<double>> use;   // phi by contender and action
  std::vector<std::vector<double>> work;  // J by contender and action; empty where it never tires
  std::vector<Condition> condition;       // by contender
  std::vector<Habits> habits;             // by contender
  std::vector<ActionId> feigned;          // by action: the attack that a feint begins like
  struct Shown {
    Launch launch;
    ActionTable table;
  };
  std::vector<std::optional<Shown>> shown;  // by contender
  SearchCost* cost = nullptr;
  SearchPool<Duel> searches;  // of plan()

  Inside(const MotionLibrary& of, std::vector<Contender> who, PlanSettings how, std::uint64_t s,
         std::shared_ptr<ImpactStore> store);
  DuelSetup setup(const FightState& state, FighterId fighter, FighterId opponent) const;
  void add_repliers(DuelSetup& duel, const FightState& state) const;
  SideSetup side_setup(const FightState& state, FighterId fighter, FighterId other) const;
  const ActionTable* in_flight(FighterId fighter, const Launch& launch) const;
  FighterId opponent_of(const FightState& state, FighterId fighter) const;
  Vec3 root_of(const FightState& state, FighterId fighter) const;
  float apart(const FightState& state, FighterId one, FighterId other) const;  // m
  bool enemies(FighterId one, FighterId other) const {
    return one != other && !of_one_team(contenders[one.at()].team, contenders[other.at()].team);
  }
  FightState as_seen(const FightState& state, FighterId fighter, FighterId opponent) const;
  double work_of(FighterId fighter, ActionId action) const;
  SoftChoice preference(const FightState& state, FighterId fighter) const;

  // A decision as its fighter sees it.
  struct View {
    FighterId opponent;
    FightState state;
    DuelSetup setup;
  };
  std::optional<FeintAnswer> feint_of(const FightState& state, FighterId fighter,
                                      FighterId opponent) const;
  // Nothing where there is nobody to fight.
  std::optional<View> view(const FightState& truth, FighterId fighter,
                           bool weigh_feints = true) const {
    const FighterId opponent = opponent_of(truth, fighter);
    if (!opponent.valid()) return std::nullopt;
    FightState seen = as_seen(truth, fighter, opponent);
    DuelSetup duel = setup(seen, fighter, opponent);
    if (settings.replies) add_repliers(duel, seen);
    if (weigh_feints) duel.feint = feint_of(seen, fighter, opponent);
    return View{opponent, std::move(seen), std::move(duel)};
  }
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
  paced.resize(tables.size());
  if (!tables.empty()) protection.emplace(*tables.front());
  std::vector<const MotionTables*> pointers;
  for (const auto& one : tables) pointers.push_back(one.get());
  memo = std::make_unique<ImpactMemo>(pointers, MemoSteps{}, std::move(store));
  clean.resize(tables.size());
  for (std::size_t a = 0; a < tables.size(); ++a) {
    clean[a].resize(tables.size());
    for (std::size_t v = 0; v < tables.size(); ++v) {
      const MotionTables& own = *tables[a];
      for (std::size_t i = 0; i < own.library().actions().size(); ++i) {
        for (std::size_t k = 0; k < own.at(ActionId(i)).strikes.size(); ++k) {
          clean[a][v].push_back(
              memo->clean_damage(static_cast<int>(a), ActionId(i), k, static_cast<int>(v)));
        }
      }
    }
  }
  use.assign(contenders.size(), std::vector<double>(library.actions().size(), 0.0));
  condition.resize(contenders.size());
  habits.resize(contenders.size());
  shown.resize(contenders.size());
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

// The table of the launch as it is shown, where it is known.
const ActionTable* Planner::Inside::in_flight(FighterId fighter, const Launch& launch) const {
  const std::optional<Shown>& one = shown[fighter.at()];
  if (!one || one->launch.action != launch.action || one->launch.start != launch.start ||
      one->launch.share != launch.share) {
    return nullptr;
  }
  return &one->table;
}

FighterId Planner::Inside::opponent_of(const FightState& state, FighterId fighter) const {
  const FighterState& self = state.fighters[fighter.at()];
  if (self.opponent.valid() && self.opponent != fighter &&
      self.opponent.at() < state.fighters.size()) {
    return self.opponent;
  }
  FighterId nearest;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    if (!enemies(fighter, FighterId(i))) continue;
    const float distance = apart(state, fighter, FighterId(i));
    if (distance < least) least = distance, nearest = FighterId(i);
  }
  return nearest;
}

Vec3 Planner::Inside::root_of(const FightState& state, FighterId fighter) const {
  const float scale = tables[static_cast<std::size_t>(body_of[fighter.at()])]->body().scale;
  return root_at(library, state.fighters[fighter.at()].launch, state.now, scale).position();
}

float Planner::Inside::apart(const FightState& state, FighterId one, FighterId other) const {
  return glm::distance(root_of(state, one), root_of(state, other));
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
  if (!attack.valid() ||
      !looks_like_attack(library.action(launch.action), launch, state.now, style.late_sight_s)) {
    return seen;
  }
  if (sees_through(style, habits[opponent.at()], attack)) return seen;
  launch = taken_for(launch, attack, library.action(attack), state.now);
  return seen;
}

// The feint that `fighter` could begin now and that would take its opponent in, with what the
// opponent's own plan against the attack is: who feints puts itself in the other's place. Of
// several the one that was used least, for each costs a search.
std::optional<FeintAnswer> Planner::Inside::feint_of(const FightState& state, FighterId fighter,
                                                     FighterId opponent) const {
  const Launch& self = state.fighters[fighter.at()].launch;
  const FighterState& other = state.fighters[opponent.at()];
  const Tick acts = other.launch.end;
  const bool watches = opponent_of(state, opponent) == fighter && other.balance != 2;
  if (!watches || acts < state.now) return std::nullopt;
  const MotionTables& own = *tables[static_cast<std::size_t>(body_of[fighter.at()])];
  const float scale = own.body().scale;
  const Style& theirs = contenders[opponent.at()].style;
  const Vec3 target = root_of(state, opponent);
  const float far = apart(state, fighter, opponent);
  const std::vector<double>& used = use[fighter.at()];
  std::optional<Launch> best;
  for (const NextAction& next : own.after(own.at(self.action)).next) {
    const ActionId attack = feigned[next.to.at()];
    if (!attack.valid() || !next.path.empty()) continue;
    if (sees_through(theirs, habits[fighter.at()], attack)) continue;
    const std::vector<StrikeTable>& strikes = own.at(attack).strikes;
    const bool reaches = std::any_of(strikes.begin(), strikes.end(), [&](const StrikeTable& one) {
      return one.reach + kMostGap > far;
    });
    const Launch feint = following(library, self, next.to, state.now, target, scale, kMostAim);
    if (!reaches || !looks_like_attack(library.action(next.to), feint, acts, theirs.late_sight_s)) {
      continue;
    }
    if (!best || used[next.to.at()] < used[best->action.at()]) best = feint;
  }
  if (!best) return std::nullopt;
  const ActionId attack = feigned[best->action.at()];
  FightState then = state;
  then.now = acts;
  then.fighters[fighter.at()].launch = taken_for(*best, attack, library.action(attack), acts);
  const DuelSetup against = setup(then, opponent, fighter);
  SearchPool<Duel> pool;
  const Searched searched = search_ahead(against, then, SoftChoice(0, 0), {}, pool);
  if (searched.roots.empty()) return std::nullopt;
  return FeintAnswer{best->action, state.now, acts, searched.roots.front().move.action};
}

SideSetup Planner::Inside::side_setup(const FightState& state, FighterId fighter,
                                      FighterId other) const {
  const double quiet = seconds(std::max(0, state.now - state.fighters[fighter.at()].last_contact));
  SideSetup side;
  side.body = body_of[fighter.at()];
  side.tables = tables[static_cast<std::size_t>(side.body)].get();
  if (const int step = fatigue_step(condition[fighter.at()]); step > 0) {
    side.paced = paced[static_cast<std::size_t>(side.body)].at(step).get();
    side.tone = tone_at(seen_fatigue(step));
  }
  side.id = fighter;
  side.team = contenders[fighter.at()].team;
  side.style = &contenders[fighter.at()].style;
  side.weights =
      weights_at(*side.style, quiet, apart(state, fighter, other), side.tables->body().scale);
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

DuelSetup Planner::Inside::setup(const FightState& state, FighterId fighter,
                                 FighterId opponent) const {
  DuelSetup setup;
  setup.side[0] = side_setup(state, fighter, opponent);
  setup.side[1] = side_setup(state, opponent, fighter);
  for (SideSetup& side : setup.side) {
    side.in_flight = in_flight(side.id, state.fighters[side.id.at()].launch);
  }
  setup.learning = setup.side[0].style->learning;
  if (setup.learning > 0) setup.habits = &habits[opponent.at()];
  setup.factors = leaf_factors(setup.side[0].weights);
  setup.settings = settings;
  setup.protection = &*protection;
  setup.memo = memo.get();
  setup.cost = cost;
  for (std::size_t i = 0; i < state.fighters.size(); ++i) {
    if (FighterId(i) == fighter || FighterId(i) == opponent) continue;
    Bystander one;
    one.body = body_of[i];
    one.id = FighterId(i);
    one.team = contenders[i].team;
    one.flight = InFlight(*tables[static_cast<std::size_t>(one.body)], state.fighters[i].launch);
    if (const ActionTable* table = in_flight(one.id, one.flight.launch)) one.flight.table = table;
    setup.others.push_back(one);
    if (one.lies()) setup.fallen.emplace_back(one.flight);
  }
  return setup;
}

// Of the others, those that stand and whose chief opponent the planner is.
void Planner::Inside::add_repliers(DuelSetup& duel, const FightState& state) const {
  const FighterId self = duel.side[0].id;
  for (std::size_t k = 0; k < duel.others.size(); ++k) {
    const Bystander& one = duel.others[k];
    const FighterState& fighter = state.fighters[one.id.at()];
    if (fighter.opponent != self || of_one_team(one.team, duel.side[0].team)) continue;
    if (fighter.down() || one.lies()) continue;
    Replier replier;
    replier.other = static_cast<int>(k);
    replier.now.flight = one.flight;
    replier.choice = side_setup(state, one.id, self);
    duel.repliers.push_back(std::move(replier));
  }
  std::stable_sort(duel.repliers.begin(), duel.repliers.end(),
                   [](const Replier& a, const Replier& b) { return a.free() < b.free(); });
}

SoftChoice Planner::Inside::preference(const FightState& state, FighterId fighter) const {
  const std::uint64_t moment = derived_seed(seed, "choice", static_cast<std::uint64_t>(state.now));
  return {contenders[fighter.at()].style.temperature,
          derived_seed(moment, "fighter", static_cast<std::uint64_t>(fighter.value))};
}

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

Plan Planner::plan(const FightState& state, FighterId fighter) {
  return plan(state, fighter, {});
}

Plan Planner::plan(const FightState& truth, FighterId fighter, const PlanLimits& limits) {
  Inside& in = *inside_;
  const float scale = in.tables[static_cast<std::size_t>(in.body_of[fighter.at()])]->body().scale;
  // Another's plan is a search of its own: there is no time for it under a limit.
  const std::optional<Inside::View> view = in.view(truth, fighter, !limits.any());
  if (!view) return resting(in.library, truth, fighter, scale);
  const FightState& state = view->state;
  const DuelSetup& setup = view->setup;
  const Searched searched =
      search_ahead(setup, state, in.preference(state, fighter), limits, in.searches);
  if (searched.roots.empty()) return resting(in.library, state, fighter, scale);
  Plan plan;
  plan.record = decision_record(setup, state, searched);
  plan.reproducible = !limits.any();
  const RootMove<Duel>& move = searched.roots.front();
  const FighterState& self = state.fighters[fighter.at()];
  if (move.move.forced) {
    plan.launch = forced_get_up(in.library, self.launch, move.move.action, state.now, scale);
  } else {
    const InFlight other = Duel::root(setup, state).side[1].flight;
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
  plan.foreseen = foreseen_events(setup, state, searched);
  return plan;
}

std::vector<Event> Planner::foresee(const FightState& state, FighterId fighter) const {
  const Inside& in = *inside_;
  const FighterId opponent = in.opponent_of(state, fighter);
  if (!opponent.valid()) return {};
  const DuelSetup setup = in.setup(state, fighter, opponent);
  Duel game(setup, state.now + kLongestHorizon);
  std::vector<DuelEvent> met;
  game.record_into(&met);
  DuelNode node = Duel::root(setup, state);
  node.side[0].flight.launch.end = state.fighters[fighter.at()].launch.end;  // nobody acts now
  game.play_on(node);
  std::vector<Event> events;
  for (const DuelEvent& one : met) {
    if (one.attacker == 0) events.push_back(event_of(one, setup, node));
  }
  return events;
}

DecisionTree Planner::tree(const FightState& state, FighterId fighter, Tick horizon,
                           std::size_t most_nodes) const {
  const std::optional<Inside::View> view = inside_->view(state, fighter);
  return view ? expand_tree(view->setup, view->state, horizon, most_nodes) : DecisionTree{};
}

SearchTally Planner::tally(const FightState& state, FighterId fighter, Tick horizon,
                           const SearchTrial& trial) const {
  const std::optional<Inside::View> view = inside_->view(state, fighter);
  if (!view) return {};
  return tally_of(view->setup, view->state, horizon, trial,
                  inside_->preference(view->state, fighter));
}

TreeShape Planner::shape(const FightState& state, FighterId fighter, Tick horizon,
                         int dives) const {
  const std::optional<Inside::View> view = inside_->view(state, fighter);
  if (!view) return {};
  const auto seed = derived_seed(inside_->seed, "shape", static_cast<std::uint64_t>(state.now));
  return shape_of(view->setup, view->state, horizon, dives, seed);
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
  const Kind last = in.library.action(state.fighters[fighter.at()].launch.action).kind;
  const Launch& met = state.fighters[other.at()].launch;
  const bool attacked = looks_like_attack(in.library.action(met.action), met, state.now,
                                          in.contenders[fighter.at()].style.late_sight_s);
  Habits& habits = inside_->habits[fighter.at()];
  habits.note(situation_of(in.apart(state, fighter, other), last, attacked), action);
  const ActionId feigned = in.feigned[action.at()];
  const bool attacks = in.library.action(action).attacks();
  if (attacks || feigned.valid()) habits.note_begun(feigned.valid() ? feigned : action, !attacks);
}

void Planner::show(FighterId fighter, const MotionInFlight& motion) {
  const auto body = static_cast<std::size_t>(inside_->body_of[fighter.at()]);
  ActionTable table = inside_->tables[body]->in_flight(motion);
  table.motion = inside_->memo->begin_motion();
  inside_->shown[fighter.at()] = {motion.launch, std::move(table)};
}

void Planner::set_condition(FighterId fighter, const Condition& condition) {
  Inside& in = *inside_;
  in.condition[fighter.at()] = condition;
  const auto body = static_cast<std::size_t>(in.body_of[fighter.at()]);
  const int step = fatigue_step(condition);
  if (step == 0) return;
  std::unique_ptr<MotionTables>& slower = in.paced[body][step];
  if (slower != nullptr) return;
  slower = std::make_unique<MotionTables>(*in.tables[body], pace_at(seen_fatigue(step)));
}

double Planner::work_of(FighterId fighter, ActionId action) const {
  return inside_->work_of(fighter, action);
}

Planner::MemoCounts Planner::memo_counts() const {
  const ImpactMemo::Counts counts = inside_->memo->counts();
  return {counts.lookups - counts.entries, counts.entries};
}

}  // namespace ringcraft
