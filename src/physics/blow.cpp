// The blow: effective masses of both sides along its line, and the impulse they exchange.
#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "physics/impact.h"
#include "physics/muscles.h"
#include "physics/penetration.h"

namespace ringcraft {
namespace {

constexpr float kContactSeconds = 0.010f;  // of a blow (docs/sources.md, R4)
// Glove on body. As the published straights have it (Walilko 2005): 3,427 N over a half-sine of 12
// ms are J = 26.2 N s; at 9.14 m/s, from 2.9 kg of hand on the 6.0 kg that 58 g of head at that
// force mean, 1 + e = J (1 / 2.9 + 1 / 6.0) / 9.14 = 1.46.
constexpr float kRestitution = 0.45f;
constexpr float kFriction = 0.5f;    // leather on skin: the line stays within its cone
constexpr float kBlockShare = 0.5f;  // of a blow's impulse that a guard passes on to the body

constexpr int kMostFreedoms = 6 + 12 * 3 + 4;

// The articulated body at one pose: 6 coordinates of the pelvis, 3 of each ball joint, 1 of each
// hinge.
class Articulated {
 public:
  using Matrix = Eigen::Matrix<double, kMostFreedoms, kMostFreedoms>;

  Articulated(const BodyModel& body, const Pose& pose) : body_(body) {
    const WorldPose world = world_pose(body.skeleton, pose);
    int next = 6;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const std::size_t j = index(joint_of(part_at(i)));
      pivot_[i] = world.position[j];
      turn_[i] = world.rotation[j];
      center_[i] = world.position[j] + world.rotation[j] * body.parts[i].center;
      first_[i] = i == 0 ? 0 : next;
      if (i > 0) next += is_hinge(part_at(i)) ? 1 : 3;
    }
  }

  // M + T Kd + T^2 Kp: what a blow of contact time T meets when the muscles hold with `tone`.
  Matrix mass(float tone) const {
    Matrix m = Matrix::Zero();
    Columns columns;
    for (std::size_t i = 0; i < kPartCount; ++i) {
      collect(i, center_[i], columns);
      const PartModel& p = body_.parts[i];
      const glm::mat3 r = glm::mat3_cast(turn_[i]);
      const glm::mat3 inertia = r *
                                glm::mat3(p.inertia.x, 0, 0, 0, p.inertia.y, 0, 0, 0, p.inertia.z) *
                                glm::transpose(r);
      for (int a = 0; a < columns.count; ++a) {
        const Vec3 turned = inertia * columns.angular[a];
        for (int b = 0; b <= a; ++b) {
          const float value = p.mass * glm::dot(columns.linear[a], columns.linear[b]) +
                              glm::dot(turned, columns.angular[b]);
          m(columns.at[a], columns.at[b]) += static_cast<double>(value);
        }
      }
    }
    m.template triangularView<Eigen::StrictlyUpper>() = m.transpose();
    for (std::size_t i = 1; i < kPartCount; ++i) {
      const Muscle muscle = muscle_of(body_, part_at(i));
      const float added =
          tone * kContactSeconds * (muscle.damping() + kContactSeconds * muscle.stiffness);
      const int n = is_hinge(part_at(i)) ? 1 : 3;
      for (int k = 0; k < n; ++k) m(first_[i] + k, first_[i] + k) += static_cast<double>(added);
    }
    return m;
  }

  // What `point` on `part` moves and turns by, along and about x, y and z, per unit of each
  // coordinate's velocity.
  using Twist = Eigen::Matrix<double, 6, kMostFreedoms>;
  Twist jacobian(Part part, Vec3 point) const {
    Columns columns;
    collect(index(part), point, columns);
    Twist twist = Twist::Zero();
    for (int a = 0; a < columns.count; ++a) {
      const auto i = static_cast<std::size_t>(a);
      for (int k = 0; k < 3; ++k) {
        twist(k, columns.at[i]) = static_cast<double>(columns.linear[i][k]);
        twist(3 + k, columns.at[i]) = static_cast<double>(columns.angular[i][k]);
      }
    }
    return twist;
  }

