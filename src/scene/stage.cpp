#include "scene/stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "motion/ik.h"
#include "physics/limb_room.h"
#include "physics/penetration.h"
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
constexpr float kLegSlowsBy = kTickSeconds / .1f;  // a tick: of a leg that begins to swing
constexpr Tick kShownAhead = 2 * kTicksPerSecond;  // poses a planner is told of a launch in flight
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
    actors_.push_back(Actor{&own, std::move(body), Motion{std::move(playback)}});
  }
}

Pose Stage::clip_pose(const Actor& actor, Tick tick) const {
  const Pose clip = pose_at(*actor.library, actor.launch, tick, actor.body.scale);
  const Pose pose = part_of_answer(actor.body.skeleton, actor.rest, clip, actor.launch.share,
                                   actor.sway.at(tick - actor.launch.start));
  return actor.variation.of(actor.body.skeleton, library_.action(actor.launch.action), pose,
                            static_cast<Tick>(actor.launch.age(tick)), tick);
}

void Stage::begin(FighterId fighter, const Launch& launch) {
  begin(fighter, launch, {});
}

void Stage::begin(FighterId fighter, const Launch& launch, std::vector<Pose> simulated,
                  const Sway& sway) {
  Actor& actor = actors_[fighter.at()];
  actor.launch = launch;
  actor.sway = sway;
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
  actor.motion.seam = true;
  const Playback& playback = actor.motion.playback;
  if (playback.started() && !actor.motion.simulated) {
    LimitExcesses& free = actor.motion.free = limit_excesses(playback.shown());
    const LimitExcesses held_off = limit_excesses(actor.motion.shown);
    for (std::size_t i = 0; i < kLimitCount; ++i) free[i] = std::max(free[i], held_off[i]);
  }
  actor.motion.gives = {};
  actor.motion.landed = {};
  if (actor.simulated.empty()) stitch(actor, launch.start + 1, actor.motion.playback);
}

// To the clip, of which `tick` is shown next.
void Stage::stitch(const Actor& actor, Tick tick, Playback& playback) const {
  if (library_.action(actor.launch.action).starts_lying == Lying::none || !playback.started()) {
    playback.stitch(clip_pose(actor, tick), clip_pose(actor, tick + 1));
    return;
  }
  std::vector<Pose> clip;
  const Tick end = tick + ticks(PlaybackSettings{}.longest_blend);
  for (Tick t = tick; t <= end; ++t) clip.push_back(clip_pose(actor, t));
  const LimbRoom room(actor.body, {playback.shown(), clip.front(), clip.back()});
  playback.stitch(
      {clip, [&](const Limb& limb, const Pose& pose) { return room.lacks(limb, pose); }});
}

void Stage::drive_back(FighterId fighter, Part part, Vec3 velocity) {
  actors_[fighter.at()].motion.gives[static_cast<std::size_t>(guarding_side(part))].drive(velocity);
}

// The pose of the next tick with its arms where blows have driven them.
Pose Stage::given_way(const BodyModel& body, Motion& motion) {
  const Pose& pose = motion.playback.shown();
  LimbOffsets offsets{};
  for (const Side side : {Side::left, Side::right}) {
    const auto i = static_cast<std::size_t>(side);
    ArmGive& give = motion.gives[i];
    give.step();
    if (give.at_rest()) continue;
    offsets[i] = short_of_the_body(body, pose, side, give.offset());
  }
  return with_offsets(body, pose, offsets);
}

void Stage::land(FighterId fighter, const Contact& contact) {
  Actor& actor = actors_[fighter.at()];
  const auto limb = limb_of(contact.striker);
  if (!limb) return;
  Motion& motion = actor.motion;
  LandedLimb& landed = motion.landed[*limb];
  landed = LandedLimb(actor.body, kArmsAndLegs[*limb], motion.shown_before, motion.shown, contact);
  // The others are held back in this tick already.
  const WorldPose world = world_pose(actor.body.skeleton, motion.unhindered);
  LimbOffsets offsets{};
  offsets[*limb] = landed.hold_back(world.position[index(kArmsAndLegs[*limb].end)]);
  motion.unhindered = with_offsets(actor.body, motion.unhindered, offsets);
}

