#pragma once
// A library of both stances: every action also as a southpaw does it, mirrored across x = 0.

#include "motion/library.h"

namespace ringcraft {

// The library with every action mirrored behind its own ones, in the same order: action i's mirror
// image is action i + n, of Stance::southpaw, with edges and paths as i has them. Lead and rear in
// names stay, left and right change places; names are no longer different from each other.
//
// One stance leads to the other only over the library's switches(), which come last, where
// `switching` asks for them. There is no motion graph. Of a library of both stances: the same.
MotionLibrary both_stances(const MotionLibrary& library, bool switching = false);

}  // namespace ringcraft
