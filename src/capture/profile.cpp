#include "capture/profile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/document.h"
#include "base/file.h"
#include "capture/words.h"

namespace ringcraft {
namespace {

constexpr float kShortestLeg = 0.45f;  // m, hip to ankle
constexpr float kLongestLeg = 1.25f;
constexpr float kUnits[] = {0.01f, 1.0f, 0.0254f, 0.001f, 0.0254f / 0.45f};  // m; the last CMU's

Vec3 axis_from(const std::string& text) {
  Vec3 axis{};
  axis[text.at(1) - 'x'] = text.at(0) == '-' ? -1.0f : 1.0f;
  return axis;
}

// A joint's name without its namespace, in lower case, without what files put between words: "Bip01
// L Thigh" is "Bip01_L_Thigh", "UpperLeg_L" "upperleg.l".
std::string plain_name(std::string_view name) {
  const std::size_t space = name.rfind(':');
  if (space != std::string_view::npos && space + 1 < name.size()) name.remove_prefix(space + 1);
  std::string plain = lowered(name);
  std::erase_if(plain,
                [](char c) { return std::string_view(" _-.:").find(c) != std::string::npos; });
  return plain;
}

// A joint named with a prefix goes before a bare one of the same name (MASS has both "Spine" and
// "Character1_Spine"). `prefixes` are plain.
int find_joint(const std::vector<std::string>& prefixes, const RawClip& clip,
               const std::string& wanted) {
  const std::string bare = plain_name(wanted);
  int found = -1;
  for (std::size_t j = 0; j < clip.joints.size(); ++j) {
    const std::string name = plain_name(clip.joints[j].name);
    for (const std::string& prefix : prefixes)
      if (name == prefix + bare) return static_cast<int>(j);
    if (found < 0 && name == bare) found = static_cast<int>(j);
  }
  return found;
}

// What stands before the profile's names, plain: its own prefixes, or else what stands before the
// name of the hips, as a subject's in "Bob_Hips".
std::vector<std::string> prefixes_of(const SkeletonProfile& profile, const RawClip& clip) {
  std::vector<std::string> prefixes;
  for (const std::string& prefix : profile.prefixes) prefixes.push_back(plain_name(prefix));
  const std::string& hips = profile.source[index(Joint::hips)];
  if (find_joint(prefixes, clip, hips) >= 0) return prefixes;
  for (const RawJoint& joint : clip.joints) {
    std::string name = plain_name(joint.name);
    if (!name.ends_with(plain_name(hips))) continue;
    name.resize(name.size() - plain_name(hips).size());
    return {name};
  }
  return prefixes;
}

// Whether the file's names begin as the profile's do.
bool has_prefix(const SkeletonProfile& profile, const RawClip& clip) {
  const auto begins = [&](const RawJoint& joint) {
    return std::any_of(profile.prefixes.begin(), profile.prefixes.end(),
                       [&](const std::string& prefix) { return joint.name.starts_with(prefix); });
  };
  return std::any_of(clip.joints.begin(), clip.joints.end(), begins);
}

bool hangs_below(const RawClip& clip, int joint, int carrier) {
  while (joint >= 0 && joint != carrier)
    joint = clip.joints[static_cast<std::size_t>(joint)].parent;
  return joint == carrier;
}

// The nearest joint towards the hips that the profile maps; -1 for the hips.
int mapped_carrier(const std::array<int, kJointCount>& source, std::size_t joint) {
  int at = kParent[joint];
  while (at >= 0 && source[static_cast<std::size_t>(at)] < 0)
    at = kParent[static_cast<std::size_t>(at)];
  return at < 0 ? -1 : source[static_cast<std::size_t>(at)];
}

bool needed(Joint joint) {
  for (const Side side : {Side::left, Side::right})
    for (const Limb& limb : {arm(side), leg(side)})
      if (joint == limb.root || joint == limb.middle || joint == limb.end) return true;
  return joint == Joint::hips;
}

std::array<int, kJointCount> found_joints(const SkeletonProfile& profile, const RawClip& clip) {
  const std::vector<std::string> prefixes = prefixes_of(profile, clip);
  std::array<int, kJointCount> found{};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    found[j] = profile.source[j].empty() ? -1 : find_joint(prefixes, clip, profile.source[j]);
    // A forearm whose end alone is known: the hand rests on it.
    if (found[j] < 0 && (joint_at(j) == Joint::left_hand || joint_at(j) == Joint::right_hand))
      found[j] = find_joint(prefixes, clip,
                            profile.source[static_cast<std::size_t>(kParent[j])] + kEndSite);
    const int carrier = mapped_carrier(found, j);
    if (found[j] >= 0 && carrier >= 0 && !profile.detached[j] &&
        !hangs_below(clip, found[j], carrier))
      found[j] = -1;
  }
  return found;
}

// The joint that both arms hang on is the upper chest, whatever it is called: families differ in
// how many joints a spine has, and what it says below the arms is not what carries them.
void carry_arms(const RawClip& clip, std::array<int, kJointCount>& source) {
  const auto joint = [&](Joint j) -> int& { return source[index(j)]; };
  int carrier = joint(Joint::left_upper_arm);
  while (carrier >= 0 && !hangs_below(clip, joint(Joint::right_upper_arm), carrier))
    carrier = clip.joints[static_cast<std::size_t>(carrier)].parent;
  const int below = joint(Joint::upper_chest) >= 0
                        ? joint(Joint::upper_chest)
                        : mapped_carrier(source, index(Joint::upper_chest));
  if (carrier >= 0 && carrier != below && hangs_below(clip, carrier, below))
    joint(Joint::upper_chest) = carrier;
}

// Ways through a body, file units and axes.
struct RestLines {
  Vec3 trunk;                // from between the hip joints to between the shoulders
  std::array<Vec3, 2> legs;  // from the hip joint to the ankle
  Vec3 hips;                 // from the right hip joint to the left one
};

Vec3 place_of(const RawPose& pose, const JointMap& map, Joint joint) {
  return pose.position[static_cast<std::size_t>(map.source[index(joint)])];
}

Vec3 middle(const RawPose& pose, const JointMap& map, Joint left, Joint right) {
  return 0.5f * (place_of(pose, map, left) + place_of(pose, map, right));
}

RestLines rest_lines(const RawClip& clip, const JointMap& map) {
  const RawPose rest = raw_rest_pose(clip);
  const auto way = [&](Joint from, Joint to) {
    return place_of(rest, map, to) - place_of(rest, map, from);
  };
  return {middle(rest, map, Joint::left_upper_arm, Joint::right_upper_arm) -
              middle(rest, map, Joint::left_upper_leg, Joint::right_upper_leg),
          {way(Joint::left_upper_leg, Joint::left_foot),
           way(Joint::right_upper_leg, Joint::right_foot)},
          way(Joint::right_upper_leg, Joint::left_upper_leg)};
}

// Whether both legs point down where `up` is up; they may stand astride.
bool stands_along(Vec3 up, const RestLines& lines) {
  constexpr float kStraight = 0.5f;  // cosine
  return std::all_of(lines.legs.begin(), lines.legs.end(), [&](Vec3 leg) {
    return glm::dot(up, leg) < -kStraight * glm::length(up) * glm::length(leg);
  });
}

// Whether the rest pose stands in these axes, its left on the left.
bool agrees(const Quat& axes, const RestLines& lines) {
  constexpr float kTurned = 0.87f;  // of 30 degrees
  return stands_along(glm::inverse(axes) * kUp, lines) &&
         (axes * lines.hips).x > kTurned * glm::length(lines.hips);
}

Vec3 nearest_axis(Vec3 v) {
  const Vec3 size = glm::abs(v);
  const int most = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  Vec3 axis{};
  axis[most] = v[most] < 0 ? -1.0f : 1.0f;
  return axis;
}

// Turns the rest pose's axes to ours: up where its trunk points, left where its left hip is.
std::optional<Quat> axes_of_rest(const RestLines& lines) {
  constexpr float kStraight = 0.87f;  // of 30 degrees: hips off an axis by less lie along it
  const Vec3 up = nearest_axis(lines.trunk);
  const Vec3 across = lines.hips - up * glm::dot(up, lines.hips);
  if (glm::length(across) < 0.5f * glm::length(lines.hips) || glm::length(across) == 0)
    return std::nullopt;
  Vec3 left = glm::normalize(across);
  if (glm::dot(left, nearest_axis(left)) > kStraight) left = nearest_axis(left);
  return glm::normalize(glm::quat_cast(glm::transpose(glm::mat3(left, up, glm::cross(left, up)))));
}

// The file's axis along which people stand in the motion: `said`, unless nobody does.
Vec3 up_of_motion(const RawClip& clip, const JointMap& map, Vec3 said) {
  constexpr std::size_t kSamples = 100;
  constexpr float kUpright = 0.8f;     // cosine
  constexpr float kMostTime = 0.5f;    // of the samples upright along another axis
  constexpr float kHardlyEver = 0.1f;  // along the one that was said
  std::array<std::array<float, 2>, 3> upright{};
  for (std::size_t i = 0; i < kSamples && clip.frames > 0; ++i) {
    const RawPose pose = raw_pose(clip, clip.seconds() * static_cast<double>(i) / kSamples);
    const Vec3 body = middle(pose, map, Joint::left_upper_arm, Joint::right_upper_arm) -
                      middle(pose, map, Joint::left_foot, Joint::right_foot);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(body[static_cast<int>(axis)]) > kUpright * glm::length(body))
        upright[axis][body[static_cast<int>(axis)] < 0] += 1.0f / kSamples;
  }
  Vec3 up = said;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      Vec3 other{};
      other[axis] = sign;
      const float share = upright[static_cast<std::size_t>(axis)][sign < 0];
      if (share > kMostTime) up = other;
      if (other == said && share > kHardlyEver) return said;
    }
  return up;
}

