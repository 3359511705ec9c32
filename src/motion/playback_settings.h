#pragma once

namespace ringcraft {

struct PlaybackSettings {
  float blend_seconds = 0.24f;   // in which a seam's difference falls to nothing
  float longest_blend = 0.90f;   // s: the same where a simulated body is far from the clip
  float unlock_seconds = 0.20f;  // the same for a lifted foot's way back to the clip
  float land_seconds = 0.10f;    // in which a foot that was set down presses to the floor
  // m: a planted foot farther from the clip's takes a step of its own
  float restep_distance = 0.06f;
  float restep_seconds = 0.22f;
  float restep_lift = 0.05f;  // m: height of that step
};

}  // namespace ringcraft
