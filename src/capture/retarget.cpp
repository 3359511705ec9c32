#include "capture/retarget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr std::size_t at(Side side) {
  return static_cast<std::size_t>(side);
}

constexpr double kLongestCapture = 1800;  // s: what is read cannot exhaust the program

// How the capture's rest pose is laid on ours: per joint, the rotation that turns our rest bone to
// its.
struct RestFit {
  JointMap map;
  std::array<Quat, kJointCount> bone{};
  std::array<Vec3, 2> foot{kForward, kForward};  // per side, the captured foot's bone in ours
  float scale = 1;                               // file units to metres of the body it goes to
  Quat level{1, 0, 0, 0};  // turns the capture's floor, as its feet found it, to ours
};

Vec3 rest_bone(const RawPose& rest, const JointMap& map, Joint from, Joint to) {
  const int a = map.source[index(from)];
  const int b = map.source[index(to)];
  if (a < 0 || b < 0) return {};
  return map.rest *
         (rest.position[static_cast<std::size_t>(b)] - rest.position[static_cast<std::size_t>(a)]);
}

constexpr std::size_t kSamples = 200;  // of the motion, that tell how bones are rolled

RawPose sampled(const RawClip& raw, std::size_t i) {
  return raw_pose(raw, raw.seconds() * static_cast<double>(i) / kSamples);
}

// The axis of a limb's hinge (ik.h) in the rest pose, our axes: what its middle joint bends
// about in the motion, seen from its upper bone. Zero for one that never bends.
Vec3 hinge_of(const RawClip& raw, const JointMap& map, const Limb& limb) {
  const auto joint = [&](Joint j) { return static_cast<std::size_t>(map.source[index(j)]); };
  Vec3 sum{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const RawPose pose = sampled(raw, i);
    const Vec3 middle = pose.position[joint(limb.middle)];
    const Vec3 upper = normalized_or(middle - pose.position[joint(limb.root)], Vec3(0));
    const Vec3 lower = normalized_or(pose.position[joint(limb.end)] - middle, Vec3(0));
    sum += glm::inverse(pose.rotation[joint(limb.root)]) * glm::cross(upper, lower);
  }
  return map.rest * sum;
}

// Where the chest looks, our axes, seen from a collar bone in the rest pose: the mean of the
// motion.
Vec3 forward_of_chest(const RawClip& raw, const JointMap& map, Joint shoulder) {
  const int own = map.source[index(shoulder)];
  const int chest = map.source[index(Joint::upper_chest)];
  if (own < 0 || chest < 0) return {};
  Vec3 sum{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    const RawPose pose = sampled(raw, i);
    sum += glm::inverse(pose.rotation[static_cast<std::size_t>(own)]) *
           (pose.rotation[static_cast<std::size_t>(chest)] * (glm::inverse(map.rest) * kForward));
  }
  return map.rest * sum;
}

// Turns a bone and an axis across it to another bone and its axis.
Quat bone_and_axis_between(Vec3 bone, Vec3 axis, Vec3 to_bone, Vec3 to_axis) {
  const auto frame = [](Vec3 along, Vec3 about) {
    const Vec3 x = glm::normalize(along);
    const Vec3 y = normalized_or(about - x * glm::dot(x, about), Vec3(0));
    return glm::mat3(x, y, glm::cross(x, y));
  };
  if (glm::length(glm::cross(to_bone, to_axis)) <= 1e-3f * glm::length(to_bone))
    return rotation_between(bone, to_bone);
  return glm::normalize(
      glm::quat_cast(frame(to_bone, to_axis) * glm::transpose(frame(bone, axis))));
}

