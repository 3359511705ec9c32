#include "capture/retarget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr double kLongestCapture = 1800;  // s: what is read cannot exhaust the program

// How the capture's rest pose is laid on ours: per joint, the rotation that turns our rest bone to
// its.
struct RestFit {
  JointMap map;
  std::array<Quat, kJointCount> bone{};
  float scale = 1;  // file units to metres of the body it goes to
};

Vec3 rest_bone(const RawPose& rest, const JointMap& map, Joint from, Joint to) {
  const int a = map.source[index(from)];
  const int b = map.source[index(to)];
  if (a < 0 || b < 0) return {};
  return map.axes *
         (rest.position[static_cast<std::size_t>(b)] - rest.position[static_cast<std::size_t>(a)]);
}

Result<RestFit> lay_on(const RawClip& raw, const SkeletonProfile& profile, const Skeleton& target) {
  auto map = map_joints(profile, raw);
  if (!map) return tl::unexpected(map.error());
  RestFit fit;
  fit.map = *map;
  const RawPose rest = raw_rest_pose(raw);
  float leg_units = 0;
  for (const Side side : {Side::left, Side::right}) {
    for (const Limb& limb : {arm(side), leg(side)}) {
      const Vec3 upper = rest_bone(rest, *map, limb.root, limb.middle);
      const Vec3 lower = rest_bone(rest, *map, limb.middle, limb.end);
      fit.bone[index(limb.root)] = rotation_between(target.offset[index(limb.middle)], upper);
      fit.bone[index(limb.middle)] = rotation_between(target.offset[index(limb.end)], lower);
    }
    // A hand goes on as its forearm rests. A foot rests flat, whatever bone the file draws in it,
    // and only its way over the ground is laid on.
    fit.bone[index(arm(side).end)] = fit.bone[index(arm(side).middle)];
    const Vec3 foot = rest_bone(rest, *map, leg(side).end, toes(side));
    if (glm::length(Vec3(foot.x, 0, foot.z)) > 0.3f * glm::length(foot)) {
      fit.bone[index(leg(side).end)] = yaw_rotation(yaw_of(foot));
      fit.bone[index(toes(side))] = fit.bone[index(leg(side).end)];
    }
    leg_units += 0.5f * (glm::length(rest_bone(rest, *map, leg(side).root, leg(side).middle)) +
                         glm::length(rest_bone(rest, *map, leg(side).middle, leg(side).end)));
  }
  fit.scale = target.leg_length() / leg_units;
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
// HDM05 has them): no foot's sole faces up its own shin. Such a foot is rolled back.
void turn_soles_down(std::array<Quat, kJointCount>& world) {
  constexpr float kUpsideDown = -0.2f;  // cosine between the instep and the shin
  for (const Side side : {Side::left, Side::right}) {
    const Quat& shin = world[index(leg(side).middle)];
    Quat& foot = world[index(leg(side).end)];
    if (glm::dot(shin * kUp, foot * kUp) > kUpsideDown) continue;
    const Quat roll = glm::angleAxis(kPi, kForward);
    foot = foot * roll;
    world[index(toes(side))] = world[index(toes(side))] * roll;
  }
}

Pose pose_from(const Skeleton& target, const RestFit& fit, const RawPose& source) {
  const Quat back = glm::inverse(fit.map.axes);
  std::array<Quat, kJointCount> world{};
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (fit.map.source[j] >= 0)
      world[j] = fit.map.axes * source.rotation[static_cast<std::size_t>(fit.map.source[j])] *
                 back * fit.bone[j];
  fill_trunk(target, fit.map, world);
  for (std::size_t j = index(Joint::left_shoulder); j < kJointCount; ++j)
    if (fit.map.source[j] < 0) world[j] = world[static_cast<std::size_t>(kParent[j])];
  turn_soles_down(world);

  Pose pose;
  const auto socket = [&](Joint joint) {
    return source.position[static_cast<std::size_t>(fit.map.source[index(joint)])];
  };
  // The middle of the hip joints, which every skeleton has; where "hips" sits differs.
  pose.hips = fit.map.axes * (socket(Joint::left_upper_leg) + socket(Joint::right_upper_leg)) *
              0.5f * fit.scale;
  pose.rotation[0] = glm::normalize(world[0]);
  for (std::size_t j = 1; j < kJointCount; ++j)
    pose.rotation[j] =
        glm::normalize(glm::inverse(world[static_cast<std::size_t>(kParent[j])]) * world[j]);
  return pose;
}

Vec3 wrist_off_hips(const RestFit& fit, const RawPose& source, Side side) {
  const auto place = [&](Joint joint) {
    return source.position[static_cast<std::size_t>(fit.map.source[index(joint)])];
  };
  const Vec3 hips = 0.5f * (place(Joint::left_upper_leg) + place(Joint::right_upper_leg));
  return fit.map.axes * (place(arm(side).end) - hips) * fit.scale;
}

// Takes the tremble out of the hips' path (above about 13 Hz): feet that are held would pass it on
// to the knees.
void calm_hips(Clip& clip) {
  std::vector<Vec3> path;
  for (const Pose& pose : clip.frames) path.push_back(pose.hips);
  path = smoothed(path, 0.012f);
  for (std::size_t i = 0; i < path.size(); ++i) clip.frames[i].hips = path[i];
}

// The height of the floor: where the balls of the planted feet stand, the median over both.
float floor_height(const Skeleton& target, const Clip& clip) {
  std::vector<float> heights;
  std::vector<float> all;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const WorldPose world = world_pose(target, clip.frames[i]);
    for (const Side side : {Side::left, Side::right}) {
      const float ball = world.position[index(toes(side))].y - target.toe_height();
      all.push_back(ball);
      if (clip.contacts[i].of(side)) heights.push_back(ball);
    }
  }
  std::vector<float>& used = heights.empty() ? all : heights;
  // Without contacts (a clip in the air) the lowest twentieth stands for the floor.
  const std::size_t at = heights.empty() ? used.size() / 20 : used.size() / 2;
  std::nth_element(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(at), used.end());
  return used[at];
}

}  // namespace

