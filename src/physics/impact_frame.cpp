#include "physics/impact_frame.h"

#include <algorithm>
#include <cmath>

#include "motion/ik.h"

namespace ringcraft {
namespace {

// m/s that a blow may give to the part it meets, as slack as it is at that instant: a hand that
// took 100 N s by itself would fly through the arm's range in a tick.
constexpr float kMostPartSpeed = 20;
constexpr float kStanding = .03f;       // m: a sole this near to the ground stands on it
constexpr float kMostGrounding = .12f;  // m: farther from the ground it is in the air after all
constexpr float kMostShift = .12f;      // m: of the pelvis, against the drift
constexpr float kBalanceGain = 1.0f;

Vec3 flipped(Vec3 v) {
  return {-v.x, v.y, v.z};
}

// Rounding of the last bits that a placement leaves: the same hit elsewhere starts from the same
// numbers. 2^-14 m and rad: 7 mm/s in the start velocities.
float snapped(float v) {
  return std::round(v * 16384.0f) / 16384.0f;
}
Vec3 snapped(Vec3 v) {
  return {snapped(v.x), snapped(v.y), snapped(v.z)};
}

Pose snapped(Pose pose) {
  pose.hips = snapped(pose.hips);
  for (Quat& q : pose.rotation) {
    q = glm::normalize(Quat(snapped(q.w), snapped(q.x), snapped(q.y), snapped(q.z)));
  }
  return pose;
}

// Moves an ankle by `offset`, the foot keeping its attitude.
void move_ankle(const Skeleton& skeleton, Side side, Vec3 offset, Pose& pose) {
  const Limb limb = leg(side);
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 fallback = world.rotation[0] * kForward;
  solve_limb(skeleton, limb,
             {world.position[index(limb.end)] + offset, present_pole(world, limb, fallback), 1.0f},
             pose);
}

}  // namespace

ImpactFrame::ImpactFrame(const BodyModel& body, const ImpactInput& input) : blow_(input.blow) {
  placement_ = {input.pose.hips.x, input.pose.hips.z, heading_of(input.pose.rotation[0])};
  inverse_ = inverse(placement_);
  const Quat unturned = yaw_rotation(-placement_.yaw);
  blow_.impulse = unturned * blow_.impulse;
  blow_.point = inverse_ * blow_.point;
  constexpr float kStraight = 1e-4f;  // N s: below it the side is that of the point
  const float aside = std::abs(blow_.impulse.x) > kStraight ? blow_.impulse.x : blow_.point.x;
  mirrored_ = aside < 0;
  blow_.impulse = snapped(blow_.impulse);
  blow_.point = snapped(blow_.point);
  if (mirrored_) {
    blow_.impulse = flipped(blow_.impulse);
    blow_.point = flipped(blow_.point);
    blow_.part = ringcraft::mirrored(blow_.part);
  }
  pose_ = snapped(in(input.pose));
  before_ = snapped(in(input.pose_before));
  const auto count = std::min<std::size_t>(input.continued.size(), kImpulseStepTicks + 1);
  for (std::size_t i = 0; i < count; ++i) continued_.push_back(snapped(in(input.continued[i])));
  if (continued_.empty()) continued_.push_back(pose_);
  FootContacts given = input.contacts;
  if (mirrored_) std::swap(given.left, given.right);
  find_contacts(body, given);
  put_on_ground(body);
}

const Pose& ImpactFrame::continued(int tick) const {
  return continued_[std::min(static_cast<std::size_t>(std::max(tick, 0)), continued_.size() - 1)];
}

Pose ImpactFrame::in(const Pose& world) const {
  const Pose turned = placed(world, inverse_);
  return mirrored_ ? ringcraft::mirrored(turned) : turned;
}

Pose ImpactFrame::out(const Pose& canonical) const {
  return placed(mirrored_ ? ringcraft::mirrored(canonical) : canonical, placement_);
}

ImpactOutcome ImpactFrame::out(ImpactOutcome outcome) const {
  if (mirrored_) {
    outcome.direction = -outcome.direction;
    outcome.com_velocity = flipped(outcome.com_velocity);
    for (Vec3& m : outcome.moved) m = flipped(m);
  }
  outcome.direction = wrapped_angle(outcome.direction + placement_.yaw);
  const Quat turned = yaw_rotation(placement_.yaw);
  outcome.com_velocity = turned * outcome.com_velocity;
  for (Vec3& m : outcome.moved) m = turned * m;
  return outcome;
}

float ImpactFrame::in_yaw(float world) const {
  const float off = wrapped_angle(world - placement_.yaw);
  return mirrored_ ? -off : off;
}

// A foot that is said to stand must be near the ground; a body that is said to fly may stand after
// all.
void ImpactFrame::find_contacts(const BodyModel& body, FootContacts given) {
  const WorldPose world = world_pose(body.skeleton, pose_);
  const auto near = [&](Side side, float height) {
    return sole_height(body, world, side) < height;
  };
  contacts_.left = given.left && near(Side::left, kMostGrounding);
  contacts_.right = given.right && near(Side::right, kMostGrounding);
  if (!contacts_.left && !contacts_.right) {
    contacts_.left = near(Side::left, kStanding);
    contacts_.right = near(Side::right, kStanding);
  }
}

void ImpactFrame::put_on_ground(const BodyModel& body) {
  if (!contacts_.left && !contacts_.right) return;
  const WorldPose world = world_pose(body.skeleton, pose_);
  const float left = sole_height(body, world, Side::left),
              right = sole_height(body, world, Side::right);
  // The whole body first, so that its lower planted foot stands, then the other one alone.
  const float drop =
      contacts_.left && contacts_.right ? std::min(left, right) : (contacts_.left ? left : right);
  lowered_ = drop;
  const auto mend = [&](Pose& pose) {
    pose.hips.y -= drop;
    constexpr float kLeast = .003f;  // m
    if (contacts_.left && left - drop > kLeast) {
      move_ankle(body.skeleton, Side::left, {0, drop - left, 0}, pose);
    }
    if (contacts_.right && right - drop > kLeast) {
      move_ankle(body.skeleton, Side::right, {0, drop - right, 0}, pose);
    }
  };
  mend(pose_);
  mend(before_);
  for (Pose& pose : continued_) mend(pose);
}

void strike(Ragdoll& ragdoll, const BodyModel& body, const ImpactFrame& frame, float share) {
  const Blow& blow = frame.blow();
  float left = glm::length(blow.impulse);
  if (left <= 0) return;
  const Vec3 line = blow.impulse / left;
  // The point goes with the part while a long blow lasts.
  const WorldPose start = world_pose(body.skeleton, frame.pose());
  const std::size_t j = index(joint_of(blow.part));
  const Vec3 local = glm::conjugate(start.rotation[j]) * (blow.point - start.position[j]);
  const PartMotion now = ragdoll.motion(blow.part);
  Vec3 point = now.origin + now.rotation * local;
  Vec3 met = blow.point;  // where the point was when the blow landed
  for (Part part = blow.part; left > 0;) {
    const int parent = parent_of(part);
    const float mass = effective_mass(body, frame.pose(), part, met, line, 0);
    const float taken = parent < 0 ? left : std::min(left, mass * kMostPartSpeed);
    ragdoll.push(part, point, line * (taken * share));
    left -= taken;
    if (parent < 0) break;
    point = ragdoll.motion(part).origin;
    met = start.position[index(joint_of(part))];
    part = part_at(static_cast<std::size_t>(parent));
  }
}

std::array<Vec3, 2> strayed_feet(const BodyModel& body, const ImpactFrame& frame,
                                 const Ragdoll& ragdoll) {
  const WorldPose meant = world_pose(body.skeleton, frame.continued(kImpulseStepTicks)),
                  is = world_pose(body.skeleton, ragdoll.pose());
  std::array<Vec3, 2> strayed{};
  for (const Side side : {Side::left, Side::right}) {
    const auto now = sole(body, is, side), would = sole(body, meant, side);
    for (std::size_t k = 0; k < now.size(); ++k) {
      strayed[static_cast<std::size_t>(side)] +=
          (now[k] - would[k]) / static_cast<float>(now.size());
    }
  }
  return strayed;
}

Footing footing_of(const BodyModel& body, const ImpactFrame& frame, const Ragdoll& ragdoll,
                   const FootingQuery& query) {
  const WorldPose stood = world_pose(body.skeleton, frame.pose()),
                  meant = world_pose(body.skeleton, frame.continued(kImpulseStepTicks)),
                  is = world_pose(body.skeleton, ragdoll.pose());
  Footing footing;
  std::vector<Vec3> corners;
  for (const Side side : {Side::left, Side::right}) {
    if (!query.planted.of(side)) continue;
    const auto was = sole(body, stood, side), now = sole(body, is, side),
               would = sole(body, meant, side);
    const auto raised = raised_corners(was);
    const Vec3 own = query.strayed[static_cast<std::size_t>(side)];
    Vec3 gone{};
    float low = 1e9f, meant_low = 1e9f;
    for (std::size_t k = 0; k < was.size(); ++k) {
      const Vec3 by_blow = now[k] - would[k] - own;
      if (!raised[k]) corners.push_back(was[k] + query.so_far * by_blow);
      gone += by_blow / static_cast<float>(was.size());
      low = std::min(low, now[k].y);
      meant_low = std::min(meant_low, would[k].y);
    }
    const float lifted = low - std::max(0.0f, meant_low + own.y);
    footing.lifted = std::max(footing.lifted, lifted);
    footing.moved = std::max(footing.moved, glm::length(Vec3{gone.x, 0, gone.z}));
  }
  footing.base = Base(corners);
  return footing;
}

Balance::Balance(const BodyModel& body, const ImpactFrame&)
    : body_(body), rate_(pendulum_rate(body)) {}

void Balance::guide(Ragdoll& ragdoll, const ImpactFrame& frame, int k) {
  const Pose &from = frame.continued(k / 2), &to = frame.continued(k / 2 + 1);
  guide(ragdoll, k % 2 == 0 ? from : mix(from, to, .5f), from, to);
}

void Balance::guide(Ragdoll& ragdoll, const Pose& target, const Pose& before, const Pose& after,
                    Vec3 unfelt) {
  const Skeleton& skeleton = body_.skeleton;
  const Vec3 at = center_of_mass(body_, world_pose(skeleton, target));
  const Vec3 moving = (center_of_mass(body_, world_pose(skeleton, after)) -
                       center_of_mass(body_, world_pose(skeleton, before))) /
                      kTickSeconds;
  Vec3 drift = extrapolated(ragdoll.center_of_mass(), ragdoll.center_of_mass_velocity(), rate_) -
               extrapolated(at, moving, rate_);
  const Vec3 way = normalized_or(unfelt, Vec3{});
  drift -= std::clamp(glm::dot(drift, way), 0.0f, glm::length(unfelt)) * way;
  const float size = glm::length(drift);
  const Vec3 shift = -drift * (size > 0 ? std::min(kBalanceGain, kMostShift / size) : 0.0f);
  Pose aimed = target;
  aimed.hips += shift;
  for (const Side side : {Side::left, Side::right}) {
    move_ankle(skeleton, side, -shift, aimed);
  }
  ragdoll.track(aimed, before, after, kTickSeconds);
}

}  // namespace ringcraft