// The profile's own units, then those that files come in.
Result<float> unit_of(const SkeletonProfile& profile, const RawClip& clip, const JointMap& map) {
  const RawPose rest = raw_rest_pose(clip);
  const Vec3 knee = place_of(rest, map, Joint::left_lower_leg);
  const float leg = glm::distance(place_of(rest, map, Joint::left_upper_leg), knee) +
                    glm::distance(knee, place_of(rest, map, Joint::left_foot));
  std::vector<float> units = profile.metres_per_unit;
  units.insert(units.end(), std::begin(kUnits), std::end(kUnits));
  for (const float unit : units)
    if (leg * unit >= kShortestLeg && leg * unit <= kLongestLeg) return unit;
  return input_error(clip.file, "",
                     fmt::format("a leg of {} units has no human length in any unit of captures "
                                 "and none of profile {}",
                                 leg, profile.name),
                     "add the file's unit to metres_per_unit");
}

// Says what the nearest profile lacks, where one comes near.
tl::unexpected<Error> unknown_names(const std::vector<SkeletonProfile>& profiles,
                                    const RawClip& clip) {
  constexpr std::size_t kFew = 6;  // of the 13 bones that are needed
  const SkeletonProfile* nearest = nullptr;
  std::vector<std::string> missing;
  std::pair<std::size_t, long> fewest{kFew + 1, 0};  // missing, all found
  for (const SkeletonProfile& profile : profiles) {
    const auto found = found_joints(profile, clip);
    std::vector<std::string> lacks;
    for (std::size_t j = 0; j < kJointCount; ++j)
      if (needed(joint_at(j)) && found[j] < 0) lacks.push_back("'" + profile.source[j] + "'");
    const long have = static_cast<long>(kJointCount) - std::count(found.begin(), found.end(), -1);
    if (std::pair(lacks.size(), -have) >= fewest) continue;
    fewest = {lacks.size(), -have};
    missing = std::move(lacks);
    nearest = &profile;
  }
  const std::string place = clip.joints.empty() ? "" : "joint " + clip.joints[0].name;
  if (nearest == nullptr)
    return input_error(clip.file, place, "no skeleton profile knows these joint names",
                       "write a profile in assets/profiles");
  return input_error(clip.file, place,
                     fmt::format("no skeleton profile knows all of these joints; {} comes nearest "
                                 "and lacks {}",
                                 nearest->name, fmt::join(missing, ", ")),
                     "name joints so, each below the one that carries it, or write a profile in "
                     "assets/profiles");
}

}  // namespace

