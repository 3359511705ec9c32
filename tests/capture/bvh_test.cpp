#include "capture/bvh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace ringcraft {
namespace {

using testing::HasSubstr;

// Two joints: a root that moves and turns, an arm of length 2 along x with its own channel order.
constexpr const char* kHierarchy = R"(HIERARCHY
ROOT Base
{
  OFFSET 0 1 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 2 0 0
    CHANNELS 3 Xrotation Yrotation Zrotation
    End Site
    {
      OFFSET 3 0 0
    }
  }
}
)";

std::string with_motion(const std::string& motion) {
  return std::string(kHierarchy) + motion;
}

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_LT(glm::distance(a, b), 1e-4f) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Bvh, EveryFrameOfAToyIsWhatArithmeticSays) {
  std::string motion = "MOTION\nFrames: 7\nFrame Time: 0.1\n";
  for (int f = 0; f < 7; ++f)
    motion += std::to_string(f) + " 1 0  0 0 " + std::to_string(15 * f) + "  0 0 90\n";
  const auto clip = parse_bvh(with_motion(motion), "toy.bvh");
  ASSERT_TRUE(clip) << to_string(clip.error());
  ASSERT_EQ(clip->frames, 7u);
  EXPECT_TRUE(clip->notes.empty());
  EXPECT_NEAR(clip->seconds(), 0.6, 1e-6);
  for (int f = 0; f < 7; ++f) {
    const float turn = radians(15.0f * static_cast<float>(f));
    const RawPose pose = raw_pose(*clip, 0.1 * f);
    expect_near(pose.position[0], {static_cast<float>(f), 1, 0});
    // Turned by `turn` about y: x goes to (cos, 0, -sin). The arm's end site is one up: z turned
    // by 90.
    expect_near(pose.position[1],
                {static_cast<float>(f) + 2 * std::cos(turn), 1, -2 * std::sin(turn)});
    expect_near(pose.position[2] - pose.position[1], {0, 3, 0});
    EXPECT_EQ(clip->joints[2].name, "Arm End Site");
  }
}

TEST(Bvh, RotationsComposeInTheOrderOfTheChannels) {
  // Root ZXY: R = Rz Rx Ry. Arm XYZ: R = Rx Ry Rz.
  const auto clip = parse_bvh(
      with_motion("MOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 90 90 0 90 90 0\n"), "toy.bvh");
  ASSERT_TRUE(clip);
  const RawPose pose = raw_pose(*clip, 0);
  expect_near(pose.rotation[0] * Vec3(0, 1, 0), {0, 0, 1});  // Rx: y -> z, Rz leaves z
  expect_near(pose.rotation[0] * Vec3(0, 0, 1), {1, 0, 0});  // Rx: z -> -y, Rz: -y -> x
  const Quat arm = glm::inverse(pose.rotation[0]) * pose.rotation[1];
  expect_near(arm * Vec3(1, 0, 0), {0, 1, 0});  // Ry: x -> -z, Rx: -z -> y
}

TEST(Bvh, PositionChannelsOfAnyJointReplaceItsOffset) {
  const auto clip = parse_bvh(
      "HIERARCHY\nROOT A\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT "
      "B\n{\nOFFSET 1 2 3\n"
      "CHANNELS 1 Yposition\nEnd Site\n{\nOFFSET 0 0 0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: "
      ".01\n5 0 0 7\n",
      "toy.bvh");
  ASSERT_TRUE(clip) << to_string(clip.error());
  expect_near(raw_pose(*clip, 0).position[1], {6, 7, 3});
}

TEST(Bvh, BetweenFramesRotationsGoTheShortestWay) {
  const auto clip = parse_bvh(
      with_motion(
          "MOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0 0 0 170 0 0 0\n0 0 0 0 0 -170 0 0 0\n"),
      "toy.bvh");
  ASSERT_TRUE(clip);
  expect_near(raw_pose(*clip, 0.05).position[1], {-2, 0, 0});
}

