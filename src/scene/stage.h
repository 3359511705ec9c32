#pragma once
// The stage: every fighter's shown motion, tick by tick, and the capsules that touch.

#include <vector>

#include "fight/timeline.h"
#include "motion/playback.h"
#include "motion/variation.h"
#include "physics/contact.h"
#include "physics/limits.h"
#include "physics/partial.h"
#include "planner/motion_tables.h"
#include "scene/give.h"
#include "scene/keep_out.h"
#include "scene/landed.h"

namespace ringcraft {

// Whether two launches of one action are shown alike (motion/variation.h).
enum class Repetitions : std::uint8_t { alike, varied };

class Stage {
 public:
  Stage(const MotionLibrary& library, std::vector<BodyModel> bodies,
        Repetitions repetitions = Repetitions::alike);

  std::size_t size() const { return actors_.size(); }
  const BodyModel& body(FighterId fighter) const { return actors_[fighter.at()].body; }

  // From the next tick on, the fighter's launch is shown, stitched to what is shown now.
  void begin(FighterId fighter, const Launch& launch);

  // The same for a response: `simulated` poses are shown first, one a tick, then the launch's
  // clip, or its share of it, as it sways (physics/partial.h).
  void begin(FighterId fighter, const Launch& launch, std::vector<Pose> simulated,
             const Sway& sway = {});

  // The arm of a guard that held a blow is driven back at `velocity`, m/s, and springs back.
  void drive_back(FighterId fighter, Part part, Vec3 velocity);

  // The limb that met something with a blow in this tick stops there, in this tick already.
  void land(FighterId fighter, const Contact& contact);

  // Moves a fighter's launch on the ground; the feet follow by steps of their own. What is still to
  // come of a simulation goes along, of who stands but for its feet.
  void shift(FighterId fighter, Vec3 offset);

  // Where feet that were set down beside another body have gone, on the ground, since the last
  // call: what the fighter's body is to follow.
  Vec3 taken_aside(FighterId fighter);

  // How far a limb of the fighter is wedged by the other (keep_out.h), m.
  float wedged(FighterId fighter, FighterId other) const;

  // Shows one tick of every fighter: poses and capsules, as if nothing stood in their way.
  void show(Tick tick);

  // After the contacts of the tick were answered: keeps limbs out of the other bodies, and records.
  void keep_out_and_record();

  const Launch& launch(FighterId fighter) const { return actors_[fighter.at()].launch; }
  const Pose& shown(FighterId fighter) const { return actors_[fighter.at()].motion.shown; }
  const Pose& shown_before(FighterId fighter) const {
    return actors_[fighter.at()].motion.shown_before;
  }
  FootContacts held(FighterId fighter) const {
    return actors_[fighter.at()].motion.playback.held();
  }
  bool simulated(FighterId fighter) const;
  // Capsules now and one tick ago.
  const SweptBody& swept(FighterId fighter) const { return actors_[fighter.at()].swept; }

  // The motion that would be shown if nothing interrupted it: `count` world poses from the shown
  // one on.
  std::vector<Pose> continued(FighterId fighter, Tick tick, Tick count) const;

  // The same of the launch in flight until it ends, 2 s of it at most, as a planner is told of it.
  MotionInFlight in_flight(FighterId fighter, Tick tick) const;

  std::vector<FighterTrack> take_tracks();

 private:
  // What goes on from tick to tick; a copy of it can run ahead.
  struct Motion {
    Playback playback;                   // as if nothing stood in its way
    std::array<ArmGive, 2> gives{};      // what blows on its guard have left
    std::array<LandedLimb, 4> landed{};  // what its own blows have
    bool simulated = false;              // the pose shown last was
    bool seam = false;                   // a launch began that is not shown yet
    Pose unhindered{};                   // this tick's pose of the playback, out of ranges maybe
    Pose shown{}, shown_before{};        // in this tick and in the last one, world
    LimitExcesses free{};                // how far joints may go before they slow
    LimitExcesses free_more{};           // of that, what the last seam left
    std::array<float, 2> swings{};       // 0 the foot carries .. 1: its leg swings
    LimbOffsets kept_out{};              // what keeps its limbs out of the other bodies
  };
  struct Actor {
    const MotionLibrary* library = nullptr;  // whose clips it shows
    BodyModel body;
    Motion motion;
    Launch launch{};
    Variation variation{};          // of this launch
    Pose rest{};                    // what a share of the clip is measured from, world
    Sway sway{};                    // of this launch
    std::vector<Pose> simulated{};  // shown before the clip, from `simulated_from` on
    Tick simulated_from = 0;
    bool recorded = false;  // the tick shown last: what keeps limbs out is of that tick
    Vec3 aside{};           // taken_aside()
    SweptBody swept{};
    std::uint32_t knees = 0;  // bits of the thighs that are not kept out: their knees strike
    FighterTrack track{};
  };

  void stitch(const Actor& actor, Tick tick, Playback& playback) const;
  void free_joints(const Actor& actor, Tick tick, Motion& motion) const;
  void go_on(const Actor& actor, Tick tick, Motion& motion) const;
  // The next tick, its limbs held off as they were: a blow's speed is the motion's own, not that of
  // a limb that comes back to it.
  void next(const Actor& actor, Tick tick, Motion& motion) const;
  static void relieve_feet(const Pose& clip, Playback& playback);
  static Pose given_way(const BodyModel& body, Motion& motion);
  static Pose stopped(const BodyModel& body, Motion& motion, const Pose& pose);
  // `pose` of this tick with its joints inside their ranges, `earlier` a tick ago.
  static Pose in_range(const BodyModel& body, const Motion& motion, const Pose& pose,
                       const Pose& earlier);
  // What is shown of this tick: the motion with its limbs held off.
  static void hold_off(const BodyModel& body, Motion& motion);
  std::uint32_t knees_to_land(const Actor& actor, Tick tick) const;
  static BodyCapsules shown_capsules(const Actor& actor);
  // From the offsets of the tick `before` on, out of the others as they are by now.
  void keep_out(Actor& actor, const LimbOffsets& before) const;
  void draw_feet_away(Actor& actor) const;
  std::vector<BodyCapsules> near(const Actor& actor) const;
  void set_feet_aside(Actor& actor) const;
  Pose clip_pose(const Actor& actor, Tick tick) const;

  const MotionLibrary& library_;
  Repetitions repetitions_;
  std::vector<Actor> actors_;
};

}  // namespace ringcraft
