#pragma once
// The hit: strike -> impulse -> ragdoll impulse step in Bullet -> response.

#include <array>
#include <functional>
#include <span>

#include "physics/contact.h"

namespace ringcraft {

// What a part of a posed body offers to blows, wherever and whichever way they go: the inverse of
// the inertia that the articulated body has there (Khatib 1987, operational space), with the
// muscles' tone over the contact time (docs/sources.md, R4).
struct PartMobility {
  Vec3 about{};                      // m, in the space of the pose
  std::array<double, 36> inverse{};  // 6 x 6: forces along x, y, z, then moments; SI
  // Effective mass of `point` along the unit vector `line`, kg.
  float mass_along(Vec3 point, Vec3 line) const;
};
PartMobility mobility_of(const BodyModel& body, const Pose& pose, Part part, float tone);

// The striking limb's effective mass along the line of the blow, kg.
float effective_mass(const BodyModel& body, const Pose& pose, Part part, Vec3 point, Vec3 line,
                     float tone);

struct Blow {
  Part part = Part::head;    // struck
  Vec3 point{};              // world, m
  Vec3 impulse{};            // world, N s
  float effective_mass = 0;  // of the striker, kg
  float speed = 0;           // closing speed along the line, m/s
  bool blocked = false;
};

// The line of the blow, a unit vector into the struck body: the way of the striker, turned into the
// cone of friction around the surface's inner normal.
Vec3 line_of_blow(const Contact& contact);

// The tone of the limb that strikes and of the part that is struck, over the contact time.
float striking_tone(StrikeKind kind);
inline constexpr float kStruckTone = 0.25f;

// Where a striking part's mass counts: on its axis, nearest to the contact.
Vec3 knuckles(const Capsule& striker, Vec3 point);

// J = (1+e) v / (1/m_striker + 1/m_struck) along the line of the blow; a block passes on a part of
// it.
Blow blow_of(const BodyModel& attacker, const Pose& attacker_pose, const BodyModel& target,
             const Pose& target_pose, const Contact& contact, StrikeKind kind);

// The same from both masses along the line of the blow, kg.
Blow blow_of(const Contact& contact, StrikeKind kind, float striker, float struck);

// The same where a falling body meets another, with the mass that its slack limbs bring along.
Blow blow_of_fall(const BodyModel& faller, const Pose& faller_pose, const BodyModel& target,
                  const Pose& target_pose, const Contact& contact);

// What the blow alone gives the part that it meets, m/s, as if nothing held it.
Vec3 struck_velocity(const Blow& blow);

// What the impulse step starts from.
struct ImpactInput {
  Pose pose;                        // world, at the contact
  Pose pose_before;                 // one tick earlier: gives the start velocities
  std::span<const Pose> continued;  // world: the interrupted action's next frames, which the
                                    // muscles track; at least kImpulseStepTicks + 1, pose first
  Blow blow;
  float tone = 1.0f;      // 0 limp .. 1 full
  FootContacts contacts;  // feet on the ground at the contact
};

inline constexpr Tick kImpulseStepTicks = 12;  // 100 ms

// Change of the head's angular velocity that switches the muscles off at toughness 1, rad/s. With
// it 20 of 1,134 blows that landed in 24 duels of a minute (default library, seeds 1-8, 21-28 and
// 41-48) knocked out, lost health included: of order one in a hundred (docs/sources.md, V1). As a
// free head that is 8,500 rad/s2 for 12 ms: the published straights of Olympic boxers, at full
// strength, have 6,343 +- 1,789.
inline constexpr float kKnockoutSpin = 65.0f;

// Whole-body tone under which nobody stands (docs/sources.md, R7).
inline constexpr float kLeastStandingTone = 0.25f;

struct ImpactOutcome {
  ResponseKind response = ResponseKind::absorb;
  int steps = 0;          // 1..3 for recovery steps
  float direction = 0;    // world yaw in which the body goes
  bool knockout = false;  // a knockdown because the head's rotation switched the muscles off
  TargetZone zone = TargetZone::head;  // where the blow landed
  float head_spin = 0;                 // change of the head's angular velocity, rad/s
  float margin = 0;  // m: the extrapolated centre of mass beyond the base of support (< 0 inside)
  Vec3 com_velocity{};  // after the impulse step, m/s
  // How far head, chest and hips are from where the action would have them after the impulse step,
  // world, m: the motion that a response is to continue.
  std::array<Vec3, 3> moved{};
  float knee_moved = 0;  // m: the same of the knee that goes farther
  bool operator==(const ImpactOutcome&) const = default;
};

// What the body does by itself in the 100 ms, m: how far its own motion carries it out of its base,
// where half of its turning counts and where all of it does, and how far its feet (left, right;
// canonical frame) come off the way that the action has them go.
struct OwnMotion {
  std::array<Vec3, 2> carried{};
  std::array<Vec3, 2> strayed{};
};

// The own motion is the same for every blow on one posed body; finding it takes a second run of the
// ragdoll, without the blow. Who tries many blows keeps it: asked for one of the two sides
// (`mirrored`: the canonical frame has the blow go left), it answers what `run` gave the first
// time, or calls it.
using KeptOwnMotion =
    std::function<OwnMotion(bool mirrored, const std::function<OwnMotion()>& run)>;

// A fresh Bullet world in a canonical frame (root at the origin, heading removed), 24 steps of
// 1/240 s, then the decision by capturability and head rotation. Same input, same bits.
ImpactOutcome impulse_step(const BodyModel& body, const ImpactInput& input,
                           const KeptOwnMotion& kept = {});

// Whether a body is on its feet, by how high its hips are: else it takes no step.
bool on_its_feet(const BodyModel& body, const Pose& pose);

// Whether it is down: no blow knocks it down.
bool lies(const BodyModel& body, const Pose& pose);

// The shown response: a second simulation, active, from the same start, aimed at `target` (world
// poses, one a tick from the contact on; empty: track `input.continued`). Returns `ticks` world
// poses, the first one tick after the contact. A knockdown falls with bracing arms, or goes on from
// where the body lies, and comes to rest; where there are `lying` poses, from which get-ups start,
// it settles toward the nearest, and up to 3 s more are returned while it is far from all of them.
// A knockout falls limp.
std::vector<Pose> simulate_response(const BodyModel& body, const ImpactInput& input,
                                    const ImpactOutcome& outcome, std::span<const Pose> target,
                                    Tick ticks, std::span<const Pose> lying = {});

// Damage of a blow in thousandths of a point, by impulse and zone (damage.cpp): a clean jab to the
// head costs about 3 points. A fighter starts with 100.
std::int32_t damage_of(const Blow& blow, const ImpactOutcome& outcome);

}  // namespace ringcraft
