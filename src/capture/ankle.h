#pragma once

#include "base/vec.h"

namespace ringcraft {

// The turn of a foot against its shin, of either side, kept within the ankle's range
// (physics/limits.cpp): nothing changes up to 6 degrees before its end, which is never passed.
Quat ankle_within_range(Quat ankle);

}  // namespace ringcraft
