#include "scene/blend_judge.h"

#include <memory>

#include <fmt/format.h>

#include "physics/body.h"

namespace ringcraft {

Judge joint_limit_judge() {
  constexpr float kTolerance = radians(3);
  BodySpec spec;
  spec.height = kCanonicalHeight;
  return [body = std::make_shared<const BodyModel>(make_body(spec))](const Action& action) {
    std::string worst;
    float most = 0;
    for (const Pose& pose : action.clip.frames) {
      for (const LimitViolation& violation : limit_violations(*body, pose, kTolerance)) {
        if (violation.excess <= most) continue;
        most = violation.excess;
        worst = fmt::format("{} goes {:.0f} degrees beyond its range", vrm_name(violation.joint),
                            degrees(violation.excess));
      }
    }
    return worst;
  };
}

}  // namespace ringcraft
