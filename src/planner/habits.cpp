#include "planner/habits.h"

#include <algorithm>

namespace ringcraft {
namespace {

constexpr float kNear = 1.1f, kFar = 1.6f;  // m: fists reach up to the first, legs to the second
constexpr double kDoubt = 3;                // sightings that are believed by half

}  // namespace

Situation situation_of(float distance, Kind last, bool attacked) {
  const std::uint8_t band = distance < kNear ? 0 : distance < kFar ? 1 : 2;
  return {band, static_cast<std::uint8_t>(last), attacked};
}

bool looks_like_attack(const Action& action, const Launch& launch, Tick now, double late_sight_s) {
  if (action.feint) return now < launch.when(action.feint->parted) + ticks(late_sight_s);
  return action.attacks() && now < launch.when(action.strikes.back().active_end);
}

Launch taken_for(const Launch& feint, ActionId id, const Action& attack, Tick now) {
  Launch seen = feint;
  seen.action = id;
  seen.pace = {};  // nobody sees how fast what is not thrown would have come
  seen.end = std::max(now, seen.when(attack.length()));
  return seen;
}

std::size_t Habits::index_of(Situation situation) {
  const std::size_t calm = situation.band * kAfter + situation.after;
  return calm + (situation.attacked ? kBands * kAfter : 0);
}

void Habits::note(Situation situation, ActionId action) {
  std::vector<Seen>& seen = seen_.at(index_of(situation));
  auto at =
      std::find_if(seen.begin(), seen.end(), [&](const Seen& s) { return s.action == action; });
  if (at == seen.end()) {
    seen.push_back({action, 1});
  } else {
    ++at->count;
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.count != b.count ? a.count > b.count : a.action < b.action;
  });
  most_ = std::max(most_, seen.front().count);
}

const std::vector<Habits::Seen>& Habits::seen(Situation situation) const {
  return seen_.at(index_of(situation));
}

int Habits::total(Situation situation) const {
  int sum = 0;
  for (const Seen& one : seen(situation)) sum += one.count;
  return sum;
}

int Habits::count(Situation situation, ActionId action) const {
  for (const Seen& one : seen(situation)) {
    if (one.action == action) return one.count;
  }
  return 0;
}

double Habits::belief(int total) {
  return total / (total + kDoubt);
}

void Habits::note_begun(ActionId attack, bool feint) {
  auto at = std::find_if(begun_.begin(), begun_.end(),
                         [&](const Begun& one) { return one.attack == attack; });
  if (at == begun_.end()) at = begun_.insert(at, {attack, 0, 0});
  ++at->all;
  at->feints += feint ? 1 : 0;
}

double Habits::feint_expected(ActionId attack) const {
  const auto at = std::find_if(begun_.begin(), begun_.end(),
                               [&](const Begun& one) { return one.attack == attack; });
  return at == begun_.end() ? 0 : belief(at->all) * at->feints / at->all;
}

}  // namespace ringcraft
