#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <set>

#include "io/outputs.h"
#include "io/sample_fight.h"

namespace ringcraft {
namespace {

// The sample fight, written and read back by the library's own reader.
class Glb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    bytes() = fight_glb(sample::timeline(), sample::looks());
    tinygltf::TinyGLTF reader;
    std::string warnings, errors;
    const bool good = reader.LoadBinaryFromMemory(
        &model(), &errors, &warnings, reinterpret_cast<const unsigned char*>(bytes().data()),
        static_cast<unsigned int>(bytes().size()));
    ASSERT_TRUE(good) << errors;
    ASSERT_TRUE(warnings.empty()) << warnings;
  }
  static std::string& bytes() {
    static std::string kBytes;
    return kBytes;
  }
  static tinygltf::Model& model() {
    static tinygltf::Model kModel;
    return kModel;
  }
  template <class Element>
  static std::vector<Element> data(int accessor_index) {
    const tinygltf::Accessor& accessor = model().accessors.at(accessor_index);
    const tinygltf::BufferView& view = model().bufferViews.at(accessor.bufferView);
    EXPECT_EQ(view.byteLength, accessor.count * sizeof(Element));
    std::vector<Element> elements(accessor.count);
    std::memcpy(elements.data(), model().buffers[0].data.data() + view.byteOffset, view.byteLength);
    return elements;
  }
  static int node(const std::string& name) {
    for (std::size_t i = 0; i < model().nodes.size(); ++i) {
      if (model().nodes[i].name == name) return static_cast<int>(i);
    }
    return -1;
  }
};

TEST_F(Glb, RootsAreTheFightersAndTheirMeshes) {
  const std::vector<int>& roots = model().scenes.at(0).nodes;
  EXPECT_EQ(roots.size(), 4u);
  for (const char* name : {"fighter0", "fighter0_mesh", "fighter1", "fighter1_mesh"}) {
    ASSERT_GE(node(name), 0) << name;
    EXPECT_NE(std::find(roots.begin(), roots.end(), node(name)), roots.end()) << name;
  }
  EXPECT_GE(model().nodes[node("fighter1_mesh")].skin, 0);
}

TEST_F(Glb, JointsBearTheCanonicalNamesAndHangTogetherAsTheSkeleton) {
  ASSERT_EQ(model().skins.size(), 2u);
  for (const tinygltf::Skin& skin : model().skins) {
    ASSERT_EQ(skin.joints.size(), kJointCount);
    for (std::size_t i = 0; i < kJointCount; ++i) {
      EXPECT_EQ(model().nodes[skin.joints[i]].name, vrm_name(joint_at(i)));
      if (kParent[i] < 0) continue;
      const auto& siblings =
          model().nodes[skin.joints[static_cast<std::size_t>(kParent[i])]].children;
      EXPECT_NE(std::find(siblings.begin(), siblings.end(), skin.joints[i]), siblings.end());
    }
    EXPECT_EQ(model().nodes[skin.skeleton].children, std::vector<int>{skin.joints[0]});
  }
}

TEST_F(Glb, InverseBindMatricesUndoTheRestPose) {
  const std::vector<FighterLook> looks = sample::looks();
  for (std::size_t f = 0; f < 2; ++f) {
    const auto matrices = data<std::array<float, 16>>(model().skins[f].inverseBindMatrices);
    const Skeleton& skeleton = looks[f].body.skeleton;
    const WorldPose rest = world_pose(skeleton, rest_pose(skeleton));
    for (std::size_t i = 0; i < kJointCount; ++i) {
      EXPECT_FLOAT_EQ(matrices[i][12], -rest.position[i].x);
      EXPECT_FLOAT_EQ(matrices[i][13], -rest.position[i].y);
      EXPECT_FLOAT_EQ(matrices[i][14], -rest.position[i].z);
    }
  }
}