TEST(Bvh, ReadsWhatRealFilesDo) {
  std::string text = with_motion(
      "MOTION\r\nFrames:\t3\r\nFrame Time:\t.01\r\n0 0 0 0 0 0 0 0 0\r\n+1 -1e-2 0 0 0 0 0 0 0 "
      "\n\n");
  text.insert(text.find("Arm"), "Bras cass\xE9 ");
  const auto clip = parse_bvh(text, "odd.bvh");
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_EQ(clip->frames, 2u);
  ASSERT_EQ(clip->notes.size(), 1u);
  EXPECT_THAT(clip->notes[0], HasSubstr("says 3"));
  EXPECT_THAT(clip->notes[0], HasSubstr("2 rows"));
  EXPECT_EQ(clip->joints[1].name, "Bras cass\xC3\xA9 Arm");
}

TEST(Bvh, SpacesAndLineEndsBetweenWordsMayBeMissing) {
  std::string text = with_motion("MOTION\nFrames:1\nFrame Time:0.1\n1 2 3 0 0 0 0 0 0\n");
  const std::string site = "End Site\n    {";
  text.replace(text.find(site), site.size(), "End Site {");
  const auto clip = parse_bvh(text, "toy.bvh");
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_EQ(clip->frames, 1u);
  EXPECT_NEAR(clip->frame_seconds, 0.1, 1e-6);
  EXPECT_FALSE(
      parse_bvh(with_motion("MOTION\nFrames:1x\nFrame Time: 1\n0 0 0 0 0 0 0 0 0\n"), "toy.bvh"));
}

struct BadFile {
  const char* name;
  std::string text;
  const char* place;
  const char* what;
};

