// What is written beside the GLB, read back by the readers of captures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "capture/bvh.h"
#include "capture/gltf.h"
#include "capture/profile.h"
#include "capture/retarget.h"
#include "io/bvh_writer.h"
#include "io/root_motion.h"
#include "io/sample_fight.h"

namespace ringcraft {
namespace {

// The joints of a row that was written, as the file has them and in the axes and metres it names.
void expect_same_joints(const RawClip& raw, const Skeleton& skeleton, const FighterTrack& track) {
  const auto profiles = read_profiles(RINGCRAFT_SOURCE_DIR "/assets/profiles");
  ASSERT_TRUE(profiles);
  const auto profile = best_profile(*profiles, raw);
  ASSERT_TRUE(profile) << profile.error().what;
  EXPECT_EQ(profile->name, "vrm");
  const auto map = map_joints(*profile, raw);
  ASSERT_TRUE(map);
  const std::size_t rows = (track.frames.size() + 1) / 2;
  ASSERT_EQ(raw.frames, rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const WorldPose shown = world_pose(skeleton, track.frames[row * 2]);
    const RawPose read = raw_pose(raw, static_cast<double>(row) * raw.frame_seconds);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 at = map->axes * read.position[static_cast<std::size_t>(map->source[j])] *
                      map->metres_per_unit;
      ASSERT_LT(glm::distance(at, shown.position[j]), 5e-4f)
          << vrm_name(joint_at(j)) << " in row " << row;
    }
  }
}

class Exports : public testing::Test {
 protected:
  std::vector<FighterLook> looks = sample::looks();
  Timeline timeline = sample::timeline();
};

TEST_F(Exports, ABvhHoldsTheShownJointsToHalfAMillimetre) {
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string text = fighter_bvh(looks[i].body.skeleton, timeline.tracks[i]);
    const auto raw = parse_bvh(text, "fighter.bvh");
    ASSERT_TRUE(raw) << raw.error().what;
    EXPECT_TRUE(raw->notes.empty());
    expect_same_joints(*raw, looks[i].body.skeleton, timeline.tracks[i]);
  }
}

// Lying on the back the hips' X rotation is a quarter turn, where Z and Y are one axis.
TEST_F(Exports, ABvhHoldsABodyThatLies) {
  FighterTrack track;
  for (int i = 0; i <= 180; i += 2) {
    Pose pose = rest_pose(looks[0].body.skeleton);
    const float angle = radians(static_cast<float>(i));
    pose.rotation[0] = glm::angleAxis(0.3f, kUp) * glm::angleAxis(-angle, kLeft);
    track.frames.push_back(pose);
    track.frames.push_back(pose);
  }
  const auto raw = parse_bvh(fighter_bvh(looks[0].body.skeleton, track), "fighter.bvh");
  ASSERT_TRUE(raw) << raw.error().what;
  expect_same_joints(*raw, looks[0].body.skeleton, track);
}

// Every profile that names all bones gets back what was shown; where bones are missing, hands and
// feet are still where they were.
TEST_F(Exports, ABvhForAProfileIsReadByThatProfile) {
  const FighterTrack& track = timeline.tracks[0];
  const Skeleton& skeleton = looks[0].body.skeleton;
  const auto profiles = read_profiles(RINGCRAFT_SOURCE_DIR "/assets/profiles");
  ASSERT_TRUE(profiles);
  for (const SkeletonProfile& profile : *profiles) {
    SCOPED_TRACE(profile.name);
    const auto raw =
        parse_bvh(fighter_bvh(skeleton, track, foreign_skeleton(profile)), "fighter.bvh");
    ASSERT_TRUE(raw) << raw.error().what;
    EXPECT_EQ(score(profile, *raw), 1.0f);
    const auto map = map_joints(profile, *raw);
    ASSERT_TRUE(map) << map.error().what;
    const bool whole = std::count(profile.source.begin(), profile.source.end(), "") == 0;
    float worst = 0, hands = 0, feet = 0;
    for (std::size_t row = 0; row < raw->frames; ++row) {
      const WorldPose shown = world_pose(skeleton, track.frames[row * 2]);
      const RawPose read = raw_pose(*raw, static_cast<double>(row) * raw->frame_seconds);
      for (std::size_t j = 0; j < kJointCount; ++j) {
        if (map->source[j] < 0) continue;
        const auto source = static_cast<std::size_t>(map->source[j]);
        const Vec3 at = map->axes * read.position[source] * map->metres_per_unit;
        const float off = glm::distance(at, shown.position[j]);
        worst = std::max(worst, off);
        const Joint joint = joint_at(j);
        if (joint == Joint::left_hand || joint == Joint::right_hand) hands = std::max(hands, off);
        if (joint == Joint::left_foot || joint == Joint::right_foot) feet = std::max(feet, off);
      }
    }
    EXPECT_LT(worst, whole ? 5e-4f : 0.10f);
    EXPECT_LT(feet, 5e-4f);
    const bool collar_bones = !profile.source[index(Joint::left_shoulder)].empty();
    EXPECT_LT(hands, collar_bones ? 0.002f : 0.02f);  // without them a stretched arm is too short
    if (std::getenv("RINGCRAFT_PRINT") != nullptr)
      std::printf("[ measured ] %s: worst %.2f mm, hands %.2f, feet %.2f\n", profile.name.c_str(),
                  static_cast<double>(worst) * 1000, static_cast<double>(hands) * 1000,
                  static_cast<double>(feet) * 1000);
  }
}

TEST_F(Exports, AVrmAnimationHoldsTheShownJoints) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto raw = parse_gltf(fighter_vrma(looks[i], timeline.tracks[i]), "fighter.vrma");
    ASSERT_TRUE(raw) << raw.error().what;
    expect_same_joints(*raw, looks[i].body.skeleton, timeline.tracks[i]);
  }
}

TEST_F(Exports, RootMotionFollowsTheBodyWithoutItsSwing) {
  const FighterTrack& track = timeline.tracks[0];
  const std::vector<Placement> roots = root_motion(track);
  ASSERT_EQ(roots.size(), track.frames.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Vec3 hips = track.frames[i].hips;
    EXPECT_LT(glm::distance(roots[i].position(), Vec3(hips.x, 0, hips.z)), 0.3f) << i;
    if (i == 0) continue;
    EXPECT_LT(glm::distance(roots[i].position(), roots[i - 1].position()), 0.03f) << i;
    EXPECT_LT(std::abs(wrapped_angle(roots[i].yaw - roots[i - 1].yaw)), 0.1f) << i;
  }
}

}  // namespace
}  // namespace ringcraft
