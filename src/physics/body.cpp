#include "physics/body.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {
namespace {

// One row of de Leva 1996: share of the body's mass, centre of mass as a share of
// the segment's length from its first-named end, radii of gyration as shares of that length.
struct Segment {
  float mass, center, sagittal, transverse, longitudinal;
};

struct Table {
  Segment head, upper_trunk, middle_trunk, lower_trunk, upper_arm, forearm, hand, thigh, shank,
      foot;
  // Lengths as shares of height, of the segments that are no bone of the skeleton.
  float head_length, upper_length, middle_length, lower_length, hand_length, foot_length;
};

constexpr Table kMale = {{.0694f, .5976f, .362f, .376f, .312f},
                         {.1596f, .2999f, .716f, .454f, .659f},
                         {.1633f, .4502f, .482f, .383f, .468f},
                         {.1117f, .6115f, .615f, .551f, .587f},
                         {.0271f, .5772f, .285f, .269f, .158f},
                         {.0162f, .4574f, .276f, .265f, .121f},
                         {.0061f, .7900f, .628f, .513f, .401f},
                         {.1416f, .4095f, .329f, .329f, .149f},
                         {.0433f, .4395f, .251f, .246f, .102f},
                         {.0137f, .4415f, .257f, .245f, .124f},
                         .2033f / 1.741f,
                         .1707f / 1.741f,
                         .2155f / 1.741f,
                         .1457f / 1.741f,
                         .0862f / 1.741f,
                         .2581f / 1.741f};

constexpr Table kFemale = {{.0668f, .5894f, .330f, .359f, .318f},
                           {.1545f, .2077f, .746f, .502f, .718f},
                           {.1465f, .4512f, .433f, .354f, .415f},
                           {.1247f, .4920f, .433f, .402f, .444f},
                           {.0255f, .5754f, .278f, .260f, .148f},
                           {.0138f, .4559f, .261f, .257f, .094f},
                           {.0056f, .7474f, .531f, .454f, .335f},
                           {.1478f, .3612f, .369f, .364f, .162f},
                           {.0481f, .4352f, .267f, .263f, .092f},
                           {.0129f, .4014f, .299f, .279f, .139f},
                           .2002f / 1.735f,
                           .1425f / 1.735f,
                           .2053f / 1.735f,
                           .1815f / 1.735f,
                           .0780f / 1.735f,
                           .2283f / 1.735f};

// The head's row covers head and neck; the neck's share of it (4.3 + 0.9 kg; docs/sources.md, R4).
constexpr float kNeckShare = .173f;

struct PartTraits {
  std::string_view name;
  Joint joint;
  int parent;
};
constexpr std::array<PartTraits, kPartCount> kTraits = {{
    {"pelvis", Joint::hips, -1},
    {"abdomen", Joint::spine, 0},
    {"chest", Joint::chest, 1},
    {"neck", Joint::neck, 2},
    {"head", Joint::head, 3},
    {"leftUpperArm", Joint::left_upper_arm, 2},
    {"leftForearm", Joint::left_lower_arm, 5},
    {"leftHand", Joint::left_hand, 6},
    {"rightUpperArm", Joint::right_upper_arm, 2},
    {"rightForearm", Joint::right_lower_arm, 8},
    {"rightHand", Joint::right_hand, 9},
    {"leftThigh", Joint::left_upper_leg, 0},
    {"leftShin", Joint::left_lower_leg, 11},
    {"leftFoot", Joint::left_foot, 12},
    {"rightThigh", Joint::right_upper_leg, 0},
    {"rightShin", Joint::right_lower_leg, 14},
    {"rightFoot", Joint::right_foot, 15},
}};

constexpr std::array<Part, kJointCount> kPartOfJoint = {
    Part::pelvis,        Part::abdomen,    Part::chest,       Part::chest,
    Part::neck,          Part::head,       Part::chest,       Part::left_upper_arm,
    Part::left_forearm,  Part::left_hand,  Part::chest,       Part::right_upper_arm,
    Part::right_forearm, Part::right_hand, Part::left_thigh,  Part::left_shin,
    Part::left_foot,     Part::left_foot,  Part::right_thigh, Part::right_shin,
    Part::right_foot,    Part::right_foot};

Vec3 rest_position(const Skeleton& skeleton, Joint joint) {
  Vec3 p{};
  for (int i = static_cast<int>(index(joint)); i >= 0; i = kParent[static_cast<std::size_t>(i)]) {
    p += skeleton.offset[static_cast<std::size_t>(i)];
  }
  return p;
}

// Moments from radii of gyration about the axes x, y, z of the rest frame.
Vec3 moments(float mass, float length, float kx, float ky, float kz) {
  const Vec3 k = Vec3{kx, ky, kz} * length;
  return mass * k * k;
}

// Fills a part that stands upright in the rest pose: longitudinal axis y, transverse x, sagittal z.
void set_upright(PartModel& part, const Segment& s, float mass, float length, Vec3 center) {
  part.mass = mass;
  part.center = center;
  part.inertia = moments(mass, length, s.transverse, s.longitudinal, s.sagittal);
}

void set_capsule(PartModel& part, Vec3 a, Vec3 b, float radius) {
  part.capsule_a = a;
  part.capsule_b = b;
  part.radius = radius;
}

class Builder {
 public:
  Builder(BodyModel& body) : body_(body), table_(body.spec.sex == Sex::male ? kMale : kFemale) {
    const Table& t = table_;
    const float sum = t.head.mass + t.upper_trunk.mass + t.middle_trunk.mass + t.lower_trunk.mass +
                      2 * (t.upper_arm.mass + t.forearm.mass + t.hand.mass + t.thigh.mass +
                           t.shank.mass + t.foot.mass);
    kilograms_ = body.spec.mass / sum;
    h_ = body.spec.height;
    unit_ = h_ / 1.78f;
    girth_ = std::sqrt((body.spec.mass / body.spec.height) / (75.0f / 1.78f)) * std::sqrt(unit_);
  }

