#pragma once
// Indices that do not mix: an ActionId is not a FighterId.

#include <compare>
#include <cstddef>
#include <cstdint>

namespace ringcraft {

template <class Tag>
struct Index {
  std::int32_t value = -1;

  constexpr Index() = default;
  constexpr explicit Index(std::int32_t v) : value(v) {}
  constexpr explicit Index(std::size_t v) : value(static_cast<std::int32_t>(v)) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t at() const { return static_cast<std::size_t>(value); }
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the comparison with 0 for a pointer.
  constexpr auto operator<=>(const Index&) const = default;
};

using ActionId = Index<struct ActionTag>;
using FighterId = Index<struct FighterTag>;

}  // namespace ringcraft
