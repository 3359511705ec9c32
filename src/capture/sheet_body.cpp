#include "capture/sheet_body.h"

#include <algorithm>
#include <cmath>

#include "capture/ankle.h"

namespace ringcraft {

namespace {

constexpr float kMostGirdle = radians(20);        // of the shoulder blade
constexpr float kMostNeck = radians(75);          // head against chest
constexpr float kMostWrist = radians(80);         // bent back on the floor
constexpr float kMostAnkle = radians(50);         // given by the floor
constexpr float kKneeRadius = 0.055f;             // m: height of a knee on the floor
constexpr float kMostDorsiflexion = radians(31);  // of a foot with its heel down
constexpr float kSoftReach = 0.88f;      // of a limb's length: beyond it the reach is eased
constexpr float kClosestReach = 0.32f;   // elbow 37, knee 37 degrees: flesh meets flesh
constexpr float kSoftFold = 0.06f;       // over which a limb that folds so far gives way
constexpr float kLongestReach = 0.995f;  // and never comes to this share (elbow 169 degrees)
constexpr float kOffFloor = 0.01f;       // m: of a foot that has nothing of the floor any more
constexpr float kHandLength = 0.17f;     // m, wrist to finger tips
constexpr float kHandThickness = 0.02f;  // m, half of it

constexpr Side side_at(std::size_t i) {
  return i == 0 ? Side::left : Side::right;
}

Quat part_of(Quat rotation, float share) {
  return from_rotation_vector(rotation_vector(rotation) * share);
}

Quat foot_rotation(const FootTarget& foot) {
  return yaw_rotation(foot.yaw) * glm::angleAxis(foot.heel, kLeft);
}

// The shoulder blade follows a far-reaching hand: forward with a straight, up with a raised arm.
void turn_girdle(const Skeleton& skeleton, Side side, Vec3 wrist, Pose& pose) {
  const Joint girdle = side == Side::left ? Joint::left_shoulder : Joint::right_shoulder;
  const WorldPose world = world_pose(skeleton, pose);
  const Quat chest = world.rotation[index(Joint::upper_chest)];
  const Vec3 from = world.position[index(girdle)];
  const Vec3 shoulder = world.position[index(arm(side).root)];
  const float reach = glm::distance(wrist, shoulder) / skeleton.arm_length();
  const Vec3 toward = glm::inverse(chest) * (wrist - from);
  const Vec3 rest = skeleton.offset[index(arm(side).root)];
  Vec3 turn = rotation_vector(rotation_between(rest, toward));
  const float angle = glm::length(turn);
  if (angle < 1e-5f) return;
  const float wanted = std::min(angle * 0.3f, kMostGirdle) * glm::smoothstep(0.45f, 1.0f, reach);
  pose.rotation[index(girdle)] = from_rotation_vector(turn * (wanted / angle));
}

// Turn about `axis` that brings the end of `arm` (both world) to height `up` above its root, rad;
// the nearest there is where none does.
float turn_to_height(Vec3 arm, Vec3 axis, float up) {
  const Vec3 across = glm::cross(axis, arm);  // where the end goes as the turn begins
  const float amount = std::sqrt(arm.y * arm.y + across.y * across.y);
  if (amount < 1e-5f) return 0;
  const float least = std::asin(std::clamp(up / amount, -1.0f, 1.0f));
  const float phase = std::atan2(arm.y, across.y);
  return wrapped_angle(across.y >= 0 ? least - phase : kPi - least - phase);
}

// A hand that would reach through the floor bends back at the wrist and lies on it.
void lay_on_floor(const Skeleton& skeleton, Side side, Pose& pose) {
  const Limb limb = arm(side);
  const WorldPose world = world_pose(skeleton, pose);
  const Quat hand = world.rotation[index(limb.end)];
  const Vec3 along = hand * normalized_or(skeleton.offset[index(limb.end)], kLeft) * kHandLength;
  const float up = kHandThickness - world.position[index(limb.end)].y;
  if (along.y >= up) return;
  // Only backward, and less and less where the back of the hand does not look up.
  const Vec3 axis = side == Side::left ? kForward : -kForward;
  const float back_up = glm::cross(hand * axis, along).y / kHandLength;
  const float turn = std::clamp(turn_to_height(along, hand * axis, up), 0.0f, kMostWrist);
  pose.rotation[index(limb.end)] =
      pose.rotation[index(limb.end)] *
      glm::angleAxis(turn * glm::smoothstep(0.0f, 0.4f, back_up), axis);
}

// The same for the toes of a foot in the air; the turn from the asked rotation, rad. A foot that
// stands upright on its toes is left alone.
float toes_off_floor(const Skeleton& skeleton, Vec3 ankle, Quat rotation) {
  const Vec3 ball = rotation * skeleton.offset[index(Joint::left_toes)];
  const float up = skeleton.toe_height() - ankle.y;
  if (ball.y >= up) return 0;
  const Vec3 axis = rotation * kLeft;
  const float level = std::abs(glm::cross(axis, ball).y) / glm::length(ball);
  const float turn = std::clamp(turn_to_height(ball, axis, up), -kMostAnkle, kMostAnkle);
  return turn * glm::smoothstep(0.0f, 0.35f, level);
}

// A knee that would go through the floor kneels on it: the thigh turns up about the hip until the
// knee rests, the shin follows from there. Gives the ankle; `pole` becomes the resting knee's.
Vec3 kneeling(const Skeleton& skeleton, const Limb& limb, const Pose& pose, Vec3 ankle,
              Vec3& pole) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 hip = world.position[index(limb.root)], knee = world.position[index(limb.middle)];
  if (knee.y >= kKneeRadius) return ankle;
  const float thigh = skeleton.bone(limb.middle), shin = skeleton.bone(limb.end);
  const float down = std::min(hip.y - kKneeRadius, thigh);
  // Under the hip its own direction says little: the deeper it is, the more the asked one helps.
  const Vec3 asked =
      Vec3(pole.x, 0, pole.z) * (0.12f * glm::smoothstep(0.0f, 0.08f, kKneeRadius - knee.y));
  const Vec3 out = normalized_or(Vec3(knee.x - hip.x, 0, knee.z - hip.z) + asked, kForward);
  const Vec3 rests =
      hip + out * std::sqrt(std::max(0.0f, thigh * thigh - down * down)) - kUp * down;
  Vec3 along = normalized_or(ankle - rests, -kForward) * shin;
  along.y = std::max(along.y, skeleton.ankle_height() * 0.6f - rests.y);
  pole = rests - hip;
  return rests + along;
}

// Eases a target beyond most of a limb's length or nearer than a folded one's, so that elbow and
// knee never snap straight and a limb that unfolds does not start with a jerk.
Vec3 within_reach(Vec3 root, Vec3 target, float length) {
  const float near = kClosestReach * length, fold = kSoftFold * length;
  const float far = glm::distance(root, target);
  if (far < near + fold) {
    const float over = std::max(0.0f, far - near + fold);
    const float folded = near + over * over / (4 * fold);
    return root + (target - root) * (folded / std::max(far, 1e-4f));
  }
  const float soft = kSoftReach * length, room = (kLongestReach - kSoftReach) * length;
  if (far <= soft) return target;
  return root + (target - root) * ((soft + room * (1 - std::exp(-(far - soft) / room))) / far);
}

void set_arm(const Skeleton& skeleton, Side side, const ArmTarget& target, Pose& pose) {
  turn_girdle(skeleton, side, target.wrist, pose);
  const Limb limb = arm(side);
  const Vec3 shoulder = world_pose(skeleton, pose).position[index(limb.root)];
  const Vec3 wrist = within_reach(shoulder, target.wrist, skeleton.arm_length());
  solve_limb(skeleton, limb, {wrist, target.pole, 1.0f}, pose);
  // Either thumb turns inward about the body's left, which the rest pose's forearms lie along.
  pose.rotation[index(limb.end)] =
      glm::angleAxis(target.lag, hinge_axis(limb)) * glm::angleAxis(target.palm, kLeft);
  lay_on_floor(skeleton, side, pose);
}

// Bends hip and knee so that the ankle is where the foot's targets want it.
void place_ankle(const Skeleton& skeleton, const Limb& limb, const FootTarget& foot, Quat pelvis,
                 Pose& pose) {
  const Vec3 pelvis_forward = pelvis * kForward;
  Vec3 pole = foot.knee_pole;
  if (glm::length(pole) < 1e-4f) {
    pole =
        normalized_or(pelvis_forward, kForward) * 0.5f + yaw_rotation(foot.yaw) * kForward * 0.5f;
  }
  Vec3 ankle = ankle_of(skeleton, foot);
  if (foot.freedom > 0) {
    const Vec3 hip = world_pose(skeleton, pose).position[index(limb.root)];
    ankle += (within_reach(hip, ankle, skeleton.leg_length()) - ankle) * foot.freedom;
  }
  solve_limb(skeleton, limb, {ankle, pole, 1.0f}, pose);
  if (foot.freedom > 0) {
    const Vec3 rests = kneeling(skeleton, limb, pose, ankle, pole);
    if (rests != ankle) {
      solve_limb(skeleton, limb, {ankle + (rests - ankle) * foot.freedom, pole, 1.0f}, pose);
    }
  }
}

// How far the shin leans over the standing foot, rad; negative where the toes point away.
float dorsiflexion(const Skeleton& skeleton, const Limb& limb, const FootTarget& foot,
                   const Pose& pose) {
  const Quat shin = world_pose(skeleton, pose).rotation[index(limb.middle)];
  const Quat turn = glm::inverse(shin) * foot_rotation(foot);
  return -wrapped_angle(2 * std::atan2(turn.x, turn.w));
}

void set_leg(const Skeleton& skeleton, Side side, FootTarget foot, Quat pelvis, Pose& pose) {
  const Limb limb = leg(side);
  place_ankle(skeleton, limb, foot, pelvis, pose);
  // An ankle that is bent to its end lifts the heel; the ball stays.
  for (int i = 0; i < 5 && foot.freedom < 1; ++i) {
    const float excess = dorsiflexion(skeleton, limb, foot, pose) - kMostDorsiflexion;
    if (excess <= 0) break;
    foot.heel += excess;
    place_ankle(skeleton, limb, foot, pelvis, pose);
  }
  const WorldPose world = world_pose(skeleton, pose);
  const Quat shin = world.rotation[index(limb.middle)];
  const Quat standing = foot_rotation(foot);
  const Quat hanging = shin * glm::angleAxis(foot.point, kLeft);
  Quat wanted = glm::slerp(standing, in_hemisphere_of(hanging, standing),
                           std::clamp(foot.freedom, 0.0f, 1.0f));
  if (foot.freedom > 0) {
    const Vec3 at = world.position[index(limb.end)];
    wanted = wanted * glm::angleAxis(toes_off_floor(skeleton, at, wanted), kLeft);
  }
  const Quat ankle = glm::normalize(glm::inverse(shin) * wanted);
  // A foot that steps leans along with its shin as soon as it is off the floor.
  const float steps =
      foot.freedom > 0 ? 0 : glm::smoothstep(0.0f, kOffFloor, foot.ball.y - skeleton.toe_height());
  pose.rotation[index(limb.end)] = glm::slerp(ankle, ankle_within_range(ankle), steps);
  // The toes of a foot on its ball lie flat.
  const float flat = -foot.heel * (1 - std::clamp(foot.freedom, 0.0f, 1.0f));
  pose.rotation[index(toes(side))] = glm::angleAxis(flat, kLeft);
}

}  // namespace