// The pose with the limbs that have landed no farther than they were then. A leg that carries is
// free.
Pose Stage::stopped(const BodyModel& body, Motion& motion, const Pose& pose) {
  LimbOffsets offsets{};
  std::array<LandedLimb, 4>& landed = motion.landed;
  const WorldPose world = world_pose(body.skeleton, pose);
  const FootContacts held = motion.playback.held();
  if (held.left) landed[2].let_go();
  if (held.right) landed[3].let_go();
  for (std::size_t i = 0; i < landed.size(); ++i) {
    offsets[i] = landed[i].hold_back(world.position[index(kArmsAndLegs[i].end)]);
  }
  return with_offsets(body, pose, offsets);
}

void Stage::shift(FighterId fighter, Vec3 offset) {
  Actor& actor = actors_[fighter.at()];
  actor.launch.placement.x += offset.x;
  actor.launch.placement.z += offset.z;
  actor.rest.hips += Vec3{offset.x, 0, offset.z};
  const bool falls = library_.action(actor.launch.action).ends_lying != Lying::none;
  for (Pose& pose : actor.simulated) {
    if (falls) {
      pose.hips += Vec3{offset.x, 0, offset.z};
    } else {
      pose = swayed(actor.body.skeleton, pose, {offset.x, 0, offset.z});
    }
  }
  actor.track.segments.back().launch.placement = actor.launch.placement;
}

// A foot that stands where its leg would soon be at the end of a joint's range, and the clip's
// would not, is let go before: a leg that is stopped there takes the foot along at once.
void Stage::relieve_feet(const Pose& clip, Playback& playback) {
  constexpr float kAhead = .08f;             // s
  constexpr float kOffTheClip = radians(8);  // farther out than the clip's joint
  const FootContacts held = playback.held();
  if (!held.left && !held.right) return;
  const LimitExcesses is = limit_excesses(playback.shown()),
                      was = limit_excesses(playback.shown_before()), own = limit_excesses(clip);
  for (std::size_t i = 0; i < kLimitCount; ++i) {
    const auto leg = leg_of_limit(i);
    if (!leg || !held.of(*leg) || is[i] < own[i] + kOffTheClip || is[i] <= was[i]) continue;
    if (is[i] + (is[i] - was[i]) * kAhead / kTickSeconds > 0) playback.strain(*leg);
  }
}

// The next tick's pose as if nothing stood in its way.
void Stage::go_on(const Actor& actor, Tick tick, Motion& motion) const {
  const Clip& clip = library_.action(actor.launch.action).clip;
  auto at = static_cast<std::size_t>(tick - actor.simulated_from);
  // Who fell lies where the ragdoll came to rest, until a get-up begins.
  const bool lies = library_.action(actor.launch.action).ends_lying != Lying::none;
  if (lies && !actor.simulated.empty()) at = std::min(at, actor.simulated.size() - 1);
  const bool simulated = at < actor.simulated.size();
  const bool seam = motion.simulated && !simulated && motion.playback.started();
  if (simulated) {
    motion.playback.next_simulated(actor.simulated[at]);
  } else {
    const Pose pose = clip_pose(actor, tick);
    if (seam) stitch(actor, tick, motion.playback);
    motion.playback.next(pose, clip.contacts_at(actor.launch.clip_age(tick)));
    relieve_feet(pose, motion.playback);
  }
  motion.simulated = simulated;
  for (LandedLimb& limb : motion.landed) limb.step();
  motion.unhindered = stopped(actor.body, motion, given_way(actor.body, motion));
}

void Stage::next(const Actor& actor, Tick tick, Motion& motion) const {
  const bool first = !motion.playback.started(), begins = motion.seam;
  go_on(actor, tick, motion);
  // A simulation starts from what is shown; a clip from the motion before it, and what is in the
  // way goes on holding limbs off: pushed aside, a limb does not fly on by itself.
  if (begins && motion.simulated) motion.kept_out = {};
  free_joints(actor, tick, motion);
  motion.shown_before = first ? motion.unhindered : motion.shown;
  hold_off(actor.body, motion);
}

// The thighs whose knee is on its way to strike: it ends them, and they are thicker than the shins
// that land.
std::uint32_t Stage::knees_to_land(const Actor& actor, Tick tick) const {
  std::uint32_t thighs = 0;
  for (const Strike& strike : library_.action(actor.launch.action).strikes) {
    if (strike.kind != StrikeKind::knee) continue;
    if (actor.launch.clip_age(tick) >= strike.active_end) continue;
    const bool left = strike.joint == leg(Side::left).middle;
    if (actor.motion.landed[left ? 2 : 3].holds()) continue;
    thighs |= 1u << index(left ? Part::left_thigh : Part::right_thigh);
  }
  return thighs;
}

