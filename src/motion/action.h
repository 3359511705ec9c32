#pragma once
// An action: a meaningful segment of motion, the smallest thing a fighter can choose.

#include <optional>
#include <string>
#include <vector>

#include "base/index.h"
#include "motion/clip.h"

namespace ringcraft {

enum class Kind : std::uint8_t { attack, defense, transition, combination, response, get_up, idle };

enum class TargetZone : std::uint8_t { head, body, leg };

enum class StrikeKind : std::uint8_t {
  straight,
  hook,
  uppercut,
  front_kick,
  roundhouse,
  side_kick,
  backfist,
  elbow,
  knee
};

// One blow of an attack. Ticks count from the action's start.
struct Strike {
  StrikeKind kind = StrikeKind::straight;
  Joint joint =
      Joint::left_hand;  // a hand or a foot; of an elbow the lower arm, of a knee the lower leg
  TargetZone zone = TargetZone::head;
  Tick active_begin = 0;  // first tick at which it can hit
  Tick active_end = 0;    // first tick at which it no longer can
  bool active(Tick age) const { return age >= active_begin && age < active_end; }
  // What it was made to meet (motion/aim.h) and from where: m between the two roots at the launch.
  // Empty where nobody said.
  std::string aim = {};
  float nearest = 0, farthest = 0;
};

enum class DefenseKind : std::uint8_t { guard, parry, slip, duck, sway, check, step_away };

struct Defense {
  DefenseKind kind = DefenseKind::guard;
  // Answers one particular attack (slip, parry, duck, sway, check): not offered in the tree while
  // that attack is younger than 250 ms. Guards and steps away are broad.
  bool particular() const { return kind != DefenseKind::guard && kind != DefenseKind::step_away; }
  Tick begin = 0, end = 0;  // the ticks over which it protects
};

enum class ResponseKind : std::uint8_t { absorb, recovery_steps, knockdown };

// How a response motion answers: chosen by physics, never by the planner.
struct Response {
  ResponseKind kind = ResponseKind::absorb;
  int steps = 0;  // 1..3 for recovery_steps
  float direction =
      0;  // rad off the own facing in which the body goes; 0 fore, +pi/2 to the own left
  // Where an absorbed blow landed; without it the response answers a blow anywhere.
  std::optional<TargetZone> zone = std::nullopt;
};

enum class Lying : std::uint8_t { none, back, front, side, seat };

// Begins exactly as an attack does and turns back before the blow (motion/feints.h).
struct Feint {
  std::string of;   // the attack's name
  Tick parted = 0;  // the first tick at which the two differ
};

// Which foot is ahead: orthodox the left one, southpaw the right one.
enum class Stance : std::uint8_t { orthodox, southpaw };

inline constexpr std::size_t kMostStrikes = 6;  // of one action

struct Action {
  std::string name;
  Kind kind = Kind::idle;
  Clip clip;
  std::vector<Strike> strikes;  // attacks and combinations; empty otherwise
  std::optional<Defense> defense;
  std::optional<Response> response;
  std::optional<Feint> feint;        // transitions that feign an attack
  Lying starts_lying = Lying::none;  // get-ups
  Lying ends_lying = Lying::none;    // knockdowns
  Stance stance = Stance::orthodox;  // of whom it is for
  bool switches = false;             // ends in the other stance
  // Leads from one action to another and is never chosen for itself: made by the builder from a way
  // through the motion graph.
  bool connects = false;
  // What may follow it directly: names of actions, with * for any part, or kinds. Empty: whatever
  // begins near to where it ends.
  std::vector<std::string> leads_to;
  // An attack that cannot be thrown at an opponent of that height; only in a library fitted to one,
  // never in a file.
  bool left_out = false;
  std::string source;  // the capture or sheet, with the seconds cut from it

  Tick length() const { return clip.length(); }
  bool attacks() const { return !strikes.empty(); }
  // Follows a blow or a fall and is never chosen.
  bool forced() const { return kind == Kind::response || kind == Kind::get_up; }
};

// Breaks of its clip's rules, as text, and whether it lasts more than 30 s; empty when it is good.
std::vector<std::string> faults(const Action& action);

// Whether a word of `leads_to` means that action.
bool means(const std::string& word, const Action& action);
// Whether `from` says that `to` may follow it.
bool may_lead(const Action& from, const Action& to);

// True for an action that was compiled from a technique sheet.
bool is_authored(const Action& action);

// Whether a blow of that kind goes out along the gaze: its end is full reach.
bool goes_straight(StrikeKind kind);

std::string_view name_of(Kind kind);
std::string_view name_of(TargetZone zone);
std::string_view name_of(StrikeKind kind);
std::string_view name_of(DefenseKind kind);
std::string_view name_of(ResponseKind kind);
std::string_view name_of(Lying lying);
std::optional<Kind> kind_from_name(std::string_view name);
std::optional<TargetZone> zone_from_name(std::string_view name);
std::optional<StrikeKind> strike_kind_from_name(std::string_view name);
std::optional<DefenseKind> defense_kind_from_name(std::string_view name);
std::optional<ResponseKind> response_kind_from_name(std::string_view name);
std::optional<Lying> lying_from_name(std::string_view name);

// What is said of an action that its kind cannot have, or cannot be without: the key, what is wrong
// with it and what to do.
struct Misplaced {
  const char* key = "";
  const char* what = "";
  const char* remedy = "";
};
std::optional<Misplaced> misplaced(Kind kind, bool strikes, const std::optional<Response>& response,
                                   Lying starts, Lying ends);

// The same action for the other hand: "jab_left" becomes "jab_right", clip, strikes and response
// swap.
Action mirrored(const Action& action);

}  // namespace ringcraft