  void trunk() {
    const Skeleton& s = body_.skeleton;
    const Table& t = table_;
    const float hip = rest_position(s, Joint::left_upper_leg).y;
    const Vec3 pelvis = rest_position(s, Joint::hips), spine = rest_position(s, Joint::spine),
               chest = rest_position(s, Joint::chest);
    const float waist = hip + t.lower_length * h_, ribs = waist + t.middle_length * h_,
                notch = ribs + t.upper_length * h_;
    const auto at = [&](Vec3 joint, float y) { return Vec3{0, y - joint.y, -joint.z}; };
    set_upright(part(Part::pelvis), t.lower_trunk, t.lower_trunk.mass * kilograms_,
                t.lower_length * h_, at(pelvis, glm::mix(waist, hip, t.lower_trunk.center)));
    set_upright(part(Part::abdomen), t.middle_trunk, t.middle_trunk.mass * kilograms_,
                t.middle_length * h_, at(spine, glm::mix(ribs, waist, t.middle_trunk.center)));
    set_upright(part(Part::chest), t.upper_trunk, t.upper_trunk.mass * kilograms_,
                t.upper_length * h_, at(chest, glm::mix(notch, ribs, t.upper_trunk.center)));
    const float shoulder = rest_position(s, Joint::left_upper_arm).y;
    const float half_hip = std::abs(rest_position(s, Joint::left_upper_leg).x);
    const float half_shoulder = std::abs(rest_position(s, Joint::left_upper_arm).x);
    lying_capsule(Part::pelvis, at(pelvis, hip + .030f * unit_), half_hip * .55f, .112f);
    lying_capsule(Part::abdomen, at(spine, glm::mix(waist, ribs, .45f)), .042f * unit_, .105f);
    lying_capsule(Part::chest, at(chest, shoulder - .085f * unit_), half_shoulder * .46f, .120f);
  }

  void head() {
    const Skeleton& s = body_.skeleton;
    const Table& t = table_;
    const float mass = t.head.mass * kilograms_;
    const Vec3 neck = rest_position(s, Joint::neck), skull = rest_position(s, Joint::head);
    const float length = t.head_length * h_;
    const Vec3 face{0, 0, .018f * unit_};
    const float center = h_ - t.head.center * length;
    set_upright(part(Part::head), t.head, mass * (1 - kNeckShare), length,
                Vec3{0, center - skull.y, -skull.z} + face);
    const float radius = .095f * unit_;
    set_capsule(part(Part::head), Vec3{0, h_ - .128f * unit_ - skull.y, -skull.z} + face,
                Vec3{0, h_ - radius - skull.y, -skull.z} + face, radius);
    PartModel& n = part(Part::neck);
    const float neck_length = std::max(glm::length(skull - neck), .04f * unit_);
    n.mass = mass * kNeckShare;
    n.center = (skull - neck) * .5f;
    const float r = .056f * girth_;
    const float across = n.mass * (3 * r * r + neck_length * neck_length) / 12;
    n.inertia = {across, n.mass * r * r / 2, across};
    set_capsule(n, Vec3{}, skull - neck, r);
  }

  void limb(Side side) {
    const Skeleton& s = body_.skeleton;
    const Table& t = table_;
    const bool left = side == Side::left;
    const Limb a = arm(side), l = leg(side);
    const Vec3 out{left ? 1.0f : -1.0f, 0, 0};
    bone(left ? Part::left_upper_arm : Part::right_upper_arm, t.upper_arm,
         s.offset[index(a.middle)], .050f);
    bone(left ? Part::left_forearm : Part::right_forearm, t.forearm, s.offset[index(a.end)], .042f);
    PartModel& hand = part(left ? Part::left_hand : Part::right_hand);
    const float hand_length = t.hand_length * h_;
    hand.mass = t.hand.mass * kilograms_;
    hand.center = out * (t.hand.center * hand_length);
    hand.inertia =
        moments(hand.mass, hand_length, t.hand.longitudinal, t.hand.transverse, t.hand.sagittal);
    // A boxing glove over the fist: it does not grow with the girth.
    set_capsule(hand, out * (.035f * unit_), out * (.085f * unit_), .055f * unit_);
    bone(left ? Part::left_thigh : Part::right_thigh, t.thigh, s.offset[index(l.middle)], .075f);
    bone(left ? Part::left_shin : Part::right_shin, t.shank, s.offset[index(l.end)], .052f);
    foot(left ? Part::left_foot : Part::right_foot);
  }

