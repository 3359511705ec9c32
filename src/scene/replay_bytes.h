#pragma once
// Bytes of a replay: little-endian values, poses as differences, base64.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/pose.h"

namespace ringcraft {

// Values one after the other.
class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  void word(std::uint64_t value, int bytes);
  void number(float value);
  void vector(Vec3 v);
  // Each value of a pose is the difference of its bits to the line through the two poses before it:
  // two or three bytes instead of four.
  void poses(std::span<const Pose> poses);
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

// The same read back. After the end everything is zero and `good()` is false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint8_t byte();
  std::uint64_t word(int bytes);
  float number();
  Vec3 vector();
  std::vector<Pose> poses(std::size_t count);
  bool good() const { return good_; }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::uint32_t difference();
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace ringcraft
