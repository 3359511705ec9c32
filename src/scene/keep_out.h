#pragma once
// Arms and free legs stay out of the other bodies: what is shown never sinks into what it struck.

#include <array>
#include <span>

#include "motion/clip.h"
#include "physics/body.h"

namespace ringcraft {

// How far the ends of left arm, right arm, left leg and right leg are held off their motion, m.
using LimbOffsets = std::array<Vec3, 4>;

inline constexpr std::array<float, 4> kMostKeptOut = {0.20f, 0.20f, 0.35f, 0.35f};  // m

// The offsets that move hands, forearms, and feet and shins that are not `held` out of the
// `others`, each by at most its kMostKeptOut. Zero where nothing penetrates.
LimbOffsets ways_out(const BodyModel& body, const Pose& pose, FootContacts held,
                     std::span<const BodyCapsules> others);

// One tick from `now` toward `wanted`: a limb that is stopped is stopped at once, but it comes
// free, or is turned aside, no faster than kComingFree.
inline constexpr float kComingFree = 1.5f;  // m/s
LimbOffsets approached(const LimbOffsets& now, const LimbOffsets& wanted);

// `pose` with the ends of its limbs moved by the offsets, by two-link IK.
Pose with_offsets(const BodyModel& body, const Pose& pose, const LimbOffsets& offsets);

}  // namespace ringcraft
