#include "motion/action.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace ringcraft {

namespace {

constexpr std::array<std::string_view, 7> kKinds = {
    "attack", "defense", "transition", "combination", "response", "get-up", "idle"};
constexpr std::array<std::string_view, 3> kZones = {"head", "body", "leg"};
constexpr std::array<std::string_view, 9> kStrikes = {"straight",   "hook",       "uppercut",
                                                      "front_kick", "roundhouse", "side_kick",
                                                      "backfist",   "elbow",      "knee"};
constexpr std::array<std::string_view, 7> kDefenses = {"guard", "parry", "slip",     "duck",
                                                       "sway",  "check", "step_away"};
constexpr std::array<std::string_view, 3> kResponses = {"absorb", "recovery_steps", "knockdown"};
constexpr std::array<std::string_view, 5> kLyings = {"none", "back", "front", "side", "seat"};

template <class Enum, std::size_t N>
std::string_view name_in(const std::array<std::string_view, N>& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

template <class Enum, std::size_t N>
std::optional<Enum> value_in(const std::array<std::string_view, N>& names, std::string_view name) {
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

// "left" and "right" as words of a name change places.
std::string mirrored_name(const std::string& name) {
  std::string result;
  std::size_t at = 0;
  while (at < name.size()) {
    if (name.compare(at, 4, "left") == 0) {
      result += "right";
      at += 4;
    } else if (name.compare(at, 5, "right") == 0) {
      result += "left";
      at += 5;
    } else {
      result += name[at++];
    }
  }
  return result;
}

}  // namespace

bool means(const std::string& word, const Action& action) {
  return word == name_of(action.kind) || fnmatch(word.c_str(), action.name.c_str(), 0) == 0;
}

bool may_lead(const Action& from, const Action& to) {
  return from.leads_to.empty() ||
         std::any_of(from.leads_to.begin(), from.leads_to.end(),
                     [&](const std::string& word) { return means(word, to); });
}

bool is_authored(const Action& action) {
  return action.source.find(".toml:") != std::string::npos;
}

bool goes_straight(StrikeKind kind) {
  return kind == StrikeKind::straight || kind == StrikeKind::front_kick ||
         kind == StrikeKind::side_kick;
}

std::string_view name_of(Kind kind) {
  return name_in(kKinds, kind);
}
std::string_view name_of(TargetZone zone) {
  return name_in(kZones, zone);
}
std::string_view name_of(StrikeKind kind) {
  return name_in(kStrikes, kind);
}
std::string_view name_of(DefenseKind kind) {
  return name_in(kDefenses, kind);
}
std::string_view name_of(ResponseKind kind) {
  return name_in(kResponses, kind);
}
std::string_view name_of(Lying lying) {
  return name_in(kLyings, lying);
}
std::optional<Kind> kind_from_name(std::string_view name) {
  return value_in<Kind>(kKinds, name);
}
std::optional<TargetZone> zone_from_name(std::string_view name) {
  return value_in<TargetZone>(kZones, name);
}
std::optional<StrikeKind> strike_kind_from_name(std::string_view name) {
  return value_in<StrikeKind>(kStrikes, name);
}
std::optional<DefenseKind> defense_kind_from_name(std::string_view name) {
  return value_in<DefenseKind>(kDefenses, name);
}
std::optional<ResponseKind> response_kind_from_name(std::string_view name) {
  return value_in<ResponseKind>(kResponses, name);
}
std::optional<Lying> lying_from_name(std::string_view name) {
  return value_in<Lying>(kLyings, name);
}

std::vector<std::string> faults(const Action& action) {
  // The planner keeps what it knows of a moment by its tick in 12 bits.
  constexpr Tick kLongest = 30 * kTicksPerSecond;
  if (action.length() > kLongest) {
    return {fmt::format("it lasts {:.1f} s, longer than {} s", seconds(action.length()),
                        kLongest / kTicksPerSecond)};
  }
  return faults(action.clip);
}

std::optional<Misplaced> misplaced(Kind kind, bool strikes, const std::optional<Response>& response,
                                   Lying starts, Lying ends) {
  if ((kind == Kind::attack || kind == Kind::combination) && !strikes)
    return Misplaced{"kind", "it strikes nothing", "give it a strike, or another kind"};
  if (response && kind != Kind::response)
    return Misplaced{"response", "only an action of kind 'response' answers a blow",
                     "take the response out, or make it the action's kind"};
  if (!response && kind == Kind::response)
    return Misplaced{"kind", "a response to nothing", "give it a response, or another kind"};
  if (response && (response->kind == ResponseKind::recovery_steps) != (response->steps > 0))
    return Misplaced{"response", "its steps do not fit its kind",
                     "give recovery_steps 1 to 3 steps, and the other kinds none"};
  if (starts != Lying::none && kind != Kind::get_up)
    return Misplaced{"starts_lying", "only a get-up starts lying",
                     "take it out, or make the kind 'get-up'"};
  if (ends != Lying::none && !(response && response->kind == ResponseKind::knockdown))
    return Misplaced{"ends_lying", "only a response of kind 'knockdown' ends lying",
                     "take it out, or make the response's kind 'knockdown'"};
  return std::nullopt;
}

Action mirrored(const Action& action) {
  Action result = action;
  result.name = mirrored_name(action.name);
  result.clip = mirrored(action.clip);
  for (Strike& strike : result.strikes) strike.joint = mirrored(strike.joint);
  for (std::string& word : result.leads_to) word = mirrored_name(word);
  if (result.response) result.response->direction = -result.response->direction;
  if (result.feint) result.feint->of = mirrored_name(result.feint->of);
  return result;
}

}  // namespace ringcraft
