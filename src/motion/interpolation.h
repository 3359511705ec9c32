#pragma once
// New actions where a library is sparse: between repetitions of one action (Kovar and Gleicher
// 2004).
//
// A family is what may be blended: actions of one kind with the same blows by the same limbs, or
// steps one way or turns one way with the same feet set in the same order, each near enough to one
// of them along its registration. Where the outcomes (outcome.h) of a family leave room, a blend is
// made that goes there, measured, and kept if it is as good as what it is made of.

#include <functional>
#include <string>

#include "motion/outcome.h"
#include "motion/registration.h"

namespace ringcraft {

struct Family {
  std::string name;  // as in "straight_right"
  Outcomes kind = Outcomes::blow;
  std::vector<std::size_t> members;  // of the actions, the reference first
  std::vector<Variant> variants;     // of the members; they point to the actions
  std::vector<float> distance;       // m: of each member to the reference, along its registration
};

struct InterpolationSettings {
  float alike = 0.12f;             // m: largest distance of a member to its reference
  float blow_room = 0.05f;         // m between two outcomes that leaves room for one between
  float step_room = 0.08f;         // m
  float turn_room = radians(8);    // rad
  std::size_t most_of_family = 4;  // actions made of one family
  float skate = 0.005f;            // foot skate over that of the worst repetition
  float keeps_speed = 0.85f;       // of the weighed mean of the blows' peak speeds
  float jump = 1.25f;              // times the largest change of a joint's velocity in a tick of
                                   // the repetitions
  float miss = 0.5f;               // of the room: farthest from where it was wanted
  OutcomeSettings outcomes;
};

// Families of two members at least. `actions` must outlive them.
std::vector<Family> families(const Skeleton& skeleton, const std::vector<Action>& actions,
                             const InterpolationSettings& settings = {});

// Why a blend is not as good as what it is made of; empty if it is.
std::string worse_than(const Skeleton& skeleton, const Action& blend,
                       std::span<const Variant> variants, std::span<const float> weights,
                       const InterpolationSettings& settings = {});

// Whether an action was made here, by its source.
bool is_blend(const Action& action);

// What an outside judge has against an action; empty if nothing.
using Judge = std::function<std::string(const Action&)>;

// Blends where families leave room, with `notes` on what each is made of and comes to, and on what
// was refused and why. Names are distinct from those of `actions`.
std::vector<Action> interpolated(const Skeleton& skeleton, const std::vector<Action>& actions,
                                 const InterpolationSettings& settings, const Judge& judge,
                                 std::vector<std::string>& notes);

}  // namespace ringcraft
