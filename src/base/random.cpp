#include "base/random.h"

#include "base/hash.h"

namespace ringcraft {

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(0), increment_((stream << 1) | 1) {
  bits();
  state_ += seed;
  bits();
}

std::uint32_t Random::bits() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + increment_;
  const auto xorshifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto rotation = static_cast<std::uint32_t>(old >> 59);
  return (xorshifted >> rotation) | (xorshifted << ((32 - rotation) & 31));
}

float Random::uniform() {
  return static_cast<float>(bits() >> 8) * 0x1.0p-24f;
}

float Random::uniform(float low, float high) {
  return low + (high - low) * uniform();
}

int Random::below(int count) {
  return static_cast<int>(
      (static_cast<std::uint64_t>(bits()) * static_cast<std::uint64_t>(count)) >> 32);
}

float Random::normal() {
  float sum = 0;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum - 6;
}

std::uint64_t derived_seed(std::uint64_t seed, const char* purpose, std::uint64_t index) {
  return Hasher().add(seed).add(std::string_view(purpose)).add(index).digest();
}

}  // namespace ringcraft
