#include "planner/condition.h"

#include <algorithm>

namespace ringcraft {
namespace {

// Kinetic work that a fresh fighter can do beyond what it keeps up, J, and what it keeps up, W. A
// muscle turns about a quarter of what it spends into work: 16 kJ of W' and 320 W of critical power
// of a trained cyclist are mechanical already; arms have about a third of that.
constexpr double kReserve_J = 5000;
constexpr double kKeptUp_W = 100;
constexpr double kPointOfBody_J = 60;  // lost with a point of damage to the trunk
constexpr double kPointElsewhere_J = 20;
constexpr double kSlowest = 0.85;      // pace of who has nothing left
constexpr double kSlackest = 0.65;     // tone of the same
constexpr double kDisabling = 20;      // points of damage after which a limb is as good as lost
constexpr double kWorkCost = 2.5;      // points per 100 J at full fatigue
constexpr double kSparedLimb = 8;      // points per blow with a limb that is as good as lost
constexpr double kStandingLegs = 0.5;  // share of that for the leg on which a kick stands

}  // namespace

std::optional<std::size_t> limb_of(Part part) {
  switch (part) {
    case Part::left_upper_arm:
    case Part::left_forearm:
    case Part::left_hand:
      return 0;
    case Part::right_upper_arm:
    case Part::right_forearm:
    case Part::right_hand:
      return 1;
    case Part::left_thigh:
    case Part::left_shin:
    case Part::left_foot:
      return 2;
    case Part::right_thigh:
    case Part::right_shin:
    case Part::right_foot:
      return 3;
    default:
      return std::nullopt;
  }
}

float pace_at(double fatigue) {
  return static_cast<float>(1 - (1 - kSlowest) * fatigue);
}

float tone_at(double fatigue) {
  return static_cast<float>(1 - (1 - kSlackest) * fatigue);
}

double Condition::fatigue() const {
  return std::clamp(spent_J_ / kReserve_J, 0.0, 1.0);
}

double Condition::injury(std::size_t limb) const {
  return injury_.at(limb);
}

void Condition::rest(double seconds) {
  spent_J_ = std::max(0.0, spent_J_ - kKeptUp_W * seconds);
}

void Condition::launched(const Style& style, double kinetic_J) {
  spent_J_ = std::min(kReserve_J, spent_J_ + style.fatigue * kinetic_J);
}

void Condition::struck(const Style& style, Part part, double damage) {
  const bool body = part == Part::abdomen || part == Part::chest || part == Part::pelvis;
  const double lost = damage * (body ? kPointOfBody_J : kPointElsewhere_J);
  spent_J_ = std::min(kReserve_J, spent_J_ + style.fatigue * lost);
  if (const auto limb = limb_of(part)) {
    injury_[*limb] = std::min(1.0, injury_[*limb] + style.injury * damage / kDisabling);
  }
}

double kinetic_work(const BodyModel& body, const std::vector<Pose>& poses) {
  std::array<Vec3, kPartCount> before{};
  double work = 0, last = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const WorldPose world = world_pose(body.skeleton, poses[i]);
    double energy = 0;
    for (std::size_t p = 0; p < kPartCount; ++p) {
      const std::size_t joint = index(joint_of(part_at(p)));
      const Vec3 center = world.position[joint] + world.rotation[joint] * body.parts[p].center;
      const Vec3 velocity = (center - before[p]) / kTickSeconds;
      if (i > 0)
        energy += 0.5 * static_cast<double>(body.parts[p].mass * glm::dot(velocity, velocity));
      before[p] = center;
    }
    if (i > 1) work += std::max(0.0, energy - last);
    last = energy;
  }
  return work;
}

double condition_cost(const Condition& condition, const Style& style, const Action& action,
                      double kinetic_J) {
  double cost = 0;
  if (style.fatigue > 0) cost += kWorkCost * condition.fatigue() * kinetic_J / 100;
  if (style.injury <= 0) return cost;
  for (const Strike& strike : action.strikes) {
    const auto part = part_of(strike.joint);
    const auto limb = part ? limb_of(*part) : std::nullopt;
    if (!limb) continue;
    double hurt = condition.injury(*limb);
    if (*limb >= 2) hurt = std::max(hurt, kStandingLegs * condition.injury(5 - *limb));
    cost += kSparedLimb * hurt;
  }
  return cost;
}

}  // namespace ringcraft
