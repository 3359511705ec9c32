#pragma once
// The timeline: the record that is kept of a fight.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fight/state.h"

namespace ringcraft {

struct Segment {
  Launch launch;
  std::string name;  // of the action
  Kind kind = Kind::idle;
  bool feint = false;
};

struct FighterTrack {
  std::vector<Segment> segments;
  std::vector<Pose> frames;            // shown poses in the world, one a tick from tick 0
  std::vector<FootContacts> contacts;  // of the shown motion, one a tick
};

enum class EventType : std::uint8_t {
  decision,
  strike,
  hit,
  block,
  miss,
  response,
  knockdown,
  getup
};
std::string_view name_of(EventType type);

// What a line of the tree is worth by each term of the evaluation, thousandths of a point of the
// deciding fighter's score: what its own part credits, and what the opponent's takes away.
struct LineTerms {
  std::int32_t location = 0, hit = 0, defense = 0, control = 0;
  bool operator==(const LineTerms&) const = default;
};

// One line of the tree that a decision weighed.
struct Line {
  std::vector<std::string> actions;  // alternating as the tree did, "name" or "*name" where forced
  std::vector<int> actors;           // who launches each
  std::int32_t score = 0;            // thousandths of a point, for the deciding fighter
  bool at_most = false;              // the score is an upper bound: not worth looking at further
  // By the deciding fighter and its opponent; they add up to the score. Without a value where the
  // line is not known down to the horizon.
  std::optional<std::array<LineTerms, 2>> terms;
};

// A first move that was struck off, with the names of the rules that did.
struct StruckOff {
  std::string action;
  std::vector<std::string> rules;
};

struct DecisionRecord {
  std::vector<Line> lines;  // best first, those with an upper bound behind the others
  std::int32_t chosen = 0;  // index in lines
  std::vector<StruckOff> struck_off;
  Tick horizon = 0;  // ticks looked ahead: less than asked for under a node limit
  std::uint64_t nodes = 0, leaves = 0, forced_nodes = 0;
  std::uint64_t pruned_unanswered_hit = 0, pruned_back_turned = 0, pruned_penetration = 0,
                pruned_candidates = 0;
};

// What happened at one tick. Fields that do not apply stay at their defaults.
struct Event {
  Tick tick = 0;
  EventType type = EventType::decision;
  FighterId who;       // the acting fighter: attacker, or the one who responds
  FighterId whom;      // the other, where there is one
  std::string action;  // the action's name
  std::string part;    // struck body part
  StrikeKind strike = StrikeKind::straight;
  Vec3 point{};              // world, m
  Vec3 impulse{};            // world, N s
  float speed = 0;           // closing speed at the contact, m/s
  float effective_mass = 0;  // of the striking limb along the blow, kg
  float head_spin = 0;       // change of the head's angular velocity, rad/s
  float damage = 0;          // points
  ResponseKind response = ResponseKind::absorb;
  int steps = 0;
  float direction = 0;  // world yaw in which the body goes, rad
  bool knockout = false;
  bool fall = false;      // the hit of a falling body, not of a strike
  bool foreseen = false;  // the tree foresaw this hit with the same response
  // Of a strike and a hit: how tired `who` is, 0 .. 1; not hashed, follows from the rest.
  float fatigue = 0;
  std::string replay;  // what recomputes this hit, opaque (scene/hit_replay.h); not hashed
  DecisionRecord decision;
};

struct Timeline {
  std::vector<FighterTrack> tracks;
  std::vector<Event> events;  // in order of tick
  Tick end = 0;

  // Hash of segments and events: two runs are the same fight when it is equal.
  std::uint64_t hash() const;
};

}  // namespace ringcraft
