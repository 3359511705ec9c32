#include "io/anatomy.h"

#include <algorithm>
#include <cmath>

namespace ringcraft {

namespace {

constexpr float kReferenceMass = 71.0f;  // kg at the canonical height: an athlete's girth is 1

// Adds shapes whose places are given from a joint, in metres for the canonical height. Left side
// only: the field mirrors them.
class Sculptor {
 public:
  Sculptor(const Build& build, DistanceField& field) : build_(build), field_(field) {}

  // Places and widths grow with the girth (true) or with the height alone (head, hands, feet).
  void follow_girth(bool follow) { girth_ = follow ? build_.girth : 1.0f; }

  void ellipsoid(Joint joint, Vec3 center, Vec3 radii, float blend, Vec3 turn_degrees = {}) {
    Shape shape;
    shape.ellipsoid = true;
    shape.a = shape.b = place(joint, center);
    shape.stretch = widths(joint, radii);
    shape.turn = turn_of(turn_degrees);
    shape.blend = blend * build_.scale;
    field_.add(shape);
  }
  void hollow(Joint joint, Vec3 center, Vec3 radii, float blend, Vec3 turn_degrees = {}) {
    Shape shape;
    shape.ellipsoid = true;
    shape.carve = true;
    shape.a = shape.b = place(joint, center);
    shape.stretch = widths(joint, radii);
    shape.turn = turn_of(turn_degrees);
    shape.blend = blend * build_.scale;
    field_.add(shape);
  }
  // A tapered capsule between two places.
  void taper(Joint from, Vec3 a, Joint to, Vec3 b, float radius_a, float radius_b, float blend,
             Vec3 stretch = {1, 1, 1}) {
    Shape shape;
    shape.a = place(from, a);
    shape.b = place(to, b);
    shape.radius_a = radius_a * build_.scale * girth_;
    shape.radius_b = radius_b * build_.scale * girth_;
    shape.stretch = stretch;
    shape.blend = blend * build_.scale;
    field_.add(shape);
  }
  void cut(Joint joint, Vec3 point, Vec3 normal, float blend) {
    field_.cut({place(joint, point), glm::normalize(normal), blend * build_.scale});
  }

 private:
  // An arm lies along x, the rest stands along y: the girth widens across, never along.
  static bool along_x(Joint joint) {
    return joint == Joint::left_upper_arm || joint == Joint::left_lower_arm ||
           joint == Joint::left_hand;
  }
  Vec3 place(Joint joint, Vec3 from) const {
    const Vec3 grown = along_x(joint) ? Vec3{from.x, from.y * girth_, from.z * girth_}
                                      : Vec3{from.x * girth_, from.y, from.z * girth_};
    return build_.rest.position[index(joint)] + build_.scale * grown;
  }
  Vec3 widths(Joint joint, Vec3 radii) const {
    return build_.scale * (along_x(joint) ? Vec3{radii.x, radii.y * girth_, radii.z * girth_}
                                          : Vec3{radii.x * girth_, radii.y, radii.z * girth_});
  }
  static Quat turn_of(Vec3 turn_degrees) {
    return glm::angleAxis(radians(turn_degrees.x), Vec3{1, 0, 0}) *
           glm::angleAxis(radians(turn_degrees.y), Vec3{0, 1, 0}) *
           glm::angleAxis(radians(turn_degrees.z), Vec3{0, 0, 1});
  }

