#pragma once
// The soft choice: a move with probability ~ exp(value / temperature).

#include <cstdint>

namespace ringcraft {

// What is added to the values of a node's moves, in thousandths of a point, before the largest sum
// is taken: independent draws of the Gumbel distribution, scaled by the temperature (points), make
// that a draw from the softmax of the values (Gumbel 1954; Maddison, Tarlow and Minka 2014), so
// that one search for one largest sum does where a softmax needs every value. Draws are kept
// between -1.5 and 4.5 temperatures: a move more than 6 temperatures below the best is never
// chosen.
class SoftChoice {
 public:
  static constexpr double kMostBelow = 6;  // temperatures

  SoftChoice(double temperature, std::uint64_t seed) : temperature_(temperature), seed_(seed) {}

  std::int32_t operator()(std::uint32_t move) const;

 private:
  double temperature_;
  std::uint64_t seed_;  // of the decision
};

}  // namespace ringcraft
