#pragma once
// What an action comes to, measured on its clip: where a blow lands, where a step leads, how far a
// turn turns; and which weights of registered repetitions come to a wanted one.
//
// Blending is not linear in what it comes to, so it is measured: a table of sampled weights with
// what each blend came to, looked up by scattered-data interpolation of the nearest samples
// (Mukai and Kuriyama 2005 fit a kriging, Kovar and Gleicher 2004 weigh the nearest, as is done
// here), and what comes out is measured again.

#include <cstdint>

#include "motion/blend.h"

namespace ringcraft {

enum class Outcomes : std::uint8_t {
  blow,  // m: the striking point (aim.h) in action space, where a straight reaches farthest, else
         // in the middle of the time in which it can hit
  step,  // m: the root's place at the end (x, z; y is 0)
  turn,  // rad: the root's turn at the end (x; y and z are 0)
};
const char* unit_of(Outcomes kind);

// `action` has one strike at least for a blow.
Vec3 outcome_of(const Skeleton& skeleton, const Action& action, Outcomes kind);

struct OutcomeSample {
  std::vector<float> weights;
  Vec3 outcome{};
};

struct OutcomeSettings {
  int pairs = 3;            // samples between two repetitions
  int mixed = 4;            // samples of three or four of them, for each repetition
  int rounds = 3;           // of measuring and correcting
  std::size_t most = 4;     // repetitions that a blend is made of
  std::size_t nearest = 6;  // samples that a wanted outcome is looked up in
  std::uint64_t seed = 1;
};

// A wanted outcome, the best that blends came to, and the first.
struct Reached {
  std::vector<float> weights;
  Action action;
  Vec3 outcome{};
  float error = 0;        // distance to what was wanted, m or rad
  float first_error = 0;  // of the weights as they were looked up
};

class OutcomeTable {
 public:
  OutcomeTable(const Skeleton& skeleton, std::vector<Variant> variants, Outcomes kind,
               const OutcomeSettings& settings = {});

  const std::vector<Variant>& variants() const { return variants_; }
  // The repetitions themselves first.
  const std::vector<OutcomeSample>& samples() const { return samples_; }

  Reached reach(Vec3 wanted) const;
  // Distance to the nearest repetition's outcome.
  float nearest_variant(Vec3 wanted) const;

 private:
  void sample(std::vector<float> weights);
  std::vector<float> looked_up(const std::vector<OutcomeSample>& samples, Vec3 wanted) const;

  Skeleton skeleton_;
  std::vector<Variant> variants_;
  Outcomes kind_;
  OutcomeSettings settings_;
  std::vector<OutcomeSample> samples_;
};

}  // namespace ringcraft
