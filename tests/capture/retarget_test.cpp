#include "capture/retarget.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.h"
#include "capture/bvh.h"
#include "capture/canonical.h"
#include "mocap.h"

namespace ringcraft {
namespace {

const std::filesystem::path kBoxing = "/usr/share/assimp/models/BVH/Boxing_Toes.bvh";

SkeletonProfile own_names() {
  SkeletonProfile profile;
  profile.name = "own";
  profile.metres_per_unit = {1.0f, 0.01f};
  for (std::size_t j = 0; j < kJointCount; ++j) profile.source[j] = vrm_name(joint_at(j));
  return profile;
}

// A capture of the canonical body whose rest pose is turned joint by joint (`rest`, world
// rotations), and which is `scale` times as large.
RawClip capture_of(const Skeleton& skeleton, const std::vector<Pose>& poses,
                   const std::array<Quat, kJointCount>& rest, float scale) {
  RawClip clip;
  clip.file = "own.bvh";
  clip.frame_seconds = 1.0 / kTicksPerSecond;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    RawJoint joint;
    joint.name = vrm_name(joint_at(j));
    joint.parent = kParent[j];
    const Quat carrier =
        joint.parent < 0 ? Quat(1, 0, 0, 0) : rest[static_cast<std::size_t>(joint.parent)];
    joint.offset = carrier * skeleton.offset[j] * scale;
    clip.joints.push_back(joint);
  }
  for (const Pose& pose : poses) {
    const WorldPose world = world_pose(skeleton, pose);
    std::array<Quat, kJointCount> file{};
    for (std::size_t j = 0; j < kJointCount; ++j) {
      file[j] = world.rotation[j] * glm::inverse(rest[j]);
      const int parent = clip.joints[j].parent;
      const Quat local =
          parent < 0 ? file[j] : glm::inverse(file[static_cast<std::size_t>(parent)]) * file[j];
      clip.rotation.push_back(glm::normalize(local));
      clip.translation.push_back(parent < 0 ? pose.hips * scale : clip.joints[j].offset);
    }
    ++clip.frames;
  }
  return clip;
}

// Stands with bent knees and works with both arms and the trunk.
std::vector<Pose> standing_work(const Skeleton& skeleton) {
  std::vector<Pose> poses;
  for (int i = 0; i < 120; ++i) {
    const float phase = 2 * kPi * static_cast<float>(i) / 60.0f;
    Pose pose = rest_pose(skeleton);
    const float knee = radians(40);
    for (const Side side : {Side::left, Side::right}) {
      const float out = side == Side::left ? 1.0f : -1.0f;
      pose.rotation[index(leg(side).root)] = glm::angleAxis(-knee / 2, kLeft);
      pose.rotation[index(leg(side).middle)] = glm::angleAxis(knee, kLeft);
      pose.rotation[index(leg(side).end)] = glm::angleAxis(-knee / 2, kLeft);
      pose.rotation[index(arm(side).root)] =
          glm::angleAxis(-out * radians(40 + 20 * std::sin(phase)), kForward);
      pose.rotation[index(arm(side).middle)] =
          glm::angleAxis(radians(70 + 30 * std::cos(phase + out)), -out * kUp);
    }
    pose.rotation[index(Joint::chest)] = glm::angleAxis(radians(10) * std::sin(phase), kUp);
    const WorldPose world = world_pose(skeleton, pose);
    pose.hips -= world.position[index(Joint::left_foot)] -
                 Vec3(skeleton.offset[index(Joint::left_upper_leg)].x, skeleton.ankle_height(), 0);
    poses.push_back(pose);
  }
  return poses;
}

float largest_difference(const Skeleton& skeleton, const std::vector<Pose>& poses,
                         const Clip& clip) {
  float largest = 0;
  for (std::size_t i = 0; i < clip.frames.size(); ++i)
    largest = std::max(largest, largest_joint_distance(world_pose(skeleton, poses[i]),
                                                       world_pose(skeleton, clip.frames[i])));
  return largest;
}

TEST(Retarget, OurOwnBodyComesBackAsItWas) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  std::array<Quat, kJointCount> rest{};
  const auto clip = retarget(capture_of(skeleton, poses, rest, 1), own_names(), skeleton);
  ASSERT_TRUE(clip) << to_string(clip.error());
  ASSERT_EQ(clip->frames.size(), poses.size());
  EXPECT_TRUE(faults(*clip).empty()) << faults(*clip).front();
  EXPECT_LT(largest_difference(skeleton, poses, *clip), 0.004f);
  for (const FootContacts& contacts : clip->contacts) EXPECT_TRUE(contacts.left && contacts.right);
}

