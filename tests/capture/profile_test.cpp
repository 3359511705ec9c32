#include "capture/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.h"

namespace ringcraft {
namespace {

// A skeleton of one joint chain per limb, as its names and parents say.
RawClip skeleton_of(const std::vector<std::tuple<std::string, std::string, Vec3>>& joints) {
  RawClip clip;
  clip.file = "test.bvh";
  for (const auto& [name, parent, offset] : joints)
    clip.joints.push_back({name, parent.empty() ? -1 : clip.find(parent), offset, {}});
  return clip;
}

RawClip motion_builder(const std::string& prefix, bool third_spine) {
  std::vector<std::tuple<std::string, std::string, Vec3>> joints = {
      {"Hips", "", {0, 90, 0}},        {"Spine", "Hips", {0, 10, 0}},
      {"Spine1", "Spine", {0, 12, 0}}, {"Spine2", "Spine1", {0, 12, 0}},
      {"Neck", "Spine2", {0, 15, 0}},  {"Head", "Neck", {0, 8, 0}}};
  if (!third_spine) {
    joints.erase(joints.begin() + 3);
    std::get<1>(joints[3]) = "Spine1";
  }
  const std::string chest = third_spine ? "Spine2" : "Spine1";
  for (const auto& [side, x] : {std::pair<std::string, float>{"Left", 1.0f}, {"Right", -1.0f}}) {
    joints.push_back({side + "Shoulder", chest, {3 * x, 10, 0}});
    joints.push_back({side + "Arm", side + "Shoulder", {12 * x, 0, 0}});
    joints.push_back({side + "ForeArm", side + "Arm", {28 * x, 0, 0}});
    joints.push_back({side + "Hand", side + "ForeArm", {26 * x, 0, 0}});
    joints.push_back({side + "UpLeg", "Hips", {9 * x, 0, 0}});
    joints.push_back({side + "Leg", side + "UpLeg", {0, -42, 0}});
    joints.push_back({side + "Foot", side + "Leg", {0, -41, 0}});
    joints.push_back({side + "ToeBase", side + "Foot", {0, -6, 14}});
  }
  for (auto& [name, parent, offset] : joints) {
    name = prefix + name;
    if (!parent.empty()) parent = prefix + parent;
  }
  return skeleton_of(joints);
}

std::vector<SkeletonProfile> profiles() {
  auto read = read_profiles(assets_folder() / "profiles");
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : std::vector<SkeletonProfile>{};
}

TEST(Profile, TheOneThatKnowsAllJointsWins) {
  const auto known = profiles();
  EXPECT_EQ(best_profile(known, motion_builder("mixamorig:", true))->name, "mixamo");
  EXPECT_EQ(best_profile(known, motion_builder("Character1_", false))->name, "mass");
  EXPECT_EQ(best_profile(known, motion_builder("", true))->name, "mixamo");
}

TEST(Profile, ScoreIsTheShareOfJointsFound) {
  RawClip clip = motion_builder("mixamorig:", true);
  for (const SkeletonProfile& profile : profiles()) {
    if (profile.name != "mixamo") continue;
    EXPECT_FLOAT_EQ(score(profile, clip), 1.0f);
    clip.joints[static_cast<std::size_t>(clip.find("mixamorig:Spine2"))].name = "mixamorig:Other";
    EXPECT_FLOAT_EQ(score(profile, clip), 21.0f / 22.0f);
    clip.joints[static_cast<std::size_t>(clip.find("mixamorig:LeftLeg"))].name = "mixamorig:Shin";
    EXPECT_FLOAT_EQ(score(profile, clip), 0.0f);  // without a knee it is no body
  }
}

TEST(Profile, AJointUnderTheWrongCarrierDoesNotCount) {
  RawClip clip = motion_builder("mixamorig:", true);
  clip.joints[static_cast<std::size_t>(clip.find("mixamorig:LeftForeArm"))].parent =
      clip.find("mixamorig:RightArm");
  EXPECT_FALSE(best_profile(profiles(), clip));
}

TEST(Profile, UnknownNamesAreAnErrorThatNamesTheFirst) {
  RawClip clip = skeleton_of({{"Bip01", "", {0, 1, 0}}});
  const auto best = best_profile(profiles(), clip);
  ASSERT_FALSE(best);
  EXPECT_EQ(best.error().place, "joint Bip01");
  EXPECT_FALSE(best.error().remedy.empty());
}

TEST(Profile, TheUnitIsTheOneThatGivesHumanLegs) {
  RawClip clip = motion_builder("mixamorig:", true);
  const auto best = best_profile(profiles(), clip);
  EXPECT_FLOAT_EQ(map_joints(*best, clip)->metres_per_unit, 0.01f);
  for (RawJoint& joint : clip.joints) joint.offset *= 0.01f;
  EXPECT_FLOAT_EQ(map_joints(*best, clip)->metres_per_unit, 1.0f);
  for (RawJoint& joint : clip.joints) joint.offset *= 1e-4f;
  EXPECT_FALSE(map_joints(*best, clip));
}

TEST(Profile, AxesTurnTheFilesForwardToOurs) {
  for (const SkeletonProfile& profile : profiles()) {
    if (profile.name != "deepmimic") continue;
    std::vector<std::tuple<std::string, std::string, Vec3>> joints = {
        {"root", "", {0, 0.8f, 0}},
        {"chest", "root", {0, 0.24f, 0}},
        {"neck", "chest", {0, 0.22f, 0}}};
    for (const auto& [side, z] : {std::pair<std::string, float>{"left", -1.0f}, {"right", 1.0f}}) {
      joints.push_back({side + "_shoulder", "chest", {0, 0.2f, 0.18f * z}});
      joints.push_back({side + "_elbow", side + "_shoulder", {0, -0.27f, 0}});
      joints.push_back({side + "_wrist", side + "_elbow", {0, -0.26f, 0}});
      joints.push_back({side + "_hip", "root", {0, 0, 0.085f * z}});
      joints.push_back({side + "_knee", side + "_hip", {0, -0.42f, 0}});
      joints.push_back({side + "_ankle", side + "_knee", {0, -0.41f, 0}});
    }
    RawClip clip = skeleton_of(joints);
    const auto map = map_joints(profile, clip);
    ASSERT_TRUE(map) << to_string(map.error());
    EXPECT_LT(glm::distance(map->axes * Vec3(1, 0, 0), kForward), 1e-5f);
    EXPECT_LT(glm::distance(map->axes * Vec3(0, 0, -1), kLeft), 1e-5f);
    SkeletonProfile wrong = profile;
    wrong.forward = -profile.forward;
    EXPECT_FALSE(map_joints(wrong, clip));  // left would be right
  }
}

}  // namespace
}  // namespace ringcraft