// A rest pose in which all bones lie one along the other, as of skeletons whose joints look along
// their bones (LaFAN1's): how a bone is rolled there, the hinges in the motion tell.
void lay_along(const RawClip& raw, const Skeleton& target, RestFit& fit) {
  const JointMap& map = fit.map;
  const RawPose rest = raw_rest_pose(raw);
  const auto lay = [&](Joint bone, Vec3 ours, Vec3 hinge, Vec3 theirs, Vec3 their_hinge) {
    fit.bone[index(bone)] = bone_and_axis_between(ours, hinge, theirs, their_hinge);
  };
  for (const Side side : {Side::left, Side::right}) {
    for (const Limb& limb : {arm(side), leg(side)}) {
      const Vec3 their_hinge = hinge_of(raw, map, limb);
      const Vec3 lower = rest_bone(rest, map, limb.middle, limb.end);
      const Vec3 hinge = hinge_axis(limb);
      lay(limb.root, target.offset[index(limb.middle)], hinge,
          rest_bone(rest, map, limb.root, limb.middle), their_hinge);
      lay(limb.middle, target.offset[index(limb.end)], hinge, lower, their_hinge);
      fit.bone[index(limb.end)] = fit.bone[index(limb.middle)];
      if (limb.root == arm(side).root) continue;
      const Vec3 drawn = rest_bone(rest, map, limb.end, toes(side));
      const Vec3 foot = glm::length(drawn) > 0 ? drawn : lower;
      lay(limb.end, target.offset[index(toes(side))], hinge, foot, their_hinge);
      lay(toes(side), kForward, hinge, foot, their_hinge);
      fit.foot[at(side)] = glm::normalize(target.offset[index(toes(side))]);
    }
    const Joint root = arm(side).root;
    const Joint shoulder = joint_at(static_cast<std::size_t>(kParent[index(root)]));
    lay(shoulder, target.offset[index(root)], kForward, rest_bone(rest, map, shoulder, root),
        forward_of_chest(raw, map, shoulder));
  }
}

// How the trunk rests on the hips, from ours: bent or turned where the rest pose is a moment of
// some motion. The identity where it is nearly ours.
Quat rest_of_trunk(const RawPose& rest, const JointMap& map, const Skeleton& target) {
  constexpr float kUpright = radians(20);
  constexpr float kShort = 0.5f;  // of the way from the hips: too near the arms to say
  const WorldPose ours = world_pose(target, rest_pose(target));
  const auto way = [&](Joint from) {
    return 0.5f * (rest_bone(rest, map, from, Joint::left_upper_arm) +
                   rest_bone(rest, map, from, Joint::right_upper_arm));
  };
  Joint from = Joint::spine;
  while (from != Joint::neck && map.source[index(from)] < 0) from = joint_at(index(from) + 1);
  if (from == Joint::neck || glm::length(way(from)) < kShort * glm::length(way(Joint::hips)))
    from = Joint::hips;
  const Vec3 trunk = 0.5f * (ours.position[index(Joint::left_upper_arm)] +
                             ours.position[index(Joint::right_upper_arm)]) -
                     ours.position[index(from)];
  const Quat turn = bone_and_axis_between(
      trunk, kLeft, way(from), rest_bone(rest, map, Joint::right_upper_arm, Joint::left_upper_arm));
  return glm::length(rotation_vector(turn)) < kUpright ? Quat(1, 0, 0, 0) : turn;
}

Result<RestFit> lay_on(const RawClip& raw, const SkeletonProfile& profile, const Skeleton& target) {
  auto map = map_joints(profile, raw);
  if (!map) return tl::unexpected(map.error());
  RestFit fit;
  fit.map = *map;
  const RawPose rest = raw_rest_pose(raw);
  const Quat trunk = map->stands ? rest_of_trunk(rest, *map, target) : Quat(1, 0, 0, 0);
  for (std::size_t j = index(Joint::spine); j <= index(Joint::head); ++j) fit.bone[j] = trunk;
  float leg_units = 0;
  for (const Side side : {Side::left, Side::right}) {
    const Joint root = arm(side).root;
    fit.bone[static_cast<std::size_t>(kParent[index(root)])] = trunk;
    for (const Limb& limb : {arm(side), leg(side)}) {
      const Vec3 upper = rest_bone(rest, *map, limb.root, limb.middle);
      const Vec3 lower = rest_bone(rest, *map, limb.middle, limb.end);
      const Quat carried = limb.root == root ? trunk : Quat(1, 0, 0, 0);
      const auto laid = [&](Joint to, Vec3 bone) {
        return rotation_between(carried * target.offset[index(to)], bone) * carried;
      };
      fit.bone[index(limb.root)] = laid(limb.middle, upper);
      fit.bone[index(limb.middle)] = laid(limb.end, lower);
    }
    // A hand goes on as its forearm rests. A foot rests flat, whatever bone the file draws in it,
    // and only its way over the ground is laid on.
    fit.bone[index(arm(side).end)] = fit.bone[index(arm(side).middle)];
    const Vec3 foot = rest_bone(rest, *map, leg(side).end, toes(side));
    if (glm::length(Vec3(foot.x, 0, foot.z)) > 0.3f * glm::length(foot)) {
      fit.bone[index(leg(side).end)] = yaw_rotation(yaw_of(foot));
      fit.bone[index(toes(side))] = fit.bone[index(leg(side).end)];
      fit.foot[at(side)] = glm::inverse(fit.bone[index(leg(side).end)]) * glm::normalize(foot);
    }
    leg_units += 0.5f * (glm::length(rest_bone(rest, *map, leg(side).root, leg(side).middle)) +
                         glm::length(rest_bone(rest, *map, leg(side).middle, leg(side).end)));
  }
  fit.scale = target.leg_length() / leg_units;
  if (!fit.map.stands) lay_along(raw, target, fit);
  return fit;
}

