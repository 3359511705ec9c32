#include "physics/partial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/ik.h"
#include "motion/strike_fit.h"
#include "physics/balance.h"

namespace ringcraft {
namespace {

constexpr Tick kMeasured = 24;       // 0.2 s: heads are farthest at 0.1 s, trunks before 0.2 s
constexpr float kFace = .15f;        // m before the head's joint: shows turns
constexpr float kCalm = .01f;        // N s: moves nothing, and still says on which side it lands
constexpr Tick kAnswers = 36;        // 0.3 s: to feel a blow and to choose what to do
constexpr float kNearly = .03f;      // m from where the clip leads: as good as there
constexpr float kStraight = .95f;    // of a leg's length: no straighter does a sway make it
constexpr float kShortest = .4f;     // of a clip's steps
constexpr float kSameStance = .05f;  // m: feet that stand so near to where they stood

// Head, face, chest and hips, m.
std::array<Vec3, 4> upper(const Skeleton& skeleton, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const Vec3 head = world.position[index(Joint::head)];
  return {head, head + world.rotation[index(Joint::head)] * (kFace * kForward),
          world.position[index(Joint::upper_chest)], world.position[0]};
}

// What a blow to the zone moves, m: knees, or head, face, chest and hips.
std::vector<Vec3> moved_by(TargetZone zone, const Skeleton& skeleton, const Pose& pose) {
  if (zone != TargetZone::leg) {
    const auto points = upper(skeleton, pose);
    return {points.begin(), points.end()};
  }
  const WorldPose world = world_pose(skeleton, pose);
  return {world.position[index(leg(Side::left).middle)],
          world.position[index(leg(Side::right).middle)]};
}

// Head, face, chest, hips and feet, m.
std::array<Vec3, 6> whole(const Skeleton& skeleton, const Pose& pose) {
  const auto [head, face, chest, hips] = upper(skeleton, pose);
  const WorldPose world = world_pose(skeleton, pose);
  return {head,
          face,
          chest,
          hips,
          world.position[index(Joint::left_foot)],
          world.position[index(Joint::right_foot)]};
}

float apart(std::span<const Vec3> a, std::span<const Vec3> b) {
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
  return most;
}

// How far the hips have to sink, m, so that a leg from the foot to its hip, moved by `offset`, is
// no longer than `most`, or than it was. Nothing where that does not help.
float sunk(Vec3 leg, Vec3 offset, float most) {
  const Vec3 moved = leg + offset;
  const float more = glm::dot(moved, moved) - std::max(most * most, glm::dot(leg, leg));
  const float left = moved.y * moved.y - more;
  return more <= 0 || moved.y <= 0 || left < 0 ? 0.0f : moved.y - std::sqrt(left);
}

// How far the feet stand at the end of a clip from where they stood at its beginning, seen from the
// root, m of the canonical body.
float stance_change(const Skeleton& skeleton, const Clip& clip) {
  const auto ankles = [&](Tick tick) {
    const WorldPose world = world_pose(skeleton, clip.at(tick));
    const Placement root = inverse(clip.root_at(tick));
    return std::array<Vec3, 2>{root * world.position[index(Joint::left_foot)],
                               root * world.position[index(Joint::right_foot)]};
  };
  return apart(ankles(0), ankles(clip.length()));
}

}  // namespace

Vec3 Sway::at(Tick after_blow) const {
  const float t = static_cast<float>(std::max(0, after_blow)) / static_cast<float>(kMeasured);
  return far * (t * std::exp(1 - t));
}

Pose swayed(const Skeleton& skeleton, const Pose& pose, Vec3 offset) {
  const WorldPose stood = world_pose(skeleton, pose);
  float sinks = 0;
  for (const Side side : {Side::left, Side::right}) {
    const Vec3 from_foot =
        stood.position[index(leg(side).root)] - stood.position[index(leg(side).end)];
    sinks = std::max(sinks, sunk(from_foot, offset, kStraight * skeleton.leg_length()));
  }
  Pose moved = pose;
  moved.hips += offset - kUp * sinks;
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t end = index(leg(side).end);
    move_limb_end(skeleton, leg(side), stood.position[end], 1.0f, moved);
    set_world_rotation(skeleton, leg(side).end, stood.rotation[end], moved);
  }
  return moved;
}

