#pragma once
// The body model: masses, capsules and joint limits from height and mass (de Leva 1996).

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/pose.h"

namespace ringcraft {

// Parts of the ragdoll: VRM's 15 required bones plus chest and neck. Parents stand before children.
enum class Part : std::uint8_t {
  pelvis,
  abdomen,
  chest,
  neck,
  head,
  left_upper_arm,
  left_forearm,
  left_hand,
  right_upper_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shin,
  left_foot,
  right_thigh,
  right_shin,
  right_foot,
};
inline constexpr std::size_t kPartCount = 17;
constexpr std::size_t index(Part part) {
  return static_cast<std::size_t>(part);
}
constexpr Part part_at(std::size_t i) {
  return static_cast<Part>(i);
}

std::string_view name_of(Part part);       // "leftForearm"
Joint joint_of(Part part);                 // the canonical joint at the part's root end
std::optional<Part> part_of(Joint joint);  // the part that a joint moves (toes move the foot)
int parent_of(Part part);                  // index of the parent part, -1 for the pelvis
Part mirrored(Part part);
bool is_guard_part(Part part);  // hands (gloves) and forearms

enum class Sex : std::uint8_t { male, female };

struct BodySpec {
  std::string name = "middleweight";
  float height = 1.78f;  // m, 1.2 .. 2.3
  float mass = 75.0f;    // kg, 30 .. 200
  Sex sex = Sex::male;
  float toughness = 1.0f;  // scales the head rotation that knocks out; 1 is realistic
};

struct Capsule {
  Vec3 a{}, b{};     // ends of the axis, m
  float radius = 0;  // m
};
using BodyCapsules = std::array<Capsule, kPartCount>;

struct PartModel {
  float mass = 0;  // kg
  Vec3 center{};   // centre of mass in the joint's rest frame, m
  Vec3 inertia{};  // principal moments about it, kg m2, in the joint's rest frame axes
  Vec3 capsule_a{}, capsule_b{};  // axis ends in the joint's rest frame, m
  float radius = 0;               // m
};

struct BodyModel {
  BodySpec spec;
  Skeleton skeleton;  // canonical_skeleton(spec.height)
  float scale = 1;    // spec.height / kCanonicalHeight
  std::array<PartModel, kPartCount> parts;
};

// Any spec within the ranges that BodySpec states, which read_body() holds a file to; not checked
// here.
BodyModel make_body(const BodySpec& spec);

BodyCapsules capsules(const BodyModel& body, const WorldPose& world);
Vec3 center_of_mass(const BodyModel& body, const WorldPose& world);

// Joints beyond their range (docs/sources.md, V3), and by how much. Used by quality and by tests.
struct LimitViolation {
  Joint joint;
  float excess = 0;  // rad beyond the range
};
std::vector<LimitViolation> limit_violations(const BodyModel& body, const Pose& pose,
                                             float tolerance);

// The pose with every joint brought back to at most `tolerance` (rad) beyond its range, by the
// shortest way toward the middle of the range. A shoulder that has turned over stays on the side it
// was on `before`.
Pose within_limits(const BodyModel& body, const Pose& pose, float tolerance, const Pose& before);

}  // namespace ringcraft