TEST(Retarget, OfSeveralPeopleInOneFileTheFirstIsReadAndTheyAreCounted) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  const RawClip one = capture_of(skeleton, poses, std::array<Quat, kJointCount>{}, 1);
  RawClip two = one;
  for (RawJoint joint : one.joints) {
    if (joint.parent >= 0) joint.parent += static_cast<int>(kJointCount);
    two.joints.push_back(joint);
  }
  two.rotation.clear();
  two.translation.clear();
  for (std::size_t f = 0; f < one.frames; ++f)
    for (const std::size_t from : {f, one.frames - 1 - f})
      for (std::size_t j = 0; j < kJointCount; ++j) {
        two.rotation.push_back(one.rotation[one.at(from, j)]);
        two.translation.push_back(one.translation[one.at(from, j)]);
      }
  const auto read = canonical_of(two, skeleton, {own_names()});
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_LT(largest_difference(skeleton, poses, read->clip), 0.004f);
  ASSERT_EQ(read->raw.notes.size(), 1u);
  EXPECT_EQ(read->raw.notes[0],
            "the hips of 2 people (hips, hips): the first called hips are read");
  for (std::size_t j = kJointCount; j < two.joints.size(); ++j)
    two.joints[j].name = "Bob_" + two.joints[j].name;
  const auto prefixed = canonical_of(two, skeleton, {own_names()});
  ASSERT_TRUE(prefixed) << to_string(prefixed.error());
  ASSERT_EQ(prefixed->raw.notes.size(), 1u);
  EXPECT_EQ(prefixed->raw.notes[0],
            "the hips of 2 people (hips, Bob_hips): the first called hips are read");
  for (std::size_t j = kJointCount; j < two.joints.size(); ++j)
    two.joints[j].name = "ORG-" + one.joints[j - kJointCount].name;
  const auto rigify = canonical_of(two, skeleton, {own_names()});
  ASSERT_TRUE(rigify) << to_string(rigify.error());
  EXPECT_TRUE(rigify->raw.notes.empty());  // one person's bones twice
}

TEST(Retarget, NeitherRestPoseNorSizeNorUnitMatters) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  // Arms hang, legs are spread: as in other people's rest poses.
  std::array<Quat, kJointCount> rest{};
  for (const Side side : {Side::left, Side::right}) {
    const float out = side == Side::left ? 1.0f : -1.0f;
    for (const Joint joint : {arm(side).root, arm(side).middle, arm(side).end})
      rest[index(joint)] = glm::angleAxis(-out * radians(80), kForward);
    for (const Joint joint : {leg(side).root, leg(side).middle})
      rest[index(joint)] = glm::angleAxis(out * radians(20), kForward);
  }
  const auto clip = retarget(capture_of(skeleton, poses, rest, 112), own_names(), skeleton);
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_LT(largest_difference(skeleton, poses, *clip), 0.004f);
}

// LaFAN1's kind: every joint's x lies along its bone, so that a rest pose has all bones in a line;
// `mirrored`, as of mannequins: those of the right limbs look the other way (and one thigh a little
// aside).
// As where the rest pose is the first moment of a fighter who stands turned and bent.
TEST(Retarget, ATrunkThatRestsTurnedOrBentIsLaidOnByItsShoulders) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  for (const Quat& turn :
       {yaw_rotation(radians(50)), glm::angleAxis(radians(35), kLeft),
        glm::normalize(yaw_rotation(radians(-30)) * glm::angleAxis(radians(30), kLeft))}) {
    std::array<Quat, kJointCount> rest{};
    for (std::size_t j = index(Joint::spine); j <= index(Joint::right_hand); ++j) rest[j] = turn;
    const auto clip = retarget(capture_of(skeleton, poses, rest, 1), own_names(), skeleton);
    ASSERT_TRUE(clip) << to_string(clip.error());
    EXPECT_LT(largest_difference(skeleton, poses, *clip), 0.03f);
  }
}

