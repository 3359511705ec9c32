#include "planner/impact_store.h"

namespace ringcraft {

std::size_t ImpactKeyHash::operator()(const ImpactKey& key) const {
  std::uint64_t h =
      key.steps * 0x9e3779b97f4a7c15ULL ^ (key.world + 0x7f4a7c15ULL) * 0xc2b2ae3d27d4eb4fULL;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9ULL;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

std::optional<ImpactAnswer> ImpactStore::find(const ImpactKey& key) const {
  const Shard& shard = shard_of(key);
  const std::lock_guard lock(shard.mutex);
  const auto found = shard.entries.find(key);
  if (found == shard.entries.end()) return std::nullopt;
  return found->second;
}

void ImpactStore::add(const ImpactKey& key, const ImpactAnswer& answer) {
  auto& shard = shards_[(ImpactKeyHash()(key) >> 8) % shards_.size()];
  const std::lock_guard lock(shard.mutex);
  shard.entries.try_emplace(key, answer);
}

std::size_t ImpactStore::size() const {
  std::size_t sum = 0;
  for (const Shard& shard : shards_) {
    const std::lock_guard lock(shard.mutex);
    sum += shard.entries.size();
  }
  return sum;
}

}  // namespace ringcraft
