#include "capture/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "capture/profile.h"
#include "small_files.h"

namespace ringcraft {
namespace {

using testing::GltfDraft;
using ::testing::HasSubstr;
using testing::kHalf;
using testing::small_gltf;
using Json = nlohmann::json;

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_LT(glm::distance(a, b), 1e-4f) << a.x << ' ' << a.y << ' ' << a.z;
}

RawClip read(GltfDraft draft, const std::string& clip = "") {
  auto read = parse_gltf(draft.glb(), "toy.glb", clip);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : RawClip{};
}

Error refused(const std::string& bytes, const std::string& clip = "") {
  const auto read = parse_gltf(bytes, "toy.glb", clip);
  EXPECT_FALSE(read);
  return read ? Error{} : read.error();
}

TEST(Gltf, NodesBecomeJointsAndKeysAreSampledAt60Hz) {
  const RawClip clip = read(small_gltf());
  ASSERT_EQ(clip.joints.size(), 3u);
  EXPECT_EQ(clip.joints[2].name, "hand");
  EXPECT_EQ(clip.frames, 61u);
  EXPECT_NEAR(clip.frame_seconds, 1.0 / 60, 1e-9);
  expect_near(raw_rest_pose(clip).position[2], {3, 1, 0});
  for (const int frame : {0, 15, 29, 30, 60}) {
    const RawPose pose = raw_pose(clip, frame / 60.0);
    const float turn = radians(90.0f * static_cast<float>(frame) / 60.0f);
    const Vec3 root(0, 1, frame < 30 ? 0 : 3);  // STEP
    expect_near(pose.position[0], root);
    expect_near(pose.position[2], root + Vec3(1 + 2 * std::cos(turn), 2 * std::sin(turn), 0));
  }
}

TEST(Gltf, CubicKeysFollowTheirTangents) {
  GltfDraft draft = small_gltf();
  draft.add_clip("Hop");
  // Up by 1 in 2 s; it leaves at 3 m/s and arrives at rest.
  draft.add_track(0, "translation", "CUBICSPLINE", {0, 2},
                  {0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0});
  const RawClip clip = read(draft, "Hop");
  ASSERT_EQ(clip.frames, 121u);
  for (const int frame : {0, 30, 60, 90, 120}) {
    const float t = static_cast<float>(frame) / 120;
    const float hermite = 1 + (3 * t * t - 2 * t * t * t) + (t * t * t - 2 * t * t + t) * 2 * 3;
    EXPECT_NEAR(raw_pose(clip, frame / 60.0).position[0].y, hermite, 1e-4);
  }
  // Nothing else moves: it rests.
  expect_near(raw_pose(clip, 1).position[2] - raw_pose(clip, 1).position[0], {3, 0, 0});
}

TEST(Gltf, ClipsGoByTheirNameOrWhatStandsAfterTheBar) {
  GltfDraft draft = small_gltf();
  draft.add_clip("Rig|Punch");
  draft.add_track(0, "translation", "LINEAR", {0, 0.5f}, {0, 1, 0, 0, 2, 0});
  EXPECT_EQ(read(draft).frames, 61u);
  EXPECT_EQ(read(draft, "Punch").frames, 31u);
  EXPECT_EQ(read(draft, "Rig|Punch").frames, 31u);
  EXPECT_THAT(refused(draft.glb(), "Kick").remedy, HasSubstr("Rig|Wave, Rig|Punch"));
}

TEST(Gltf, TheRestPoseIsTheOneTheSkinWasBoundIn) {
  // The nodes stand with the arm up; the skin was bound with the arm along x, in a mesh space that
  // is a hundredth of the world's and has z up.
  GltfDraft draft = small_gltf();
  draft.json["nodes"][1]["rotation"] = {0, 0, kHalf, kHalf};
  const auto inverse_bind = [](Vec3 place) {
    // World (x, y, z) is mesh (x, -z, y) / 100.
    const glm::mat4 to_mesh(glm::vec4(0.01f, 0, 0, 0), glm::vec4(0, 0, 0.01f, 0),
                            glm::vec4(0, -0.01f, 0, 0), glm::vec4(0, 0, 0, 1));
    glm::mat4 bind(1);
    bind[3] = glm::vec4(place, 1);
    return glm::inverse(to_mesh * bind);
  };
  std::vector<float> matrices;
  for (const Vec3& place : {Vec3(0, 1, 0), Vec3(1, 1, 0)}) {
    const glm::mat4 matrix = inverse_bind(place);
    for (int cell = 0; cell < 16; ++cell) matrices.push_back(matrix[cell / 4][cell % 4]);
  }
  const int accessor = draft.add(matrices, "MAT4", 16);
  draft.json["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", accessor}}};
  const RawClip clip = read(draft);
  expect_near(raw_rest_pose(clip).position[2], {3, 1, 0});
  // What moves moves as the nodes say, whatever the rest pose is.
  expect_near(raw_pose(clip, 0).position[2], {3, 1, 0});
  expect_near(raw_pose(clip, 1).position[2], {1, 3, 3});
  draft.json["skins"] = Json::array();
  expect_near(raw_rest_pose(read(draft)).position[2], {1, 3, 0});
}