void expect_lined_bones_to_do(bool mirrored) {
  SCOPED_TRACE(mirrored);
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  // Turns a bone to x and an axis across it to z, rolled.
  const auto lined = [](Vec3 bone, Vec3 axis, float roll) {
    const Vec3 x = glm::normalize(bone);
    const Vec3 z = glm::normalize(axis - x * glm::dot(x, axis));
    return glm::angleAxis(roll, kLeft) *
           glm::quat_cast(glm::transpose(glm::mat3(x, glm::cross(z, x), z)));
  };
  std::array<Quat, kJointCount> rest{};
  rest.fill(lined(kUp, kLeft, 0));
  for (const Side side : {Side::left, Side::right}) {
    const float way = mirrored && side == Side::right ? -1.0f : 1.0f;
    const Limb leg_joints = leg(side);
    const Limb arm_joints = arm(side);
    for (const Joint joint : {leg_joints.root, leg_joints.middle})
      rest[index(joint)] = lined(-way * kUp, kLeft, radians(20));
    if (mirrored && side == Side::left)
      rest[index(leg_joints.root)] = yaw_rotation(radians(10)) * rest[index(leg_joints.root)];
    rest[index(leg_joints.end)] =
        lined(way * skeleton.offset[index(toes(side))], kLeft, radians(20));
    rest[index(toes(side))] = lined(way * kForward, kLeft, radians(20));
    const Vec3 out = side == Side::left ? kLeft : -kLeft;
    const auto shoulder = static_cast<std::size_t>(kParent[index(arm_joints.root)]);
    rest[shoulder] = lined(skeleton.offset[index(arm_joints.root)], -kForward, radians(70));
    for (const Joint joint : {arm_joints.root, arm_joints.middle, arm_joints.end})
      rest[index(joint)] = lined(way * out, kUp, radians(130));
  }
  const auto clip = retarget(capture_of(skeleton, poses, rest, 100), own_names(), skeleton);
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_LT(largest_difference(skeleton, poses, *clip), 0.004f);
  for (std::size_t i = 0; i < poses.size(); i += 10)
    for (const Joint joint :
         {Joint::left_shoulder, Joint::left_hand, Joint::right_foot, Joint::right_toes})
      EXPECT_LT(glm::length(rotation_vector(
                    glm::inverse(world_pose(skeleton, poses[i]).rotation[index(joint)]) *
                    world_pose(skeleton, clip->frames[i]).rotation[index(joint)])),
                radians(3))
          << vrm_name(joint) << ' ' << i;
}

TEST(Retarget, ARestPoseWithAllBonesInALineIsLaidOnByTheHinges) {
  expect_lined_bones_to_do(false);
  expect_lined_bones_to_do(true);
}

TEST(Retarget, AnyFrameRateBecomesOneFrameATick) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  RawClip raw = capture_of(skeleton, poses, {}, 1);
  raw.frame_seconds = 1.0 / 30;
  const auto clip = retarget(raw, own_names(), skeleton);
  ASSERT_TRUE(clip);
  EXPECT_NEAR(seconds(clip->length()), raw.seconds(), 1.0 / 120 + 1e-6);
}

