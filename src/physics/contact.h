#pragma once
// Strike contact: the swept capsule of the striking part against the body parts, guard first.

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "motion/action.h"
#include "physics/body.h"

namespace ringcraft {

// Parts that take a blow for what is behind them at that age of an action's clip, bit index(part):
// gloves and forearms always; while a check protects, the shin and foot of the leg that is lifted.
std::uint32_t guarding_parts(const Action& action, Tick age);
std::uint32_t guarding_parts();  // whatever the body does: gloves and forearms

// The capsules of one body at two neighbouring moments.
struct SweptBody {
  BodyCapsules before, after;
  float seconds = 1.0f / 120.0f;  // between them
  std::uint32_t guards = guarding_parts();
};

// A part of a striking limb at two neighbouring moments.
struct SweptPart {
  Part part = Part::right_hand;
  Capsule before, after;
};

// What a blow may meet: a swept body, wherever its capsules are kept.
struct SweptTarget {
  const BodyCapsules& before;
  const BodyCapsules& after;
  float seconds;
  std::uint32_t guards;

  SweptTarget(const BodyCapsules& was, const BodyCapsules& is, std::uint32_t guarding,
              float between = 1.0f / 120.0f)
      : before(was), after(is), seconds(between), guards(guarding) {}
  SweptTarget(const SweptBody& body)  // NOLINT(google-explicit-constructor): a view of it
      : before(body.before), after(body.after), seconds(body.seconds), guards(body.guards) {}
};

struct Contact {
  Part striker = Part::right_hand;
  Part struck = Part::head;  // the first part in the way, one that guards where blocked
  bool blocked = false;
  Vec3 point{};     // on the struck part's surface, world, m
  Vec3 normal{};    // unit, from the struck part's axis toward the striker
  Vec3 velocity{};  // of the striker relative to the struck part at the point, m/s
  float share = 0;  // when between `before` (0) and `after` (1)
};

// The farthest that any point of the axis travels, m (ends move on straight lines).
inline float travel(const Capsule& before, const Capsule& after) {
  return std::max(glm::distance(before.a, after.a), glm::distance(before.b, after.b));
}

// First contact of `striker` with a part of the target in the interval, or nothing. A guard part in
// the way is a block, one that is only brushed lets the blow go on. Only an approaching striker
// makes contact.
std::optional<Contact> strike_contact(const SweptBody& attacker, Part striker,
                                      const SweptBody& target);

// The same for whatever part of the limb the strike can land with (striking_parts): the earliest
// one.
std::optional<Contact> strike_contact(const SweptBody& attacker, const Strike& strike,
                                      const SweptBody& target);

// The same for these parts of a limb. Of the target, only `target_parts` (bit index(part)) are
// looked at.
std::optional<Contact> strike_contact(std::span<const SweptPart> limb, const SweptTarget& target,
                                      std::uint32_t target_parts = ~0u);

// First contact of a falling body with another, by its trunk, its head, a thigh or an upper arm,
// which itself moves toward the other at `least` m/s or faster: who walks into somebody that falls
// away is not fallen upon. What hangs on the ends of the limbs gives way.
std::optional<Contact> fall_contact(const SweptBody& faller, const SweptBody& other, float least);

// Parts a strike can land with, bit index(part): the glove; the foot; of a roundhouse the shin too.
// To be excepted from penetration while the strike is active.
std::uint32_t striking_parts(const Strike& strike);
inline constexpr std::size_t kMostStrikingParts = 2;

// Head: head and neck; body: trunk and arms; leg: thighs, shins, feet.
TargetZone zone_of(Part part);

}  // namespace ringcraft