TEST(Gltf, VrmBonesGoByTheirVrmNames) {
  for (const char* key : {"VRMC_vrm", "VRMC_vrm_animation"}) {
    GltfDraft draft = small_gltf();
    draft.json["nodes"][0]["name"] = "leftHand";
    draft.json["extensions"][key]["humanoid"]["humanBones"] = {
        {"leftHand", {{"node", 2}}}, {"leftEyeOfNewt", {{"node", 1}}}, {"hips", {{"node", 99}}}};
    const RawClip clip = read(draft);
    EXPECT_EQ(clip.joints[0].name, "leftHand_");
    EXPECT_EQ(clip.joints[1].name, "arm");
    EXPECT_EQ(clip.joints[2].name, "leftHand");
  }
  GltfDraft draft = small_gltf();
  draft.json["extensions"]["VRM"]["humanoid"]["humanBones"] = {{{"bone", "hips"}, {"node", 0}}};
  EXPECT_EQ(read(draft).joints[0].name, "hips");
}

TEST(Gltf, HostileFilesAreRefusedWithAReason) {
  const auto with = [](auto change) {
    GltfDraft draft = small_gltf();
    change(draft);
    return draft.glb();
  };
  struct Case {
    std::string bytes, says;
  };
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  std::string cut = small_gltf().glb();
  cut.resize(cut.size() - 8);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Case cases[] = {
      {"", "ends"},
      {"glTF", "header"},
      {"{}", "no glTF 2.0 file"},
      {"[1,2]", "no object"},
      {"{\"a\":" + deep + "}", "no glTF 2.0 file"},
      {"{\"nodes\":" + deep + "}", "deeper"},
      {cut, "beyond the file's end"},
      {with([](GltfDraft& d) { d.json.erase("animations"); }), "no motion"},
      {with([](GltfDraft& d) { d.json["nodes"][2]["children"] = {0}; }), "ring"},
      {with([](GltfDraft& d) { d.json["nodes"][2]["children"] = {1}; }), "hangs on two"},
      {with([](GltfDraft& d) { d.json["nodes"][2]["children"] = {7}; }), "no node 7"},
      {with([](GltfDraft& d) {
         d.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
       }),
       "length zero"},
      {with([](GltfDraft& d) {
         d.json["nodes"][0]["translation"] = {0, 1e30, 0};
       }),
       "cannot be used"},
      {with([](GltfDraft& d) { d.json["accessors"][0]["count"] = 1000000000; }),
       "beyond its buffer"},
      {with([](GltfDraft& d) { d.json["accessors"][0]["count"] = 0; }), "beyond its buffer"},
      {with([](GltfDraft& d) { d.json["accessors"][0]["byteOffset"] = 1ull << 62; }), ""},
      {with([](GltfDraft& d) { d.json["accessors"][0]["type"] = "VEC2"; }), "type"},
      {with([](GltfDraft& d) { d.json["accessors"][0]["bufferView"] = 77; }), "no buffer view"},
      {with([](GltfDraft& d) { d.json["bufferViews"][0]["byteLength"] = 1 << 30; }), ""},
      {with([](GltfDraft& d) { d.json["bufferViews"][0]["buffer"] = 5; }), ""},
      {with([](GltfDraft& d) {
         d.json["animations"] = nlohmann::json(4097, d.json["animations"][0]);
       }),
       "more than 4096 clips"},
      {with([](GltfDraft& d) { d.json["animations"][0]["channels"][0]["sampler"] = 9; }),
       "no sampler"},
      {with([](GltfDraft& d) { d.json["animations"][0]["channels"][0]["target"]["node"] = 9; }),
       "no node 9"},
      {with([](GltfDraft& d) { d.json["animations"][0]["samplers"][0]["input"] = 99; }),
       "no accessor"},
      {with([&](GltfDraft& d) { std::memcpy(d.binary.data() + 4, &nan, 4); }), "cannot be used"},
      {with([](GltfDraft& d) {
         d.add_clip("long");
         std::swap(d.json["animations"][0], d.json["animations"][1]);
         GltfDraft& last = d;
         last.json["animations"].erase(1);
         last.add_track(0, "translation", "LINEAR", {0, 1e6f}, {0, 0, 0, 1, 1, 1});
       }),
       "longer than"},
      {with([](GltfDraft& d) {
         d.json["animations"].clear();
         d.add_clip("back");
         d.add_track(0, "translation", "LINEAR", {1, 0}, {0, 0, 0, 1, 1, 1});
       }),
       "do not rise"},
  };
  for (const Case& c : cases) {
    const Error error = refused(c.bytes);
    EXPECT_THAT(error.what, HasSubstr(c.says));
    EXPECT_FALSE(error.what.empty());
    EXPECT_FALSE(error.remedy.empty());
  }
}

