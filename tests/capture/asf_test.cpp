#include "capture/asf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/temporary_folder.h"
#include "capture/amc.h"
#include "capture/bvh.h"
#include "capture/read_capture.h"
#include "mocap.h"
#include "small_files.h"

namespace ringcraft {
namespace {

using ::testing::HasSubstr;

Result<RawClip> read(const std::string& asf, const std::string& amc) {
  const auto skeleton = parse_asf(asf, "toy.asf");
  if (!skeleton) return tl::unexpected(skeleton.error());
  return parse_amc(amc, "toy.amc", *skeleton);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_LT(glm::distance(a, b), 1e-4f) << a.x << ' ' << a.y << ' ' << a.z;
}

constexpr float kUnit = 0.0254f / 0.45f;

TEST(Asf, BonesTurnAboutTheirStartInTheirOwnFrame) {
  const auto clip = read(testing::small_asf(), testing::small_amc());
  ASSERT_TRUE(clip) << to_string(clip.error());
  ASSERT_EQ(clip->frames, 2u);
  EXPECT_NEAR(clip->frame_seconds, 1.0 / 120, 1e-9);
  const RawPose first = raw_pose(*clip, 0);
  expect_near(first.position[0], {0, 18 * kUnit, 0});
  expect_near(first.position[1], first.position[0]);  // a bone begins where its carrier ends
  expect_near(first.position[2], first.position[0] + Vec3(9 * kUnit, 0, 0));
  // The upper arm's own x axis is our y (axis 0 0 90): +90 about it turns x to -z. The forearm then
  // turns by +90 about its carrier's z, from x to y, which the upper arm leaves where it is.
  const RawPose second = raw_pose(*clip, 1.0 / 120);
  expect_near(second.position[2], Vec3(0, 18 * kUnit, 9 * kUnit) + Vec3(0, 0, -9 * kUnit));
  expect_near(second.position[3] - second.position[2], {0, 4.5f * kUnit, 0});
}

TEST(Asf, RadiansAreReadWhereTheMotionSaysSo) {
  std::string amc = replaced(testing::small_amc(), ":DEGREES", ":RADIANS");
  amc = replaced(amc, "upper 90 0\nfore 90", "upper 1.5707963 0\nfore 1.5707963");
  const auto degrees = read(testing::small_asf(), testing::small_amc());
  const auto clip = read(testing::small_asf(), amc);
  ASSERT_TRUE(clip) << to_string(clip.error());
  expect_near(raw_pose(*clip, 1).position[2], raw_pose(*degrees, 1).position[2]);
}

TEST(Asf, BonesWithoutMotionRest) {
  std::string amc = testing::small_amc();
  amc = replaced(replaced(amc, "fore 0\n", ""), "fore 90\n", "");
  const auto clip = read(testing::small_asf(), amc);
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_FLOAT_EQ(clip->rotation[clip->at(1, 2)].w, 1);
  ASSERT_EQ(clip->notes.size(), 1u);
  EXPECT_THAT(clip->notes[0], HasSubstr("fore"));
}

TEST(Asf, CommentsLatin1AndCarriageReturnsDoNoHarm) {
  std::string amc = "#!OML:ASF X:\\f\xFCr\\Bastian.ASF\r\n";
  for (const char c : testing::small_amc())
    amc += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto clip = read("# \xFC\n" + testing::small_asf(), amc);
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_EQ(clip->frames, 2u);
}

TEST(Asf, WhatWouldBeReadWrongIsRefusedWithItsLine) {
  struct Case {
    std::string asf, amc, says;
  };
  const std::string asf = testing::small_asf(), amc = testing::small_amc();
  const Case cases[] = {
      {asf, replaced(amc, "fore 0", "shin 0"), "has no bone 'shin'"},
      {asf, replaced(amc, "upper 90 0", "upper 90"), "numbers, not fewer"},
      {asf, replaced(amc, "upper 90 0", "upper 90 0 1"), "numbers, not more"},
      {asf, replaced(amc, "upper 90 0", "upper 90 nan"), "not a number"},
      {asf, replaced(amc, "\n2\n", "\n4\n"), "frame 4 follows frame 1"},
      {asf, replaced(amc, "fore 90\n", ""), "lacks bone 'fore'"},
      {asf, replaced(amc, "upper 90 0\n", "upper 90 0\nupper 0 0\n"), "stands twice"},
      {asf, "hello\n", "number of the first frame"},
      {asf, "", "there are no frames"},
      {"HIERARCHY\n", amc, "no ASF file"},
      {replaced(asf, "upper fore", "upper upper"), amc, "hangs on two bones"},
      {replaced(asf, "    upper fore\n", ""), amc, "hangs on nothing"},
      {replaced(asf, "root upper\n    upper fore", "upper fore\n    fore upper"), amc, "in a ring"},
      {replaced(asf, "axis 0 0 90 XYZ", "axis 0 0 90 XYY"), amc, "axis order"},
      {replaced(asf, "dof rx rz", "dof rx rx"), amc, "stands twice"},
      {replaced(asf, "length 9", "length -9"), amc, "negative length"},
      {replaced(asf, "name fore", "name upper"), amc, "a second bone"},
      {asf.substr(0, asf.find(":hierarchy")), amc, "no :hierarchy"},
  };
  for (const Case& c : cases) {
    const auto clip = read(c.asf, c.amc);
    ASSERT_FALSE(clip) << c.says;
    EXPECT_THAT(clip.error().what, HasSubstr(c.says));
    EXPECT_THAT(clip.error().place, HasSubstr("line "));
    EXPECT_FALSE(clip.error().remedy.empty());
  }
}

TEST(Asf, LimitsHold) {
  CaptureLimits limits;
  limits.cells = 5;  // two frames of three bones are six
  const auto skeleton = parse_asf(testing::small_asf(), "toy.asf");
  ASSERT_TRUE(skeleton);
  EXPECT_FALSE(parse_amc(testing::small_amc(), "toy.amc", *skeleton, 120, limits));
  limits.joints = 2;
  EXPECT_FALSE(parse_asf(testing::small_asf(), "toy.asf", limits));
  limits = {};
  limits.depth = 2;
  EXPECT_FALSE(parse_asf(testing::small_asf(), "toy.asf", limits));
}

class CaptureFolder : public ::testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& text) {
    std::ofstream(folder() / name, std::ios::binary) << text;
    return folder() / name;
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(CaptureFolder, AMotionFindsTheSkeletonBesideIt) {
  put("13.asf", testing::small_asf());
  put("bd.asf", testing::small_asf());
  for (const char* name : {"13_17.amc", "13.amc", "bd_kick_001_120.AMC"}) {
    const auto clip = read_capture(put(name, testing::small_amc()));
    EXPECT_TRUE(clip) << to_string(clip.error());
  }
  const auto lost = read_capture(put("14_01.amc", testing::small_amc()));
  ASSERT_FALSE(lost);
  EXPECT_THAT(to_string(lost.error()), HasSubstr("14.asf"));
  CaptureSource source;
  source.skeleton = folder() / "13.asf";
  source.frames_per_second = 60;
  const auto named = read_capture(folder() / "14_01.amc", source);
  ASSERT_TRUE(named);
  EXPECT_NEAR(named->frame_seconds, 1.0 / 60, 1e-9);
}

TEST_F(CaptureFolder, WhatDoesNotGoWithAFormatIsSaid) {
  const auto bvh = put("a.bvh", testing::small_bvh());
  EXPECT_TRUE(read_capture(bvh));
  CaptureSource source;
  source.clip = "Punch";
  EXPECT_FALSE(read_capture(bvh, source));
  source = {};
  source.skeleton = "a.asf";
  EXPECT_FALSE(read_capture(bvh, source));
  EXPECT_FALSE(read_capture(put("a.asf", testing::small_asf())));
  EXPECT_FALSE(read_capture(put("a.fbx", "x")));
}

TEST(Asf, OneTakeAsAsfAndAsBvhAgreesToAMillimetre) {
  const auto folder = testing::mocap_folder() / "cmu";
  if (!std::filesystem::exists(folder / "07_05.amc")) GTEST_SKIP() << "skipped: no captures";
  const auto acclaim = read_capture(folder / "07_05.amc");
  const auto bvh = read_capture(folder / "07_05_converted.bvh");
  ASSERT_TRUE(acclaim && bvh);
  ASSERT_EQ(acclaim->frames, bvh->frames);
  float largest = 0;
  int compared = 0;
  for (std::size_t f = 0; f < acclaim->frames; ++f) {
    const RawPose a = raw_pose(*acclaim, static_cast<double>(f) * acclaim->frame_seconds);
    const RawPose b = raw_pose(*bvh, static_cast<double>(f) * bvh->frame_seconds);
    for (std::size_t j = 0; j < acclaim->joints.size(); ++j) {
      const int other = bvh->find(acclaim->joints[j].name);
      if (other < 0) continue;
      ++compared;
      largest = std::max(
          largest,
          glm::distance(a.position[j], b.position[static_cast<std::size_t>(other)] * 0.01f));
    }
  }
  EXPECT_EQ(compared, static_cast<int>(acclaim->frames * acclaim->joints.size()));
  EXPECT_LT(largest, 0.001f);
  RecordProperty("largest_mm", std::to_string(1000 * largest));
}

}  // namespace
}  // namespace ringcraft
