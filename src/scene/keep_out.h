#pragma once
// Arms and free legs stay out of the other bodies: what is shown never sinks into what it struck.

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "motion/clip.h"
#include "physics/body.h"

namespace ringcraft {

// In the order of limb_of() (planner/condition.h).
inline constexpr std::array<Limb, 4> kArmsAndLegs = {arm(Side::left), arm(Side::right),
                                                     leg(Side::left), leg(Side::right)};

// How far the ends of kArmsAndLegs are held off their motion, m.
using LimbOffsets = std::array<Vec3, 4>;

// m. With 20 cm, arms stayed in whoever walked onto them.
inline constexpr std::array<float, 4> kMostKeptOut = {0.30f, 0.30f, 0.35f, 0.35f};

// One tick on from `now`: limbs come back to their motion, no faster than kComingFree, as far as
// hands, forearms, and of legs that are not `held` all below the middle of the thigh, stay out of
// the `others`, each limb held off by at most its kMostKeptOut and going there no faster than
// kGoingOut, nor than kTurningOut about its shoulder or hip. On the side on which it is: none
// passes through another. Parts whose bit is set in `spared` (bit index(part)) go where they go. A
// leg has to be clear in the pose that is shown of it, `as_shown`: inverse kinematics may fold it
// as its ranges forbid. An arm's ranges are wide, and one that is asked the same is thrown to and
// fro between the other body and the end of its range.
inline constexpr float kComingFree = 1.5f;  // m/s
inline constexpr float kGoingOut = 12.0f;   // m/s
// rad/s. Where a glove is at its own shoulder, the elbow would come round at once.
inline constexpr float kTurningOut = 24.0f;
LimbOffsets kept_out(const BodyModel& body, const Pose& pose, FootContacts held,
                     std::span<const BodyCapsules> others, const LimbOffsets& now,
                     const std::function<Pose(const Pose&)>& as_shown = std::identity{},
                     std::uint32_t spared = 0);

// How far, m, a limb that touches the other body is held off beyond half of its kMostKeptOut: by as
// much the bodies are too near to each other, before it can give no more. `own` are shown with the
// offsets.
float wedge(const BodyCapsules& own, const LimbOffsets& offsets, const BodyCapsules& other);

// How far along the ground a foot that comes down must go to stand beside the `others`, m; the way
// out that kept_out() finds may lead up, onto them. `away`: where none of their ways leads aside.
Vec3 way_beside(const Capsule& foot, std::span<const BodyCapsules> others, Vec3 away);

// `pose` with the ends of its limbs moved by the offsets, by two-link IK.
Pose with_offsets(const BodyModel& body, const Pose& pose, const LimbOffsets& offsets);

}  // namespace ringcraft