std::vector<FootContacts> capture_contacts(const RawClip& raw, const JointMap& map, float scale,
                                           const RetargetSettings& settings) {
  const auto count = static_cast<std::size_t>(std::floor(raw.seconds() * kTicksPerSecond)) + 1;
  std::vector<FootContacts> contacts(count);
  std::array<std::vector<Vec3>, 2> ball;
  for (std::size_t i = 0; i < count; ++i) {
    const RawPose pose = raw_pose(raw, static_cast<double>(i) / kTicksPerSecond);
    for (const Side side : {Side::left, Side::right}) {
      int joint = map.source[index(toes(side))];
      if (joint < 0) joint = map.source[index(leg(side).end)];
      ball[static_cast<std::size_t>(side)].push_back(
          map.axes * pose.position[static_cast<std::size_t>(joint)] * scale);
    }
  }
  for (const Side side : {Side::left, Side::right}) {
    const std::vector<Vec3>& path = ball[static_cast<std::size_t>(side)];
    std::vector<float> heights;
    heights.reserve(path.size());
    for (const Vec3& p : path) heights.push_back(p.y);
    const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
    std::nth_element(heights.begin(), low, heights.end());
    std::vector<bool> planted(count);
    bool carries = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = i >= 2 ? i - 2 : 0;
      const std::size_t after = std::min(i + 2, count - 1);
      const float elapsed =
          static_cast<float>(std::max<std::size_t>(1, after - before)) * kTickSeconds;
      const float speed = glm::distance(path[before], path[after]) / elapsed;
      carries = path[i].y < *low + settings.contact_height &&
                speed < (carries ? settings.release_speed : settings.contact_speed);
      planted[i] = carries;
    }
    close_short_runs(planted, false, 5);
    close_short_runs(planted, true, 8);
    for (std::size_t i = 0; i < count; ++i)
      (side == Side::left ? contacts[i].left : contacts[i].right) = planted[i];
  }
  return contacts;
}

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
  Clip clip;
  clip.contacts = capture_contacts(raw, fit->map, fit->scale, settings);
  std::array<std::vector<Vec3>, 2> hands;
  for (std::size_t i = 0; i < clip.contacts.size(); ++i) {
    const RawPose source = raw_pose(raw, static_cast<double>(i) / kTicksPerSecond);
    clip.frames.push_back(pose_from(target, *fit, source));
    for (const Side side : {Side::left, Side::right})
      hands[static_cast<std::size_t>(side)].push_back(wrist_off_hips(*fit, source, side));
  }
  if (clip.frames.size() < 2)
    return input_error(raw.file, "", "a capture shorter than a tick is no motion",
                       "give a longer capture");
  clip.root.assign(clip.frames.size(), Placement{});
  turn_to_hinges(target, clip);
  carry_hands(target, hands, clip);
  const float floor = floor_height(target, clip);
  for (Pose& pose : clip.frames) pose.hips.y -= floor;
  calm_hips(clip);
  clear_floor(target, clip);
  fit_wrists(clip);
  plant_feet(target, clip, settings);
  unroll_rotations(clip);
  return clip;
}

}  // namespace ringcraft
