#include "physics/muscles.h"

namespace ringcraft {

Muscle muscle_of(const BodyModel& body, Part child) {
  const float k = body.spec.mass / 75;  // the table is for 75 kg
  const auto scaled_by_mass = [k](float torque, float stiffness) {
    return Muscle{torque * k, stiffness * k};
  };
  switch (child) {
    case Part::pelvis:
      return {};
    case Part::abdomen:
      return scaled_by_mass(260, 1000);
    case Part::chest:
      return scaled_by_mass(220, 1000);
    case Part::neck:
      return scaled_by_mass(50, 150);
    case Part::head:
      return scaled_by_mass(40, 100);
    case Part::left_upper_arm:
    case Part::right_upper_arm:
      return scaled_by_mass(90, 400);
    case Part::left_forearm:
    case Part::right_forearm:
      return scaled_by_mass(70, 300);
    case Part::left_hand:
    case Part::right_hand:
      return scaled_by_mass(15, 40);
    case Part::left_thigh:
    case Part::right_thigh:
      return scaled_by_mass(240, 700);
    case Part::left_shin:
    case Part::right_shin:
      return scaled_by_mass(220, 700);
    case Part::left_foot:
    case Part::right_foot:
      return scaled_by_mass(150, 500);
  }
  return {};
}

Tone whole_body(float tone) {
  Tone t;
  t.fill(tone);
  return t;
}

bool is_hinge(Part child) {
  return child == Part::left_forearm || child == Part::right_forearm || child == Part::left_shin ||
         child == Part::right_shin;
}

}  // namespace ringcraft