  const Build& build_;
  DistanceField& field_;
  float girth_ = 1;
};

constexpr Joint kHips = Joint::hips, kSpine = Joint::spine, kChest = Joint::chest,
                kUpperChest = Joint::upper_chest, kNeck = Joint::neck, kHead = Joint::head,
                kArm = Joint::left_upper_arm, kElbow = Joint::left_lower_arm,
                kWrist = Joint::left_hand, kThigh = Joint::left_upper_leg,
                kKnee = Joint::left_lower_leg, kAnkle = Joint::left_foot;

void add_trunk(Sculptor& s, const Build& build) {
  s.follow_girth(true);
  const float hip = build.female ? 0.012f : 0.0f, waist = build.female ? -0.013f : 0.0f;
  const float chest = build.female ? -0.010f : 0.0f;
  s.ellipsoid(kHips, {0, 0.020f, -0.004f}, {0.146f + hip, 0.115f, 0.098f}, 0);
  s.taper(kSpine, {0, -0.030f, 0.002f}, kChest, {0, 0.020f, 0.004f}, 0.119f + waist, 0.128f + waist,
          0.06f, {1, 1, 0.76f});
  s.ellipsoid(kUpperChest, {0, -0.025f, 0}, {0.152f + chest, 0.185f, 0.106f}, 0.05f);
  s.taper(kUpperChest, {0, 0.105f, -0.018f}, kArm, {-0.045f, -0.004f, -0.012f}, 0.060f, 0.047f,
          0.05f);
  // Back: latissimus, shoulder blade, the two columns beside the spine.
  s.taper(kUpperChest, {0.132f + chest, 0.055f, -0.030f}, kSpine, {0.084f + waist, 0.080f, -0.025f},
          0.056f, 0.034f, 0.05f);
  s.ellipsoid(kUpperChest, {0.082f, 0.045f, -0.072f}, {0.072f, 0.090f, 0.036f}, 0.04f, {0, 20, 0});
  s.taper(kUpperChest, {0.032f, 0.0f, -0.082f}, kHips, {0.032f, 0.070f, -0.075f}, 0.026f, 0.026f,
          0.03f);
  // Front: chest muscle or breast, abdominal wall, belly.
  if (build.female) {
    s.ellipsoid(kUpperChest, {0.070f, -0.010f, 0.078f}, {0.068f, 0.066f, 0.054f}, 0.03f);
  } else {
    s.ellipsoid(kUpperChest, {0.078f, 0.052f, 0.066f}, {0.090f, 0.062f, 0.034f}, 0.026f,
                {-16, 22, 10});
    s.ellipsoid(kUpperChest, {0.086f, 0.022f, 0.078f}, {0.066f, 0.034f, 0.024f}, 0.020f,
                {-4, 24, 6});
  }
  // The straight muscle in three rows beside the white line, the oblique beside it.
  s.taper(kSpine, {0.030f, -0.060f, 0.062f}, kChest, {0.032f, 0.050f, 0.070f}, 0.026f, 0.026f,
          0.02f);
  if (!build.female && build.belly <= 0) {
    for (const float row : {-0.048f, 0.006f, 0.058f}) {
      s.ellipsoid(kChest, {0.032f, row, 0.080f}, {0.030f, 0.026f, 0.020f}, 0.016f, {-4, 12, 0});
    }
  }
  s.taper(kSpine, {0.094f + waist, 0.020f, 0.036f}, kChest, {0.110f + waist, 0.030f, 0.040f},
          0.032f, 0.032f, 0.03f);
  if (build.belly > 0) {
    s.ellipsoid(kSpine, {0, 0.010f, 0.030f}, {0.120f, 0.130f, 0.085f + build.belly}, 0.06f);
  }
  s.ellipsoid(kHips, {0.074f + 0.5f * hip, -0.022f, -0.062f}, {0.078f, 0.084f, 0.068f}, 0.03f);
}

void add_neck(Sculptor& s, const Build& build) {
  s.follow_girth(true);
  const float thin = build.female ? -0.008f : 0.0f;
  s.taper(kUpperChest, {0, 0.100f, -0.022f}, kHead, {0, 0.020f, -0.008f}, 0.066f + thin,
          0.055f + thin, 0.04f);
  // Trapezius: from the neck's side down to the shoulder.
  s.taper(kNeck, {0.026f, 0.040f, -0.026f}, kArm, {-0.030f, 0.022f, -0.020f}, 0.036f + thin,
          0.030f + thin, 0.05f);
  s.taper(kNeck, {0.024f, 0.000f, -0.050f}, kUpperChest, {0.050f, 0.020f, -0.080f}, 0.030f, 0.026f,
          0.04f);
  // The strap from behind the ear to the breastbone.
  s.taper(kHead, {0.048f, 0.035f, -0.012f}, kUpperChest, {0.018f, 0.125f, 0.030f}, 0.014f, 0.012f,
          0.015f);
  // Collarbone.
  s.taper(kUpperChest, {0.020f, 0.125f, 0.034f}, kArm, {-0.035f, 0.022f, 0.012f}, 0.012f, 0.012f,
          0.022f);
}

void add_arm(Sculptor& s, const Build& build) {
  s.follow_girth(true);
  const float thin = build.female ? -0.005f : 0.0f;
  s.ellipsoid(kArm, {0.022f, 0.004f, -0.002f}, {0.088f, 0.059f + thin, 0.062f + thin}, 0.035f,
              {0, 0, -6});
  s.taper(kArm, {0.0f, 0, 0}, kElbow, {0, 0, 0}, 0.046f + thin, 0.037f + thin, 0.03f);
  s.ellipsoid(kArm, {0.148f, 0.002f, 0.021f}, {0.088f, 0.036f + thin, 0.033f + thin}, 0.02f);
  s.ellipsoid(kArm, {0.132f, -0.002f, -0.023f}, {0.100f, 0.040f + thin, 0.034f + thin}, 0.02f);
  s.ellipsoid(kElbow, {-0.002f, 0, -0.022f}, {0.030f, 0.024f, 0.020f}, 0.02f);
  s.taper(kElbow, {0, 0, 0}, kWrist, {0.020f, 0, 0}, 0.037f + thin, 0.026f + 0.5f * thin, 0.03f,
          {1, 0.95f, 1.05f});
  s.ellipsoid(kElbow, {0.078f, 0.008f, 0.006f}, {0.098f, 0.038f + thin, 0.040f + thin}, 0.02f);
  s.ellipsoid(kElbow, {0.080f, -0.012f, -0.006f}, {0.090f, 0.032f + thin, 0.036f + thin}, 0.02f);
}

void add_leg(Sculptor& s, const Build& build) {
  s.follow_girth(true);
  const float full = build.female ? 0.003f : 0.0f;
  s.taper(kThigh, {0.004f, -0.030f, 0}, kKnee, {0, 0.020f, -0.002f}, 0.083f + full, 0.052f, 0.04f);
  s.ellipsoid(kThigh, {0.006f, -0.215f, 0.034f}, {0.060f, 0.175f, 0.050f}, 0.03f);
  s.ellipsoid(kThigh, {0.034f, -0.220f, 0.012f}, {0.046f, 0.160f, 0.052f}, 0.03f);
  s.ellipsoid(kKnee, {-0.024f, 0.075f, 0.024f}, {0.032f, 0.060f, 0.034f}, 0.025f);
  s.ellipsoid(kKnee, {0.026f, 0.090f, 0.020f}, {0.030f, 0.060f, 0.034f}, 0.025f);
  s.ellipsoid(kThigh, {-0.014f, -0.200f, -0.034f}, {0.040f, 0.165f, 0.048f}, 0.03f);
  s.ellipsoid(kThigh, {0.024f, -0.215f, -0.034f}, {0.038f, 0.165f, 0.046f}, 0.03f);
  s.ellipsoid(kThigh, {-0.030f, -0.100f, 0.0f}, {0.044f, 0.120f, 0.060f}, 0.03f);
  // Knee, shin, calf.
  s.ellipsoid(kKnee, {0, 0.000f, 0.006f}, {0.049f, 0.056f, 0.050f}, 0.03f);
  s.ellipsoid(kKnee, {0, 0.012f, 0.046f}, {0.025f, 0.030f, 0.016f}, 0.018f);
  s.taper(kKnee, {0, 0, 0.010f}, kAnkle, {0, 0.030f, -0.004f}, 0.048f, 0.033f, 0.03f);
  s.ellipsoid(kKnee, {-0.018f, -0.125f, -0.032f}, {0.037f, 0.105f, 0.040f}, 0.025f);
  s.ellipsoid(kKnee, {0.019f, -0.112f, -0.030f}, {0.034f, 0.090f, 0.037f}, 0.025f);
  s.ellipsoid(kKnee, {0.012f, -0.120f, 0.018f}, {0.030f, 0.125f, 0.026f}, 0.02f);
  s.taper(kKnee, {0, -0.220f, -0.030f}, kAnkle, {0, 0.005f, -0.040f}, 0.024f, 0.016f, 0.025f);
}

void add_foot(Sculptor& s) {
  s.follow_girth(false);
  s.ellipsoid(kAnkle, {-0.030f, 0.010f, 0.0f}, {0.013f, 0.017f, 0.015f}, 0.015f);
  s.ellipsoid(kAnkle, {0.031f, 0.002f, -0.006f}, {0.012f, 0.017f, 0.014f}, 0.015f);
  s.ellipsoid(kAnkle, {0, -0.032f, -0.032f}, {0.033f, 0.037f, 0.034f}, 0.03f);
  s.taper(kAnkle, {0, -0.002f, 0.008f}, kAnkle, {0.000f, -0.040f, 0.105f}, 0.037f, 0.027f, 0.03f,
          {1.06f, 1, 1});
  s.taper(kAnkle, {0.010f, -0.048f, -0.030f}, kAnkle, {0.030f, -0.048f, 0.095f}, 0.024f, 0.021f,
          0.02f);
  s.ellipsoid(kAnkle, {0.004f, -0.046f, 0.120f}, {0.046f, 0.022f, 0.036f}, 0.02f);
  struct Toe {
    float x, z, radius, out;
  };
  constexpr std::array<Toe, 5> kToes = {{{-0.023f, 0.183f, 0.0150f, -0.002f},
                                         {0.000f, 0.186f, 0.0115f, 0.000f},
                                         {0.017f, 0.179f, 0.0105f, 0.001f},
                                         {0.032f, 0.168f, 0.0100f, 0.002f},
                                         {0.045f, 0.153f, 0.0095f, 0.003f}}};
  for (const Toe& toe : kToes) {
    s.taper(kAnkle, {toe.x - toe.out, -0.046f, toe.z - 0.05f}, kAnkle,
            {toe.x, -0.067f + toe.radius, toe.z}, toe.radius * 1.05f, toe.radius, 0.008f);
  }
}

void add_head(Sculptor& s, const Build& build) {
  s.follow_girth(false);
  const float soft = build.female ? -0.004f : 0.0f;
  s.ellipsoid(kHead, {0, 0.133f, -0.009f}, {0.076f, 0.095f, 0.096f}, 0.02f);
  s.ellipsoid(kHead, {0, 0.085f, 0.036f}, {0.060f, 0.090f, 0.054f}, 0.03f);
  s.taper(kHead, {0.044f, 0.056f, -0.004f}, kHead, {0.008f, 0.021f, 0.068f}, 0.024f + soft,
          0.019f + soft, 0.03f);
  s.ellipsoid(kHead, {0, 0.020f, 0.080f}, {0.020f + soft, 0.017f, 0.016f}, 0.02f);
  s.ellipsoid(kHead, {0.043f, 0.092f, 0.062f}, {0.022f, 0.016f, 0.020f}, 0.02f);
  s.taper(kHead, {0.008f, 0.127f, 0.083f}, kHead, {0.046f, 0.124f, 0.062f}, 0.012f, 0.010f, 0.016f);
  s.hollow(kHead, {0.032f, 0.108f, 0.094f}, {0.018f, 0.010f, 0.016f}, 0.012f);
  s.taper(kHead, {0, 0.122f, 0.086f}, kHead, {0, 0.080f, 0.106f}, 0.0075f, 0.0115f, 0.012f);
  s.ellipsoid(kHead, {0.010f, 0.076f, 0.094f}, {0.0095f, 0.008f, 0.012f}, 0.008f);
  s.ellipsoid(kHead, {0.038f, 0.062f, 0.046f}, {0.025f, 0.034f, 0.028f}, 0.02f);
  // Mouth: the swell around the teeth, lips, the line between them.
  s.ellipsoid(kHead, {0, 0.048f, 0.073f}, {0.028f, 0.024f, 0.017f}, 0.02f);
  s.taper(kHead, {0, 0.0535f, 0.0890f}, kHead, {0.021f, 0.050f, 0.081f}, 0.0050f, 0.003f, 0.006f);
  s.taper(kHead, {0, 0.0425f, 0.0880f}, kHead, {0.018f, 0.046f, 0.080f}, 0.0055f, 0.003f, 0.006f);
  // Ear.
  s.ellipsoid(kHead, {0.077f, 0.098f, -0.010f}, {0.008f, 0.031f, 0.018f}, 0.008f, {-12, 22, 0});
  s.hollow(kHead, {0.088f, 0.101f, -0.004f}, {0.007f, 0.017f, 0.009f}, 0.006f, {-12, 22, 0});
}

void add_shorts(Sculptor& s, const Build& build) {
  s.follow_girth(true);
  const float hip = build.female ? 0.012f : 0.0f, waist = build.female ? -0.010f : 0.0f;
  s.ellipsoid(kHips, {0, 0.020f, -0.004f}, {0.156f + hip, 0.120f, 0.108f}, 0);
  s.taper(kHips, {0, 0.060f, 0}, kSpine, {0, 0.040f, 0.002f}, 0.139f + waist, 0.133f + waist, 0.05f,
          {1, 1, 0.79f});
  s.ellipsoid(kHips, {0.074f + 0.5f * hip, -0.024f, -0.064f}, {0.090f, 0.094f, 0.078f}, 0.05f);
  s.taper(kThigh, {0.002f, -0.030f, 0}, kThigh, {0.018f, -0.250f, 0.004f}, 0.094f, 0.104f, 0.05f);
  if (build.belly > 0) {
    s.ellipsoid(kSpine, {0, 0.0f, 0.030f}, {0.130f, 0.130f, 0.093f + build.belly}, 0.06f);
  }
  s.hollow(kThigh, {-0.093f, -0.300f, 0}, {0.014f, 0.160f, 0.200f}, 0.03f);
}

// A point of the face: the skin seen from the front at x, y off the head's joint, sunk by `sunk`
// metres.
Vec3 on_face(const Build& build, const DistanceField& skin, float x, float y, float sunk) {
  const float s = build.scale;
  const Vec3 head = build.rest.position[index(kHead)];
  Vec3 point = head + s * Vec3{x, y, 0.14f};
  for (int i = 0; i < 40; ++i) point.z -= std::clamp(0.8f * skin.at(point), -0.004f * s, 0.01f * s);
  point.z -= sunk * s;
  return point;
}

}  // namespace

Build build_of(const BodyModel& body) {
  Build build;
  build.rest = world_pose(body.skeleton, rest_pose(body.skeleton));
  build.scale = body.spec.height / kCanonicalHeight;
  const float cubed = build.scale * build.scale * build.scale;
  build.female = body.spec.sex == Sex::female;
  const float reference = kReferenceMass * (build.female ? 0.88f : 1.0f) * cubed;
  const float thickness = std::sqrt(body.spec.mass / reference);
  build.girth = std::clamp(thickness, 0.80f, 1.45f);
  build.belly = std::min(0.16f * std::max(thickness - 1.08f, 0.0f), 0.05f);
  return build;
}

DistanceField skin_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  add_trunk(s, build);
  add_neck(s, build);
  add_arm(s, build);
  add_leg(s, build);
  add_foot(s);
  add_head(s, build);
  field.cut({{0, 0, 0}, {0, -1, 0}, 0.008f * build.scale});  // soles
  return field;
}