Absorbed absorbed(const BodyModel& body, const ImpactInput& input, const ImpactOutcome& outcome,
                  const Pose& rest, std::span<const Pose> clip) {
  if (clip.empty() || glm::length(input.blow.impulse) <= 0) return {};
  const TargetZone zone = outcome.zone;
  const float goes = way_of_clip(body.skeleton, rest, clip, zone);
  if (goes <= 0) return {};

  ImpactInput calm = input;
  calm.blow.impulse *= kCalm / glm::length(calm.blow.impulse);
  const std::span still(&rest, 1);
  const auto struck = simulate_response(body, input, outcome, still, kMeasured);
  const auto unstruck = simulate_response(body, calm, outcome, still, kMeasured);
  float moved = 0;
  for (std::size_t t = 0; t < struck.size(); ++t) {
    moved = std::max(moved, apart(moved_by(zone, body.skeleton, struck[t]),
                                  moved_by(zone, body.skeleton, unstruck[t])));
  }
  Absorbed shown;
  shown.share = std::min(1.0f, moved / goes);

  Vec3 sways{};
  for (std::size_t t = 0; t < struck.size(); ++t) {
    const Vec3 hips = struck[t].hips - unstruck[t].hips, over_ground{hips.x, 0, hips.z};
    if (glm::length(over_ground) > glm::length(sways)) sways = over_ground;
  }
  const Vec3 way = normalized_or(sways, Vec3{});
  float by_clip = 0;
  for (const Pose& pose : clip.first(std::min<std::size_t>(clip.size(), kMeasured + 1))) {
    by_clip = std::max(by_clip, shown.share * glm::dot(pose.hips - rest.hips, way));
  }
  shown.sway.far = way * std::max(0.0f, glm::length(sways) - by_clip);
  return shown;
}

void put_in_guard(const MotionLibrary& library, const Action& response, Pose& pose) {
  const Pose* guard = standing_guard(library, response.stance);
  if (guard == nullptr) return;
  constexpr std::size_t kHips = index(Joint::hips);
  for (std::size_t i = index(Joint::spine); i <= index(Joint::right_hand); ++i) {
    pose.rotation[i] = guard->rotation[i];
  }
  // The trunk as the guard has it, however the clip's hips are turned.
  const Quat hips = response.clip.frames.front().rotation[kHips];
  pose.rotation[index(Joint::spine)] = glm::normalize(
      glm::conjugate(hips) * guard->rotation[kHips] * guard->rotation[index(Joint::spine)]);
}

float way_of_clip(const Skeleton& skeleton, const Pose& rest, std::span<const Pose> clip,
                  TargetZone zone) {
  const auto at_rest = moved_by(zone, skeleton, rest);
  float goes = 0;
  for (const Pose& pose : clip) {
    goes = std::max(goes, apart(moved_by(zone, skeleton, pose), at_rest));
  }
  return goes;
}

std::vector<float> way_left(const Skeleton& skeleton, std::span<const Pose> clip) {
  if (clip.empty()) return {};
  const auto at_last = whole(skeleton, clip.back());
  std::vector<float> left;
  left.reserve(clip.size());
  for (const Pose& pose : clip) left.push_back(apart(whole(skeleton, pose), at_last));
  return left;
}

Strides strides_of(const Skeleton& skeleton, const Clip& clip, float scale) {
  Strides strides;
  for (const Pose& pose : clip.frames) {
    const Vec3 way = pose.hips - clip.frames.front().hips;
    strides.longest = std::max(strides.longest, scale * glm::length(Vec3{way.x, 0, way.z}));
  }
  const bool in_part = stance_change(skeleton, clip) < kSameStance;
  strides.shortest = (in_part ? kShortest : 1) * strides.longest;
  return strides;
}

float share_of_steps(const BodyModel& body, const ImpactOutcome& outcome, const Strides& strides) {
  if (strides.longest <= 0) return 1;
  const float stride = stride_to_catch(body, outcome.margin);
  return std::clamp(stride, strides.shortest, strides.longest) / strides.longest;
}

Tick free_again(std::span<const float> left, float share) {
  const auto far =
      std::find_if(left.rbegin(), left.rend(), [&](float way) { return share * way > kNearly; });
  const auto near = static_cast<Tick>(left.rend() - far);  // the first after the last that is far
  const auto last = static_cast<Tick>(left.size()) - 1;
  return std::max(0, std::min(last, std::max(kAnswers, near)));
}

float share_foreseen(const ImpactOutcome& outcome, float way_of_clip) {
  if (way_of_clip <= 0) return 0;
  float moved = outcome.knee_moved;
  if (outcome.zone != TargetZone::leg) {
    moved = 0;
    for (const Vec3& way : outcome.moved) moved = std::max(moved, glm::length(way));
  }
  return std::min(1.0f, moved / way_of_clip);
}

Pose partial_pose(const Skeleton& skeleton, const Pose& rest, const Pose& pose, float share) {
  Pose part = mix(rest, pose, share);
  const WorldPose from = world_pose(skeleton, rest), to = world_pose(skeleton, pose);
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t end = index(leg(side).end);
    move_limb_end(skeleton, leg(side), glm::mix(from.position[end], to.position[end], share), 1.0f,
                  part);
    const Quat turn = glm::slerp(from.rotation[end],
                                 in_hemisphere_of(to.rotation[end], from.rotation[end]), share);
    set_world_rotation(skeleton, leg(side).end, glm::normalize(turn), part);
  }
  return part;
}

}  // namespace ringcraft