void Stage::show(Tick tick) {
  for (Actor& actor : actors_) {
    next(actor, tick, actor.motion);
    actor.swept.before = actor.swept.after;
    actor.swept.guards =
        guarding_parts(library_.action(actor.launch.action), actor.launch.clip_age(tick));
    actor.swept.after = shown_capsules(actor);
    actor.knees = knees_to_land(actor, tick);
    actor.recorded = false;
    if (actor.track.frames.empty()) actor.swept.before = actor.swept.after;
  }
}

// How far each joint may go in this tick before it slows: as far as its clip does, from a seam on
// as far as it was shown there. Legs bear the body: theirs do not slow while they stand.
void Stage::free_joints(const Actor& actor, Tick tick, Motion& motion) const {
  const LimitExcesses clip = limit_excesses(clip_pose(actor, tick));
  const bool seam = motion.simulated || motion.seam;
  if (motion.simulated) motion.free = limit_excesses(motion.playback.shown());
  motion.seam = false;
  const FootContacts held = motion.playback.held();
  for (const Side side : {Side::left, Side::right}) {
    float& share = motion.swings[static_cast<std::size_t>(side)];
    share = std::clamp(share + (held.of(side) ? -kLegSlowsBy : kLegSlowsBy), 0.0f, 1.0f);
  }
  for (std::size_t i = 0; i < kLimitCount; ++i) {
    const auto leg = leg_of_limit(i);
    const float slows = leg ? motion.swings[static_cast<std::size_t>(*leg)] : 1.0f;
    const float own = glm::mix(kLimitTolerance, std::max(kSlowsFrom, clip[i]), slows);
    float& more = motion.free_more[i];
    if (seam) more = std::max(kSlowsFrom, motion.free[i]) - own;
    more -= std::clamp(more, -kSlowsBy, kSlowsBy);
    motion.free[i] = own + more;
  }
}

Pose Stage::in_range(const BodyModel& body, const Motion& motion, const Pose& pose,
                     const Pose& earlier) {
  LimitExcesses simulated;  // mended already
  simulated.fill(kLimitTolerance);
  return limited(body, pose, earlier, motion.simulated ? simulated : motion.free);
}

void Stage::hold_off(const BodyModel& body, Motion& motion) {
  Playback& playback = motion.playback;
  playback.amend(in_range(body, motion, motion.unhindered, playback.shown_before()));
  motion.shown = playback.shown();
  if (motion.kept_out != LimbOffsets{}) {
    motion.shown = in_range(body, motion, with_offsets(body, motion.unhindered, motion.kept_out),
                            motion.shown_before);
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    Quat& rotation = motion.shown.rotation[j];
    rotation = in_hemisphere_of(rotation, motion.shown_before.rotation[j]);
  }
}

BodyCapsules Stage::shown_capsules(const Actor& actor) {
  return capsules(actor.body, world_pose(actor.body.skeleton, actor.motion.shown));
}

void Stage::keep_out_and_record() {
  std::vector<LimbOffsets> before;
  before.reserve(actors_.size());
  for (const Actor& actor : actors_) before.push_back(actor.motion.kept_out);
  for (std::size_t i = 0; i < actors_.size(); ++i) keep_out(actors_[i], before[i]);
  // Who was not last has not seen where the others went.
  constexpr float kStillDeep = .02f;  // m
  for (std::size_t i = 0; i + 1 < actors_.size(); ++i) {
    const bool deep = std::any_of(actors_.begin(), actors_.end(), [&](const Actor& other) {
      return &other != &actors_[i] &&
             deepest_penetration(actors_[i].swept.after, other.swept.after).depth > kStillDeep;
    });
    if (deep) keep_out(actors_[i], before[i]);
  }
  for (Actor& actor : actors_) {
    draw_feet_away(actor);
    set_feet_aside(actor);
    actor.recorded = true;
    actor.track.frames.push_back(actor.motion.shown);
    actor.track.contacts.push_back(actor.motion.playback.held());
  }
}

// The bodies within its reach, as they are shown.
std::vector<BodyCapsules> Stage::near(const Actor& actor) const {
  std::vector<BodyCapsules> all;
  for (const Actor& other : actors_) {
    const float apart = glm::distance(actor.motion.unhindered.hips, other.motion.shown.hips);
    if (&other != &actor && apart < kArmsReach * actor.body.scale) all.push_back(other.swept.after);
  }
  return all;
}

