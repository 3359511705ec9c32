// Damaged captures: whatever the bytes, a reader answers with a clip or with one error.
#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "capture/amc.h"
#include "capture/bvh.h"
#include "capture/gltf.h"
#include "capture/profile.h"
#include "small_files.h"

namespace ringcraft {
namespace {

constexpr int kRounds = 3000;

std::uint32_t pick(Random& random, std::size_t below) {
  return static_cast<std::uint32_t>(random.uniform() * static_cast<double>(below));
}

// Bytes turned over, cut out, doubled, or numbers replaced by ones that break what trusts them.
std::string damaged(std::string bytes, Random& random) {
  static constexpr std::array<const char*, 12> kNumbers = {
      "-1",         "0",     "1e30", "nan",     "-0", "4294967296",
      "2147483647", "1e-30", "0.5",  "9999999", "{",  "}"};
  for (std::uint32_t n = pick(random, 4) + 1; n-- > 0 && !bytes.empty();) {
    const std::size_t at = pick(random, bytes.size());
    switch (pick(random, 5)) {
      case 0:
        bytes[at] = static_cast<char>(pick(random, 256));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, pick(random, 40));
        break;
      case 3:
        bytes.insert(at, bytes.substr(pick(random, bytes.size()), pick(random, 60)));
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        std::size_t end = bytes.find_first_not_of("0123456789.e-", digit);
        if (end == std::string::npos) end = bytes.size();
        bytes.replace(digit, end - digit, kNumbers[pick(random, kNumbers.size())]);
      }
    }
  }
  return bytes;
}

// A clip that was read is whole: what comes next may rely on it.
void expect_whole(const Result<RawClip>& clip) {
  if (!clip) {
    EXPECT_FALSE(clip.error().what.empty());
    EXPECT_FALSE(clip.error().remedy.empty());
    return;
  }
  ASSERT_GT(clip->frames, 0u);
  ASSERT_EQ(clip->rotation.size(), clip->frames * clip->joints.size());
  ASSERT_EQ(clip->translation.size(), clip->rotation.size());
  for (std::size_t j = 0; j < clip->joints.size(); ++j)
    ASSERT_LT(clip->joints[j].parent, static_cast<int>(j));
  for (const double time : {0.0, 0.3, 1e9}) {
    const RawPose pose = raw_pose(*clip, time);
    for (const Vec3& p : pose.position) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const Quat& q : pose.rotation) ASSERT_NEAR(glm::length(q), 1, 1e-2);
  }
}

template <class Read>
void fuzz(const std::string& seed, std::uint64_t number, int rounds, const Read& read) {
  Random random(number);
  expect_whole(read(seed));
  int whole = 0;
  for (int i = 0; i < rounds; ++i) {
    const std::string bytes = damaged(seed, random);
    const Result<RawClip> clip = read(bytes);
    expect_whole(clip);
    whole += clip ? 1 : 0;
    if (::testing::Test::HasFailure()) FAIL() << "round " << i << ":\n" << bytes;
  }
  // Some damage is harmless, most is not: else nothing was tried.
  EXPECT_GT(whole, 0);
  EXPECT_LT(whole, rounds);
}

TEST(DamagedCaptures, BvhGivesAClipOrAnError) {
  fuzz(testing::small_bvh(), 1, kRounds,
       [](const std::string& b) { return parse_bvh(b, "f.bvh"); });
}

TEST(DamagedCaptures, AsfGivesAClipOrAnError) {
  fuzz(testing::small_asf(), 2, kRounds, [](const std::string& bytes) -> Result<RawClip> {
    const auto skeleton = parse_asf(bytes, "f.asf");
    if (!skeleton) return tl::unexpected(skeleton.error());
    return parse_amc(testing::small_amc(), "f.amc", *skeleton);
  });
}

TEST(DamagedCaptures, AmcGivesAClipOrAnError) {
  const auto skeleton = parse_asf(testing::small_asf(), "f.asf");
  ASSERT_TRUE(skeleton);
  fuzz(testing::small_amc(), 3, kRounds,
       [&](const std::string& bytes) { return parse_amc(bytes, "f.amc", *skeleton); });
}

TEST(DamagedCaptures, GlbGivesAClipOrAnError) {
  testing::GltfDraft draft = testing::small_gltf();
  draft.json["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"] = {{"hips", {{"node", 0}}}};
  std::vector<float> matrices(32);
  for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) matrices[i] = 1;
  draft.json["skins"] = {
      {{"joints", {0, 1}}, {"inverseBindMatrices", draft.add(matrices, "MAT4", 16)}}};
  const auto read = [](const std::string& bytes) { return parse_gltf(bytes, "f.glb"); };
  fuzz(draft.glb(), 4, kRounds, read);
  // The same as text: damage there reaches the numbers more often.
  draft.json["extensions"].clear();
  std::string data;
  static constexpr char kCode[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (draft.binary.size() % 3 != 0) draft.binary += '\0';
  for (std::size_t i = 0; i < draft.binary.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | static_cast<unsigned char>(draft.binary[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) data += kCode[three >> shift & 63];
  }
  draft.json["buffers"] = {{{"byteLength", draft.binary.size()},
                            {"uri", "data:application/octet-stream;base64," + data}}};
  fuzz(draft.json.dump(), 5, kRounds, read);
}

}  // namespace
}  // namespace ringcraft