// Trunk joints the capture does not have share the turn between those it has, by bone length.
void fill_trunk(const Skeleton& target, const JointMap& map, std::array<Quat, kJointCount>& world) {
  const std::size_t last = index(Joint::head);
  for (std::size_t j = 1; j <= last; ++j) {
    if (map.source[j] >= 0) continue;
    std::size_t above = j + 1;
    while (above <= last && map.source[above] < 0) ++above;
    // The chest carries the arms: a trunk joint takes nothing from neck and head.
    if (above > last || (above >= index(Joint::neck) && j < index(Joint::neck))) {
      world[j] = world[j - 1];
      continue;
    }
    float way = 0;
    for (std::size_t k = j + 1; k <= above; ++k) way += glm::length(target.offset[k]);
    const float step = glm::length(target.offset[j]);
    world[j] =
        glm::slerp(world[j - 1], in_hemisphere_of(world[above], world[j - 1]), step / (step + way));
  }
}

// Some captures roll a foot by half a turn about its length (two Euler angles near 180 degrees, as
// HDM05 has them): no foot's sole faces up its own shin. Such a foot is rolled back about `bones`,
// which so go on pointing where they point.
void turn_soles_down(const std::array<Vec3, 2>& bones, std::array<Quat, kJointCount>& world) {
  constexpr float kUpsideDown = -0.2f;  // cosine between the instep and the shin
  for (const Side side : {Side::left, Side::right}) {
    const Quat& shin = world[index(leg(side).middle)];
    Quat& foot = world[index(leg(side).end)];
    if (glm::dot(shin * kUp, foot * kUp) > kUpsideDown) continue;
    const Quat roll = glm::angleAxis(kPi, bones[at(side)]);
    foot = foot * roll;
    world[index(toes(side))] = world[index(toes(side))] * roll;
  }
}

// Where a joint of the capture is, in our axes and at our size.
Vec3 place_of(const RestFit& fit, const RawPose& source, Joint joint) {
  return fit.level * fit.map.axes *
         source.position[static_cast<std::size_t>(fit.map.source[index(joint)])] * fit.scale;
}

Vec3 place_of_hips(const RestFit& fit, const RawPose& source) {
  return 0.5f * (place_of(fit, source, Joint::left_upper_leg) +
                 place_of(fit, source, Joint::right_upper_leg));
}

Pose pose_from(const Skeleton& target, const RestFit& fit, const RawPose& source) {
  const Quat back = glm::inverse(fit.map.rest);
  std::array<Quat, kJointCount> world{};
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (fit.map.source[j] >= 0)
      world[j] = fit.level * fit.map.axes *
                 source.rotation[static_cast<std::size_t>(fit.map.source[j])] * back * fit.bone[j];
  fill_trunk(target, fit.map, world);
  for (std::size_t j = index(Joint::left_shoulder); j < kJointCount; ++j)
    if (fit.map.source[j] < 0) world[j] = world[static_cast<std::size_t>(kParent[j])];
  turn_soles_down(fit.foot, world);

  Pose pose;
  pose.rotation[0] = glm::normalize(world[0]);
  for (std::size_t j = 1; j < kJointCount; ++j)
    pose.rotation[j] =
        glm::normalize(glm::inverse(world[static_cast<std::size_t>(kParent[j])]) * world[j]);
  // The middle of the hip joints, which every skeleton has; where "hips" sits differs.
  const Vec3 sockets = 0.5f * (target.offset[index(Joint::left_upper_leg)] +
                               target.offset[index(Joint::right_upper_leg)]);
  pose.hips = place_of_hips(fit, source) - world[0] * sockets;
  return pose;
}

