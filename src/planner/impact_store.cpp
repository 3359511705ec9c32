#include "planner/impact_store.h"

namespace ringcraft {

std::size_t ImpactKeyHash::operator()(const ImpactKey& key) const {
  std::uint64_t h = key.steps * 0x9e3779b97f4a7c15ULL ^ key.more * 0xd6e8feb86659fd93ULL ^
                    (key.world + 0x7f4a7c15ULL) * 0xc2b2ae3d27d4eb4fULL;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9ULL;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

}  // namespace ringcraft
