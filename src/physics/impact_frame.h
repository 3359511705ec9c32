#pragma once
// What the impulse step and the shown response share: the canonical frame, the blow on the ragdoll,
// the balance help.

#include "physics/balance.h"
#include "physics/impact.h"
#include "physics/ragdoll.h"

namespace ringcraft {

// The input in a canonical frame: root at the origin, heading removed, and mirrored where the blow
// goes to the right, so that a mirrored hit has the mirrored outcome to the bit. (The same ragdoll
// 3 m away ends 14-28 cm elsewhere after 1 s.) Planted feet are put on the ground.
class ImpactFrame {
 public:
  ImpactFrame(const BodyModel& body, const ImpactInput& input);

  const Pose& pose() const { return pose_; }
  const Pose& before() const { return before_; }
  const Pose& continued(int tick) const;  // clamped to the last
  const Blow& blow() const { return blow_; }
  FootContacts contacts() const { return contacts_; }
  bool mirrored() const { return mirrored_; }
  float lowered() const { return lowered_; }  // m: by how much the body was let down to stand

  Pose in(const Pose& world) const;
  Pose out(const Pose& canonical) const;
  ImpactOutcome out(ImpactOutcome canonical) const;
  float in_yaw(float world) const;

 private:
  void find_contacts(const BodyModel& body, FootContacts given);
  void put_on_ground(const BodyModel& body);

  Placement placement_, inverse_;
  bool mirrored_ = false;
  Pose pose_, before_;
  std::vector<Pose> continued_;
  Blow blow_;
  FootContacts contacts_;
  float lowered_ = 0;
};

// Applies `share` of the blow: as much as the part can take (effective mass times 20 m/s), the rest
// at the joint to its parent, and so on.
void strike(Ragdoll& ragdoll, const BodyModel& body, const ImpactFrame& frame, float share);

// How far the feet (left, right) are off the way that the action has them go, 100 ms on, m.
std::array<Vec3, 2> strayed_feet(const BodyModel& body, const ImpactFrame& frame,
                                 const Ragdoll& ragdoll);

// Where the planted feet stood, moved by what the blow has done to them 100 ms on: what the action
// itself does with them in that time is taken off. A lifted foot comes down again.
struct Footing {
  Base base;         // moved by `so_far` of the way
  float lifted = 0;  // m: how high the higher one is
  float moved = 0;   // m: how far the farther one has gone along the ground
};
struct FootingQuery {
  FootContacts planted;
  float so_far = 1;
  std::array<Vec3, 2> strayed{};  // without the blow
};
Footing footing_of(const BodyModel& body, const ImpactFrame& frame, const Ragdoll& ragdoll,
                   const FootingQuery& query);

// Balance without outside force: the target poses' pelvis is shifted against the drift of the
// extrapolated centre of mass, the legs reach for the same foot places (docs/sources.md, R2).
class Balance {
 public:
  Balance(const BodyModel& body, const ImpactFrame& frame);
  // Aims the muscles at half-tick `k` of the continued motion.
  void guide(Ragdoll& ragdoll, const ImpactFrame& frame, int k);
  // The same at any target: `target` now, moving from `before` to `after` in one tick; xi of the
  // motion. As much of the drift as goes the way of `unfelt` (m, on the ground) is let be.
  void guide(Ragdoll& ragdoll, const Pose& target, const Pose& before, const Pose& after,
             Vec3 unfelt = {});

 private:
  const BodyModel& body_;
  float rate_;
};

}  // namespace ringcraft