TEST(Retarget, AFootThatStandsInTheCaptureStandsStill) {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Pose> poses = standing_work(skeleton);
  // A body that drifts: every foot slides at 0.1 m/s, slow enough to be meant as standing.
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].hips.x += 0.1f * static_cast<float>(i) * kTickSeconds;
  const auto clip = retarget(capture_of(skeleton, poses, {}, 1), own_names(), skeleton);
  ASSERT_TRUE(clip);
  const WorldPose first = world_pose(skeleton, clip->frames[10]);
  const WorldPose last = world_pose(skeleton, clip->frames[110]);
  for (const Side side : {Side::left, Side::right}) {
    EXPECT_LT(glm::distance(first.position[index(toes(side))], last.position[index(toes(side))]),
              0.002f);
    EXPECT_NEAR(first.position[index(toes(side))].y, skeleton.toe_height(), 0.002f);
  }
  // Nor does the body drift away from the feet it stands on.
  EXPECT_LT(glm::distance(first.position[0], last.position[0]), 0.02f);
}

TEST(Retarget, ASteppingFootIsLiftedAndTheOtherIsNot) {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Pose> poses = standing_work(skeleton);
  for (std::size_t i = 40; i < 80; ++i) {  // the left knee goes up and down again
    const float lift = std::sin(kPi * static_cast<float>(i - 40) / 40.0f);
    poses[i].rotation[index(Joint::left_upper_leg)] *= glm::angleAxis(-radians(40) * lift, kLeft);
    poses[i].rotation[index(Joint::left_lower_leg)] *= glm::angleAxis(radians(40) * lift, kLeft);
  }
  const auto clip = retarget(capture_of(skeleton, poses, {}, 1), own_names(), skeleton);
  ASSERT_TRUE(clip);
  EXPECT_TRUE(clip->contacts[20].left && clip->contacts[100].left);
  EXPECT_FALSE(clip->contacts[60].left);
  for (const FootContacts& contacts : clip->contacts) EXPECT_TRUE(contacts.right);
  EXPECT_GT(world_pose(skeleton, clip->frames[60]).position[index(Joint::left_toes)].y, 0.15f);
}

TEST(Retarget, AMissingJointIsAnErrorThatNamesIt) {
  const Skeleton skeleton = canonical_skeleton();
  RawClip raw = capture_of(skeleton, standing_work(skeleton), {}, 1);
  raw.joints[index(Joint::left_lower_leg)].name = "shin";
  const auto clip = retarget(raw, own_names(), skeleton);
  ASSERT_FALSE(clip);
  EXPECT_NE(clip.error().place.find("leftLowerLeg"), std::string::npos);
}

TEST(Retarget, WristsShareTheTurnOfTheForearmAndKeepTheirRange) {
  const Skeleton skeleton = canonical_skeleton();
  Clip clip;
  for (int i = 0; i < 60; ++i) {
    Pose pose = rest_pose(skeleton);
    pose.rotation[index(Joint::left_hand)] = glm::angleAxis(radians(80), kLeft);
    pose.rotation[index(Joint::right_hand)] = glm::angleAxis(radians(-100), kForward);
    clip.frames.push_back(pose);
  }
  const Quat left_before = world_pose(skeleton, clip.frames[30]).rotation[index(Joint::left_hand)];
  fit_wrists(clip);
  const Pose& pose = clip.frames[30];
  const Quat left_after = world_pose(skeleton, pose).rotation[index(Joint::left_hand)];
  EXPECT_LT(glm::length(rotation_vector(glm::inverse(left_before) * left_after)), radians(0.5f));
  EXPECT_NEAR(degrees(glm::length(rotation_vector(pose.rotation[index(Joint::left_lower_arm)]))),
              40, 0.5);
  EXPECT_NEAR(degrees(glm::length(rotation_vector(pose.rotation[index(Joint::left_hand)]))), 40,
              0.5);
  const float bent = degrees(glm::length(rotation_vector(pose.rotation[index(Joint::right_hand)])));
  EXPECT_LT(bent, 66);  // extension
  EXPECT_GT(bent, 50);
}

