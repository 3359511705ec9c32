#include "motion/outcome.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "motion/aim.h"

namespace ringcraft {
namespace {

constexpr float kLeastWeight = 0.05f;  // smaller ones are left out
constexpr float kSameSpot = 1e-4f;     // m or rad
constexpr std::size_t kAllPairs = 8;   // repetitions up to which every pair is sampled

Vec3 blow_of(const Skeleton& skeleton, const Action& action) {
  const Strike& strike = action.strikes.back();
  const auto at = [&](Tick tick) {
    return striking_point(strike, skeleton, world_pose(skeleton, action.clip.at(tick)));
  };
  if (!goes_straight(strike.kind)) return at((strike.active_begin + strike.active_end - 1) / 2);
  Vec3 farthest = at(strike.active_begin);
  for (Tick t = strike.active_begin + 1; t < strike.active_end; ++t) {
    const Vec3 point = at(t);
    if (point.z > farthest.z) farthest = point;
  }
  return farthest;
}

void normalize(std::vector<float>& weights) {
  const float total = std::accumulate(weights.begin(), weights.end(), 0.0f);
  for (float& w : weights) w /= total;
}

// The largest few, summing to one.
std::vector<float> pruned(std::vector<float> weights, std::size_t most) {
  normalize(weights);
  std::vector<float> sorted = weights;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const float least =
      sorted.size() > most ? std::max(kLeastWeight, sorted[most] + 1e-6f) : kLeastWeight;
  std::vector<float> kept = weights;
  for (float& w : kept) w = w < least ? 0 : w;
  // Where all are alike, none is the largest.
  if (std::accumulate(kept.begin(), kept.end(), 0.0f) <= 0)
    std::fill(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(std::min(most, kept.size())),
              1.0f);
  normalize(kept);
  return kept;
}

}  // namespace

const char* unit_of(Outcomes kind) {
  return kind == Outcomes::turn ? "rad" : "m";
}

Vec3 outcome_of(const Skeleton& skeleton, const Action& action, Outcomes kind) {
  const Placement& end = action.clip.root.back();
  switch (kind) {
    case Outcomes::blow:
      return blow_of(skeleton, action);
    case Outcomes::step:
      return end.position();
    case Outcomes::turn:
      break;
  }
  float yaw = 0;
  for (Tick t = 1; t <= action.length(); ++t)
    yaw += wrapped_angle(action.clip.root_at(t).yaw - action.clip.root_at(t - 1).yaw);
  return {yaw, 0, 0};
}

OutcomeTable::OutcomeTable(const Skeleton& skeleton, std::vector<Variant> variants, Outcomes kind,
                           const OutcomeSettings& settings)
    : skeleton_(skeleton), variants_(std::move(variants)), kind_(kind), settings_(settings) {
  const std::size_t count = variants_.size();
  const auto single = [count](std::size_t i) {
    std::vector<float> weights(count, 0.0f);
    weights[i] = 1;
    return weights;
  };
  for (std::size_t i = 0; i < count; ++i) sample(single(i));
  const auto pair = [&](std::size_t a, std::size_t b) {
    for (int k = 1; k <= settings_.pairs; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(settings_.pairs + 1);
      std::vector<float> weights(count, 0.0f);
      weights[a] = 1 - share;
      weights[b] = share;
      sample(std::move(weights));
    }
  };
  for (std::size_t a = 0; a < count; ++a) {
    std::vector<std::size_t> others;
    for (std::size_t b = a + 1; b < count; ++b) others.push_back(b);
    std::stable_sort(others.begin(), others.end(), [&](std::size_t p, std::size_t q) {
      return glm::distance(samples_[p].outcome, samples_[a].outcome) <
             glm::distance(samples_[q].outcome, samples_[a].outcome);
    });
    if (count > kAllPairs) others.resize(std::min<std::size_t>(others.size(), 4));
    for (const std::size_t b : others) pair(a, b);
  }
  if (count < 3) return;
  Random random(derived_seed(settings_.seed, "outcomes"));
  for (std::size_t i = 0; i < count * static_cast<std::size_t>(settings_.mixed); ++i) {
    std::vector<float> weights(count, 0.0f);
    for (int k = 0; k < 4; ++k)
      weights[static_cast<std::size_t>(random.below(static_cast<int>(count)))] +=
          random.uniform(0.05f, 1);
    sample(pruned(std::move(weights), settings_.most));
  }
}

void OutcomeTable::sample(std::vector<float> weights) {
  normalize(weights);
  const Vec3 outcome = outcome_of(skeleton_, blended(skeleton_, variants_, weights), kind_);
  samples_.push_back({std::move(weights), outcome});
}

std::vector<float> OutcomeTable::looked_up(const std::vector<OutcomeSample>& samples,
                                           Vec3 wanted) const {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto far = [&](std::size_t i) { return glm::distance(samples[i].outcome, wanted); };
  const std::size_t count = std::min(settings_.nearest + 1, order.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return far(a) < far(b); });
  // Kovar and Gleicher 2004: 1/d - 1/d_k, so that samples come and go smoothly.
  const float last = 1 / std::max(far(order[count - 1]), kSameSpot);
  std::vector<float> weights(variants_.size(), 0.0f);
  for (std::size_t k = 0; k < count; ++k) {
    const OutcomeSample& near = samples[order[k]];
    const float share =
        count > 1 ? std::max(0.0f, 1 / std::max(far(order[k]), kSameSpot) - last) : 1.0f;
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += share * near.weights[i];
  }
  if (std::accumulate(weights.begin(), weights.end(), 0.0f) <= 0)
    return samples[order.front()].weights;
  return pruned(std::move(weights), settings_.most);
}

Reached OutcomeTable::reach(Vec3 wanted) const {
  std::vector<OutcomeSample> samples = samples_;
  Reached best;
  // What comes out is a sample too: the next round looks it up among the nearest, and asks for as
  // much more as was missing.
  Vec3 asked = wanted;
  for (int round = 0; round <= settings_.rounds; ++round) {
    std::vector<float> weights = looked_up(samples, asked);
    Action action = blended(skeleton_, variants_, weights);
    const Vec3 outcome = outcome_of(skeleton_, action, kind_);
    const float error = glm::distance(outcome, wanted);
    if (round == 0) best.first_error = error;
    if (round == 0 || error < best.error) {
      best.weights = weights;
      best.action = std::move(action);
      best.outcome = outcome;
      best.error = error;
    }
    asked += wanted - outcome;
    samples.push_back({std::move(weights), outcome});
  }
  return best;
}

float OutcomeTable::nearest_variant(Vec3 wanted) const {
  float nearest = glm::distance(samples_.front().outcome, wanted);
  for (std::size_t i = 1; i < variants_.size(); ++i)
    nearest = std::min(nearest, glm::distance(samples_[i].outcome, wanted));
  return nearest;
}

}  // namespace ringcraft
