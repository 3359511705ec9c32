#include "physics/body.h"

#include "physics/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "physics/stance.h"

namespace ringcraft {
namespace {

float total(const BodyModel& body) {
  return std::accumulate(body.parts.begin(), body.parts.end(), 0.0f,
                         [](float sum, const PartModel& p) { return sum + p.mass; });
}

TEST(Body, PartMassesSumToTheMass) {
  for (const Sex sex : {Sex::male, Sex::female}) {
    for (const float mass : {45.0f, 75.0f, 130.0f}) {
      EXPECT_NEAR(total(make_body({"b", 1.8f, mass, sex})), mass, 1e-3f);
    }
  }
}

TEST(Body, CentreOfMassStandsAt55To57PercentOfHeight) {
  for (const Sex sex : {Sex::male, Sex::female}) {
    for (const float height : {1.55f, 1.78f, 2.0f}) {
      const BodyModel body = make_body({"b", height, 75, sex});
      Pose pose = rest_pose(body.skeleton);
      // De Leva's bodies stand with their arms down.
      pose.rotation[index(Joint::left_upper_arm)] = from_rotation_vector({0, 0, radians(-80)});
      pose.rotation[index(Joint::right_upper_arm)] = from_rotation_vector({0, 0, radians(80)});
      const float share = center_of_mass(body, world_pose(body.skeleton, pose)).y / height;
      EXPECT_GT(share, .545f);
      EXPECT_LT(share, .575f);
    }
  }
}

TEST(Body,
     HeadMomentsAreThoseMeasured) {  // docs/sources.md, R4: .0263 pitch, .0181 yaw, .0244 roll
  const Vec3 i = make_body({}).parts[index(Part::head)].inertia;
  EXPECT_NEAR(i.x, .0263f, .001f);
  EXPECT_NEAR(i.y, .0181f, .001f);
  EXPECT_NEAR(i.z, .0244f, .001f);
}

TEST(Body, RestPoseStandsOnTheGroundAndReachesItsHeight) {
  for (const float height : {1.5f, 1.78f, 2.1f}) {
    const BodyModel body = make_body({"b", height, 75, Sex::male});
    const BodyCapsules c = capsules(body, world_pose(body.skeleton, rest_pose(body.skeleton)));
    float low = 10, high = 0;
    for (const Capsule& k : c) {
      low = std::min({low, k.a.y - k.radius, k.b.y - k.radius});
      high = std::max({high, k.a.y + k.radius, k.b.y + k.radius});
    }
    EXPECT_NEAR(low, 0, 1e-4f);
    EXPECT_NEAR(high, height, .01f);
  }
}

TEST(Body, CapsulesTurnAndMoveWithThePose) {
  const BodyModel body = make_body({});
  const Pose pose = stance::fighting(body);
  const Placement placement{1.5f, -2, .7f};
  const BodyCapsules here = capsules(body, world_pose(body.skeleton, pose));
  const BodyCapsules there = capsules(body, world_pose(body.skeleton, placed(pose, placement)));
  for (std::size_t i = 0; i < kPartCount; ++i) {
    EXPECT_LT(glm::distance(placement * here[i].a, there[i].a), 1e-4f) << name_of(part_at(i));
    EXPECT_LT(glm::distance(placement * here[i].b, there[i].b), 1e-4f) << name_of(part_at(i));
  }
}

TEST(Body, MirroredPoseHasMirroredCapsules) {
  const BodyModel body = make_body({});
  const Pose pose = stance::fighting(body);
  const BodyCapsules here = capsules(body, world_pose(body.skeleton, pose));
  const BodyCapsules there = capsules(body, world_pose(body.skeleton, mirrored(pose)));
  const auto flip = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Capsule& m = there[index(mirrored(part_at(i)))];
    const float same = glm::distance(flip(here[i].a), m.a) + glm::distance(flip(here[i].b), m.b);
    const float swapped = glm::distance(flip(here[i].a), m.b) + glm::distance(flip(here[i].b), m.a);
    EXPECT_LT(std::min(same, swapped), 1e-4f) << name_of(part_at(i));
  }
}

TEST(Body, GirthGrowsWithMassAndTheGloveDoesNot) {
  const BodyModel light = make_body({"l", 1.78f, 55, Sex::male});
  const BodyModel heavy = make_body({"h", 1.78f, 110, Sex::male});
  EXPECT_GT(heavy.parts[index(Part::abdomen)].radius,
            1.3f * light.parts[index(Part::abdomen)].radius);
  EXPECT_EQ(heavy.parts[index(Part::left_hand)].radius, light.parts[index(Part::left_hand)].radius);
}

Pose turned(Joint joint, Vec3 degrees_about) {
  Pose pose = rest_pose(canonical_skeleton());
  pose.rotation[index(joint)] = from_rotation_vector(degrees_about * (kPi / 180));
  return pose;
}

struct Case {
  const char* what;
  Joint joint;
  Vec3 turn;  // rotation vector, degrees
  bool allowed;
};

TEST(JointLimits, PosesOfTheRangeOfMotionTablesAreAllowedAndThoseBeyondAreNot) {
  const BodyModel body = make_body({});
  const Case cases[] = {
      {"knee bent 140", Joint::left_lower_leg, {140, 0, 0}, true},
      {"knee bent forward", Joint::left_lower_leg, {-30, 0, 0}, false},
      {"knee sideways", Joint::right_lower_leg, {0, 0, 40}, false},
      {"left elbow bent 140", Joint::left_lower_arm, {0, -140, 0}, true},
      {"left elbow bent back", Joint::left_lower_arm, {0, 40, 0}, false},
      {"right elbow bent 140", Joint::right_lower_arm, {0, 140, 0}, true},
      {"right elbow bent back", Joint::right_lower_arm, {0, -40, 0}, false},
      {"arm hanging", Joint::left_upper_arm, {0, 0, -85}, true},
      {"arm overhead", Joint::left_upper_arm, {0, 0, 88}, true},
      {"arm forward", Joint::left_upper_arm, {0, -90, 0}, true},
      {"arm across", Joint::right_upper_arm, {0, 130, 0}, true},
      {"arm straight back", Joint::left_upper_arm, {0, 90, 0}, false},
      {"arm straight back, right", Joint::right_upper_arm, {0, -90, 0}, false},
      {"hip flexed 120", Joint::left_upper_leg, {-120, 0, 0}, true},
      {"hip extended 25", Joint::left_upper_leg, {25, 0, 0}, true},
      {"hip extended 60", Joint::left_upper_leg, {60, 0, 0}, false},
      {"hip abducted 45", Joint::left_upper_leg, {0, 0, 45}, true},
      {"hip adducted 25", Joint::left_upper_leg, {0, 0, -25}, true},
      {"hip adducted 80", Joint::right_upper_leg, {0, 0, 80}, false},
      {"hip rotated 45", Joint::right_upper_leg, {0, 45, 0}, true},
      {"hip rotated 110", Joint::right_upper_leg, {0, 110, 0}, false},
      {"ankle dorsiflexed 33", Joint::left_foot, {-33, 0, 0}, true},
      {"ankle dorsiflexed 50", Joint::left_foot, {-50, 0, 0}, false},
      {"ankle plantarflexed 55", Joint::right_foot, {55, 0, 0}, true},
      {"head turned 75", Joint::head, {0, 75, 0}, true},
      {"head turned 110", Joint::neck, {0, 110, 0}, false},
      {"trunk bent forward 70", Joint::spine, {70, 0, 0}, true},
      {"trunk bent back 70", Joint::chest, {-70, 0, 0}, false},
      {"wrist bent 80", Joint::left_hand, {0, 0, -80}, true},
      {"wrist bent back 100", Joint::left_hand, {0, 0, 100}, false},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(limit_violations(body, turned(c.joint, c.turn), radians(2)).empty(), c.allowed)
        << c.what;
  }
}

TEST(JointLimits, StancesAreAllowedAndMirroringChangesNothing) {
  const BodyModel body = make_body({});
  for (const Pose& pose : {stance::square(body), stance::fighting(body)}) {
    for (const LimitViolation& v : limit_violations(body, pose, radians(1))) {
      ADD_FAILURE() << vrm_name(v.joint) << " " << degrees(v.excess);
    }
    EXPECT_TRUE(limit_violations(body, mirrored(pose), radians(1)).empty());
  }
  for (const Joint joint : {Joint::left_upper_arm, Joint::left_upper_leg, Joint::left_hand}) {
    const Pose bad = turned(joint, {100, 60, -110});
    const auto here = limit_violations(body, bad, 0),
               there = limit_violations(body, mirrored(bad), 0);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i)
      EXPECT_NEAR(here[i].excess, there[i].excess, 1e-4f);
  }
}

