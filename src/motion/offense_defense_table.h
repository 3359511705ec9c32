#pragma once
// The offense/defense table: for each attack the defenses that were launched against it, with how
// often each one worked, over the launch offset and the relative placement (Shum and Komura 2006,
// section 3.2). It is a pure function of sparring records, wherever these come from.

#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/index.h"
#include "base/ticks.h"
#include "motion/placement.h"

namespace ringcraft {

enum class ExchangeEnd : std::uint8_t { evaded, blocked, struck };
std::string_view name_of(ExchangeEnd end);

// One defense launched against one attack, and what came of it.
struct SparringRecord {
  ActionId attack, defense;
  Tick offset = 0;     // from the attack's launch to the defense's; negative: launched before
  Placement relative;  // the defender's root as seen from the attacker's when the attack starts
  ExchangeEnd end = ExchangeEnd::struck;
  // Of the attack's first blow alone: what a defense of one beat can answer of a combination.
  ExchangeEnd first = ExchangeEnd::struck;

  bool worked() const { return end != ExchangeEnd::struck; }
};

// Width of a bin of the histogram.
inline constexpr Tick kOffsetBin = 6;              // 50 ms
inline constexpr float kDistanceBin = 0.1f;        // m between the roots
inline constexpr float kBearingBin = radians(20);  // of the defender off the attacker's facing

struct ExchangeBin {
  std::int32_t offset = 0, distance = 0, bearing = 0;  // which bin, by rounding down
  std::uint32_t launched = 0, worked = 0;
  auto key() const { return std::tuple(offset, distance, bearing); }
};

// One defense against one attack.
struct DefenseEntry {
  ActionId defense;
  std::uint32_t launched = 0, worked = 0;
  std::vector<ExchangeBin> bins;  // only those with records, sorted by key

  float share() const { return static_cast<float>(worked) / static_cast<float>(launched); }
};

// Successes of one launch offset over all placements.
struct ExchangeTiming {
  Tick offset = 0;  // start of the bin
  std::uint32_t launched = 0, worked = 0;
  float share() const { return static_cast<float>(worked) / static_cast<float>(launched); }
};
std::vector<ExchangeTiming> timings(const DefenseEntry& entry);  // by offset
// The offset with the largest share of success, the earliest of equals. The entry is not empty.
ExchangeTiming best_timing(const DefenseEntry& entry);

class OffenseDefenseTable {
 public:
  OffenseDefenseTable() = default;
  // Records in any order give the same table. Their ids must be valid.
  explicit OffenseDefenseTable(std::span<const SparringRecord> records);

  bool empty() const { return entries_.empty(); }
  // What was launched against the attack: the largest share of success first, then more launches,
  // then the lower id. Empty where nothing was.
  std::span<const DefenseEntry> against(ActionId attack) const;
  const DefenseEntry* entry(ActionId attack, ActionId defense) const;

  // How much more often the defense works against this attack than against all attacks together
  // (ratio of shares): above 1 the pair belongs together. 0 where there is no entry.
  float lift(ActionId attack, ActionId defense) const;

 private:
  std::vector<std::vector<DefenseEntry>> entries_;               // by attack
  std::vector<std::pair<std::uint32_t, std::uint32_t>> totals_;  // by defense: launched, worked
};

}  // namespace ringcraft