TEST_F(Glb, WeightsSumToOneAndIndicesStayWithin) {
  int primitives = 0;
  for (const tinygltf::Mesh& mesh : model().meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      ++primitives;
      const auto weights = data<std::array<std::uint16_t, 4>>(primitive.attributes.at("WEIGHTS_0"));
      const auto joints = data<std::array<std::uint8_t, 4>>(primitive.attributes.at("JOINTS_0"));
      const auto positions = data<std::array<float, 3>>(primitive.attributes.at("POSITION"));
      ASSERT_EQ(weights.size(), positions.size());
      for (std::size_t i = 0; i < weights.size(); ++i) {
        ASSERT_EQ(weights[i][0] + weights[i][1] + weights[i][2] + weights[i][3], 65535);
        for (std::size_t k = 0; k < 4; ++k) {
          ASSERT_LT(joints[i][k], kJointCount);
          if (weights[i][k] == 0) {
            ASSERT_EQ(joints[i][k], 0);
          }
        }
      }
      for (const std::uint16_t v : data<std::uint16_t>(primitive.indices)) {
        ASSERT_LT(v, positions.size());
      }
      EXPECT_GE(primitive.material, 0);
    }
  }
  EXPECT_GE(primitives, 12);
}

TEST_F(Glb, VertexDataNamesItsTargetAndBounds) {
  for (const tinygltf::Mesh& mesh : model().meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      for (const auto& [name, accessor] : primitive.attributes) {
        EXPECT_EQ(model().bufferViews[model().accessors[accessor].bufferView].target,
                  TINYGLTF_TARGET_ARRAY_BUFFER)
            << name;
      }
      EXPECT_EQ(model().bufferViews[model().accessors[primitive.indices].bufferView].target,
                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      EXPECT_EQ(model().accessors[primitive.attributes.at("POSITION")].minValues.size(), 3u);
    }
  }
}

TEST_F(Glb, OneAnimationHoldsAllChannelsAt60HzWithStrictlyIncreasingTimes) {
  ASSERT_EQ(model().animations.size(), 1u);
  const tinygltf::Animation& animation = model().animations[0];
  EXPECT_EQ(animation.channels.size(), 2 * (kJointCount + 1));
  std::set<int> inputs;
  for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
    EXPECT_EQ(sampler.interpolation, "LINEAR");
    EXPECT_EQ(model().accessors[sampler.input].count, model().accessors[sampler.output].count);
    inputs.insert(sampler.input);
  }
  EXPECT_LE(inputs.size(), 2u);  // shared: all keys, or one
  const std::size_t frames = sample::timeline().tracks[0].frames.size();
  std::size_t longest = 0;
  for (const int input : inputs) {
    const auto times = data<float>(input);
    longest = std::max(longest, times.size());
    EXPECT_FLOAT_EQ(times.front(), 0);
    EXPECT_FLOAT_EQ(static_cast<float>(model().accessors[input].minValues.at(0)), times.front());
    EXPECT_FLOAT_EQ(static_cast<float>(model().accessors[input].maxValues.at(0)), times.back());
    for (std::size_t i = 1; i < times.size(); ++i) {
      ASSERT_GT(times[i], times[i - 1]);
      ASSERT_NEAR(times[i], static_cast<double>(i) / 60.0, 1e-5);
    }
  }
  EXPECT_EQ(longest, (frames + 1) / 2);
}

TEST_F(Glb, RotationsAreUnitInOneHemisphereAndOnlyHipsTranslate) {
  const tinygltf::Animation& animation = model().animations[0];
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const int output = animation.samplers[channel.sampler].output;
    if (channel.target_path == "translation") {
      EXPECT_EQ(model().nodes[channel.target_node].name, "hips");
      continue;
    }
    ASSERT_EQ(channel.target_path, "rotation");
    const auto keys = data<std::array<float, 4>>(output);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      double length = 0, dot = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        length += static_cast<double>(keys[i][c]) * keys[i][c];
        dot += i == 0 ? 1 : static_cast<double>(keys[i][c]) * keys[i - 1][c];
      }
      ASSERT_NEAR(length, 1.0, 1e-6);
      ASSERT_GT(dot, 0);
    }
  }
}