DistanceField shorts_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  add_shorts(s, build);
  s.cut(kSpine, {0, 0.004f, 0}, {0, 1, 0}, 0.010f);
  s.cut(kThigh, {0, -0.222f, 0}, {0.25f, -1, 0}, 0.020f);
  return field;
}

DistanceField waistband_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  add_shorts(s, build);
  field.grow(0.006f * build.scale);
  s.cut(kSpine, {0, 0.021f, 0}, {0, 1, 0}, 0.016f);
  s.cut(kSpine, {0, -0.029f, 0}, {0, -1, 0}, 0.016f);
  return field;
}

DistanceField top_field(const Build& build) {
  DistanceField field;
  if (!build.female) return field;
  Sculptor s(build, field);
  add_trunk(s, build);
  add_neck(s, build);
  field.grow(0.005f * build.scale);
  s.cut(kUpperChest, {0, -0.100f, 0}, {0, -1, 0}, 0.012f);
  s.cut(kNeck, {0, 0.052f, 0}, {0, 1, 0}, 0.006f);
  s.follow_girth(true);
  // Armholes, neckline, back.
  s.hollow(kArm, {-0.028f, 0.015f, 0}, {0.085f, 0.130f, 0.300f}, 0.010f);
  s.hollow(kUpperChest, {0, 0.150f, 0.080f}, {0.064f, 0.105f, 0.110f}, 0.010f);
  s.hollow(kUpperChest, {0, 0.170f, -0.090f}, {0.064f, 0.105f, 0.110f}, 0.010f);
  s.hollow(kNeck, {0, 0.060f, -0.010f}, {0.070f, 0.090f, 0.075f}, 0.010f);
  return field;
}

