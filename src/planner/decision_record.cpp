#include "planner/decision_record.h"

#include <algorithm>
#include <array>
#include <optional>

#include "planner/tree.h"

namespace ringcraft {
namespace {

constexpr std::size_t kMostLines = 6;

const MotionLibrary& library_of(const DuelSetup& setup) {
  return setup.side[0].tables->library();
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

// The first moves that rules struck off: those that show the back, then the others.
std::vector<StruckOff> struck_off(const Searched& searched, const DuelSetup& setup,
                                  const FightState& state) {
  const MotionLibrary& library = library_of(setup);
  Duel game(setup, state.now + searched.horizon);
  const DuelNode root = Duel::root(setup, state);
  Sifted sifted = sift(game, root, library);
  for (const DuelMove& move : sifted.moves) {
    const bool kept = std::any_of(
        searched.roots.begin(), searched.roots.end(),
        [&](const RootMove<Duel>& one) { return game.key(one.move) == game.key(move); });
    if (kept) continue;
    const DuelCounts before = game.counts();
    game.apply(root, move);
    sifted.pruned.push_back(
        {library.action(move.action).name, reasons_between(before, game.counts())});
  }
  std::vector<StruckOff> all;
  for (const TreePruned& one : sifted.pruned) {
    all.push_back({one.action, {}});
    for (const Pruned rule : one.reasons) all.back().rules.emplace_back(name_of(rule));
  }
  return all;
}

Line line_of(const RootMove<Duel>& root, const DuelSetup& setup) {
  Line line;
  line.score = root.value;
  line.at_most = !root.exact;
  const auto add = [&](const DuelMove& move) {
    if (move.passes()) return;  // nothing is launched
    const std::string& name = library_of(setup).action(move.first()).name;
    line.actions.push_back(move.forced ? "*" + name : name);
    line.actors.push_back(id_of(setup, move.side).value);
  };
  add(root.move);
  for (const DuelMove& move : root.line) add(move);
  return line;
}

// The best first, those of which only an upper bound is known behind the others.
void add_lines(DecisionRecord& record, const Roots& roots, const DuelSetup& setup,
               const FightState& state) {
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
    record.lines.push_back(line_of(*root, setup));
    record.lines.back().terms = terms_of(*root, setup, state, record.horizon);
  }
}

}  // namespace

DecisionRecord decision_record(const DuelSetup& setup, const FightState& state,
                               const Searched& searched) {
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
  add_lines(record, searched.roots, setup, state);
  record.struck_off = struck_off(searched, setup, state);
  return record;
}

std::vector<Event> foreseen_events(const DuelSetup& setup, const FightState& state,
                                   const Searched& searched) {
  std::vector<Event> events;
  Duel game(setup, state.now + searched.horizon);
  DuelNode node = Duel::root(setup, state);
  const RootMove<Duel>& chosen = searched.roots.front();
  std::vector<DuelMove> line{chosen.move};
  line.insert(line.end(), chosen.line.begin(), chosen.line.end());
  for (const DuelMove& move : line) {
    std::vector<DuelEvent> met;
    game.record_into(&met);
    node = game.apply(node, move).node;
    for (const DuelEvent& one : met) events.push_back(event_of(one, setup, node));
  }
  return events;
}

Event event_of(const DuelEvent& foreseen, const DuelSetup& setup, const DuelNode& node) {
  const MotionLibrary& library = library_of(setup);
  const ImpactAnswer& answer = foreseen.answer;
  const Frame frame =
      node.side[static_cast<std::size_t>(foreseen.victim)].flight.frame_at(foreseen.tick);
  Event event;
  event.tick = foreseen.tick;
  event.type = foreseen.kind == DuelEvent::Kind::hit     ? EventType::hit
               : foreseen.kind == DuelEvent::Kind::block ? EventType::block
                                                         : EventType::miss;
  event.who = id_of(setup, foreseen.attacker);
  event.whom = id_of(setup, foreseen.victim);
  event.action = library.action(foreseen.attack).name;
  event.strike = library.action(foreseen.attack).strikes[foreseen.strike].kind;
  if (foreseen.kind == DuelEvent::Kind::evaded) return event;
  event.part = name_of(foreseen.blow.contact.struck);
  event.point = frame.to_outer(foreseen.blow.contact.point);
  const Vec3 line = line_of_blow(foreseen.blow.contact);
  event.impulse = yaw_rotation(frame.yaw) * line * answer.impulse;
  event.speed = glm::dot(foreseen.blow.contact.velocity, line);
  event.damage = static_cast<float>(answer.damage) / 1000;
  event.response = answer.outcome.response;
  event.steps = answer.outcome.steps;
  event.direction = wrapped_angle(frame.yaw + answer.outcome.direction);
  event.knockout = answer.outcome.knockout;
  event.head_spin = answer.outcome.head_spin;
  return event;
}

}  // namespace ringcraft