TEST(Gltf, ManyNodesAndClipsAreRefusedAtOnce) {
  std::string list = "[{}";
  for (int i = 0; i < 300000; ++i) list += ",{}";
  const auto begin = std::chrono::steady_clock::now();
  for (const char* key : {"nodes", "animations"}) {
    const Error error =
        refused(fmt::format(R"({{"asset":{{"version":"2.0"}},"{}":{}]}})", key, list));
    EXPECT_EQ(error.place, std::string("/") + key);
    EXPECT_THAT(error.what, HasSubstr("more than"));
  }
  // The parser's own filter took a minute for each.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(Gltf, JsonThatIsNoneIsRefusedInOurWordsWithItsPlace) {
  struct Case {
    std::string bytes, place, says;
  };
  for (const Case& c : {Case{"", "byte 0 of its JSON", "it ends there"},
                        Case{"{\"nodes\": [", "byte 11 of its JSON", "it ends there"},
                        Case{"glT", "byte 0 of its JSON", "no JSON"},
                        Case{std::string(4, '\0'), "byte 0 of its JSON", "no JSON"},
                        Case{"{\"a\":\x1b[31m", "byte 5 of its JSON", "no JSON"},
                        Case{"{\"a\": 1e999}", "", "a number that cannot be used"}}) {
    const Error error = refused(c.bytes);
    EXPECT_EQ(error.place, c.place);
    EXPECT_THAT(error.what, HasSubstr(c.says));
    EXPECT_FALSE(error.remedy.empty());
  }
}

TEST(Gltf, BuffersOutsideOfTheFolderAreNotRead) {
  const TemporaryFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  std::filesystem::create_directories(folder / "inside");
  GltfDraft draft = small_gltf();
  const auto write = [&](const std::string& uri) {
    draft.json["buffers"] = {{{"byteLength", draft.binary.size()}, {"uri", uri}}};
    std::ofstream(folder / "inside" / "toy.gltf", std::ios::binary) << draft.json.dump();
    return read_gltf(folder / "inside" / "toy.gltf");
  };
  std::ofstream(folder / "outside.bin", std::ios::binary) << draft.binary;
  std::ofstream(folder / "inside" / "toy.bin", std::ios::binary) << draft.binary;
  const auto inside = write("toy.bin");
  EXPECT_TRUE(inside) << to_string(inside.error());
  EXPECT_FALSE(write("../outside.bin"));
  EXPECT_FALSE(write("%2e%2e/outside.bin"));
  EXPECT_FALSE(write((folder / "outside.bin").string()));
  EXPECT_FALSE(write("missing.bin"));
}

TEST(Gltf, BuffersTogetherAreBounded) {
  const TemporaryFolder scratch;
  std::ofstream(scratch.path() / "zeros.bin").close();
  std::filesystem::resize_file(scratch.path() / "zeros.bin", kLargestInput / 4);  // sparse
  GltfDraft draft = small_gltf();
  for (int i = 0; i < 5; ++i) {
    draft.json["buffers"].push_back({{"byteLength", kLargestInput / 4}, {"uri", "zeros.bin"}});
  }
  std::ofstream(scratch.path() / "toy.gltf", std::ios::binary) << draft.json.dump();
  const auto read = read_gltf(scratch.path() / "toy.gltf");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().place, "/buffers/4");
  EXPECT_THAT(read.error().what, HasSubstr("more than 256 MiB"));
}

}  // namespace
}  // namespace ringcraft
