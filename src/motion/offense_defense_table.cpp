#include "motion/offense_defense_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace ringcraft {

namespace {

std::int32_t bin_of(float value, float width) {
  return static_cast<std::int32_t>(std::floor(value / width));
}

ExchangeBin bin_at(Tick offset, const Placement& relative) {
  ExchangeBin bin;
  bin.offset = bin_of(static_cast<float>(offset), static_cast<float>(kOffsetBin));
  bin.distance = bin_of(std::hypot(relative.x, relative.z), kDistanceBin);
  // Straight ahead lies in the middle of a bin.
  bin.bearing = bin_of(yaw_of(relative.position()) + kBearingBin / 2, kBearingBin);
  return bin;
}

}  // namespace

std::string_view name_of(ExchangeEnd end) {
  switch (end) {
    case ExchangeEnd::evaded:
      return "evaded";
    case ExchangeEnd::blocked:
      return "blocked";
    case ExchangeEnd::struck:
      return "struck";
  }
  return "";
}

std::vector<ExchangeTiming> timings(const DefenseEntry& entry) {
  std::vector<ExchangeTiming> found;  // the bins are sorted by offset first
  for (const ExchangeBin& bin : entry.bins) {
    const Tick offset = bin.offset * kOffsetBin;
    if (found.empty() || found.back().offset != offset) found.push_back({offset, 0, 0});
    found.back().launched += bin.launched;
    found.back().worked += bin.worked;
  }
  return found;
}

ExchangeTiming best_timing(const DefenseEntry& entry) {
  const std::vector<ExchangeTiming> all = timings(entry);
  assert(!all.empty());
  return *std::max_element(
      all.begin(), all.end(), [](const ExchangeTiming& a, const ExchangeTiming& b) {
        return std::uint64_t{a.worked} * b.launched < std::uint64_t{b.worked} * a.launched;
      });
}

OffenseDefenseTable::OffenseDefenseTable(std::span<const SparringRecord> records) {
  using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
  std::map<std::pair<ActionId, ActionId>, std::map<Key, ExchangeBin>> counted;
  for (const SparringRecord& record : records) {
    ExchangeBin bin = bin_at(record.offset, record.relative);
    ExchangeBin& kept =
        counted[{record.attack, record.defense}].try_emplace(bin.key(), bin).first->second;
    ++kept.launched;
    if (record.worked()) ++kept.worked;
  }
  for (const auto& [pair, bins] : counted) {
    const auto [attack, defense] = pair;
    if (entries_.size() <= attack.at()) entries_.resize(attack.at() + 1);
    if (totals_.size() <= defense.at()) totals_.resize(defense.at() + 1);
    DefenseEntry entry;
    entry.defense = defense;
    entry.bins.reserve(bins.size());
    for (const auto& [key, bin] : bins) {
      entry.bins.push_back(bin);
      entry.launched += bin.launched;
      entry.worked += bin.worked;
    }
    totals_[defense.at()].first += entry.launched;
    totals_[defense.at()].second += entry.worked;
    entries_[attack.at()].push_back(std::move(entry));
  }
  for (std::vector<DefenseEntry>& row : entries_)
    std::stable_sort(row.begin(), row.end(), [](const DefenseEntry& a, const DefenseEntry& b) {
      // Shares are compared as products of whole numbers: no equality of floats decides.
      const std::uint64_t left = std::uint64_t{a.worked} * b.launched;
      const std::uint64_t right = std::uint64_t{b.worked} * a.launched;
      if (left != right) return left > right;
      return a.launched != b.launched ? a.launched > b.launched : a.defense < b.defense;
    });
}

std::span<const DefenseEntry> OffenseDefenseTable::against(ActionId attack) const {
  if (!attack.valid() || attack.at() >= entries_.size()) return {};
  return entries_[attack.at()];
}

const DefenseEntry* OffenseDefenseTable::entry(ActionId attack, ActionId defense) const {
  for (const DefenseEntry& one : against(attack))
    if (one.defense == defense) return &one;
  return nullptr;
}

float OffenseDefenseTable::lift(ActionId attack, ActionId defense) const {
  const DefenseEntry* found = entry(attack, defense);
  if (found == nullptr) return 0;
  const auto [launched, worked] = totals_[defense.at()];
  if (worked == 0) return 0;
  return found->share() * static_cast<float>(launched) / static_cast<float>(worked);
}

}  // namespace ringcraft
