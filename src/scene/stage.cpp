#include "scene/stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "motion/ik.h"
#include "physics/partial.h"
#include "planner/condition.h"
#include "scene/answer.h"
#include "scene/keep_out.h"

namespace ringcraft {

namespace {
constexpr float kArmsReach =
    2.4f;  // m between the hips of canonical bodies: beyond it none can touch
constexpr float kLimitTolerance = radians(2);
constexpr float kSlowsFrom = radians(-12);  // of a joint's range: there it slows, unless its clip
constexpr float kUpright = .6f;             // of the leg's length: hips lower than that lie
constexpr float kLegSlowsBy = kTickSeconds / .1f;       // a tick: of a leg that begins to swing
constexpr float kSlowsBy = radians(60) * kTickSeconds;  // rad a tick: at which that sets in

// The pose with its joints inside their ranges, on the side on which they were a tick `earlier`,
// slowing from where they are `free` to go; feet of a body that is up stay where they are as far as
// the ranges of the leg allow.
Pose limited(const BodyModel& body, const Pose& pose, const Pose& earlier,
             const LimitExcesses& free) {
  Pose result = within_limits(body, pose, kLimitTolerance, earlier, free);
  if (pose.hips.y < kUpright * body.skeleton.leg_length()) return result;
  const WorldPose before = world_pose(body.skeleton, pose);
  for (const Side side : {Side::left, Side::right}) {
    const Limb limb = leg(side);
    const WorldPose after = world_pose(body.skeleton, result);
    const Vec3 ankle = before.position[index(limb.end)];
    if (glm::distance(ankle, after.position[index(limb.end)]) < 1e-5f) continue;
    move_limb_end(body.skeleton, limb, ankle, 1.0f, result);
  }
  return within_limits(body, result, kLimitTolerance, earlier, free);
}

}  // namespace

Stage::Stage(const MotionLibrary& library, std::vector<BodyModel> bodies, Repetitions repetitions)
    : library_(library), repetitions_(repetitions) {
  for (BodyModel& body : bodies) {
    const MotionLibrary& own = library.of(FighterId(actors_.size()));
    Playback playback(body.skeleton);
    actors_.push_back(Actor{&own, std::move(body), std::move(playback)});
  }
}

Pose Stage::clip_pose(const Actor& actor, Tick tick) const {
  const Tick start = actor.launch.start;
  const float age = actor.pace.age(tick - start);
  const auto whole = static_cast<Tick>(std::floor(age));
  const float share = age - static_cast<float>(whole);
  const MotionLibrary& own = *actor.library;
  Pose pose = pose_at(own, actor.launch, start + whole, actor.body.scale);
  if (share > 0) {
    pose = mix(pose, pose_at(own, actor.launch, start + whole + 1, actor.body.scale), share);
  }
  if (actor.launch.share < 1) {
    pose = partial_pose(actor.body.skeleton, actor.rest, pose, actor.launch.share);
  }
  return actor.variation.of(actor.body.skeleton, library_.action(actor.launch.action), pose, whole,
                            tick);
}

Tick Stage::clip_age(const Actor& actor, Tick tick) {
  return static_cast<Tick>(std::lround(actor.pace.age(tick - actor.launch.start)));
}

void Stage::begin(FighterId fighter, const Launch& launch) {
  begin(fighter, launch, {});
}

void Stage::begin(FighterId fighter, const Launch& launch, std::vector<Pose> simulated,
                  const Pace& pace) {
  Actor& actor = actors_[fighter.at()];
  actor.launch = launch;
  actor.pace = pace;
  if (launch.share < 1) actor.rest = rest_of(*actor.library, launch, actor.body.scale);
  // No two launches of a fight are alike, and none depends on anything but the record.
  if (repetitions_ == Repetitions::varied) {
    actor.variation = Variation(derived_seed(static_cast<std::uint64_t>(launch.start), "launch",
                                             static_cast<std::uint64_t>(fighter.at())));
  }
  actor.simulated = std::move(simulated);
  actor.simulated_from = launch.start + 1;
  const Action& action = library_.action(launch.action);
  if (!actor.track.segments.empty()) {
    Launch& last = actor.track.segments.back().launch;
    last.end = std::min(last.end, launch.start);
  }
  actor.track.segments.push_back({launch, action.name, action.kind, action.feint.has_value()});
  actor.seam = true;
  actor.kept_out = {};  // what is shown is where the new motion starts from
  actor.gives = {};
  actor.landed = {};
  if (actor.simulated.empty()) {
    actor.playback.stitch(clip_pose(actor, launch.start + 1), clip_pose(actor, launch.start + 2));
  }
}

void Stage::drive_back(FighterId fighter, Part part, Vec3 velocity) {
  actors_[fighter.at()].gives[static_cast<std::size_t>(guarding_side(part))].drive(velocity);
}

// The pose of the next tick with its arms where blows have driven them.
Pose Stage::given_way(const Actor& actor, std::array<ArmGive, 2>& gives, const Pose& pose) {
  LimbOffsets offsets{};
  for (const Side side : {Side::left, Side::right}) {
    const auto i = static_cast<std::size_t>(side);
    gives[i].step();
    if (gives[i].at_rest()) continue;
    offsets[i] = short_of_the_body(actor.body, pose, side, gives[i].offset());
  }
  return with_offsets(actor.body, pose, offsets);
}

void Stage::land(FighterId fighter, const Contact& contact) {
  Actor& actor = actors_[fighter.at()];
  const auto limb = limb_of(contact.striker);
  if (!limb) return;
  actor.landed[*limb] = LandedLimb(actor.body, kArmsAndLegs[*limb], actor.playback.shown_before(),
                                   actor.playback.shown(), contact);
  actor.unhindered = stopped(actor, actor.landed, actor.unhindered);
}

// The pose with the limbs that have landed no farther than they were then. A leg that carries is
// free.
Pose Stage::stopped(const Actor& actor, std::array<LandedLimb, 4>& landed, const Pose& pose) {
  LimbOffsets offsets{};
  const WorldPose world = world_pose(actor.body.skeleton, pose);
  const FootContacts held = actor.playback.held();
  if (held.left) landed[2] = {};
  if (held.right) landed[3] = {};
  for (std::size_t i = 0; i < landed.size(); ++i) {
    const Vec3 end = world.position[index(kArmsAndLegs[i].end)];
    offsets[i] = landed[i].held_back(end);
    landed[i].let_go_behind(end);
  }
  return with_offsets(actor.body, pose, offsets);
}

void Stage::shift(FighterId fighter, Vec3 offset) {
  Actor& actor = actors_[fighter.at()];
  actor.launch.placement.x += offset.x;
  actor.launch.placement.z += offset.z;
  actor.rest.hips += Vec3{offset.x, 0, offset.z};
  actor.track.segments.back().launch.placement = actor.launch.placement;
}

void Stage::show(Tick tick) {
  for (Actor& actor : actors_) {
    const Clip& clip = library_.action(actor.launch.action).clip;
    auto at = static_cast<std::size_t>(tick - actor.simulated_from);
    // Who fell lies where the ragdoll came to rest, until a get-up begins.
    const bool lies = library_.action(actor.launch.action).ends_lying != Lying::none;
    if (lies && !actor.simulated.empty()) at = std::min(at, actor.simulated.size() - 1);
    if (at < actor.simulated.size()) {
      actor.playback.next_simulated(actor.simulated[at]);
      actor.was_simulated = true;
    } else {
      const Pose pose = clip_pose(actor, tick);
      if (actor.was_simulated && actor.playback.started()) {
        actor.kept_out = {};
        actor.playback.stitch(pose, clip_pose(actor, tick + 1));
      }
      actor.was_simulated = false;
      actor.playback.next(pose, clip.contacts_at(clip_age(actor, tick)));
    }
    for (LandedLimb& limb : actor.landed) limb.step();
    actor.unhindered =
        stopped(actor, actor.landed, given_way(actor, actor.gives, actor.playback.shown()));
    free_joints(actor, tick);
    actor.swept.before = actor.swept.after;
    amend(actor, actor.kept_out);
    if (actor.track.frames.empty()) actor.swept.before = actor.swept.after;
  }
}

// How far each joint may go in this tick before it slows: as far as its clip does, from a seam on
// as far as it was shown there. Legs bear the body: theirs do not slow while they stand.
void Stage::free_joints(Actor& actor, Tick tick) const {
  const LimitExcesses clip = limit_excesses(clip_pose(actor, tick));
  if (actor.was_simulated) actor.free = limit_excesses(actor.playback.shown());
  const bool seam = actor.was_simulated || actor.seam;
  actor.seam = false;
  const FootContacts held = actor.playback.held();
  for (const Side side : {Side::left, Side::right}) {
    float& share = actor.swings[static_cast<std::size_t>(side)];
    share = std::clamp(share + (held.of(side) ? -kLegSlowsBy : kLegSlowsBy), 0.0f, 1.0f);
  }
  for (std::size_t i = 0; i < kLimitCount; ++i) {
    const auto leg = leg_of_limit(i);
    const float slows = leg ? actor.swings[static_cast<std::size_t>(*leg)] : 1.0f;
    const float own = glm::mix(kLimitTolerance, std::max(kSlowsFrom, clip[i]), slows);
    float& more = actor.free_more[i];
    if (seam) more = std::max(kSlowsFrom, actor.free[i]) - own;
    more -= std::clamp(more, -kSlowsBy, kSlowsBy);
    actor.free[i] = own + more;
  }
}

void Stage::amend(Actor& actor, const LimbOffsets& offsets) {
  actor.kept_out = offsets;
  LimitExcesses simulated;  // mended already
  simulated.fill(kLimitTolerance);
  actor.playback.amend(limited(actor.body, with_offsets(actor.body, actor.unhindered, offsets),
                               actor.playback.shown_before(),
                               actor.was_simulated ? simulated : actor.free));
  actor.swept.after = capsules(actor.body, world_pose(actor.body.skeleton, actor.playback.shown()));
}

void Stage::keep_out_and_record() {
  for (Actor& actor : actors_) {
    std::vector<BodyCapsules> near;
    for (const Actor& other : actors_) {
      const float apart = glm::distance(actor.unhindered.hips, other.playback.shown().hips);
      if (&other != &actor && apart < kArmsReach * actor.body.scale)
        near.push_back(other.swept.after);
    }
    amend(actor,
          kept_out(actor.body, actor.unhindered, actor.playback.held(), near, actor.kept_out));
    actor.track.frames.push_back(actor.playback.shown());
    actor.track.contacts.push_back(actor.playback.held());
  }
}

const Pose& Stage::shown_before(FighterId fighter) const {
  return actors_[fighter.at()].playback.shown_before();
}

bool Stage::simulated(FighterId fighter) const {
  return actors_[fighter.at()].was_simulated;
}

std::vector<Pose> Stage::continued(FighterId fighter, Tick tick, Tick count) const {
  const Actor& actor = actors_[fighter.at()];
  const Clip& clip = library_.action(actor.launch.action).clip;
  Playback ahead = actor.playback;
  std::array<ArmGive, 2> gives = actor.gives;
  std::array<LandedLimb, 4> landed = actor.landed;
  std::vector<Pose> poses{actor.playback.shown()};
  for (Tick next = tick + 1; static_cast<Tick>(poses.size()) < count; ++next) {
    const auto at = static_cast<std::size_t>(next - actor.simulated_from);
    if (at < actor.simulated.size()) {
      poses.push_back(actor.simulated[at]);
    } else {
      const Pose& pose =
          ahead.next(clip_pose(actor, next), clip.contacts_at(clip_age(actor, next)));
      for (LandedLimb& limb : landed) limb.step();
      poses.push_back(with_offsets(
          actor.body, stopped(actor, landed, given_way(actor, gives, pose)), actor.kept_out));
    }
  }
  return poses;
}

std::vector<FighterTrack> Stage::take_tracks() {
  std::vector<FighterTrack> tracks;
  for (Actor& actor : actors_) tracks.push_back(std::move(actor.track));
  return tracks;
}

}  // namespace ringcraft