  Vec3 pivot(Part part) const { return pivot_[index(part)]; }

 private:
  struct Columns {  // of the coordinates that move one part
    std::array<Vec3, kMostFreedoms> linear, angular;
    std::array<int, kMostFreedoms> at{};
    int count = 0;
    void add(int column, Vec3 v, Vec3 w) {
      const auto i = static_cast<std::size_t>(count++);
      linear[i] = v;
      angular[i] = w;
      at[i] = column;
    }
  };

  // Ascending coordinates first to last along the chain from the pelvis to `part`.
  void collect(std::size_t part, Vec3 point, Columns& columns) const {
    columns.count = 0;
    std::array<std::size_t, kPartCount> chain{};
    std::size_t n = 0;
    for (int i = static_cast<int>(part); i > 0;
         i = parent_of(part_at(static_cast<std::size_t>(i)))) {
      chain[n++] = static_cast<std::size_t>(i);
    }
    const std::array<Vec3, 3> axes = {kLeft, kUp, kForward};
    for (int k = 0; k < 3; ++k) columns.add(k, axes[static_cast<std::size_t>(k)], Vec3{});
    for (int k = 0; k < 3; ++k) {
      const Vec3& w = axes[static_cast<std::size_t>(k)];
      columns.add(3 + k, glm::cross(w, point - pivot_[0]), w);
    }
    while (n > 0) {
      const std::size_t i = chain[--n];
      if (is_hinge(part_at(i))) {
        const bool knee = index(part_at(i)) >= index(Part::left_thigh);
        const Vec3 w = turn_[i] * (knee ? kLeft : kUp);
        columns.add(first_[i], glm::cross(w, point - pivot_[i]), w);
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        const Vec3& w = axes[static_cast<std::size_t>(k)];
        columns.add(first_[i] + k, glm::cross(w, point - pivot_[i]), w);
      }
    }
  }

  const BodyModel& body_;
  std::array<Vec3, kPartCount> pivot_, center_;
  std::array<Quat, kPartCount> turn_;
  std::array<int, kPartCount> first_{};
};

constexpr float kFallingTone = .3f;  // of a body that braces itself (shown.cpp)

struct StrikeTraits {
  // Of the striking limb: the one at which the default library's blows have the mass that trained
  // ones have, 2.5-3 kg for punches (docs/sources.md, R4), 4-6 kg for roundhouses. Over 1: a boxer
  // braces a bent arm at the contact harder than he holds it, and the wrist is wrapped.
  float tone;
  float least, most;  // kg: a straight limb is nearly singular, its mass doubles within centimetres
};

StrikeTraits traits_of(StrikeKind kind) {
  switch (kind) {
    case StrikeKind::straight:
      return {.4f, 1.3f, 3.5f};
    case StrikeKind::hook:
    case StrikeKind::uppercut:
      return {2.5f, 1.3f, 3.5f};
    case StrikeKind::roundhouse:
      return {.5f, 2.0f, 7.0f};
    case StrikeKind::backfist:  // a whip: the trunk is not behind it
      return {.25f, 1.0f, 3.0f};
    case StrikeKind::elbow:  // the trunk turns with it, nothing bends between
      return {.75f, 2.0f, 6.0f};
    case StrikeKind::knee:
      return {.5f, 4.0f, 14.0f};
    case StrikeKind::front_kick:
    case StrikeKind::side_kick:
      return {.5f, 4.0f, 18.0f};
  }
  return {.4f, 1.3f, 3.5f};
}

Blow blow_with(const Contact& contact, const StrikeTraits& traits, float striker, float struck) {
  Blow blow;
  blow.part = contact.struck;
  blow.point = contact.point;
  blow.blocked = contact.blocked;
  const Vec3 line = line_of_blow(contact);
  blow.speed = std::max(0.0f, glm::dot(contact.velocity, line));
  blow.effective_mass = std::clamp(striker, traits.least, traits.most);
  const float both = 1 / (1 / blow.effective_mass + 1 / struck);
  const float share = contact.blocked ? kBlockShare : 1.0f;
  blow.impulse = line * (share * (1 + kRestitution) * blow.speed * both);
  return blow;
}

Blow blow_with(const BodyModel& attacker, const Pose& attacker_pose, const BodyModel& target,
               const Pose& target_pose, const Contact& contact, const StrikeTraits& traits) {
  const Vec3 line = line_of_blow(contact);
  // A fist strikes with the knuckles in line: its mass is that at the glove's axis, in the pose
  // given (the contact may lie a few centimetres before it).
  const Capsule glove =
      capsules(attacker, world_pose(attacker.skeleton, attacker_pose))[index(contact.striker)];
  return blow_with(
      contact, traits,
      effective_mass(attacker, attacker_pose, contact.striker, knuckles(glove, contact.point), line,
                     traits.tone),
      effective_mass(target, target_pose, contact.struck, contact.point, line, kStruckTone));
}

}  // namespace

