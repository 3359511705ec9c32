// What those outside the duel may choose: one reply, by one of them.

#include <algorithm>

#include "planner/duel.h"

namespace ringcraft {

const Replier& Duel::replier(int other) const {
  return *std::find_if(setup_->repliers.begin(), setup_->repliers.end(),
                       [&](const Replier& one) { return one.other == other; });
}

const Duelist& Duel::duelist(const Node& node, int who) const {
  if (who < 2) return node.side[static_cast<std::size_t>(who)];
  return node.replier == who - 2 ? node.reply : replier(who - 2).now;
}

Tick Duel::sides_end(const Node& node) {
  return std::min(node.side[0].flight.launch.end, node.side[1].flight.launch.end);
}

Tick Duel::next_reply(const Node& node) const {
  const auto next = static_cast<std::size_t>(node.asked);
  if (node.replier >= 0 || next >= setup_->repliers.size()) return kNever;
  return setup_->repliers[next].free();
}

// Where a side is free at the same tick it comes first.
bool Duel::asks(const Node& node) const {
  return next_reply(node) <= node.now && next_end(node) > node.now;
}

// The attacks that reach the planner first: a pass is the best only where none of them does.
void Duel::find_replies(const Node& node, std::vector<Move>& moves) {
  const Replier& one = setup_->repliers[static_cast<std::size_t>(node.asked)];
  const auto who = static_cast<std::uint8_t>(2 + one.other);
  score_candidates(node, who);
  for (const Scored& attack : picked_) moves.push_back({attack.next->to, who, false, attack.next});
  moves.push_back({one.now.flight.launch.action, who, false, nullptr});
}

void Duel::reply(Node& node, const Move& move) const {
  if (move.passes()) {
    ++node.asked;
    return;
  }
  node.replier = move.side - 2;
  node.reply = replier(node.replier).now;
  node.threats_met &= ~(std::uint64_t{0xf} << (4 * node.replier));
  launch_chosen(node, move);
}

}  // namespace ringcraft
