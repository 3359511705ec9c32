#pragma once
// Where the time of a search goes, by the clock. For studies: nothing that is decided depends on
// it.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace ringcraft {

// `response` is what the impact memo answers, impulse steps included; `contact` is without it.
enum class CostPart : std::uint8_t {
  candidates,
  ordering,
  contact,
  response,
  location,
  penetration
};
inline constexpr std::size_t kCostParts = 6;
inline constexpr std::array<const char*, kCostParts> kCostPartNames = {
    "candidates", "ordering", "contact", "response", "location", "penetration"};

struct SearchCost {
  std::array<double, kCostParts> seconds{};
};

// Adds its own lifetime to a part, and takes it off the part around it; null costs nothing.
class CostSpan {
 public:
  CostSpan(SearchCost* cost, CostPart part) : CostSpan(cost, part, part) {}
  CostSpan(SearchCost* cost, CostPart part, CostPart inside)
      : cost_(cost),
        part_(static_cast<std::size_t>(part)),
        inside_(static_cast<std::size_t>(inside)) {
    if (cost_ != nullptr) begin_ = Clock::now();
  }
  ~CostSpan() {
    if (cost_ == nullptr) return;
    const double took = std::chrono::duration<double>(Clock::now() - begin_).count();
    cost_->seconds[part_] += took;
    if (inside_ != part_) cost_->seconds[inside_] -= took;
  }
  CostSpan(const CostSpan&) = delete;
  CostSpan& operator=(const CostSpan&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  SearchCost* cost_;
  std::size_t part_, inside_;
  Clock::time_point begin_;
};

}  // namespace ringcraft