DistanceField glove_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  s.follow_girth(false);
  s.taper(kWrist, {0.012f, 0.002f, 0.002f}, kWrist, {0.060f, 0.006f, 0.004f}, 0.043f, 0.050f, 0);
  s.ellipsoid(kWrist, {0.086f, 0.010f, 0.006f}, {0.068f, 0.054f, 0.062f}, 0.03f);
  s.ellipsoid(kWrist, {0.124f, -0.002f, 0.006f}, {0.046f, 0.054f, 0.061f}, 0.03f);
  s.ellipsoid(kWrist, {0.080f, -0.026f, 0.004f}, {0.052f, 0.036f, 0.050f}, 0.03f);
  s.taper(kWrist, {0.040f, -0.012f, 0.048f}, kWrist, {0.112f, -0.022f, 0.062f}, 0.024f, 0.024f,
          0.010f);
  return field;
}

DistanceField cuff_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  s.follow_girth(false);
  s.taper(kWrist, {-0.070f, 0, 0}, kWrist, {0.040f, 0.003f, 0.003f}, 0.045f, 0.046f, 0);
  s.cut(kWrist, {-0.075f, 0, 0}, {-1, 0, 0}, 0.014f);
  s.cut(kWrist, {0.014f, 0, 0}, {1, 0, 0}, 0.010f);
  return field;
}

