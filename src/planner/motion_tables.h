#pragma once
// Motion tables: what the tree asks of an action, worked out once per library and body, so that a
// contact or penetration test costs microseconds and no pose is built inside a search.

#include <cstdint>
#include <span>
#include <vector>

#include "fight/state.h"
#include "physics/contact.h"
#include "physics/partial.h"

namespace ringcraft {

// A placement with its sine and cosine at hand.
struct Frame {
  float x = 0, z = 0, yaw = 0;
  float sine = 0, cosine = 1;

  Frame() = default;
  explicit Frame(const Placement& placement);
  Placement placement() const { return {x, z, yaw}; }
  Vec3 to_outer(Vec3 p) const {
    return {x + cosine * p.x + sine * p.z, p.y, z - sine * p.x + cosine * p.z};
  }
  Vec3 to_inner(Vec3 p) const {
    const float dx = p.x - x, dz = p.z - z;
    return {cosine * dx - sine * dz, p.y, sine * dx + cosine * dz};
  }
};

// `inner`, given in the space in which `outer` is given, as seen from `outer`.
Frame relative(const Frame& outer, const Frame& inner);

struct Sphere {
  Vec3 center{};
  float radius = 0;
};

struct Box {
  Vec3 low{}, high{};
};

// One blow of an attack, in action space.
struct StrikeTable {
  Strike strike;
  std::uint32_t parts = 0;  // that can land, bit index(part)
  Part main = Part::left_hand;
  Vec3 landing{};  // the main part's outer end where it reaches farthest while active, m
  Tick landing_tick = 0;
  float reach = 0;  // largest distance of any of the parts from the origin on the ground, m
};

// What of a strike a candidate is weighed by.
struct StrikeAim {
  float ahead = 0, aside = 0;  // m: StrikeTable::landing, z and x
  Tick tick = 0;               // StrikeTable::landing_tick
  StrikeKind kind = StrikeKind::straight;
};
StrikeAim aim_of(const StrikeTable& strike);

Frame operator*(const Frame& outer, const Frame& inner);

struct ActionTable;

// Kinds of choices as a list of candidates has them; whatever is none of the others is a step.
enum class Choice : std::uint8_t { attack, step, defense, idle };
inline constexpr std::size_t kChoices = 4;

// m: a body whose root is farther than this beyond where a blow lands, before it or beside it is
// not reached.
inline constexpr float kMostGap = .28f, kMostPast = .75f, kMostAside = .40f;

// An action that can follow, directly or by a path of the state machine.
struct NextAction {
  ActionId to;
  Choice choice = Choice::step;
  Tick lead = 0;                       // length of the path
  Tick length = 0;                     // of `to`
  std::size_t first_strike = 0;        // ActionTable::first_strike
  std::span<const StrikeAim> strikes;  // of `to`
  const Placement* root = nullptr;     // of `to`, one a tick
  const Defense* defense = nullptr;    // of `to`: ActionTable::defense
  Frame alignment;  // of `to` relative to where the last action's root ends; scaled to the body
  Frame end;        // of `to`: ActionTable::end
  const ActionTable* table = nullptr;  // of `to`
  std::vector<ActionId> path;          // actions played in full before it; empty for a direct edge

  const Placement& root_at(Tick age) const {
    return root[age < 0 ? 0 : age > length ? length : age];
  }
};

// What every candidate of a node is weighed by, of kLanes of them side by side and not in a hundred
// tables; zeros behind the last.
inline constexpr std::size_t kLanes = 8;
struct NextLanes {
  using Lanes = std::array<float, kLanes>;
  Lanes x{}, z{}, sine{}, cosine{};                  // alignment
  Lanes end_x{}, end_z{}, end_sine{}, end_cosine{};  // end
  Lanes attacks{};                                   // 1 where it does
  Lanes within{};  // m: no strike of it reaches a body that is farther from where it starts
  std::array<Tick, kLanes> lead{}, until{};  // length of the path, and with that of `to`
  std::array<std::int32_t, kLanes> to{};     // number of the action
  std::array<Choice, kLanes> choice{};
  std::array<bool, kLanes> particular{};  // a defense that answers particular attacks
};

// Spheres around the parts of a body, side by side (SIMD); those behind the last are nowhere near
// anything.
inline constexpr std::size_t kPartLanes = 20;
static_assert(kPartLanes >= kPartCount);
struct PartSpheres {
  using Lanes = std::array<float, kPartLanes>;
  Lanes x{}, y{}, z{}, radius{};