TEST_F(Glb, KeysAreTheShownPoses) {
  const Timeline timeline = sample::timeline();
  const tinygltf::Animation& animation = model().animations[0];
  for (std::size_t f = 0; f < 2; ++f) {
    const int hips = model().skins[f].joints[0];
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node != hips || channel.target_path != "translation") continue;
      const auto places = data<std::array<float, 3>>(animation.samplers[channel.sampler].output);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Vec3 shown = timeline.tracks[f].frames[2 * k].hips;
        ASSERT_EQ(places[k], (std::array<float, 3>{shown.x, shown.y, shown.z}));
      }
    }
  }
}

TEST_F(Glb, ConstantTracksHaveOneKey) {
  // Nothing in the sample's clips moves the toes.
  const tinygltf::Animation& animation = model().animations[0];
  const int toes = model().skins[0].joints[index(Joint::left_toes)];
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (channel.target_node != toes) continue;
    EXPECT_EQ(model().accessors[animation.samplers[channel.sampler].output].count, 1u);
  }
}

TEST_F(Glb, ExtrasHoldTheEventsAndTheCapsules) {
  const tinygltf::Value& extras = model().animations[0].extras;
  ASSERT_TRUE(extras.Has("events"));
  EXPECT_EQ(extras.Get("events").ArrayLen(), sample::events().size());
  EXPECT_EQ(extras.Get("events").Get(2).Get("part").Get<std::string>(), "head");
  const tinygltf::Value& fighter = model().nodes[node("fighter0")].extras;
  EXPECT_EQ(fighter.Get("capsules").ArrayLen(), kPartCount);
  EXPECT_EQ(fighter.Get("name").Get<std::string>(), "Ana \"the Anvil\"");
}

TEST_F(Glb, IsTheSameBytesTwice) {
  EXPECT_TRUE(fight_glb(sample::timeline(), sample::looks()) == bytes());
}

TEST_F(Glb, ARingIsANodeOfItsOwn) {
  const std::string with_ring = fight_glb(sample::timeline(), sample::looks(), {3.0f});
  tinygltf::Model ring;
  tinygltf::TinyGLTF reader;
  std::string warnings, errors;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&ring, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(with_ring.data()),
                                          static_cast<unsigned int>(with_ring.size())));
  EXPECT_EQ(ring.scenes[0].nodes.size(), 5u);
  EXPECT_EQ(ring.nodes[ring.scenes[0].nodes.back()].name, "ring");
}

TEST(GlbOfThree, HoldsThreeFighters) {
  Timeline timeline = sample::timeline();
  timeline.tracks.push_back(timeline.tracks[0]);
  std::vector<FighterLook> looks = sample::looks();
  looks.push_back(looks[0]);
  looks[2].name = "\xff broken name";
  const std::string bytes = fight_glb(timeline, looks);
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string warnings, errors;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned int>(bytes.size())));
  EXPECT_EQ(model.skins.size(), 3u);
}

TEST(GlbOfNothing, IsStillAReadableFile) {
  const std::string bytes = fight_glb({}, sample::looks());
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string warnings, errors;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned int>(bytes.size())));
  EXPECT_EQ(model.animations.size(), 0u);
}