std::vector<BadFile> bad_files() {
  const std::string head = "MOTION\nFrames: 2\nFrame Time: 0.1\n";
  const std::string good = with_motion(head + "0 0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0 0\n");
  std::string deep = "HIERARCHY\nROOT r\n{\n";
  for (int i = 0; i < 200000; ++i) deep += "JOINT j\n{\n";
  std::string wide = "HIERARCHY\nROOT r\n{\n";
  for (int i = 0; i < 3000; ++i) wide += "JOINT j\n{\n}\n";
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  return {
      {"empty", "", "line 1", "HIERARCHY"},
      {"other format", "glTF\x02", "line 1", "no BVH"},
      {"cut in the hierarchy", good.substr(0, 120), "line 6", "the file ends"},
      {"no MOTION", std::string(kHierarchy), "line 16", "MOTION"},
      {"cut in a row", good.substr(0, good.size() - 6), "line 20", "6 numbers"},
      {"cut between rows", replaced(good, "Frames: 2", "Frames: 9"), "line 21", "after 2 rows"},
      {"text in a row", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 x1 0 0 0 0 0 0"), "line 19",
       "'x1'"},
      {"half a number", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 1.5.2 0 0 0 0 0 0"), "line 19",
       "'1.5.2'"},
      {"not a number", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 nan 0 0 0 0 0 0"), "line 19",
       "'nan'"},
      {"infinity", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 inf 0 0 0 0 0 0"), "line 19", "'inf'"},
      {"huge", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 1e30 0 0 0 0 0 0"), "line 19", "'1e30'"},
      {"row too long", replaced(good, "0 0 0 0 0 0 0 0 0", "0 0 0 0 0 0 0 0 0 0"), "line 19",
       "more numbers"},
      {"no rows", with_motion(head), "line 19", "no rows"},
      {"absurd frames", replaced(good, "Frames: 2", "Frames: 9999999"), "line 17",
       "more than is read"},
      {"negative frames", replaced(good, "Frames: 2", "Frames: -2"), "line 17", "no count"},
      {"frames as text", replaced(good, "Frames: 2", "Frames: two"), "line 17", "'two'"},
      {"zero frame time", replaced(good, "0.1\n", "0\n"), "line 18", "frame time"},
      {"unknown channel", replaced(good, "Zrotation", "Wrotation"), "line 5", "'Wrotation'"},
      {"channel twice", replaced(good, "Xposition", "Yposition"), "line 5", "twice"},
      {"too many channels", replaced(good, "CHANNELS 6", "CHANNELS 7"), "line 5", "0 to 6"},
      {"offset without numbers", replaced(good, "OFFSET 2 0 0", "OFFSET 2 0"), "line 9",
       "a number"},
      {"no joints in motion",
       "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 1\nFrame Time: 1\n0\n", "line 9",
       "no joint has channels"},
      {"nested too deep", deep, "line", "nested deeper"},
      {"too many joints", wide, "line", "more than 1024 joints"},
      {"brackets only", "HIERARCHY ROOT a {{{{", "line 1", "should stand"},
  };
}

TEST(Bvh, BadFilesAreErrorsThatSayWhereAndWhat) {
  for (const BadFile& file : bad_files()) {
    const auto clip = parse_bvh(file.text, "bad.bvh");
    ASSERT_FALSE(clip) << file.name;
    EXPECT_EQ(clip.error().file, "bad.bvh") << file.name;
    EXPECT_EQ(clip.error().kind, ErrorKind::input) << file.name;
    EXPECT_THAT(clip.error().place, HasSubstr(file.place))
        << file.name << ": " << to_string(clip.error());
    EXPECT_THAT(clip.error().what, HasSubstr(file.what))
        << file.name << ": " << to_string(clip.error());
    EXPECT_FALSE(clip.error().remedy.empty()) << file.name;
  }
}

TEST(Bvh, DecimalsWithCommasAreNamed) {
  const auto clip = parse_bvh(
      with_motion("MOTION\nFrames: 1\nFrame Time: 0.1\n1,5 2 3 4 5 6 7 8 9\n"), "comma.bvh");
  ASSERT_FALSE(clip);
  EXPECT_THAT(clip.error().what, HasSubstr("'1,5'"));
  EXPECT_EQ(clip.error().remedy, "write decimals with points");
}

TEST(Bvh, NoPrefixOfAFileCrashesTheReader) {
  const std::string good = with_motion("MOTION\nFrames: 1\nFrame Time: 0.1\n1 2 3 4 5 6 7 8 9\n");
  for (std::size_t size = 0; size < good.size(); ++size) {
    const auto clip = parse_bvh(good.substr(0, size), "cut.bvh");
    // Only the last line end may go missing.
    if (size + 1 < good.size()) {
      EXPECT_FALSE(clip) << size;
    }
  }
}

TEST(Bvh, AJunkFirstFrameIsReplacedAndAnHonestOneKept) {
  std::string motion = "MOTION\nFrames: 20\nFrame Time: 0.01\n0 0 0 0 0 0 0 0 0\n";
  for (int f = 1; f < 20; ++f) motion += "0 0 0 0 0 " + std::to_string(90 + f) + " 0 0 0\n";
  auto junk = parse_bvh(with_motion(motion), "junk.bvh");
  ASSERT_TRUE(junk);
  EXPECT_TRUE(replace_junk_start(*junk));
  expect_near(raw_pose(*junk, 0).position[1], raw_pose(*junk, 0.01).position[1]);
  EXPECT_EQ(junk->frames, 20u);
  EXPECT_FALSE(replace_junk_start(*junk));
}

TEST(Bvh, AHeldOrResampledJunkStartIsReplacedAndAHeldHonestOneKept) {
  const auto arm_at = [](int degrees) {
    return "0 0 0 0 0 " + std::to_string(degrees) + " 0 0 0\n";
  };
  const auto started = [&](const std::vector<int>& first) {
    std::string motion = fmt::format("MOTION\nFrames: {}\nFrame Time: 0.01\n", first.size() + 20);
    for (const int degrees : first) motion += arm_at(degrees);
    for (int f = 0; f < 20; ++f) motion += arm_at(90 + f);
    return parse_bvh(with_motion(motion), "junk.bvh").value();
  };
  for (const std::vector<int>& first : {std::vector<int>{0, 45}, std::vector<int>(12, 0)}) {
    RawClip junk = started(first);
    EXPECT_TRUE(replace_junk_start(junk));
    const double begins = 0.01 * static_cast<double>(first.size());
    for (double t = 0; t < begins; t += 0.01)
      expect_near(raw_pose(junk, t).position[1], raw_pose(junk, begins).position[1]);
    EXPECT_FALSE(replace_junk_start(junk));
  }
  // The rest pose, at 24 frames a second: the motion is not slower by much than the jump.
  std::string fast = "MOTION\nFrames: 22\nFrame Time: 0.041667\n" + arm_at(0) + arm_at(0);
  for (int f = 0; f < 20; ++f) fast += fmt::format("0 0 0 0 0 {} 0 0 {}\n", 15 * f, 60 + 15 * f);
  RawClip few = parse_bvh(with_motion(fast), "few.bvh").value();
  EXPECT_TRUE(replace_junk_start(few));
  for (const double t : {0.0, few.frame_seconds})
    EXPECT_LT(glm::length(rotation_vector(glm::inverse(raw_pose(few, t).rotation[1]) *
                                          raw_pose(few, 2 * few.frame_seconds).rotation[1])),
              1e-3f);
  // Stands, and then goes on at the pace of the rest, or moves before the jump.
  RawClip honest = started(std::vector<int>(12, 89));
  EXPECT_FALSE(replace_junk_start(honest));
  RawClip moving = started({0, 1, 2, 3, 4});
  EXPECT_FALSE(replace_junk_start(moving));
}

TEST(Bvh, SeveralRootsAreReadEachWithItsChannels) {
  std::string text = kHierarchy;
  text +=
      "ROOT Sword\n{\n OFFSET 0 0 0\n CHANNELS 3 Xposition Yposition Zposition\n}\n"
      "MOTION\nFrames: 2\nFrame Time: 0.01\n"
      "1 2 3 0 0 0 0 0 0 7 8 9\n1 2 3 0 0 0 0 0 0 8 8 9\n";
  const auto clip = parse_bvh(text, "two.bvh");
  ASSERT_TRUE(clip) << to_string(clip.error());
  const auto sword = static_cast<std::size_t>(clip->find("Sword"));
  EXPECT_EQ(clip->joints[sword].parent, -1);
  expect_near(raw_pose(*clip, 0).position[sword], {7, 8, 9});
  expect_near(raw_pose(*clip, 0.01).position[sword], {8, 8, 9});
  expect_near(raw_pose(*clip, 0.01).position[0], {1, 2, 3});
}

TEST(Bvh, FramesThatAreElsewhereAtOnceAndBackAreBridgedAndFastOnesKept) {
  // The root goes steadily; in frame 20 it is far away, from 40 on as many frames as `lost` are 0.
  const auto with_spikes = [](const char* frame_seconds, float way, bool spike, int lost) {
    std::string motion = fmt::format("MOTION\nFrames: 80\nFrame Time: {}\n", frame_seconds);
    for (int f = 0; f < 80; ++f)
      motion += f >= 40 && f < 40 + lost
                    ? "0 0 0 0 0 0 0 0 0\n"
                    : fmt::format("{} {} 30 0 0 30 0 0 40\n", way * static_cast<float>(f),
                                  spike && f == 20 ? -70 : 0);
    return parse_bvh(with_motion(motion), "spikes.bvh").value();
  };
  for (const char* frame_seconds : {"0.00833333", "0.0333333"}) {
    RawClip clip = with_spikes(frame_seconds, 0.01f, true, 4);
    EXPECT_EQ(mend_jumps(clip), 5u);
    const RawClip whole = with_spikes(frame_seconds, 0.01f, false, 0);
    for (std::size_t f = 0; f < 80; ++f)
      for (std::size_t j = 0; j < 2; ++j)
        expect_near(clip.translation[clip.at(f, j)], whole.translation[clip.at(f, j)]);
    EXPECT_EQ(clip.notes.size(), 1u);
    EXPECT_EQ(mend_jumps(clip), 0u);
  }
  // Goes elsewhere and stays, is gone for longer than can be guessed, or is only fast.
  RawClip cut = with_spikes("0.00833333", 0.01f, false, 40);
  EXPECT_EQ(mend_jumps(cut), 0u);
  RawClip gone = with_spikes("0.00833333", 0.01f, false, 25);
  EXPECT_EQ(mend_jumps(gone), 0u);
  RawClip fast = with_spikes("0.0333333", 1.5f, false, 0);
  EXPECT_EQ(mend_jumps(fast), 0u);
}

TEST(Bvh, EveryCaptureThatIsHereIsRead) {
  const std::filesystem::path folder =
      std::filesystem::path(RINGCRAFT_SOURCE_DIR) / "../shared/mocap";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no captures";
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".bvh") continue;
    const auto clip = read_bvh(entry.path());
    ASSERT_TRUE(clip) << to_string(clip.error());
    EXPECT_GT(clip->frames, 20u);
    ++read;
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace ringcraft