void Stage::keep_out(Actor& actor, const LimbOffsets& before) const {
  Motion& motion = actor.motion;
  motion.kept_out = kept_out(
      actor.body, motion.unhindered, motion.playback.held(), near(actor), before,
      [&](const Pose& pose) { return in_range(actor.body, motion, pose, motion.shown_before); },
      actor.knees);
  hold_off(actor.body, motion);
  actor.swept.after = shown_capsules(actor);
}

// A foot on which a body falls does not stay under it.
void Stage::draw_feet_away(Actor& actor) const {
  constexpr float kPressed = .02f;  // m
  const FootContacts held = actor.motion.playback.held();
  for (const Actor& other : actors_) {
    const bool falls = library_.action(other.launch.action).ends_lying != Lying::none;
    if (&other == &actor || !other.motion.simulated || !falls) continue;
    for (const Penetration& one : penetrations(actor.swept.after, other.swept.after, kPressed)) {
      for (const Side side : {Side::left, Side::right}) {
        const Part foot = side == Side::left ? Part::left_foot : Part::right_foot;
        if (one.a == foot && held.of(side)) actor.motion.playback.strain(side);
      }
    }
  }
}

// A foot that comes down where another body is stands beside it, and does not slide into it once it
// carries.
void Stage::set_feet_aside(Actor& actor) const {
  for (const Side side : {Side::left, Side::right}) {
    Vec3& offset = actor.motion.kept_out[2 + static_cast<std::size_t>(side)];
    if (!actor.motion.playback.presses_down(side) || offset == Vec3{}) continue;
    Vec3 aside{offset.x, 0, offset.z};
    const Part foot = side == Side::left ? Part::left_foot : Part::right_foot;
    const Pose& pose = actor.motion.unhindered;
    Capsule stands = capsules(actor.body, world_pose(actor.body.skeleton, pose))[index(foot)];
    stands.a += aside;
    stands.b += aside;
    aside +=
        way_beside(stands, near(actor), aside == Vec3{} ? pose.rotation[0] * -kForward : aside);
    actor.motion.playback.stand_aside(side, aside);
    actor.aside += aside;
    offset -= aside;
  }
}

Vec3 Stage::taken_aside(FighterId fighter) {
  return std::exchange(actors_[fighter.at()].aside, {});
}

float Stage::wedged(FighterId fighter, FighterId other) const {
  const Actor& actor = actors_[fighter.at()];
  return wedge(actor.swept.after, actor.motion.kept_out, actors_[other.at()].swept.after);
}

bool Stage::simulated(FighterId fighter) const {
  return actors_[fighter.at()].motion.simulated;
}

std::vector<Pose> Stage::continued(FighterId fighter, Tick tick, Tick count) const {
  const Actor& actor = actors_[fighter.at()];
  Motion ahead = actor.motion;
  std::vector<Pose> poses{ahead.shown};
  bool came_back = actor.recorded;  // what was held off in the last tick
  for (Tick t = tick + 1; static_cast<Tick>(poses.size()) < count; ++t) {
    if (!came_back) {
      ahead.kept_out =
          kept_out(actor.body, ahead.unhindered, ahead.playback.held(), {}, ahead.kept_out);
    }
    came_back = false;
    next(actor, t, ahead);
    poses.push_back(ahead.shown);
  }
  return poses;
}

MotionInFlight Stage::in_flight(FighterId fighter, Tick tick) const {
  const Actor& actor = actors_[fighter.at()];
  MotionInFlight motion;
  motion.launch = actor.launch;
  motion.from = tick;
  // A blow at its end is answered by a body that goes on.
  constexpr Tick kGoesOn = kImpulseStepTicks + 1;
  const Launch& launch = actor.launch;
  const Tick shown = std::clamp(launch.end, tick, tick + kShownAhead) + kGoesOn;
  motion.poses = continued(fighter, tick, shown - tick + 1);
  const Tick clip_length = actor.library->action(launch.action).length();
  const Tick over = std::min(launch.end, launch.when(clip_length)) + kGoesOn;
  for (Tick t = launch.start; t <= std::max(shown, over); ++t) {
    motion.clip_ages.push_back(launch.clip_age(t));
  }
  return motion;
}

std::vector<FighterTrack> Stage::take_tracks() {
  std::vector<FighterTrack> tracks;
  for (Actor& actor : actors_) tracks.push_back(std::move(actor.track));
  return tracks;
}

}  // namespace ringcraft