TEST(Retarget, BonesWithoutLengthDoNoHarm) {
  const Skeleton skeleton = canonical_skeleton();
  RawClip raw = capture_of(skeleton, standing_work(skeleton), {}, 1);
  for (const Joint joint :
       {Joint::left_lower_arm, Joint::left_hand, Joint::right_toes, Joint::neck, Joint::head}) {
    raw.joints[index(joint)].offset = {};
    for (std::size_t f = 0; f < raw.frames; ++f) raw.translation[raw.at(f, index(joint))] = {};
  }
  const auto clip = retarget(raw, own_names(), skeleton);
  ASSERT_TRUE(clip) << to_string(clip.error());
  EXPECT_TRUE(faults(*clip).empty()) << faults(*clip).front();
}

TEST(Retarget, AFootRolledUpsideDownIsRolledBack) {
  const Skeleton skeleton = canonical_skeleton();
  const std::vector<Pose> poses = standing_work(skeleton);
  RawClip raw = capture_of(skeleton, poses, {}, 1);
  const auto right = retarget(raw, own_names(), skeleton);
  for (std::size_t f = 0; f < raw.frames; ++f)
    raw.rotation[raw.at(f, index(Joint::left_foot))] *= glm::angleAxis(kPi, kForward);
  const auto rolled = retarget(raw, own_names(), skeleton);
  ASSERT_TRUE(right && rolled);
  for (std::size_t i = 0; i < right->frames.size(); i += 20) {
    const Quat a = world_pose(skeleton, right->frames[i]).rotation[index(Joint::left_foot)];
    const Quat b = world_pose(skeleton, rolled->frames[i]).rotation[index(Joint::left_foot)];
    EXPECT_LT(glm::length(rotation_vector(glm::inverse(a) * b)), radians(1)) << i;
  }
}

// A half turn about the foot's own bone, as two Euler angles near 180 degrees give it: the foot in
// the air points where it pointed.
TEST(Retarget, AFootRolledAboutItsBoneGoesOnPointing) {
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Pose> poses = standing_work(skeleton);
  for (std::size_t i = 40; i < 80; ++i) {  // the left knee goes up and down again
    const float lift = std::sin(kPi * static_cast<float>(i - 40) / 40.0f);
    poses[i].rotation[index(Joint::left_upper_leg)] *= glm::angleAxis(-radians(60) * lift, kLeft);
    poses[i].rotation[index(Joint::left_lower_leg)] *= glm::angleAxis(radians(40) * lift, kLeft);
  }
  RawClip raw = capture_of(skeleton, poses, {}, 1);
  const auto right = retarget(raw, own_names(), skeleton);
  const Vec3 bone = glm::normalize(skeleton.offset[index(Joint::left_toes)]);
  for (std::size_t f = 0; f < raw.frames; ++f)
    raw.rotation[raw.at(f, index(Joint::left_foot))] *= glm::angleAxis(kPi, bone);
  const auto rolled = retarget(raw, own_names(), skeleton);
  ASSERT_TRUE(right && rolled);
  for (std::size_t i = 55; i < 65; ++i) {
    const WorldPose a = world_pose(skeleton, right->frames[i]);
    const WorldPose b = world_pose(skeleton, rolled->frames[i]);
    ASSERT_GT(a.position[index(Joint::left_foot)].y, 0.2f);
    EXPECT_LT(
        glm::distance(a.position[index(Joint::left_toes)], b.position[index(Joint::left_toes)]),
        0.003f)
        << i;
  }
}

// Forearms, shoulders and trunk of another build than ours.
Skeleton built_otherwise(float forearms, float shoulders) {
  Skeleton other = canonical_skeleton();
  for (const Side side : {Side::left, Side::right}) {
    other.offset[index(arm(side).end)] *= forearms;
    other.offset[index(arm(side).root)].x *= shoulders;
  }
  other.offset[index(Joint::chest)] *= 0.7f;
  return other;
}

