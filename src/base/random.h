#pragma once
// Seeded random numbers with the same bits on every platform (std distributions are not).

#include <cstdint>

namespace ringcraft {

// PCG32 (O'Neill 2014): 64-bit state, 32-bit output.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint32_t bits();
  float uniform();  // [0, 1)
  float uniform(float low, float high);
  int below(int count);  // 0 .. count-1; count > 0
  float normal();        // mean 0, standard deviation 1 (sum of 12 uniforms: no libm)

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

// A seed for a named purpose, independent of the other purposes of the same run.
std::uint64_t derived_seed(std::uint64_t seed, const char* purpose, std::uint64_t index = 0);

}  // namespace ringcraft
