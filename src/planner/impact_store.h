#pragma once
// The impact store: what impacts are known already, shared by planners.
//
// A key names library, bodies and the quantised numbers, so a store can be handed from fight to
// fight. It changes how long an answer takes, never the answer.

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "base/index.h"
#include "physics/impact.h"

namespace ringcraft {

// What physics answers.
struct ImpactAnswer {
  ImpactOutcome outcome;  // its direction is a yaw in the victim's action space
  ActionId response;
  float share = 1;          // of the response that is shown
  std::int32_t damage = 0;  // thousandths of a point
  float impulse = 0;        // N s
  bool operator==(const ImpactAnswer&) const = default;
};

struct ImpactKey {
  std::uint64_t steps = 0, more = 0;  // the quantised numbers
  std::uint64_t world = 0;            // library and bodies
  bool operator==(const ImpactKey&) const = default;
};
struct ImpactKeyHash {
  std::size_t operator()(const ImpactKey& key) const;
};

// Values by key, for any number of threads; what is there stays as it is.
template <class Value>
class ImpactShelf {
 public:
  std::optional<Value> find(const ImpactKey& key) const {
    const Shard& shard = shards_[place_of(key)];
    const std::lock_guard lock(shard.mutex);
    const auto found = shard.entries.find(key);
    if (found == shard.entries.end()) return std::nullopt;
    return found->second;
  }
  void add(const ImpactKey& key, const Value& value) {
    Shard& shard = shards_[place_of(key)];
    const std::lock_guard lock(shard.mutex);
    shard.entries.try_emplace(key, value);
  }
  std::size_t size() const {
    std::size_t sum = 0;
    for (const Shard& shard : shards_) {
      const std::lock_guard lock(shard.mutex);
      sum += shard.entries.size();
    }
    return sum;
  }

 private:
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<ImpactKey, Value, ImpactKeyHash> entries;
  };
  std::size_t place_of(const ImpactKey& key) const {
    return (ImpactKeyHash()(key) >> 8) % shards_.size();
  }
  std::array<Shard, 16> shards_;
};

struct ImpactStore {
  ImpactShelf<ImpactAnswer> answers;     // impulse steps
  ImpactShelf<PartMobility> mobilities;  // of parts that strike or are struck
  ImpactShelf<OwnMotion> own_motions;    // what struck bodies do by themselves
};

}  // namespace ringcraft