Quat leaning(float forward, float left, float yaw) {
  return from_rotation_vector({forward, 0, -left}) * yaw_rotation(yaw);
}

Vec3 ankle_of(const Skeleton& skeleton, const FootTarget& foot) {
  const Vec3 set = foot.ball - foot_rotation(foot) * skeleton.offset[index(Joint::left_toes)];
  return foot.freedom <= 0 ? set : set + (foot.ankle - set) * std::min(1.0f, foot.freedom);
}

Pose torso_pose(const Skeleton& skeleton, const BodyTargets& targets) {
  Pose pose = rest_pose(skeleton);
  pose.hips = targets.pelvis;
  pose.rotation[index(Joint::hips)] = targets.pelvis_rotation;
  const Quat twist = glm::inverse(targets.pelvis_rotation) * targets.chest_rotation;
  pose.rotation[index(Joint::spine)] = part_of(twist, 0.30f);
  pose.rotation[index(Joint::chest)] = part_of(twist, 0.36f);
  pose.rotation[index(Joint::upper_chest)] = part_of(twist, 0.34f);
  Vec3 look = rotation_vector(glm::inverse(targets.chest_rotation) * targets.head_rotation);
  const float angle = glm::length(look);
  if (angle > kMostNeck) look *= kMostNeck / angle;
  pose.rotation[index(Joint::neck)] = from_rotation_vector(look * 0.5f);
  pose.rotation[index(Joint::head)] = from_rotation_vector(look * 0.5f);
  return pose;
}

Pose body_pose(const Skeleton& skeleton, const BodyTargets& targets) {
  Pose pose = torso_pose(skeleton, targets);
  for (std::size_t i = 0; i < 2; ++i) {
    set_arm(skeleton, side_at(i), targets.arms[i], pose);
    set_leg(skeleton, side_at(i), targets.feet[i], targets.pelvis_rotation, pose);
  }
  return pose;
}

float missing_reach(const Skeleton& skeleton, const BodyTargets& targets, float share) {
  float missing = 0;
  const float longest = share * skeleton.leg_length();
  for (std::size_t i = 0; i < 2; ++i) {
    const FootTarget& foot = targets.feet[i];
    if (foot.freedom > 0) continue;
    const Vec3 hip =
        targets.pelvis + targets.pelvis_rotation * skeleton.offset[index(leg(side_at(i)).root)];
    const Vec3 ankle = ankle_of(skeleton, foot);
    const float across = glm::length(Vec2(hip.x - ankle.x, hip.z - ankle.z));
    const float most = std::sqrt(std::max(0.0f, longest * longest - across * across));
    missing = std::max(missing, hip.y - ankle.y - most);
  }
  return missing;
}

}  // namespace ringcraft
