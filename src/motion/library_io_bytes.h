#pragma once
// Little-endian numbers and texts in a string of bytes. Inside the library file only.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/utf8.h"

namespace ringcraft {

static_assert(std::endian::native == std::endian::little,
              "the library file is little-endian and is copied as it is");

class BytesOut {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void put_count(std::size_t count) { put(static_cast<std::uint32_t>(count)); }
  void put_text(std::string_view text) {
    put_count(text.size());
    bytes_ += text;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Past the end every value is zero and ok() is false; nothing is read beyond.
class BytesIn {
 public:
  explicit BytesIn(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    T value{};
    if (!ok_ || bytes_.size() - at_ < sizeof(T)) {
      ok_ = false;
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  // One of an enumeration's names, of which `last` is the last.
  template <class T>
  requires std::is_enum_v<T> T get(T last) {
    const auto value = get<std::underlying_type_t<T>>();
    if (value > static_cast<std::underlying_type_t<T>>(last)) ok_ = false;
    return ok_ ? static_cast<T>(value) : T{};
  }
  bool get_flag() {
    const auto value = get<std::uint8_t>();
    if (value > 1) ok_ = false;
    return value == 1;
  }
  // A count of things that take at least `least_bytes` each: what cannot be there is no count.
  std::size_t get_count(std::size_t least_bytes) {
    const std::size_t count = get<std::uint32_t>();
    if (count > (bytes_.size() - at_) / least_bytes) ok_ = false;
    return ok_ ? count : 0;
  }
  std::string get_text() {
    const std::size_t size = get_count(1);
    std::string text(bytes_.substr(at_, size));
    at_ += size;
    if (!is_utf8(text)) ok_ = false;  // no report could hold it
    return ok_ ? text : std::string();
  }
  bool ok() const { return ok_; }
  bool done() const { return ok_ && at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace ringcraft