Result<SkeletonProfile> read_profile(const std::filesystem::path& path) {
  auto document = read_document(path, "profile");
  if (!document) return tl::unexpected(document.error());
  const nlohmann::json& value = document->value;
  SkeletonProfile profile;
  profile.name = value["name"].get<std::string>();
  for (const auto& unit : value["metres_per_unit"])
    profile.metres_per_unit.push_back(unit.get<float>());
  profile.up = axis_from(value["up"].get<std::string>());
  profile.forward = axis_from(value["forward"].get<std::string>());
  if (glm::dot(profile.up, profile.forward) != 0)
    return input_error(path.string(), document->place("/forward"), "up and forward lie on one axis",
                       "give the way the rest pose looks as forward");
  if (value.contains("prefixes"))
    for (const auto& prefix : value["prefixes"])
      profile.prefixes.push_back(prefix.get<std::string>());
  for (const auto& [bone, joint] : value["joints"].items())
    if (const auto known = joint_from_vrm_name(bone))
      profile.source[index(*known)] = joint.get<std::string>();
  if (value.contains("detached"))
    for (const auto& bone : value["detached"])
      if (const auto known = joint_from_vrm_name(bone.get<std::string>()))
        profile.detached[index(*known)] = true;
  return profile;
}

Result<std::vector<SkeletonProfile>> read_profiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code fault;
  for (std::filesystem::directory_iterator it(folder, fault), end; !fault && it != end;
       it.increment(fault))
    if (it->path().extension() == ".toml") paths.push_back(it->path());
  if (fault || paths.empty())
    return input_error(folder.string(), "", "no skeleton profiles in this folder",
                       "set RINGCRAFT_ASSETS to the folder assets");
  std::sort(paths.begin(), paths.end());
  std::vector<SkeletonProfile> profiles;
  for (const auto& path : paths) {
    auto profile = read_profile(path);
    if (!profile) return tl::unexpected(profile.error());
    profiles.push_back(std::move(*profile));
  }
  return profiles;
}