DistanceField anklet_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  add_leg(s, build);
  add_foot(s);
  field.grow(0.0050f * build.scale);
  // Above the ankle, over the instep, open at the heel and the toes.
  s.cut(kAnkle, {0, 0.105f, 0}, {0, 1, 0}, 0.004f);
  s.cut(kAnkle, {0, 0, 0.062f}, {0, -0.20f, 1}, 0.008f);
  s.cut(kAnkle, {0, -0.030f, -0.030f}, {0, -0.55f, -1}, 0.008f);
  field.cut({{0, 0.001f * build.scale, 0}, {0, -1, 0}, 0.006f * build.scale});
  return field;
}

DistanceField hair_field(const Build& build) {
  DistanceField field;
  Sculptor s(build, field);
  s.follow_girth(false);
  s.ellipsoid(kHead, {0, 0.136f, -0.010f}, {0.0795f, 0.0985f, 0.1000f}, 0.0f);
  if (build.female) {
    s.ellipsoid(kHead, {0, 0.150f, -0.118f}, {0.034f, 0.034f, 0.034f}, 0.02f);
  }
  // The face, the skin around the ears, the nape.
  s.hollow(kHead, {0, 0.085f, 0.085f}, {0.070f, 0.094f, 0.072f}, 0.006f, {-14, 0, 0});
  s.hollow(kHead, {0.085f, 0.088f, 0.004f}, {0.030f, 0.036f, 0.026f}, 0.006f);
  s.cut(kHead, {0, 0.062f, -0.060f}, {0, -1, 0.25f}, 0.004f);
  return field;
}

