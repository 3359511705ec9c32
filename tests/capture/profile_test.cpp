#include "capture/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"

namespace ringcraft {
namespace {

// A skeleton of one joint chain per limb, as its names and parents say.
RawClip skeleton_of(const std::vector<std::tuple<std::string, std::string, Vec3>>& joints) {
  RawClip clip;
  clip.file = "test.bvh";
  for (const auto& [name, parent, offset] : joints)
    clip.joints.push_back({name, parent.empty() ? -1 : clip.find(parent), offset});
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

// The same body under other names, its axes and unit turned to those of the file.
RawClip renamed(const std::vector<std::pair<std::string, std::string>>& names, const Quat& axes,
                float unit) {
  RawClip clip = motion_builder("", true);
  for (RawJoint& joint : clip.joints) {
    joint.offset = axes * joint.offset * unit;
    for (const auto& [from, to] : names)
      if (joint.name == from) {
        joint.name = to;
        break;
      }
  }
  return clip;
}

std::vector<std::pair<std::string, std::string>> names_of(const SkeletonProfile& profile) {
  std::vector<std::pair<std::string, std::string>> names;
  const auto known = profiles();
  const auto mixamo = std::find_if(known.begin(), known.end(),
                                   [](const auto& one) { return one.name == "mixamo"; });
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (!profile.source[j].empty()) names.emplace_back(mixamo->source[j], profile.source[j]);
  return names;
}

// Without toes LaFAN1's and Mixamo's joints are the same.
TEST(Profile, AmongEqualsTheOneWhosePrefixTheNamesHaveWins) {
  const auto without_toes = [](const std::string& prefix) {
    RawClip clip = motion_builder(prefix, true);
    for (RawJoint& joint : clip.joints)
      if (joint.name.ends_with("ToeBase")) joint.name = "tip";
    return clip;
  };
  const auto known = profiles();
  EXPECT_EQ(best_profile(known, without_toes("mixamorig:"))->name, "mixamo");
  EXPECT_EQ(best_profile(known, without_toes("Someone:"))->name, "lafan1");
}

TEST(Profile, AxesAndUnitsDecideBetweenProfilesOfTheSameNames) {
  const auto known = profiles();
  const Quat same(1, 0, 0, 0);
  const Quat turned = yaw_rotation(kPi);                 // looks along -Z
  const Quat z_up = glm::angleAxis(radians(90), kLeft);  // y to z, z to -y
  const std::tuple<std::string, Quat, float> bodies[] = {
      {"vrm", same, 0.01f},     {"vrm0", turned, 0.01f},     {"unreal", same, 0.01f},
      {"unreal", same, 1.0f},   {"unreal_z_up", z_up, 1.0f}, {"unreal5", same, 0.01f},
      {"kaykit", same, 0.005f},
  };
  for (const auto& [name, axes, unit] : bodies) {
    const auto own =
        std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.name == name; });
    ASSERT_NE(own, known.end()) << name;
    const RawClip clip = renamed(names_of(*own), axes, unit);
    const auto best = best_profile(known, clip);
    ASSERT_TRUE(best) << name << ": " << to_string(best.error());
    EXPECT_EQ(best->name, name);
    const auto map = map_joints(*best, clip);
    ASSERT_TRUE(map) << to_string(map.error());
    const Vec3 toes =
        map->axes *
        clip.joints[static_cast<std::size_t>(map->source[index(Joint::left_toes)])].offset;
    EXPECT_GT(toes.z, 0.9f * glm::length(toes)) << name;  // feet look forward
  }
}

TEST(Profile, EveryProfileIsTheBestForItsOwnNames) {
  const auto known = profiles();
  for (const SkeletonProfile& own : known) {
    const ForeignSkeleton form = foreign_skeleton(own);
    const RawClip clip =
        renamed(names_of(own), glm::inverse(form.axes), 0.01f / form.metres_per_unit);
    const auto best = best_profile(known, clip);
    ASSERT_TRUE(best) << own.name << ": " << to_string(best.error());
    EXPECT_EQ(best->name, own.name);
  }
}

TEST(Profile, FamiliesAreKnownByTheirNames) {
  const auto known = profiles();
  const std::vector<std::pair<std::string, std::vector<std::string>>> families = {
      {"lafan1", {"Hips", "UpLeg", "Leg", "Foot", "Toe", "Shoulder", "Arm", "ForeArm", "Hand"}},
      {"xsens", {"Hips", "Hip", "Knee", "Ankle", "Toe", "Collar", "Shoulder", "Elbow", "Wrist"}},
      {"xsens_mvn",
       {"Pelvis", "UpperLeg", "LowerLeg", "Foot", "Toe", "Shoulder", "UpperArm", "ForeArm",
        "Hand"}},
      {"rokoko", {"Hips", "Thigh", "Shin", "Foot", "Toe", "Shoulder", "Arm", "ForeArm", "Hand"}},
  };
  const std::array<std::string, 9> ours = {"Hips",     "UpLeg", "Leg",     "Foot", "ToeBase",
                                           "Shoulder", "Arm",   "ForeArm", "Hand"};
  const std::vector<std::vector<std::string>> trunks = {{"Spine", "Spine1", "Spine2"},
                                                        {"Chest", "Chest2", "Chest4"},
                                                        {"L5", "L3", "T8"},
                                                        {"Spine1", "Spine2", "Spine3"}};
  for (std::size_t f = 0; f < families.size(); ++f) {
    const auto& [name, words] = families[f];
    std::vector<std::pair<std::string, std::string>> names = {{"Hips", words[0]}};
    for (std::size_t i = 1; i < ours.size(); ++i)
      for (const std::string side : {"Left", "Right"})
        names.emplace_back(side + ours[i], side + words[i]);
    const std::array<std::string, 3> spine = {"Spine", "Spine1", "Spine2"};
    for (std::size_t i = 0; i < 3; ++i) names.emplace_back(spine[i], trunks[f][i]);
    const auto best = best_profile(known, renamed(names, Quat(1, 0, 0, 0), 1));
    ASSERT_TRUE(best) << name << ": " << to_string(best.error());
    EXPECT_EQ(best->name, name);
  }
}

TEST(Profile, TheJointThatCarriesTheArmsIsTheUpperChestWhateverItsName) {
  const auto known = profiles();
  RawClip clip = motion_builder("", true);
  const auto chest = [&] {
    const auto best = best_profile(known, clip);
    EXPECT_TRUE(best) << to_string(best.error());
    return map_joints(*best, clip)->source[index(Joint::upper_chest)];
  };
  EXPECT_EQ(chest(), clip.find("Spine2"));
  clip.joints[static_cast<std::size_t>(clip.find("Spine2"))].name = "Ribs";
  EXPECT_EQ(chest(), clip.find("Ribs"));
  // A fourth joint of the spine.
  clip.joints[static_cast<std::size_t>(clip.find("Spine1"))].name = "Spine2";
  clip.joints[static_cast<std::size_t>(clip.find("Spine"))].name = "Spine1";
  EXPECT_EQ(chest(), clip.find("Ribs"));
  EXPECT_EQ(map_joints(best_profile(known, clip).value(), clip)->source[index(Joint::chest)],
            clip.find("Spine1"));
}

TEST(Profile, WhatStandsBeforeEveryNameMakesNoOtherName) {
  const auto known = profiles();
  for (const std::string prefix : {"Bob_", "Skeleton 001_", "m_avg_"}) {
    RawClip clip = motion_builder(prefix, true);
    // A root above the hips is called otherwise.
    for (RawJoint& joint : clip.joints) ++joint.parent;
    clip.joints.insert(clip.joints.begin(), {"Reference", -1, {}});
    const auto best = best_profile(known, clip);
    ASSERT_TRUE(best) << prefix << ": " << to_string(best.error());
    EXPECT_EQ(best->name, "mixamo") << prefix;
    EXPECT_EQ(map_joints(*best, clip)->source[index(Joint::left_hand)],
              clip.find(prefix + "LeftHand"));
  }
}

TEST(Profile, WhatTheNearestProfileLacksIsNamed) {
  RawClip clip = motion_builder("mixamorig:", true);
  const auto at = static_cast<std::size_t>(clip.find("mixamorig:LeftHand"));
  clip.joints[at].name = "mixamorig:LeftPaw";
  const auto best = best_profile(profiles(), clip);
  ASSERT_FALSE(best);
  EXPECT_THAT(best.error().what, ::testing::HasSubstr("mixamo comes nearest and lacks 'LeftHand'"));
}

TEST(Profile, NamespacesCaseAndWhatStandsBetweenWordsMakeNoOtherName) {
  const auto known = profiles();
  for (const std::string prefix : {"mixamorig:", "mixamorig9:", "mixamorig_", "mixamorig",
                                   "Scene:Boxer:", "Robot_", "Character1_"}) {
    const auto best = best_profile(known, motion_builder(prefix, true));
    ASSERT_TRUE(best) << prefix << ": " << to_string(best.error());
    EXPECT_EQ(best->name, "mixamo") << prefix;
  }
  const SkeletonProfile biped = profile_named("biped").value();
  for (const std::string root : {"Bip01 ", "Bip001_", "bip01_"}) {
    auto names = names_of(biped);
    for (auto& [from, to] : names) {
      to = root + to;
      if (root.back() == '_') std::replace(to.begin(), to.end(), ' ', '_');
    }
    const auto best = best_profile(known, renamed(names, Quat(1, 0, 0, 0), 1));
    ASSERT_TRUE(best) << root << ": " << to_string(best.error());
    EXPECT_EQ(best->name, "biped") << root;
  }
}

TEST(Profile, AxesAndUnitAreThoseOfTheRestPoseWhereTheProfileSaysOthers) {
  const auto known = profiles();
  const Quat z_up = glm::angleAxis(radians(90), kLeft);
  const Quat axes[] = {yaw_rotation(kPi), yaw_rotation(kPi / 2), yaw_rotation(radians(45)), z_up,
                       glm::angleAxis(radians(90), kForward) * z_up};
  for (const float unit : {1.0f, 0.01f, 1 / 2.54f, 10.0f})
    for (const Quat& turned : axes) {
      RawClip clip = renamed({}, turned, unit);
      const auto best = best_profile(known, clip);
      ASSERT_TRUE(best) << to_string(best.error());
      EXPECT_EQ(best->name, "mixamo");
      const auto map = map_joints(*best, clip);
      ASSERT_TRUE(map) << to_string(map.error());
      EXPECT_NEAR(map->metres_per_unit * unit, 0.01f, 1e-6f);
      EXPECT_LT(glm::distance(map->axes * (turned * kForward), kForward), 1e-4f);
      EXPECT_LT(glm::distance(map->axes * (turned * kUp), kUp), 1e-4f);
    }
}

TEST(Profile, UpIsWhereTheMotionStandsAndNotWhereItsRestPoseDid) {
  const Quat z_up = glm::angleAxis(radians(90), kLeft);
  RawClip clip = renamed({}, z_up, 1);
  clip.frames = 40;
  clip.frame_seconds = 0.01;
  for (std::size_t f = 0; f < clip.frames; ++f)
    for (const RawJoint& joint : clip.joints) {
      clip.translation.push_back(joint.offset);
      clip.rotation.emplace_back(1, 0, 0, 0);
    }
  const SkeletonProfile profile = best_profile(profiles(), clip).value();
  EXPECT_LT(glm::distance(map_joints(profile, clip)->axes * Vec3(0, 0, 1), kUp), 1e-4f);
  // The root stands it up along y, but for a while too short to say anything.
  for (std::size_t f = 0; f < 38; ++f) clip.rotation[clip.at(f, 0)] = glm::inverse(z_up);
  JointMap map = map_joints(profile, clip).value();
  EXPECT_LT(glm::distance(map.axes * kUp, kUp), 1e-4f);
  EXPECT_LT(glm::distance(map.rest * Vec3(0, 0, 1), kUp), 1e-4f);
  // One who stands up along the rest pose often enough is believed.
  for (std::size_t f = 20; f < 38; ++f) clip.rotation[clip.at(f, 0)] = Quat(1, 0, 0, 0);
  map = map_joints(profile, clip).value();
  EXPECT_LT(glm::distance(map.axes * Vec3(0, 0, 1), kUp), 1e-4f);
}

TEST(Profile, ADetachedJointNeedNotHangBelowItsBone) {
  SkeletonProfile profile;
  for (const SkeletonProfile& one : profiles())
    if (one.name == "mixamo") profile = one;
  RawClip clip = motion_builder("", true);
  const auto foot = static_cast<std::size_t>(clip.find("LeftFoot"));
  clip.joints[foot].offset = {9, -83, 0};
  clip.joints[foot].parent = 0;
  EXPECT_EQ(score(profile, clip), 0.0f);
  profile.detached[index(Joint::left_foot)] = true;
  EXPECT_EQ(score(profile, clip), 1.0f);
  EXPECT_TRUE(map_joints(profile, clip));
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

TEST(Profile, FourLimbsAreEnoughToBeKnown) {
  RawClip clip = motion_builder("", true);
  for (const std::string name : {"Spine", "Spine1", "Neck", "LeftShoulder", "RightShoulder"})
    clip.joints[static_cast<std::size_t>(clip.find(name))].name = "of_no_family_" + name;
  const auto best = best_profile(profiles(), clip);
  ASSERT_TRUE(best) << to_string(best.error());
  EXPECT_EQ(best->name, "mixamo");
}

TEST(Profile, AForearmThatEndsWithoutAHandHasOneAtItsEndSite) {
  RawClip clip = motion_builder("mixamorig:", true);
  for (const std::string side : {"Left", "Right"})
    clip.joints[static_cast<std::size_t>(clip.find("mixamorig:" + side + "Hand"))].name =
        "mixamorig:" + side + "ForeArm" + kEndSite;
  const auto best = best_profile(profiles(), clip);
  ASSERT_TRUE(best) << to_string(best.error());
  EXPECT_EQ(best->name, "mixamo");
  EXPECT_EQ(map_joints(*best, clip)->source[index(Joint::left_hand)],
            clip.find("mixamorig:LeftForeArm End Site"));
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
    wrong.forward = -profile.forward;  // left would be right
    const auto righted = map_joints(wrong, clip);
    ASSERT_TRUE(righted) << to_string(righted.error());
    EXPECT_TRUE(map->as_written);
    EXPECT_FALSE(righted->as_written);
    EXPECT_LT(glm::distance(righted->axes * Vec3(1, 0, 0), kForward), 1e-5f);
    EXPECT_LT(glm::distance(righted->axes * Vec3(0, 0, -1), kLeft), 1e-5f);
  }
}

}  // namespace
}  // namespace ringcraft