Result<SkeletonProfile> profile_named(const std::string& name) {
  const auto profiles = read_profiles(assets_folder() / "profiles");
  if (!profiles) return tl::unexpected(profiles.error());
  std::string known;
  for (const SkeletonProfile& profile : *profiles) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + profile.name;
  }
  return usage_error("", "", fmt::format("no skeleton profile is called '{}'", name),
                     "known names: " + known);
}

Quat axes_of(const SkeletonProfile& profile) {
  // Left is up x forward; the columns are where our x, y and z lie in the file.
  const glm::mat3 file_axes(glm::cross(profile.up, profile.forward), profile.up, profile.forward);
  return glm::normalize(glm::quat_cast(glm::transpose(file_axes)));
}

ForeignSkeleton foreign_skeleton(const SkeletonProfile& profile) {
  ForeignSkeleton form;
  const std::string prefix = profile.prefixes.empty() ? "" : profile.prefixes.front();
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const std::string& name = profile.source.at(i);
    if (!name.empty()) form.name.at(i) = prefix + name;
  }
  form.metres_per_unit = profile.metres_per_unit.front();
  form.axes = axes_of(profile);
  return form;
}

std::vector<std::string> people_in(const SkeletonProfile& profile, const RawClip& clip) {
  std::set<std::string> names;
  for (const RawJoint& joint : clip.joints) names.insert(plain_name(joint.name));
  const std::string hips = plain_name(profile.source[index(Joint::hips)]);
  const std::string leg = plain_name(profile.source[index(Joint::left_upper_leg)]);
  std::vector<std::string> people;
  for (const RawJoint& joint : clip.joints) {
    const std::string name = plain_name(joint.name);
    if (!name.ends_with(hips)) continue;
    const std::string prefix = name.substr(0, name.size() - hips.size());
    if (prefix == "org" || prefix == "mch") continue;  // Rigify's copies of its own bones
    // A name may end so by itself ("LeftHip"): with a person's hips there is a leg.
    if (names.contains(prefix + leg)) people.push_back(joint.name);
  }
  return people;
}