TEST(JointLimits, AJointSlowsBeforeItsLimitAndNeverPassesIt) {
  const BodyModel body = make_body({});
  LimitExcesses free;
  free.fill(radians(-12));
  constexpr float kMost = radians(2);
  const auto excess_at = [&](float flexed) {
    Pose pose = rest_pose(body.skeleton);
    pose.rotation[index(Joint::left_lower_arm)] = from_rotation_vector({0, -radians(flexed), 0});
    constexpr std::size_t kLeftElbow = 3;
    return limit_excesses(within_limits(body, pose, kMost, pose, free))[kLeftElbow];
  };
  EXPECT_NEAR(excess_at(137), radians(-13), 1e-3f);  // free to go that far
  for (float flexed = 138; flexed < 175; flexed += 1) {
    EXPECT_LE(excess_at(flexed), kMost + 1e-4f) << flexed;
    EXPECT_GE(excess_at(flexed + 1), excess_at(flexed) - 1e-4f) << flexed;
  }
  // Evenly: at 3/4 of its pace after a quarter of the way, at half where a hard stop would have a
  // corner.
  EXPECT_NEAR(excess_at(145.5f) - excess_at(144.5f), radians(.75f), radians(.02f));
  EXPECT_NEAR(excess_at(152.5f) - excess_at(151.5f), radians(.5f), radians(.02f));
}

}  // namespace
}  // namespace ringcraft
