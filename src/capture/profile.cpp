#include "capture/profile.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "base/document.h"
#include "base/file.h"

namespace ringcraft {
namespace {

constexpr float kShortestLeg = 0.45f;  // m, hip to ankle
constexpr float kLongestLeg = 1.25f;

Vec3 axis_from(const std::string& text) {
  Vec3 axis{};
  axis[text.at(1) - 'x'] = text.at(0) == '-' ? -1.0f : 1.0f;
  return axis;
}

std::string_view without_prefix(const SkeletonProfile& profile, std::string_view name) {
  for (const std::string& prefix : profile.prefixes)
    if (name.starts_with(prefix)) return name.substr(prefix.size());
  return name;
}

// A joint named with the prefix goes before a bare one of the same name (MASS has both "Spine" and
// "Character1_Spine").
int find_joint(const SkeletonProfile& profile, const RawClip& clip, const std::string& wanted) {
  int bare = -1;
  for (std::size_t j = 0; j < clip.joints.size(); ++j) {
    const std::string_view name = clip.joints[j].name;
    if (without_prefix(profile, name) != wanted) continue;
    if (name != wanted) return static_cast<int>(j);
    if (bare < 0) bare = static_cast<int>(j);
  }
  return bare;
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
  std::array<int, kJointCount> found{};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    found[j] = profile.source[j].empty() ? -1 : find_joint(profile, clip, profile.source[j]);
    const int carrier = mapped_carrier(found, j);
    if (found[j] >= 0 && carrier >= 0 && !profile.detached[j] &&
        !hangs_below(clip, found[j], carrier))
      found[j] = -1;
  }
  return found;
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
  constexpr float kLeast = 0.8f;
  const SkeletonProfile* best = nullptr;
  std::tuple<bool, float, long> best_score{false, kLeast, -1};
  for (const SkeletonProfile& profile : profiles) {
    const auto names = std::count_if(profile.source.begin(), profile.source.end(),
                                     [](const std::string& name) { return !name.empty(); });
    const float share = score(profile, clip);
    if (share < kLeast) continue;
    const std::tuple<bool, float, long> fit{map_joints(profile, clip).has_value(), share,
                                            static_cast<long>(names)};
    if (fit > best_score) {
      best_score = fit;
      best = &profile;
    }
  }
  if (best == nullptr)
    return input_error(clip.file, clip.joints.empty() ? "" : "joint " + clip.joints[0].name,
                       "no skeleton profile knows these joint names",
                       "write a profile in assets/profiles, or name one with profile = \"...\"");
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
  map.axes = axes_of(profile);

  const RawPose rest = raw_rest_pose(clip);
  const auto place = [&](Joint joint) {
    return rest.position[static_cast<std::size_t>(map.source[index(joint)])];
  };
  const float leg_units =
      glm::distance(place(Joint::left_upper_leg), place(Joint::left_lower_leg)) +
      glm::distance(place(Joint::left_lower_leg), place(Joint::left_foot));
  for (const float unit : profile.metres_per_unit) {
    const float metres = leg_units * unit;
    if (metres < kShortestLeg || metres > kLongestLeg) continue;
    map.metres_per_unit = unit;
    const Vec3 hips_line =
        map.axes * (place(Joint::left_upper_leg) - place(Joint::right_upper_leg));
    const Vec3 leg_line = map.axes * (place(Joint::left_foot) - place(Joint::left_upper_leg));
    if (leg_line.y > -0.5f * glm::length(leg_line))
      return input_error(clip.file, "",
                         fmt::format("profile {}: the legs do not point down", profile.name),
                         "correct up and forward of the profile");
    if (hips_line.x <= 0)
      return input_error(clip.file, "",
                         fmt::format("profile {}: the left leg is on the right", profile.name),
                         "correct up and forward of the profile");
    return map;
  }
  return input_error(
      clip.file, "",
      fmt::format("a leg of {} units has no human length in profile {}", leg_units, profile.name),
      "add the file's unit to metres_per_unit");
}

}  // namespace ringcraft
