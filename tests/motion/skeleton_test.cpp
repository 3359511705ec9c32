#include "motion/skeleton.h"

#include <gtest/gtest.h>

namespace ringcraft {
namespace {

TEST(Skeleton, ParentsStandBeforeTheirChildren) {
  EXPECT_EQ(kParent[0], -1);
  for (std::size_t i = 1; i < kJointCount; ++i) {
    EXPECT_GE(kParent[i], 0);
    EXPECT_LT(static_cast<std::size_t>(kParent[i]), i);
  }
}

TEST(Skeleton, NamesLeadToTheirJointsAndNothingElseDoes) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_EQ(joint_from_vrm_name(vrm_name(joint_at(i))), joint_at(i));
  }
  EXPECT_EQ(joint_from_vrm_name("Hips"), std::nullopt);
  EXPECT_EQ(joint_from_vrm_name(""), std::nullopt);
}

TEST(Skeleton, MirroringJointsTwiceIsNothingAndKeepsTheTree) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Joint joint = joint_at(i), other = mirrored(joint);
    EXPECT_EQ(mirrored(other), joint);
    if (i == 0) continue;
    EXPECT_EQ(mirrored(joint_at(static_cast<std::size_t>(kParent[i]))),
              joint_at(static_cast<std::size_t>(kParent[index(other)])));
  }
  EXPECT_EQ(mirrored(Joint::left_toes), Joint::right_toes);
  EXPECT_EQ(mirrored(Joint::right_hand), Joint::left_hand);
  EXPECT_EQ(mirrored(Joint::neck), Joint::neck);
}

TEST(Skeleton, StandsOnItsSolesAndScalesWithItsHeight) {
  const Skeleton tall = canonical_skeleton(2.0f), small = canonical_skeleton(1.0f);
  EXPECT_GT(tall.toe_height(), 0);
  EXPECT_GT(tall.ankle_height(), tall.toe_height());
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_NEAR(glm::distance(tall.offset[i], 2.0f * small.offset[i]), 0, 1e-5f);
    const Vec3 o = tall.offset[i], m = tall.offset[index(mirrored(joint_at(i)))];
    EXPECT_NEAR(glm::distance(m, Vec3(-o.x, o.y, o.z)), 0, 1e-6f) << vrm_name(joint_at(i));
  }
}

TEST(Skeleton, SpansAboutItsHeightWithItsArms) {
  const Skeleton skeleton = canonical_skeleton(1.8f);
  float reach = 0;  // wrist to wrist; the hands add about 0.1 of the height each
  for (Joint joint = Joint::left_hand; joint != Joint::upper_chest;
       joint = joint_at(static_cast<std::size_t>(kParent[index(joint)]))) {
    reach += 2 * skeleton.offset[index(joint)].x;
  }
  EXPECT_NEAR(reach / skeleton.height + 0.2f, 1.0f, 0.08f);
}

}  // namespace
}  // namespace ringcraft