// The least correlation, over both hands and all axes, of the wrists' ways from the hips.
double least_hand_correlation(const Skeleton& ours, const std::vector<Pose>& our_poses,
                              const Skeleton& theirs, const std::vector<Pose>& their_poses) {
  double least = 1;
  for (const Side side : {Side::left, Side::right})
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t hand = index(arm(side).end);
      std::vector<double> a, b;
      for (std::size_t i = 0; i < our_poses.size(); ++i) {
        const WorldPose our = world_pose(ours, our_poses[i]);
        const WorldPose their = world_pose(theirs, their_poses[i]);
        a.push_back(static_cast<double>(our.position[hand][axis] - our.position[0][axis]));
        b.push_back(static_cast<double>(their.position[hand][axis] - their.position[0][axis]));
      }
      least = std::min(least, testing::correlation(a, b));
    }
  return least;
}

// Longer arms on a shorter trunk: hands still draw the captured way.
TEST(Retarget, HandsGoTheCapturedWayWhateverTheProportions) {
  const Skeleton skeleton = canonical_skeleton();
  const Skeleton other = built_otherwise(0.75f, 1.3f);
  const std::vector<Pose> poses = standing_work(skeleton);
  const auto clip = retarget(capture_of(other, poses, {}, 1), own_names(), skeleton);
  ASSERT_TRUE(clip);
  EXPECT_GT(least_hand_correlation(skeleton, clip->frames, other, poses), 0.995);
}

// The same body, turned by a whole turn: a shift of the hands that turned with it would show.
TEST(Retarget, HandsGoTheCapturedWayInATurn) {
  const Skeleton skeleton = canonical_skeleton();
  const Skeleton other = built_otherwise(0.8f, 1.2f);
  std::vector<Pose> poses = standing_work(skeleton);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(poses.size());
    poses[i] = placed(poses[i], {0, 0, 2 * kPi * share});
  }
  const auto clip = retarget(capture_of(other, poses, {}, 1), own_names(), skeleton);
  ASSERT_TRUE(clip);
  EXPECT_GT(least_hand_correlation(skeleton, clip->frames, other, poses), 0.98);
}

// Hands that rise and sink over the hips of a body that lies down, captured with a floor that lies
// lower there than ours: it lifts the lying ones, and the standing ones go up with them.
TEST(Retarget, HandsThatTheFloorLiftsKeepTheirWay) {
  const Skeleton skeleton = canonical_skeleton();
  Clip clip;
  std::array<std::vector<Vec3>, 2> captured;
  std::vector<double> theirs;
  for (int i = 0; i < 240; ++i) {
    const float lies = glm::smoothstep(80.0f, 160.0f, static_cast<float>(i));
    Pose pose = rest_pose(skeleton);
    for (const Side side : {Side::left, Side::right})
      pose.rotation[index(arm(side).root)] =
          glm::angleAxis((side == Side::left ? -1.0f : 1.0f) * radians(70), kForward);
    pose.rotation[0] = glm::angleAxis(-lies * radians(85), kLeft);
    pose.hips.y = glm::mix(pose.hips.y, 0.1f, lies);
    const float height = glm::mix(0.02f, -0.12f, lies);
    for (std::size_t s = 0; s < 2; ++s)
      captured[s].emplace_back(s == 0 ? 0.35f : -0.35f, height, -0.1f * lies);
    theirs.push_back(static_cast<double>(height));
    clip.frames.push_back(pose);
  }
  carry_hands(skeleton, captured, clip);
  clear_floor(skeleton, clip);
  for (const Side side : {Side::left, Side::right}) {
    std::vector<double> ours;
    for (const Pose& pose : clip.frames) {
      const WorldPose world = world_pose(skeleton, pose);
      EXPECT_GT(world.position[index(arm(side).end)].y, kPalm - 0.005f);
      ours.push_back(static_cast<double>(world.position[index(arm(side).end)].y -
                                         world.position[index(leg(side).root)].y));
    }
    EXPECT_GT(testing::correlation(ours, theirs), 0.98);
  }
}