Vec3 line_of_blow(const Contact& contact) {
  const Vec3 inward = -contact.normal, way = normalized_or(contact.velocity, inward);
  const float along = glm::dot(way, inward);
  const float across = std::sqrt(std::max(0.0f, 1 - along * along));
  if (along > 0 && across <= kFriction * along) return way;
  const Vec3 side = normalized_or(way - inward * along, Vec3{});
  return glm::normalize(inward + kFriction * side);
}

PartMobility mobility_of(const BodyModel& body, const Pose& pose, Part part, float tone) {
  const Articulated articulated(body, pose);
  PartMobility mobility;
  mobility.about = articulated.pivot(part);
  const Articulated::Twist twist = articulated.jacobian(part, mobility.about);
  const Eigen::LDLT<Articulated::Matrix> solver(articulated.mass(tone));
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(mobility.inverse.data()) =
      twist * solver.solve(twist.transpose());
  return mobility;
}

float PartMobility::mass_along(Vec3 point, Vec3 line) const {
  const Vec3 moment = glm::cross(point - about, line);
  const std::array<double, 6> wrench{static_cast<double>(line.x),   static_cast<double>(line.y),
                                     static_cast<double>(line.z),   static_cast<double>(moment.x),
                                     static_cast<double>(moment.y), static_cast<double>(moment.z)};
  double inverse_mass = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) inverse_mass += wrench[i] * inverse[6 * i + k] * wrench[k];
  }
  return static_cast<float>(1.0 / std::max(inverse_mass, 1e-6));
}

float effective_mass(const BodyModel& body, const Pose& pose, Part part, Vec3 point, Vec3 line,
                     float tone) {
  return mobility_of(body, pose, part, tone).mass_along(point, normalized_or(line, kForward));
}

float striking_tone(StrikeKind kind) {
  return traits_of(kind).tone;
}

Vec3 knuckles(const Capsule& striker, Vec3 point) {
  return segment_distance(striker.a, striker.b, point, point).on_first;
}

Blow blow_of(const Contact& contact, StrikeKind kind, float striker, float struck) {
  return blow_with(contact, traits_of(kind), striker, struck);
}

Blow blow_of(const BodyModel& attacker, const Pose& attacker_pose, const BodyModel& target,
             const Pose& target_pose, const Contact& contact, StrikeKind kind) {
  return blow_with(attacker, attacker_pose, target, target_pose, contact, traits_of(kind));
}

Blow blow_of_fall(const BodyModel& faller, const Pose& faller_pose, const BodyModel& target,
                  const Pose& target_pose, const Contact& contact) {
  return blow_with(faller, faller_pose, target, target_pose, contact,
                   {kFallingTone, .3f, faller.spec.mass});
}

// The two part at e v along the line, and the striker has lost J / m.
Vec3 struck_velocity(const Blow& blow) {
  if (blow.effective_mass <= 0) return {};
  const float given = glm::length(blow.impulse) / (blow.blocked ? kBlockShare : 1.0f);
  const float speed = (1 + kRestitution) * blow.speed - given / blow.effective_mass;
  return normalized_or(blow.impulse, Vec3{}) * std::max(0.0f, speed);
}

}  // namespace ringcraft
