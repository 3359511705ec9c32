#pragma once
// The gates that a library must pass, from what was measured of it.

#include "scene/library_check.h"

namespace ringcraft {

inline constexpr double kMostBeyondDegrees = 3;
inline constexpr double kMostFootSkate = 0.01;
inline constexpr double kMostSelfPenetration = 0.02;  // m
inline constexpr double kMostAimError = 0.03;         // m
inline constexpr double kMostSeamJump = 1.5;          // m/s
inline constexpr double kMostOwnJump = 2;  // m/s, of who steps or rises; captured ones 1.2

// Adds a row for every gate whose subject the library has.
void add_gates(LibraryCheck& check);

}  // namespace ringcraft
