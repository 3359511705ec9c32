#pragma once
// Whether a limb of a body has room: over the floor, and beside the rest of the body.

#include <initializer_list>

#include "physics/body.h"

namespace ringcraft {

class LimbRoom {
 public:
  // As deep in anything as in one of these poses a limb may be.
  LimbRoom(const BodyModel& body, std::initializer_list<Pose> poses);

  // By how much more it is, m, in the sum over its parts.
  float lacks(const Limb& limb, const Pose& pose) const;

 private:
  using Depths = std::array<float, kPartCount>;  // m, in each part of the body
  struct Room {
    Depths floor{};
    std::array<Depths, kPartCount> parts{};
  };

  const BodyModel& body_;
  Room may_;
};

}  // namespace ringcraft