// Feet that stand for half a second each, one after the other, on the plane y = slope . place.
CapturedFeet walk_on(Vec2 slope, float step) {
  CapturedFeet feet;
  for (int k = 0; k < 8; ++k)
    for (int tick = 0; tick < 60; ++tick) {
      for (const Side side : {Side::left, Side::right}) {
        const bool stands = (k % 2 == 0) == (side == Side::left);
        const float x = side == Side::left ? 0.1f : -0.1f;
        const float z = step * static_cast<float>(k);
        const float lift = stands ? 0.0f : 0.2f;
        feet.ball[static_cast<std::size_t>(side)].emplace_back(
            x, 0.03f + slope.x * x + slope.y * z + lift, z);
      }
      feet.hips.emplace_back(0, 0.9f, 0);
    }
  return feet;
}

TEST(Retarget, ATiltedFloorIsLaidFlat) {
  const Vec2 slope(0, 0.02f);
  const CapturedFeet feet = walk_on(slope, 0.6f);
  const Quat level = floor_level(feet, {});
  const Vec3 along = level * glm::normalize(Vec3(0, slope.y, 1));
  EXPECT_NEAR(along.y, 0, 0.001);
  EXPECT_LT(glm::length(rotation_vector(level)), radians(1.3f));
}

TEST(Retarget, APersonOnOneSpotSaysNothingAboutTheFloor) {
  const CapturedFeet feet = walk_on({0, 0.05f}, 0.02f);
  const Quat level = floor_level(feet, {});
  EXPECT_LT(glm::length(rotation_vector(level)), radians(0.4f));
}

TEST(Retarget, AFootThatShiftsInAContactRestsTwice) {
  std::vector<Vec3> path;
  path.reserve(120);
  for (int i = 0; i < 120; ++i)
    path.emplace_back(0.03f * glm::smoothstep(50.0f, 70.0f, static_cast<float>(i)), 0, 0);
  const std::vector<Rest> rests = rests_of(path, 0, path.size());
  ASSERT_EQ(rests.size(), 2u);
  EXPECT_NEAR(rests[0].place.x, 0, 0.003);
  EXPECT_NEAR(rests[1].place.x, 0.03, 0.003);
  EXPECT_LE(rests[0].end, rests[1].begin);
  // Steady creeping is no rest.
  for (std::size_t i = 0; i < path.size(); ++i)
    path[i].x = 0.1f * kTickSeconds * static_cast<float>(i);
  EXPECT_TRUE(rests_of(path, 0, path.size()).empty());
}

TEST(Retarget, ACaptureOfHoursIsRefused) {
  const Skeleton skeleton = canonical_skeleton();
  RawClip raw = capture_of(skeleton, standing_work(skeleton), {}, 1);
  raw.frame_seconds = 60;
  EXPECT_FALSE(retarget(raw, own_names(), skeleton));
}

class Boxing : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kBoxing))
      GTEST_SKIP() << "no captures: apt-get install assimp-testmodels";
    raw_ = *read_bvh(kBoxing);
    const SkeletonProfile profile =
        *best_profile(*read_profiles(assets_folder() / "profiles"), raw_);
    EXPECT_EQ(profile.name, "boxing_toes");
    map_ = *map_joints(profile, raw_);
    clip_ = *retarget(raw_, profile, skeleton_);
    for (std::size_t i = 0; i < clip_.frames.size(); ++i)
      source_.push_back(raw_pose(raw_, static_cast<double>(i) / kTicksPerSecond));
  }
  Vec3 source(std::size_t i, Joint joint) const {
    const auto at = static_cast<std::size_t>(map_.source[index(joint)]);
    return map_.axes * source_[i].position[at] * map_.metres_per_unit;
  }

  Skeleton skeleton_ = canonical_skeleton();
  RawClip raw_;
  JointMap map_;
  Clip clip_;
  std::vector<RawPose> source_;
};

TEST_F(Boxing, WristsAndAnklesGoTheWayTheyWentInTheCapture) {
  for (const Joint joint :
       {Joint::left_hand, Joint::right_hand, Joint::left_foot, Joint::right_foot})
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> ours, theirs;
      for (std::size_t i = 0; i < clip_.frames.size(); ++i) {
        const WorldPose world = world_pose(skeleton_, clip_.frames[i]);
        ours.push_back(
            static_cast<double>(world.position[index(joint)][axis] - world.position[0][axis]));
        theirs.push_back(
            static_cast<double>(source(i, joint)[axis] - source(i, Joint::hips)[axis]));
      }
      EXPECT_GT(testing::correlation(ours, theirs), 0.98) << vrm_name(joint) << " axis " << axis;
    }
}