// The root's key times the hips' key is where the hips are without root motion.
TEST(GlbRootMotion, MovesTheFightersNodeAndLeavesTheBodyWhereItIs) {
  GlbSettings settings;
  settings.root_motion = true;
  tinygltf::Model model;
  std::string warnings, errors;
  const std::string bytes = fight_glb(sample::timeline(), sample::looks(), settings);
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &errors, &warnings, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned int>(bytes.size())));
  const auto keys = [&](const std::string& node, const std::string& path) {
    std::vector<float> values;
    for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
      if (model.nodes[channel.target_node].name != node || channel.target_path != path) continue;
      const auto& accessor = model.accessors[model.animations[0].samplers[channel.sampler].output];
      const auto& view = model.bufferViews[accessor.bufferView];
      values.resize(view.byteLength / sizeof(float));
      std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
      break;  // fighter 0 comes first
    }
    return values;
  };
  const Timeline timeline = sample::timeline();
  const FighterTrack& track = timeline.tracks[0];
  const std::vector<float> places = keys("fighter0", "translation");
  const std::vector<float> turns = keys("fighter0", "rotation");
  const std::vector<float> hips = keys("hips", "translation");
  ASSERT_EQ(places.size(), hips.size());
  ASSERT_EQ(turns.size() / 4, places.size() / 3);
  float travelled = 0;
  for (std::size_t k = 0; k < places.size() / 3; ++k) {
    const Quat turn(turns[4 * k + 3], turns[4 * k], turns[4 * k + 1], turns[4 * k + 2]);
    const Vec3 at = Vec3(places[3 * k], places[3 * k + 1], places[3 * k + 2]) +
                    turn * Vec3(hips[3 * k], hips[3 * k + 1], hips[3 * k + 2]);
    const Vec3 shown = track.frames[std::min(2 * k, track.frames.size() - 1)].hips;
    EXPECT_LT(glm::distance(at, shown), 1e-4f) << k;
    travelled = std::max(travelled, glm::length(Vec3(places[3 * k], 0, places[3 * k + 2])));
  }
  EXPECT_GT(travelled, 0.01f);
}

TEST(GlbCharacter, StandsInPlaceOfTheMannequinOnTheCanonicalBones) {
  auto character = std::make_shared<Character>();
  const Skeleton skeleton = canonical_skeleton();
  const WorldPose rest = world_pose(skeleton, rest_pose(skeleton));
  CharacterPiece piece;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    character->joint.at(j) = rest.position[j];
    for (int corner = 0; corner < 3; ++corner) {
      piece.position.push_back(rest.position[j] + Vec3(0, 0, 0.01f * static_cast<float>(corner)));
      piece.normal.push_back(kForward);
      piece.uv.emplace_back(0.5f, 0.5f);
      piece.triangles.push_back(static_cast<std::uint32_t>(piece.triangles.size()));
      piece.weights.push_back({{joint_at(j)}, {1, 0, 0, 0}});
    }
  }
  character->pieces = {piece};
  CharacterMaterial cloth;
  cloth.name = "cloth";
  cloth.image = 0;
  character->materials = {cloth};
  character->images = {{"image/png", "bytes of a picture"}};
  std::vector<FighterLook> looks = sample::looks();
  looks[0].character = character;
  tinygltf::Model model;
  std::string warnings, errors;
  tinygltf::TinyGLTF reader;
  std::string picture;
  reader.SetImageLoader(
      [](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char* bytes,
         int size, void* out) {
        static_cast<std::string*>(out)->assign(reinterpret_cast<const char*>(bytes),
                                               static_cast<std::size_t>(size));
        return true;
      },
      &picture);
  const std::string bytes = fight_glb(sample::timeline(), looks);
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned int>(bytes.size())))
      << errors;
  EXPECT_EQ(picture, "bytes of a picture");
  ASSERT_EQ(model.meshes.at(0).primitives.size(), 1u);
  const tinygltf::Primitive& shown = model.meshes[0].primitives[0];
  EXPECT_EQ(model.accessors.at(shown.attributes.at("POSITION")).count, 3 * kJointCount);
  EXPECT_EQ(model.materials.at(shown.material).name, "fighter0_cloth");
  EXPECT_EQ(model.skins.at(0).joints.size(), kJointCount);
  EXPECT_EQ(model.nodes.at(model.skins[0].joints[0]).name, "hips");
  EXPECT_GT(model.meshes.at(1).primitives.size(), 1u);  // the other is a mannequin still
}

}  // namespace
}  // namespace ringcraft
