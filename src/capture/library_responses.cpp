#include "capture/library_responses.h"

#include <algorithm>

#include <fmt/format.h>

namespace ringcraft {
namespace {

constexpr float kSameDirection = radians(45);

bool answers(const Action& have, const Response& asked, Lying falls) {
  if (!have.response || have.response->kind != asked.kind) return false;
  if (have.ends_lying != falls) return false;
  if (asked.kind == ResponseKind::recovery_steps && have.response->steps != asked.steps)
    return false;
  if (have.response->zone && have.response->zone != asked.zone) return false;
  return std::abs(wrapped_angle(have.response->direction - asked.direction)) <= kSameDirection;
}

bool any(const std::vector<Action>& actions, std::size_t count, auto what) {
  return std::any_of(actions.begin(), actions.begin() + static_cast<std::ptrdiff_t>(count), what);
}

}  // namespace

void add_missing_responses(std::vector<Action>& actions, std::vector<Action> others,
                           const std::string& named, std::vector<std::string>& notes) {
  const std::size_t own = actions.size();
  const auto take = [&](Action& other) {
    if (any(actions, actions.size(), [&](const Action& a) { return a.name == other.name; }))
      other.name = named + "_" + other.name;
    notes.push_back(fmt::format("{}: not in the captures, taken from {} ({})", other.name, named,
                                other.source));
    actions.push_back(std::move(other));
  };
  for (Action& other : others) {
    if (other.kind != Kind::response || !other.response) continue;
    const bool have = any(actions, own, [&](const Action& a) {
      return answers(a, *other.response, other.ends_lying);
    });
    if (!have) take(other);
  }
  for (Action& other : others) {
    if (other.kind != Kind::get_up) continue;
    const bool asked = any(actions, actions.size(), [&](const Action& a) {
      return a.kind == Kind::response && a.ends_lying == other.starts_lying;
    });
    const bool have = any(actions, own, [&](const Action& a) {
      return a.kind == Kind::get_up && a.starts_lying == other.starts_lying;
    });
    if (asked && !have) take(other);
  }
  if (any(actions, own, [](const Action& a) { return a.kind == Kind::idle; })) return;
  for (Action& other : others)
    if (other.kind == Kind::idle) take(other);
}

}  // namespace ringcraft
