#pragma once
// The impact memo: impulse steps by quantised input, of one fight. The outcome is computed from the
// quantised values, so a memo never changes a result. The impulse itself is exact: what the parts
// offer to it is kept by action and tick.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "physics/impact.h"
#include "physics/response.h"
#include "planner/impact_store.h"
#include "planner/motion_tables.h"
#include "planner/pose_classes.h"

namespace ringcraft {

// Steps of the quantisation.
struct MemoSteps {
  Tick ticks = 6;        // of the victim's action
  int azimuths = 8;      // directions of the impulse around the victim, 45 degrees each
  float impulse = 3.0f;  // N s
};

// What a body is doing at a tick.
struct BodyMoment {
  const ActionTable* table = nullptr;  // of the memo's tables, or of a motion in flight
  Tick age = 0;                        // within the table

  const Pose& pose() const { return table->pose_at(age); }
  Placement root() const { return table->root_at(age); }
  // Which way it would answer a blow, rad (turned_away).
  float faces(const MotionLibrary& library) const {
    return root().yaw + turned_away(library, *table->action, table->clip_age(age));
  }
  Capsule part(Part which) const { return table->capsules_at(age)[index(which)]; }
};

// A landed blow as the tree meets it. Bodies are indices into the memo's tables.
struct LandedBlow {
  int attacker = 0, victim = 0;
  BodyMoment attack, struck;
  StrikeKind kind = StrikeKind::straight;
  float tone = 1.0f;       // of the victim's muscles, 0 limp .. 1 full
  Contact contact;         // in the victim's action space
  float attacker_yaw = 0;  // of the attacker's action space, seen from the victim's, rad
  Vec3 striking{};         // contact.point in the attacker's action space
};

class ImpactMemo {
 public:
  // `store`, where there is one, outlives the fight: what it holds need not be computed again.
  explicit ImpactMemo(std::vector<const MotionTables*> bodies, const MemoSteps& steps = {},
                      std::shared_ptr<ImpactStore> store = nullptr);

  // The number of another motion in flight (ActionTable::motion). What is known of blows on earlier
  // ones is dropped.
  std::uint64_t begin_motion();

  // The same answer whether it was stored or not, on any number of threads.
  ImpactAnswer answer(const LandedBlow& blow);
  // The same without the memo.
  ImpactAnswer recomputed(const LandedBlow& blow) const;

  // Damage of a strike that meets a standing, unguarded body at its best speed, thousandths.
  std::int32_t clean_damage(int attacker, ActionId attack, std::size_t strike, int victim);

  struct Counts {
    // Neither depends on the number of threads, nor on what a store holds. `entries`: answers made,
    // to quantised blows and to those on motions in flight.
    std::uint64_t lookups = 0, entries = 0;
  };
  Counts counts() const;

 private:
  using Key = ImpactKey;
  template <class Value>
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<Key, Value, ImpactKeyHash> entries;
    std::uint64_t lookups = 0, made = 0;
  };
  template <class Value>
  using Shards = std::array<Shard<Value>, 16>;

  // Where a blow meets a part: what turns a head is that its line passes beside the middle.
  struct BlowPlace {
    int along;   // the part's axis: -1 at its beginning, 1 at its end
    int beside;  // the middle, to the left of the line of the blow: halves of the radius, -2 to 2
  };
  static BlowPlace place_of(const Capsule& struck, Vec3 line, Vec3 point);
  static Vec3 point_of(const Capsule& struck, Vec3 line, BlowPlace place);

  // The quantised impulse, as numbers of steps.
  struct ImpulseSteps {
    int victim;         // in the key by its world
    PoseMoment moment;  // of the pose class of the struck body
    Part struck;
    bool blocked;
    int azimuth;  // off the facing of the struck body's root
    int elevation, impulse;
    int tone;  // hundredths
    BlowPlace place;
  };

  // `mobility`: of the body, action, tick, part and tone that it is given.
  template <class Mobility>
  Blow exact(const LandedBlow& blow, const Mobility& mobility) const;
  Blow exact(const LandedBlow& blow) const;  // without the memo
  Blow kept(const LandedBlow& blow);
  ImpulseSteps steps_of(const LandedBlow& blow, Vec3 impulse) const;
  // Seen from the struck body's root. `own`: what the struck body does without the blow, kept.
  ImpactAnswer answer_of(const ImpulseSteps& steps, const KeptOwnMotion& own) const;
  // The impulse step of a blow, without its damage; in the struck body's action space.
  static ImpactAnswer stepped(const MotionTables& victim, const BodyMoment& struck, float tone,
                              const Blow& blow, const KeptOwnMotion& own);
  // The answer to a blow on a motion in flight: nothing is quantised.
  ImpactAnswer in_flight_answer(const LandedBlow& landed, const Blow& blow,
                                const KeptOwnMotion& own) const;
  ImpactAnswer kept_in_flight_answer(const LandedBlow& landed, const Blow& blow);
  KeptOwnMotion own_motion(const ImpulseSteps& steps);
  static ImpactAnswer turned(ImpactAnswer answer, float yaw);
  // The answer to the exact blow, in the victim's action space, out of that to the steps.
  ImpactAnswer carried(const ImpactAnswer& found, const LandedBlow& landed, const Blow& blow) const;
  Key key_of(const ImpulseSteps& steps) const;
  template <class Value, class Compute>
  static const Value& remembered(Shards<Value>& shards, const Key& key, const Compute& compute);
  // Out of the store, else computed; and out of the memo before that.
  template <class Value, class Compute>
  Value kept(ImpactShelf<Value> ImpactStore::*shelf, const Key& key, const Compute& compute);
  template <class Value, class Compute>
  const Value& looked_up(Shards<Value>& shards, ImpactShelf<Value> ImpactStore::*shelf,
                         const Key& key, const Compute& compute);

  std::vector<const MotionTables*> bodies_;
  std::vector<PoseClasses> classes_;   // one a body
  std::vector<std::uint64_t> worlds_;  // ImpactKey::world, one a body
  MemoSteps size_;
  std::shared_ptr<ImpactStore> store_;
  Shards<PartMobility> mobilities_;
  Shards<ImpactAnswer> answers_;
  Shards<OwnMotion> own_motions_;  // by pose class and side
  Shards<ImpactAnswer> in_flight_answers_;
  Shards<OwnMotion> in_flight_own_motions_;  // by motion, tick and side
  std::uint64_t motions_ = 0;
};

}  // namespace ringcraft