float score(const SkeletonProfile& profile, const RawClip& clip) {
  const auto found = found_joints(profile, clip);
  int listed = 0;
  int have = 0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (needed(joint_at(j)) && found[j] < 0) return 0;
    listed += profile.source[j].empty() ? 0 : 1;
    have += found[j] >= 0 ? 1 : 0;
  }
  return static_cast<float>(have) / static_cast<float>(listed);
}

Result<SkeletonProfile> best_profile(const std::vector<SkeletonProfile>& profiles,
                                     const RawClip& clip) {
  const SkeletonProfile* best = nullptr;
  std::tuple<bool, float, bool, bool, long> best_score{};
  for (const SkeletonProfile& profile : profiles) {
    const auto names = std::count_if(profile.source.begin(), profile.source.end(),
                                     [](const std::string& name) { return !name.empty(); });
    const float share = score(profile, clip);
    if (share == 0) continue;
    const auto map = map_joints(profile, clip);
    const std::tuple<bool, float, bool, bool, long> fit{
        map.has_value(), share, map && map->as_written, has_prefix(profile, clip),
        static_cast<long>(names)};
    if (fit > best_score) {
      best_score = fit;
      best = &profile;
    }
  }
  if (best == nullptr) return unknown_names(profiles, clip);
  return *best;
}

Result<JointMap> map_joints(const SkeletonProfile& profile, const RawClip& clip) {
  JointMap map;
  map.source = found_joints(profile, clip);
  for (std::size_t j = 0; j < kJointCount; ++j)
    if (needed(joint_at(j)) && map.source[j] < 0)
      return input_error(
          clip.file, fmt::format("joint {}", profile.source[j]),
          fmt::format("profile {} needs it for {}", profile.name, vrm_name(joint_at(j))),
          "use another profile");
  carry_arms(clip, map.source);
  const auto unit = unit_of(profile, clip, map);
  if (!unit) return tl::unexpected(unit.error());
  map.metres_per_unit = *unit;
  const RestLines lines = rest_lines(clip, map);
  map.stands = stands_along(lines.trunk, lines);
  map.rest = axes_of(profile);
  map.as_written = map.stands && agrees(map.rest, lines);
  if (!map.as_written) {
    const auto rest = axes_of_rest(lines);
    if (!rest)
      return input_error(clip.file, "",
                         fmt::format("profile {}: the hips have no width", profile.name),
                         "use another profile");
    map.rest = *rest;
  }
  map.axes = map.rest;
  const Vec3 said = map.stands ? glm::inverse(map.rest) * kUp : profile.up;
  const Vec3 up = up_of_motion(clip, map, said);
  if (glm::distance(map.axes * up, kUp) > 0.1f) map.axes = rotation_between(up, kUp);
  const auto& own = profile.metres_per_unit;
  map.as_written = map.as_written && std::find(own.begin(), own.end(), *unit) != own.end();
  return map;
}

}  // namespace ringcraft
