#include "capture/character.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "capture/mocap.h"
#include "capture/small_files.h"
#include "motion/pose.h"

namespace ringcraft {
namespace {

const char* const kProfiles = RINGCRAFT_SOURCE_DIR "/assets/profiles";

Result<Character> parse(const std::string& bytes) {
  return parse_character(bytes, "hero.glb", kProfiles);
}

// A character of VRM's bone names, 0.9 times our size, whose arms hang 40 degrees below the
// horizontal: on every bone one triangle, its first corner at the joint, its second half way to the
// next bone.
struct Hero {
  testing::GltfDraft draft;
  std::array<Vec3, kJointCount> joint{};

  Hero() {
    Skeleton skeleton = canonical_skeleton(0.9f * kCanonicalHeight);
    Pose pose = rest_pose(skeleton);
    pose.rotation[index(Joint::left_upper_arm)] = glm::angleAxis(radians(-40), kForward);
    pose.rotation[index(Joint::right_upper_arm)] = glm::angleAxis(radians(40), kForward);
    joint = world_pose(skeleton, pose).position;
    std::vector<float> inverse, positions, joints, weights, uv, indices;
    nlohmann::json nodes = nlohmann::json::array(), listed = nlohmann::json::array();
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const Vec3 from = i == 0 ? Vec3{} : joint.at(static_cast<std::size_t>(kParent.at(i)));
      const Vec3 at = joint.at(i) - from;
      nodes.push_back({{"name", vrm_name(joint_at(i))}, {"translation", {at.x, at.y, at.z}}});
      if (i > 0) nodes[static_cast<std::size_t>(kParent.at(i))]["children"].push_back(i);
      listed.push_back(i);
      for (int cell = 0; cell < 12; ++cell) inverse.push_back(cell % 5 == 0 ? 1.0f : 0.0f);
      inverse.insert(inverse.end(), {-joint.at(i).x, -joint.at(i).y, -joint.at(i).z, 1});
      Vec3 next = joint.at(i) + Vec3(0, 0.02f, 0);
      for (std::size_t child = i + 1; child < kJointCount; ++child)
        if (kParent.at(child) == static_cast<int>(i)) next = joint.at(child);
      for (const Vec3& corner :
           {joint.at(i), 0.5f * (joint.at(i) + next), joint.at(i) + Vec3(0, 0, 0.03f)}) {
        indices.push_back(static_cast<float>(indices.size()));
        positions.insert(positions.end(), {corner.x, corner.y, corner.z});
        joints.insert(joints.end(), {static_cast<float>(i), 0, 0, 0});
        weights.insert(weights.end(), {1, 0, 0, 0});
        uv.insert(uv.end(), {0.25f, 0.75f});
      }
    }
    nodes.push_back({{"name", "body"}, {"mesh", 0}, {"skin", 0}});
    nodes.push_back({{"name", "sword"}, {"mesh", 0}});
    nodes[index(Joint::right_hand)]["children"].push_back(kJointCount + 1);
    draft.json["nodes"] = nodes;
    draft.json["skins"] = {
        {{"joints", listed}, {"inverseBindMatrices", draft.add(inverse, "MAT4", 16)}}};
    draft.json["meshes"] = {{{"primitives",
                              {{{"attributes",
                                 {{"POSITION", draft.add(positions, "VEC3", 3)},
                                  {"TEXCOORD_0", draft.add(uv, "VEC2", 2)},
                                  {"JOINTS_0", draft.add(joints, "VEC4", 4)},
                                  {"WEIGHTS_0", draft.add(weights, "VEC4", 4)}}},
                                {"indices", draft.add(indices, "SCALAR", 1)},
                                {"material", 0}}}}}};
    draft.json["materials"] = {
        {{"name", "cloth"},
         {"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
    draft.json["textures"] = {{{"source", 0}}};
    draft.json["images"] = {{{"mimeType", "image/png"}, {"bufferView", add_bytes("picture!")}}};
  }

  std::size_t add_bytes(const std::string& bytes) {
    draft.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", draft.binary.size()}, {"byteLength", bytes.size()}});
    draft.binary += bytes;
    return draft.json["bufferViews"].size() - 1;
  }
};

TEST(Character, IsReadWithItsBonesMaterialsAndPictures) {
  Hero hero;
  const auto character = parse(hero.draft.glb());
  ASSERT_TRUE(character) << to_string(character.error());
  ASSERT_EQ(character->pieces.size(), 1u);
  EXPECT_EQ(character->pieces[0].position.size(), 3 * kJointCount);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    ASSERT_TRUE(character->joint.at(j)) << vrm_name(joint_at(j));
    EXPECT_LT(glm::distance(*character->joint.at(j), hero.joint.at(j)), 1e-4f);
    EXPECT_EQ(character->pieces[0].weights[3 * j].joint[0], joint_at(j));
  }
  EXPECT_EQ(character->materials[0].name, "cloth");
  EXPECT_TRUE(character->materials[0].double_sided);
  ASSERT_TRUE(character->materials[0].image);
  EXPECT_EQ(character->images.at(*character->materials[0].image).bytes, "picture!");
  EXPECT_THAT(character->notes, ::testing::Contains(::testing::HasSubstr("sword hangs on a bone")));
}

// What is shown is what is hit: joints and bones of the character come to lie in those of the body.
TEST(Character, ConformsToTheBodysTPose) {
  const auto character = parse(Hero().draft.glb());
  ASSERT_TRUE(character);
  const Skeleton skeleton = canonical_skeleton(1.9f);
  const WorldPose rest = world_pose(skeleton, rest_pose(skeleton));
  const auto pieces = conformed(*character, skeleton);
  for (std::size_t j = 0; j < kJointCount; ++j)
    EXPECT_LT(glm::distance(pieces[0].position[3 * j], rest.position[j]), 1e-4f)
        << vrm_name(joint_at(j));
  for (const Joint joint : {Joint::left_upper_arm, Joint::right_lower_arm, Joint::left_upper_leg,
                            Joint::right_lower_leg, Joint::spine}) {
    const std::size_t j = index(joint);
    std::size_t child = j + 1;
    while (kParent.at(child) != static_cast<int>(j)) ++child;
    const Vec3 middle = 0.5f * (rest.position[j] + rest.position[child]);
    EXPECT_LT(glm::distance(pieces[0].position[3 * j + 1], middle), 1e-3f) << vrm_name(joint);
  }
  for (const Vec3& normal : pieces[0].normal) EXPECT_NEAR(glm::length(normal), 1, 1e-4f);
}

TEST(Character, WithoutAKnownHeadGoesByTheRestOfItsSpine) {
  Hero hero;
  hero.draft.json["nodes"][index(Joint::head)]["name"] = "skull";
  const auto character = parse(hero.draft.glb()), whole = parse(Hero().draft.glb());
  ASSERT_TRUE(character) << to_string(character.error());
  ASSERT_FALSE(character->joint[index(Joint::head)]);
  const auto pieces = conformed(*character, canonical_skeleton(1.9f));
  const auto usual = conformed(*whole, canonical_skeleton(1.9f));
  for (std::size_t v = 0; v < pieces[0].position.size(); ++v)
    EXPECT_LT(glm::distance(pieces[0].position[v], usual[0].position[v]), 1e-3f);
}

TEST(Character, FaultsNameThePlaceAndTheRemedy) {
  const auto fault_of = [](const auto& change) {
    Hero hero;
    change(hero.draft.json);
    const auto character = parse(hero.draft.glb());
    return character ? std::string("no fault") : to_string(character.error());
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(fault_of([](auto& j) { j["nodes"][kJointCount].erase("skin"); }),
              HasSubstr("no skinned mesh"));
  EXPECT_THAT(fault_of([](auto& j) { j["nodes"][kJointCount]["skin"] = 7; }),
              HasSubstr("there is no skin 7"));
  EXPECT_THAT(fault_of([](auto& j) { j["meshes"][0]["primitives"][0]["indices"] = 99; }),
              HasSubstr("there is no accessor 99"));
  EXPECT_THAT(fault_of([](auto& j) { j["accessors"][1]["count"] = 1000000; }),
              HasSubstr("run beyond its view"));
  EXPECT_THAT(fault_of([](auto& j) {
                j["images"][0] = {{"uri", "beside.png"}};
              }),
              HasSubstr("export it as one .glb"));
  EXPECT_THAT(fault_of([](auto& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
              HasSubstr("needs 'KHR_draco_mesh_compression'; export it without compression"));
  EXPECT_THAT(fault_of([](auto& j) { j["nodes"][0]["name"] = "Bip01"; }),
              AllOf(HasSubstr("no skeleton profile knows"),
                    Not(HasSubstr("profile = "))));  // no key of a scene
}

TEST(Character, CornersBelowZeroDoNotExist) {
  Hero hero;
  const int corners = hero.draft.add({0, 1, -1}, "SCALAR", 1);
  hero.draft.json["meshes"][0]["primitives"][0]["indices"] = corners;
  const auto character = parse(hero.draft.glb());
  ASSERT_FALSE(character);
  EXPECT_EQ(to_string(character.error()),
            "hero.glb: /meshes/0/primitives/0: a corner that does not exist; export the character "
            "again");
}

TEST(Character, ASmallFileCannotAskForMuch) {
  const auto fault_of = [](const auto& change) {
    Hero hero;
    change(hero);
    const auto character = parse(hero.draft.glb());
    return character ? std::string("no fault") : to_string(character.error());
  };
  using ::testing::HasSubstr;
  // 200 surfaces of the same 300,000 corners.
  EXPECT_THAT(fault_of([](Hero& hero) {
                const int corners = hero.draft.add(std::vector<float>(300'000, 0), "SCALAR", 1);
                nlohmann::json& all = hero.draft.json["meshes"][0]["primitives"];
                nlohmann::json surface = all[0];
                surface["indices"] = corners;
                all = std::vector<nlohmann::json>(200, surface);
              }),
              HasSubstr("reduce the character's mesh"));
  EXPECT_THAT(fault_of([](Hero& hero) {
                nlohmann::json& all = hero.draft.json["meshes"][0]["primitives"];
                all = std::vector<nlohmann::json>(200, all[0]);
                nlohmann::json& skin = hero.draft.json["skins"][0];
                skin.erase("inverseBindMatrices");
                for (int i = 0; i < 100'000; ++i) skin["joints"].push_back(0);
              }),
              HasSubstr("reduce the character's mesh"));
  EXPECT_THAT(fault_of([](Hero& hero) {
                const std::size_t picture = hero.add_bytes(std::string(2'000'000, '.'));
                hero.draft.json["images"] = std::vector<nlohmann::json>(
                    200, {{"mimeType", "image/png"}, {"bufferView", picture}});
              }),
              HasSubstr("/images/134: up to it the pictures have 270000000 bytes"));
}

TEST(Character, OfAnEmptyOrCutFileTheFaultNamesTheByte) {
  const auto fault_of = [](const std::string& bytes) {
    const auto character = parse(bytes);
    return character ? std::string("no fault") : to_string(character.error());
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(fault_of(""), HasSubstr("hero.glb: byte 0 of its JSON: it ends there; the file is "
                                      "empty or cut off"));
  EXPECT_THAT(fault_of("{\"asset\": "), HasSubstr("byte 10 of its JSON: it ends there"));
  EXPECT_THAT(fault_of("no glTF"), HasSubstr("of its JSON: what stands there is no JSON"));
}

TEST(Character, DamagedFilesGiveACharacterOrOneError) {
  const std::string good = Hero().draft.glb();
  Random random(11);
  int whole = 0;
  constexpr int kRounds = 60;  // each reads the profiles anew
  for (int round = 0; round < kRounds; ++round) {
    std::string bytes = good;
    for (int i = 0; i < 1 + round % 3; ++i) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<float>(bytes.size()));
      bytes[std::min(at, bytes.size() - 1)] =
          static_cast<char>(static_cast<int>(random.uniform() * 256));
    }
    const auto character = parse(bytes);
    if (!character) {
      EXPECT_FALSE(character.error().what.empty());
      continue;
    }
    ++whole;
    for (const CharacterPiece& piece : conformed(*character, canonical_skeleton()))
      for (const std::uint32_t corner : piece.triangles) ASSERT_LT(corner, piece.position.size());
  }
  EXPECT_GT(whole, 0);
  EXPECT_LT(whole, kRounds);
}

TEST(Character, RealOnesStandAsTallAsTheBodyOnItsFloor) {
  const std::filesystem::path folder = testing::mocap_folder() / "characters";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no captures in " << folder;
  int read = 0;
  for (const char* file : {"Knight.glb", "Character.glb"}) {
    if (!std::filesystem::exists(folder / file)) continue;
    const auto character = read_character(folder / file);
    ASSERT_TRUE(character) << to_string(character.error());
    ++read;
    const Skeleton skeleton = canonical_skeleton();
    float low = 10, high = -10;
    for (const CharacterPiece& piece : conformed(*character, skeleton))
      for (const Vec3& at : piece.position) {
        low = std::min(low, at.y);
        high = std::max(high, at.y);
      }
    EXPECT_NEAR(low, 0, 0.12f) << file;
    EXPECT_GT(high, 0.9f * skeleton.height) << file;
    EXPECT_LT(high, 1.4f * skeleton.height) << file;  // the knight has a big head
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace ringcraft
