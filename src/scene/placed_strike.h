#pragma once
// A blow placed so that it lands: how far from the other the attacker stands when it meets a given
// part.

#include <optional>
#include <vector>

#include "base/error.h"
#include "fight/state.h"
#include "physics/contact.h"

namespace ringcraft {

// Distances between the roots that are tried, m.
inline constexpr float kNearestPlace = 0.30f, kFarthestPlace = 3.00f, kPlaceStep = 0.02f;

struct StrikePlace {
  float distance = 0;  // m between the two roots when the blow meets
  Tick age = 0;        // of the attack at the contact
  Contact contact;     // as the clips alone would have it
};

// One fighter in an action at an age, struck by another's.
struct StrikeQuery {
  static constexpr FighterId kStruck{0}, kAttacker{1};
  const MotionLibrary& library;  // as each of the two does it (MotionLibrary::of)
  const BodyModel& target;
  const BodyModel& attacker;
  ActionId target_action;
  Tick target_age = 0;  // at the contact
  ActionId attack;
};

// The attacker's placement at `distance` in front of the target, facing it. `root`: the target's at
// the contact.
Placement attacker_placement(const Placement& root, float distance);

// Every place of the attack's first strike from which it meets the target, near to far. Only
// `distance` is looked at where it is given.
std::vector<StrikePlace> strike_places(const StrikeQuery& query, std::optional<float> distance);

// How well a contact answers to the wish for a part: the lower the better.
enum class Met : std::uint8_t {
  part,     // the part itself
  zone,     // another part of its zone
  guard,    // a guard that stands before the zone that the strike is made for
  anything  // something else
};
Met met_by(const Contact& contact, const Strike& strike, Part part);

// What the places meet, as text: "head 0.52-0.86 m, rightHand (guard) 0.88-0.96 m".
std::string met_parts(const std::vector<StrikePlace>& places);

}  // namespace ringcraft