  explicit PartSpheres(const BodyCapsules& capsules);
  PartSpheres() = default;
  Vec3 center(std::size_t part) const { return {x[part], y[part], z[part]}; }
};

inline constexpr std::size_t kLongestPath = 3;  // longer ones are not offered

// What may follow an action.
struct Followers {
  std::vector<NextAction> next;       // what a fighter may choose after it, by Choice
  std::vector<NextLanes> next_lanes;  // of `next`
  std::vector<NextAction> over;       // what follows it only on the way to something else

  const NextAction* find(ActionId to) const;
};

struct ActionTable {
  ActionId id;  // of MotionTables::at; beyond the library's actions where it is a part of one
  const Action* action = nullptr;
  Tick length = 0;
  std::uint64_t motion = 0;                // its number where it is of a motion in flight, else 0
  const ActionTable* clip = nullptr;       // the clip's own, where it is of one at another pace
  Pace pace;                               // of that
  std::vector<Tick> clip_ages;             // of either: the clip's age, by ticks since the launch
  float tone = 1.0f;                       // of its muscles: less where a tired body is in flight
  std::vector<BodyCapsules> capsules;      // action space, one a tick
  std::vector<PartSpheres> spheres;        // around the capsules
  std::vector<PartSpheres::Lanes> travel;  // m: how far each goes in the tick before
  std::vector<Placement> root;             // scaled to the body
  std::vector<Box> box;                    // around the capsules
  std::vector<Sphere> bound;               // of the capsules
  std::vector<Pose> pose;                  // scaled to the body
  std::vector<float> turn;  // rad: how far its space has turned, where it is of a motion in flight
  std::vector<StrikeTable> strikes;
  std::optional<Defense> defense;  // the action's, by ticks since the launch
  std::size_t first_strike = 0;    // its number among all strikes of the library's actions
  float extent = 0;                // largest distance of the body from the origin on the ground, m
  Frame end;                       // root[length]
  float way = 0, leg_way = 0;   // of a response that stays up: way_of_clip (physics/partial.h), m
  Strides strides;              // of the same
  std::vector<float> way_left;  // of a response that stays up, one a tick, m
  ActionId get_up;              // of a fall: what follows it; invalid for anything else
  std::size_t after = 0;        // of MotionTables::after

  Tick clamped(Tick age) const { return age < 0 ? 0 : age > length ? length : age; }
  bool in_flight() const { return motion != 0; }
  Tick clip_age(Tick age) const { return clip_ages.empty() ? clamped(age) : clip_ages[at(age)]; }
  const BodyCapsules& capsules_at(Tick age) const { return capsules[at(age)]; }
  const Placement& root_at(Tick age) const { return root[at(age)]; }
  const Sphere& bound_at(Tick age) const { return bound[at(age)]; }
  const PartSpheres& spheres_at(Tick age) const { return spheres[at(age)]; }
  const PartSpheres::Lanes& travel_at(Tick age) const { return travel[at(age)]; }
  const Box& box_at(Tick age) const { return box[at(age)]; }
  const Pose& pose_at(Tick age) const { return pose[at(age)]; }
  // The pose at `age` as it is seen from its space at `from`: a motion in flight may turn to its
  // aim.
  Pose pose_seen(Tick age, Tick from) const;

