#pragma once
// Moved: smoothing belongs to motion.

#include "motion/smooth.h"  // IWYU pragma: export
