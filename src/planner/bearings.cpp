#include "planner/bearings.h"

#include <cmath>

namespace ringcraft {

void find_bearings(std::span<const NextLanes> next, const Frame& root, Vec3 opponent,
                   AimLimit attack, AimLimit other, std::span<const Lanes> then_x,
                   std::span<const Lanes> then_z, std::vector<BearingLanes>& out) {
  constexpr float kNowhere = 1e-5f;  // m: nearer than that no direction is meant
  constexpr float kTogether = 1e-4f;
  out.resize(next.size());
  for (std::size_t block = 0; block < next.size(); ++block) {
    const NextLanes& in = next[block];
    BearingLanes found;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float start_x = root.x + root.cosine * in.x[i] + root.sine * in.z[i];
      const float start_z = root.z - root.sine * in.x[i] + root.cosine * in.z[i];
      const float start_sine = root.sine * in.cosine[i] + root.cosine * in.sine[i];
      const float start_cosine = root.cosine * in.cosine[i] - root.sine * in.sine[i];
      // The aim of an attack points its start at the opponent, that of anything else its end.
      const float dx = opponent.x - start_x, dz = opponent.z - start_z;
      const float at_x = start_cosine * dx - start_sine * dz;
      const float at_z = start_sine * dx + start_cosine * dz;
      const float past_x = at_x - in.end_x[i], past_z = at_z - in.end_z[i];
      const float seen_x = in.end_cosine[i] * past_x - in.end_sine[i] * past_z;
      const float seen_z = in.end_sine[i] * past_x + in.end_cosine[i] * past_z;
      const bool attacks = in.attacks[i] > 0;
      const float target_x = attacks ? at_x : seen_x, target_z = attacks ? at_z : seen_z;
      const float most_sine = attacks ? attack.sine : other.sine;
      const float most_cosine = attacks ? attack.cosine : other.cosine;
      const float target = std::sqrt(target_x * target_x + target_z * target_z);
      const float to_sine = target_x / target, to_cosine = target_z / target;
      const bool beyond = to_cosine < most_cosine, nowhere = target < kNowhere;
      const float limit = target_x < 0 ? -most_sine : most_sine;
      const float clamped_sine = beyond ? limit : to_sine;
      const float clamped_cosine = beyond ? most_cosine : to_cosine;
      const float sine = nowhere ? 0.0f : clamped_sine;
      const float cosine = nowhere ? 1.0f : clamped_cosine;
      // The end, turned by the aim, in the world.
      const float end_x = cosine * in.end_x[i] + sine * in.end_z[i];
      const float end_z = cosine * in.end_z[i] - sine * in.end_x[i];
      const float x = start_x + start_cosine * end_x + start_sine * end_z;
      const float z = start_z - start_sine * end_x + start_cosine * end_z;
      const float ahead_x = cosine * in.end_sine[i] + sine * in.end_cosine[i];
      const float ahead_z = cosine * in.end_cosine[i] - sine * in.end_sine[i];
      const float facing_x = start_cosine * ahead_x + start_sine * ahead_z;
      const float facing_z = start_cosine * ahead_z - start_sine * ahead_x;
      const float apart_x = then_x[block][i] - x, apart_z = then_z[block][i] - z;
      const float apart = std::sqrt(apart_x * apart_x + apart_z * apart_z);
      const float facing = (apart_x * facing_x + apart_z * facing_z) / apart;
      found.start_x[i] = start_x, found.start_z[i] = start_z;
      found.start_sine[i] = start_sine, found.start_cosine[i] = start_cosine;
      found.aim_sine[i] = sine, found.aim_cosine[i] = cosine;
      found.target[i] = target;
      found.x[i] = x, found.z[i] = z;
      found.apart[i] = apart;
      found.facing[i] = apart > kTogether ? facing : 1.0f;
    }
    out[block] = found;
  }
}

}  // namespace ringcraft