 private:
  std::size_t at(Tick age) const { return static_cast<std::size_t>(clamped(age)); }
};

// What a launch in flight shows from now on: its clip with the blend of its seam, at its pace, or a
// simulated response. The tree plays it as it is; of what is still to be launched it has the clip,
// at the pace of who launches it.
struct MotionInFlight {
  Launch launch;
  Tick from = 0;                // of the first pose
  std::vector<Pose> poses;      // world, one a tick
  std::vector<Tick> clip_ages;  // the clip's, from the launch's first tick to its last, or that of
                                // the last pose
  float tone = 1.0f;            // of the body's muscles, 0 limp .. 1 full
};

class MotionTables {
 public:
  MotionTables(const MotionLibrary& library, const BodyModel& body);
  // The same where what is launched runs at a pace of its own (fight/pace.h). What a fighter does
  // not choose, and the parts of it, are those of `clips`, which must outlive them.
  MotionTables(const MotionTables& clips, float pace);
  MotionTables(const MotionTables&) = delete;  // its actions point at each other
  MotionTables& operator=(const MotionTables&) = delete;

  const MotionLibrary& library() const { return library_; }
  const BodyModel& body() const { return body_; }
  const ActionTable& at(ActionId action) const { return *shown_[action.at()]; }
  // The table of as much of a response as `share` says, to the nearest of a few.
  const ActionTable& at(ActionId action, float share) const;
  // Of the library's actions and of parts of them.
  std::size_t count() const { return shown_.size(); }
  // What may follow an action, a part of one or a motion in flight.
  const Followers& after(const ActionTable& table) const { return followers_[table.after]; }
  // For so many ticks after its launch no choice strikes or ends.
  Tick lull() const { return lull_; }
  Tick longest_lead() const { return longest_lead_; }  // NextAction::lead

  // The table of a launch as it is shown, by ticks since the launch in place of the clip's age. Of
  // this body; before the first pose and behind the last it is the clip's.
  ActionTable in_flight(const MotionInFlight& motion) const;

 private:
  std::optional<NextAction> next_action(ActionId from, ActionId to) const;
  void add_parts(ActionId action);
  void find_followers();
  void find_lull();

  const MotionLibrary& library_;
  BodyModel body_;
  std::vector<ActionTable> actions_;
  std::vector<const ActionTable*> shown_;  // by number: of `actions_`, or the clips' tables
  std::vector<StrikeAim> strikes_;         // of the library's actions, beside each other
  std::vector<Followers> followers_;       // by action
  Tick lull_ = 0, longest_lead_ = 0;
  std::vector<std::size_t> parts_;  // by action: the first of its parts, 0 where it has none
};

// A launch resolved against its tables: where its action space and its root lie at a tick.
struct InFlight {
  const ActionTable* table = nullptr;
  Launch launch;
  Frame aimed;          // action space once the aim is in
  Tick aimed_from = 0;  // when it is

  InFlight() = default;
  InFlight(const MotionTables& tables, const Launch& launch);
  Tick age(Tick tick) const { return tick - launch.start; }
  bool turning(Tick tick) const { return launch.aim != 0 && tick < aimed_from; }
  Frame frame_at(Tick tick) const { return turning(tick) ? frame_while_aiming(tick) : aimed; }
  Placement root_at(Tick tick) const {
    const Frame frame = frame_at(tick);
    const Placement& root = table->root_at(age(tick));
    const Vec3 at = frame.to_outer(root.position());
    return {at.x, at.z, frame.yaw + root.yaw};
  }

 private:
  Frame frame_while_aiming(Tick tick) const;
};

// The first contact of a strike over the tick that ends at `tick`, in the action space of the
// target, or nothing. The strike must be active at `tick`.
std::optional<Contact> contact_at(const InFlight& attacker, const StrikeTable& strike,
                                  const InFlight& target, Tick tick);

// Whether a strike can touch the target at all while active: false costs next to nothing.
bool may_reach(const InFlight& attacker, const StrikeTable& strike, const InFlight& target);

// Deepest penetration at `tick`, m, or 0 where it is not deeper than `least`. Between foes, parts
// of a strike that is active, or was within the last kContactRest ticks, are left out: its contact
// is intended.
float penetration_at(const InFlight& a, const InFlight& b, Tick tick, float least = 0,
                     bool foes = true);
inline constexpr Tick kContactRest = 24;

}  // namespace ringcraft