 private:
  PartModel& part(Part p) { return body_.parts[index(p)]; }

  void lying_capsule(Part p, Vec3 center, float half, float radius) {
    const float r = radius * girth_;
    set_capsule(part(p), center - Vec3{half, 0, 0}, center + Vec3{half, 0, 0}, r);
  }

  // A limb's bone from its joint along `along`. In the T-pose the arm was raised about the sagittal
  // axis: its longitudinal axis is x, its transverse axis y.
  void bone(Part p, const Segment& s, Vec3 along, float radius) {
    PartModel& m = part(p);
    const float length = glm::length(along);
    m.mass = s.mass * kilograms_;
    m.center = along * s.center;
    m.inertia = std::abs(along.x) > std::abs(along.y)
                    ? moments(m.mass, length, s.longitudinal, s.transverse, s.sagittal)
                    : moments(m.mass, length, s.transverse, s.longitudinal, s.sagittal);
    set_capsule(m, Vec3{}, along, radius * girth_);
  }

  // The foot stands flat in the rest pose: longitudinal axis z; heel 27 % of its length behind the
  // ankle.
  void foot(Part p) {
    PartModel& m = part(p);
    const Segment& s = table_.foot;
    const float length = table_.foot_length * h_;
    const float ankle = body_.skeleton.ankle_height();
    const float heel = -.27f * length;
    m.mass = s.mass * kilograms_;
    m.center = {0, -.45f * ankle, heel + s.center * length};
    m.inertia = moments(m.mass, length, s.transverse, s.sagittal, s.longitudinal);
    const float r = std::min(.040f * unit_, .6f * ankle);
    set_capsule(m, {0, r - ankle, heel + r}, {0, r - ankle, heel + length - r}, r);
  }

  BodyModel& body_;
  const Table& table_;
  float kilograms_ = 0;  // of a mass share of 1
  float h_ = 0, unit_ = 0, girth_ = 0;
};

// Trunk and upper limbs hang on the upper chest, which the chest part carries along: its shape
// follows the upper chest's frame.
struct ShapeFrame {
  Vec3 origin{};  // world
  Quat rotation;
  Vec3 zero{};  // rest-frame point that lies at the origin
};
ShapeFrame shape_frame(const BodyModel& body, const WorldPose& world, Part part) {
  if (part == Part::chest) {
    return {world.position[index(Joint::upper_chest)], world.rotation[index(Joint::upper_chest)],
            body.skeleton.offset[index(Joint::upper_chest)]};
  }
  const std::size_t j = index(joint_of(part));
  return {world.position[j], world.rotation[j], Vec3{}};
}

}  // namespace

std::string_view name_of(Part part) {
  return kTraits[index(part)].name;
}
Joint joint_of(Part part) {
  return kTraits[index(part)].joint;
}
std::optional<Part> part_of(Joint joint) {
  return kPartOfJoint[index(joint)];
}
int parent_of(Part part) {
  return kTraits[index(part)].parent;
}

Part mirrored(Part part) {
  const auto i = index(part);
  constexpr auto kArm = index(Part::left_upper_arm), kRightArm = index(Part::right_upper_arm),
                 kLeg = index(Part::left_thigh), kRightLeg = index(Part::right_thigh);
  if (i < kArm) return part;
  if (i < kRightArm) return part_at(i + 3);
  if (i < kLeg) return part_at(i - 3);
  return i < kRightLeg ? part_at(i + 3) : part_at(i - 3);
}

bool is_guard_part(Part part) {
  return part == Part::left_forearm || part == Part::right_forearm || part == Part::left_hand ||
         part == Part::right_hand;
}

BodyModel make_body(const BodySpec& spec) {
  BodyModel body;
  body.spec = spec;
  body.skeleton = canonical_skeleton(spec.height);
  body.scale = spec.height / kCanonicalHeight;
  Builder builder(body);
  builder.trunk();
  builder.head();
  builder.limb(Side::left);
  builder.limb(Side::right);
  return body;
}

BodyCapsules capsules(const BodyModel& body, const WorldPose& world) {
  BodyCapsules out;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const ShapeFrame f = shape_frame(body, world, part_at(i));
    const PartModel& p = body.parts[i];
    out[i] = {f.origin + f.rotation * (p.capsule_a - f.zero),
              f.origin + f.rotation * (p.capsule_b - f.zero), p.radius};
  }
  return out;
}

Vec3 center_of_mass(const BodyModel& body, const WorldPose& world) {
  Vec3 sum{};
  float mass = 0;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const ShapeFrame f = shape_frame(body, world, part_at(i));
    const PartModel& p = body.parts[i];
    sum += p.mass * (f.origin + f.rotation * (p.center - f.zero));
    mass += p.mass;
  }
  return sum / mass;
}

}  // namespace ringcraft