DistanceField line_field(const Build& build, const DistanceField& skin) {
  struct Point {
    float x, y, radius;
  };
  using Line = std::vector<Point>;
  const std::array<Line, 3> lines = {
      // Brow, lashes of the upper lid, lips.
      Line{{0.013f, 0.1235f, 0.0042f},
           {0.024f, 0.1275f, 0.0044f},
           {0.036f, 0.1290f, 0.0040f},
           {0.048f, 0.1240f, 0.0030f}},
      Line{{0.0190f, 0.1090f, 0.0018f},
           {0.026f, 0.1138f, 0.0023f},
           {0.032f, 0.1152f, 0.0024f},
           {0.039f, 0.1132f, 0.0023f},
           {0.0450f, 0.1090f, 0.0018f}},
      Line{{0.000f, 0.0480f, 0.0026f}, {0.010f, 0.0485f, 0.0026f}, {0.022f, 0.0468f, 0.0022f}}};
  constexpr float kSunk = 0.7f;  // of the radius: only the crest shows
  DistanceField field;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      Shape shape;
      shape.a = on_face(build, skin, line[i].x, line[i].y, kSunk * line[i].radius);
      shape.b = on_face(build, skin, line[i + 1].x, line[i + 1].y, kSunk * line[i + 1].radius);
      shape.radius_a = line[i].radius * build.scale;
      shape.radius_b = line[i + 1].radius * build.scale;
      field.add(shape);
    }
  }
  return field;
}

Eye eye_of(const Build& build, const DistanceField& skin) {
  const float radius = 0.0128f;
  return {on_face(build, skin, 0.0320f, 0.1085f, 0.42f * radius), radius * build.scale};
}

}  // namespace ringcraft
