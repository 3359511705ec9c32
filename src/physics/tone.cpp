#include "physics/tone.h"

#include <algorithm>

namespace ringcraft {
namespace {

// Of full tone: what reproduces the published head accelerations.
constexpr float kNeckTone = .5f;

// Over all joints, by the torque of their muscles.
float mean_of(const Tone& tone) {
  static const BodyModel body = make_body({});
  float given = 0, full = 0;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const float torque = muscle_of(body, static_cast<Part>(i)).torque;
    given += tone[i] * torque;
    full += torque;
  }
  return given / full;
}

}  // namespace

Tone standing_tone(float seconds, float tone) {
  const float back = glm::smoothstep(kReflex, kFirm, seconds);
  const auto ramp = [&](float low) { return tone * (low + (1 - low) * back); };
  Tone t = whole_body(ramp(.4f));
  for (const Part p : {Part::neck, Part::head}) t[index(p)] = ramp(1);
  for (std::size_t i = index(Part::left_thigh); i < kPartCount; ++i) t[i] = ramp(.9f);
  return t;
}

Tone falling_tone() {
  Tone t = whole_body(.35f);  // arms
  for (const Part p : {Part::abdomen, Part::chest}) t[index(p)] = .4f;
  for (const Part p : {Part::neck, Part::head}) t[index(p)] = .6f;
  for (std::size_t i = index(Part::left_thigh); i < kPartCount; ++i) t[i] = .2f;
  return t;
}

Tone struck_tone(float tone) {
  Tone t = whole_body(tone);
  t[index(Part::neck)] *= kNeckTone;
  t[index(Part::head)] *= kNeckTone;
  return t;
}

float tone_left(const Action& action, Tick age) {
  if (action.kind == Kind::get_up) {
    const float up =
        static_cast<float>(age) / static_cast<float>(std::max<Tick>(1, action.length()));
    return glm::mix(kGatherTone, 1.0f, std::clamp(up, 0.0f, 1.0f));
  }
  if (!action.response) return 1;
  if (action.response->kind == ResponseKind::knockdown) return mean_of(falling_tone());
  return mean_of(standing_tone(static_cast<float>(age) * kTickSeconds, 1));
}

}  // namespace ringcraft
