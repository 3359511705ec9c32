#include "planner/habits.h"

#include <algorithm>

namespace ringcraft {
namespace {

constexpr float kNear = 1.1f, kFar = 1.6f;  // m: fists reach up to the first, legs to the second
constexpr double kDoubt = 3;                // sightings that are believed by half

}  // namespace

Situation situation_of(float distance, Kind last) {
  const std::uint8_t band = distance < kNear ? 0 : distance < kFar ? 1 : 2;
  return {band, static_cast<std::uint8_t>(last)};
}

std::size_t Habits::index_of(Situation situation) {
  return situation.band * kAfter + situation.after;
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
}

const std::vector<Habits::Seen>& Habits::seen(Situation situation) const {
  return seen_.at(index_of(situation));
}

int Habits::total(Situation situation) const {
  int sum = 0;
  for (const Seen& one : seen(situation)) sum += one.count;
  return sum;
}

double Habits::belief(int total) {
  return total / (total + kDoubt);
}

}  // namespace ringcraft
