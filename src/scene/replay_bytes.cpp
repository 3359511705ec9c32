#include "scene/replay_bytes.h"

#include <array>
#include <bit>

namespace ringcraft {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kValues = 3 + 4 * kJointCount;  // of a pose

using Values = std::array<std::uint32_t, kValues>;

// A float's bits in the order of the numbers: neighbouring numbers are neighbouring integers.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}
float from_ordered(std::uint32_t order) {
  return std::bit_cast<float>((order >> 31) != 0 ? order & 0x7fffffffu : ~order);
}

Values values_of(const Pose& pose) {
  Values values{};
  std::size_t n = 0;
  for (const float v : {pose.hips.x, pose.hips.y, pose.hips.z}) values[n++] = ordered(v);
  for (const Quat& q : pose.rotation) {
    for (const float v : {q.x, q.y, q.z, q.w}) values[n++] = ordered(v);
  }
  return values;
}

Pose pose_of(const Values& values) {
  std::array<float, kValues> v{};
  for (std::size_t i = 0; i < kValues; ++i) v[i] = from_ordered(values[i]);
  Pose pose;
  pose.hips = {v[0], v[1], v[2]};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const float* q = &v[3 + 4 * j];
    pose.rotation[j] = Quat(q[3], q[0], q[1], q[2]);
  }
  return pose;
}

// Where a value is going; unsigned arithmetic, which wraps around.
std::uint32_t expected(std::size_t pose, std::uint32_t last, std::uint32_t before_last) {
  if (pose == 0) return ordered(0.0f);
  return pose == 1 ? last : last + (last - before_last);
}

}  // namespace

void ByteWriter::word(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) byte(static_cast<std::uint8_t>(value >> (8 * i)));
}

void ByteWriter::number(float value) {
  word(std::bit_cast<std::uint32_t>(value), 4);
}

void ByteWriter::vector(Vec3 v) {
  for (const float value : {v.x, v.y, v.z}) number(value);
}

void ByteWriter::poses(std::span<const Pose> poses) {
  Values last{}, before_last{};
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Values values = values_of(poses[k]);
    for (std::size_t i = 0; i < kValues; ++i) {
      const std::uint32_t off = values[i] - expected(k, last[i], before_last[i]);
      // Zigzag, then seven bits a byte: small differences of either sign are short.
      std::uint32_t left = (off << 1) ^ ((off >> 31) != 0 ? 0xffffffffu : 0u);
      for (; left >= 0x80; left >>= 7) byte(static_cast<std::uint8_t>(left | 0x80));
      byte(static_cast<std::uint8_t>(left));
    }
    before_last = last;
    last = values;
  }
}

std::uint8_t ByteReader::byte() {
  if (at_ >= bytes_.size()) {
    good_ = false;
    return 0;
  }
  return bytes_[at_++];
}

std::uint64_t ByteReader::word(int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value |= static_cast<std::uint64_t>(byte()) << (8 * i);
  return value;
}

float ByteReader::number() {
  return std::bit_cast<float>(static_cast<std::uint32_t>(word(4)));
}

Vec3 ByteReader::vector() {
  const float x = number(), y = number(), z = number();
  return {x, y, z};
}

std::uint32_t ByteReader::difference() {
  std::uint32_t value = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    const std::uint8_t next = byte();
    value |= static_cast<std::uint32_t>(next & 0x7fu) << shift;
    if ((next & 0x80u) == 0) return (value >> 1) ^ ((value & 1u) != 0 ? 0xffffffffu : 0u);
  }
  good_ = false;
  return 0;
}

std::vector<Pose> ByteReader::poses(std::size_t count) {
  std::vector<Pose> poses;
  Values last{}, before_last{};
  for (std::size_t k = 0; k < count && good_; ++k) {
    Values values{};
    for (std::size_t i = 0; i < kValues; ++i) {
      values[i] = expected(k, last[i], before_last[i]) + difference();
    }
    poses.push_back(pose_of(values));
    before_last = last;
    last = values;
  }
  return poses;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= left ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
    }
  }
  return text;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const bool last = i + 4 == text.size();
    std::size_t digits = 4;
    while (last && digits > 2 && text[i + digits - 1] == '=') --digits;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t digit = k < digits ? kDigits.find(text[i + k]) : 0;
      if (digit == std::string_view::npos) return std::nullopt;
      group = group << 6 | static_cast<std::uint32_t>(digit);
    }
    const std::uint32_t unused = digits == 4 ? 0u : (1u << (8 * (4 - digits))) - 1;
    if ((group & unused) != 0) return std::nullopt;
    for (std::size_t k = 0; k + 1 < digits; ++k) {
      bytes.push_back(static_cast<std::uint8_t>(group >> (16 - 8 * k)));
    }
  }
  return bytes;
}

}  // namespace ringcraft
