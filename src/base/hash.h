#pragma once
// 64-bit hashing (xxHash's XXH3). A value is hashed by its fields, never by its padding.

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ringcraft {

std::uint64_t hash_bytes(std::span<const std::byte> bytes);
std::uint64_t hash_text(std::string_view text);

// Sixteen lower-case hexadecimal digits.
std::string hash_name(std::uint64_t hash);

// Collects fields and hashes them together.
class Hasher {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hasher& add(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
    return *this;
  }
  Hasher& add(std::string_view text) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + text.size());
    if (!text.empty()) std::memcpy(bytes_.data() + at, text.data(), text.size());
    return add(text.size());
  }
  // As if they were added one after another.
  Hasher& add(std::span<const float> values) {
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  std::uint64_t digest() const { return hash_bytes(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace ringcraft
