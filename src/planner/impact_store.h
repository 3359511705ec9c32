#pragma once
// The impact store: impulse steps that are known already, shared by planners.
//
// A key names library, body and the quantised blow, so a store can be handed from fight to fight.
// It changes how long an answer takes, never the answer.

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
  std::int32_t damage = 0;  // thousandths of a point
  float impulse = 0;        // N s
  bool operator==(const ImpactAnswer&) const = default;
};

struct ImpactKey {
  std::uint64_t steps = 0;  // the quantised numbers
  std::uint64_t world = 0;  // library and bodies
  bool operator==(const ImpactKey&) const = default;
};
struct ImpactKeyHash {
  std::size_t operator()(const ImpactKey& key) const;
};

class ImpactStore {
 public:
  std::optional<ImpactAnswer> find(const ImpactKey& key) const;
  void add(const ImpactKey& key, const ImpactAnswer& answer);
  std::size_t size() const;

 private:
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<ImpactKey, ImpactAnswer, ImpactKeyHash> entries;
  };
  const Shard& shard_of(const ImpactKey& key) const {
    return shards_[(ImpactKeyHash()(key) >> 8) % shards_.size()];
  }
  std::array<Shard, 16> shards_;
};

}  // namespace ringcraft
