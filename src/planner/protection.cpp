#include "planner/protection.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "planner/sparring.h"

namespace ringcraft {

namespace {

// Exchanges that failed, added to those of each timing: a few say little.
constexpr float kUnsure = 2;

auto sort_of(const StrikeTable& blow) {
  return std::tuple(blow.strike.kind, blow.strike.zone, blow.main);
}

}  // namespace

Protection::Protection(const MotionTables& tables) : actions_(tables.library().actions().size()) {
  std::map<decltype(sort_of({})), std::size_t> sorts;
  for (std::size_t i = 0; i < actions_; ++i) {
    for (const StrikeTable& blow : tables.at(ActionId(i)).strikes) {
      sort_.push_back(sorts.try_emplace(sort_of(blow), sorts.size()).first->second);
    }
  }
  SparringSettings settings;
  settings.offset_step = 2 * kOffsetBin;
  settings.idles = 1;
  // Of every attack its first blow, by how long before that the defense is launched.
  std::vector<SparringRecord> records = spar(tables, tables, settings).records;
  for (SparringRecord& one : records) {
    const StrikeTable& blow = tables.at(one.attack).strikes.front();
    one.attack = ActionId(sorts.at(sort_of(blow)));
    one.offset -= blow.strike.active_begin;
    one.end = one.first;
  }
  const OffenseDefenseTable table(records);
  shares_.assign(sorts.size() * actions_, 0);
  std::vector<float> sum(actions_);
  std::size_t landed = 0;
  for (std::size_t sort = 0; sort < sorts.size(); ++sort) {
    const std::span<const DefenseEntry> entries = table.against(ActionId(sort));
    landed += entries.empty() ? 0 : 1;
    for (const DefenseEntry& entry : entries) {
      float& best = shares_[sort * actions_ + entry.defense.at()];
      for (const ExchangeTiming& timing : timings(entry)) {
        best = std::max(best, static_cast<float>(timing.worked) /
                                  (static_cast<float>(timing.launched) + kUnsure));
      }
      sum[entry.defense.at()] += best;
    }
  }
  if (landed == 0) return;
  for (std::size_t sort = 0; sort < sorts.size(); ++sort) {
    if (!table.against(ActionId(sort)).empty()) continue;
    for (std::size_t i = 0; i < actions_; ++i) {
      shares_[sort * actions_ + i] = sum[i] / static_cast<float>(landed);
    }
  }
}

}  // namespace ringcraft