TEST_F(Boxing, FeetSkateNoMoreThanInTheCapture) {
  std::array<FootPath, 2> feet;
  std::vector<float> hips;
  for (std::size_t i = 0; i < source_.size(); ++i) {
    hips.push_back(source(i, Joint::hips).y);
    for (const Side side : {Side::left, Side::right}) {
      feet[static_cast<std::size_t>(side)].ankle.push_back(source(i, leg(side).end));
      feet[static_cast<std::size_t>(side)].toes.push_back(source(i, toes(side)));
    }
  }
  EXPECT_LE(foot_skate_ratio(skeleton_, clip_.frames, 120),
            foot_skate_ratio(feet, hips, 120) + 0.005);
}

TEST_F(Boxing, PlantedFeetDoNotMoveAndNothingSinksIntoTheFloor) {
  for (std::size_t i = 1; i < clip_.frames.size(); ++i) {
    const WorldPose before = world_pose(skeleton_, clip_.frames[i - 1]);
    const WorldPose world = world_pose(skeleton_, clip_.frames[i]);
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t ball = index(toes(side));
      EXPECT_GT(world.position[ball].y, skeleton_.toe_height() - 0.002f) << i;
      EXPECT_GT(world.position[index(arm(side).end)].y, 0.02f) << i;
      if (clip_.contacts[i].of(side) && clip_.contacts[i - 1].of(side)) {
        EXPECT_LT(glm::distance(world.position[ball], before.position[ball]), 0.001f) << i;
      }
    }
  }
}

TEST_F(Boxing, NoKneePops) {
  // The largest jerk of a knee within two ticks is that of the capture, give or take a fifth.
  float ours = 0;
  float theirs = 0;
  const auto bend = [](Vec3 a, Vec3 b, Vec3 c) {
    return std::acos(
        glm::clamp(glm::dot(glm::normalize(a - b), glm::normalize(c - b)), -1.0f, 1.0f));
  };
  for (const Side side : {Side::left, Side::right}) {
    std::vector<float> mine, their;
    const Limb limb = leg(side);
    for (std::size_t i = 0; i < clip_.frames.size(); ++i) {
      const WorldPose world = world_pose(skeleton_, clip_.frames[i]);
      mine.push_back(bend(world.position[index(limb.root)], world.position[index(limb.middle)],
                          world.position[index(limb.end)]));
      their.push_back(bend(source(i, limb.root), source(i, limb.middle), source(i, limb.end)));
    }
    for (std::size_t i = 1; i + 1 < mine.size(); ++i) {
      ours = std::max(ours, std::abs(mine[i + 1] - 2 * mine[i] + mine[i - 1]));
      theirs = std::max(theirs, std::abs(their[i + 1] - 2 * their[i] + their[i - 1]));
    }
  }
  EXPECT_LT(ours, 1.2f * theirs);
}

TEST_F(Boxing, ElbowsAndKneesFlexAboutTheirHinges) {
  int bent = 0;
  int off = 0;
  for (const Pose& pose : clip_.frames)
    for (const Side side : {Side::left, Side::right})
      for (const Limb& limb : {arm(side), leg(side)}) {
        const Vec3 bone = glm::normalize(skeleton_.offset[index(limb.end)]);
        const Vec3 hinge = limb.root == leg(side).root ? kLeft : (side == Side::left ? -kUp : kUp);
        const Vec3 axis = glm::cross(bone, pose.rotation[index(limb.middle)] * bone);
        if (glm::length(axis) < std::sin(radians(35))) continue;
        ++bent;
        off += glm::dot(glm::normalize(axis), hinge) < std::cos(radians(10)) ? 1 : 0;
      }
  EXPECT_GT(bent, 1000);
  EXPECT_LT(off, bent / 100);
}

}  // namespace
}  // namespace ringcraft