// Takes the tremble out of a path (above about 13 Hz). Hips and ankles alike: a foot that is held
// would pass what only one of them has on to the knee.
constexpr float kTrembleSigma = 0.012f;  // s

void calm_hips(Clip& clip) {
  std::vector<Vec3> path;
  path.reserve(clip.frames.size());
  for (const Pose& pose : clip.frames) path.push_back(pose.hips);
  path = smoothed(path, kTrembleSigma);
  for (std::size_t i = 0; i < path.size(); ++i) clip.frames[i].hips = path[i];
}

}  // namespace

Result<Clip> retarget(const RawClip& raw, const SkeletonProfile& profile, const Skeleton& target,
                      const RetargetSettings& settings) {
  if (raw.frames < 2)
    return input_error(raw.file, "", "a capture of one frame is no motion",
                       "give a longer capture");
  if (raw.seconds() > kLongestCapture)
    return input_error(raw.file, "",
                       fmt::format("a capture of {:.0f} s is longer than {:.0f} s", raw.seconds(),
                                   kLongestCapture),
                       "cut the file into shorter ones");
  auto fit = lay_on(raw, profile, target);
  if (!fit) return tl::unexpected(fit.error());
  const auto count = static_cast<std::size_t>(std::floor(raw.seconds() * kTicksPerSecond)) + 1;
  const auto moment = [&](std::size_t i) {
    return raw_pose(raw, static_cast<double>(i) / kTicksPerSecond);
  };
  CapturedFeet feet;
  feet.has_toes = fit->map.source[index(Joint::left_toes)] >= 0 &&
                  fit->map.source[index(Joint::right_toes)] >= 0;
  for (std::size_t i = 0; i < count; ++i) {
    const RawPose source = moment(i);
    for (const Side side : {Side::left, Side::right}) {
      const bool has_toes = fit->map.source[index(toes(side))] >= 0;
      feet.ball[at(side)].push_back(place_of(*fit, source, has_toes ? toes(side) : leg(side).end));
    }
    feet.hips.push_back(place_of_hips(*fit, source));
  }
  Clip clip;
  fit->level = floor_level(feet, settings);
  for (auto& path : feet.ball)
    for (Vec3& p : path) p = fit->level * p;
  clip.contacts = contacts_of(feet, settings);
  std::array<std::vector<Vec3>, 2> hands;
  for (std::size_t i = 0; i < count; ++i) {
    const RawPose source = moment(i);
    clip.frames.push_back(pose_from(target, *fit, source));
    feet.hips[i] = place_of_hips(*fit, source);
    for (const Side side : {Side::left, Side::right}) {
      hands[at(side)].push_back(place_of(*fit, source, arm(side).end) - feet.hips[i]);
      feet.ankle[at(side)].push_back(place_of(*fit, source, leg(side).end));
    }
  }
  if (clip.frames.size() < 2)
    return input_error(raw.file, "", "a capture shorter than a tick is no motion",
                       "give a longer capture");
  clip.root.assign(clip.frames.size(), Placement{});
  turn_to_hinges(target, clip);
  stand_on_floor(target, feet, clip);
  carry_hands(target, hands, clip);
  calm_hips(clip);
  for (auto& path : feet.ankle) path = smoothed(path, kTrembleSigma);
  carry_feet(target, feet, clip);
  clear_floor(target, clip);
  fit_wrists(clip);
  RetargetSettings planting = settings;
  // Without toes the height of a ball of the foot is a guess, and says nothing about the floor.
  if (!feet.has_toes) {
    planting.floor_play = 0;
    planting.guessed_balls = true;
  }
  plant_feet(target, clip, planting);
  unroll_rotations(clip);
  return clip;
}

}  // namespace ringcraft
