#pragma once
// The rows of the hits study, and its parts.

#include <limits>
#include <optional>
#include <string>

#include "scene/single_hit.h"
#include "scene/study_hits.h"

namespace ringcraft {

// The bar that a row is held to: measured within low .. high.
struct HitBar {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

inline HitBar at_least(double low) {
  return {.low = low};
}
inline HitBar at_most(double high) {
  return {.high = high};
}

class HitRows {
 public:
  HitRows();
  void group(const std::string& name) { group_ = name; }
  // Where nothing was measured a row has no value, and no verdict.
  void said(const std::string& what, const std::string& unit, std::optional<double> measured,
            const std::string& published);
  void held(const std::string& what, const std::string& unit, std::optional<double> measured,
            const std::string& published, const HitBar& bar);

  StudyTable table;
  int missed = 0;

 private:
  std::string group_;
};

struct HitsAsked {
  const MotionLibrary& library;
  const HitsSettings& settings;
  const StudyRun& run;
};

void strike_rows(const HitsAsked& asked, HitRows& rows);      // V1
void balance_rows(const HitsAsked& asked, HitRows& rows);     // V2
void decision_rows(const HitsAsked& asked, HitRows& rows);    // V2: against the simulated end
void recovery_rows(const HitsAsked& asked, HitRows& rows);    // V2: leans and first steps
void answer_rows(const HitsAsked& asked, HitRows& rows);      // V4, V7
void law_rows(const HitsAsked& asked, HitRows& rows);         // what must hold exactly
void robustness_rows(const HitsAsked& asked, HitRows& rows);  // many random hits
StudyTable cost_rows(const HitsAsked& asked);                 // what the clock says

// A horizontal impulse that goes `way` (rad: 0 fore, +pi/2 to +X) at the middle of a part of a body
// that stands still.
struct StillHit {
  StillHit(const BodyModel& body, const Pose& pose, Part part, float way, float impulse,
           float tone = 1);
  StillHit(const StillHit&) = delete;
  StillHit& operator=(const StillHit&) = delete;
  std::vector<Pose> continued;
  ImpactInput input;
};

// 0 absorb, 1..3 steps, 4 knockdown.
int severity(const ImpactOutcome& outcome);

double mean(const std::vector<double>& values);
double deviation(const std::vector<double>& values);  // standard, of the sample; 0 of one

}  // namespace ringcraft
