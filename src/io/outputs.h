#pragma once
// What comes out of a fight: fight.glb, events.jsonl, report.json, timing.json, fight.html.

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "fight/timeline.h"
#include "motion/character.h"
#include "physics/body.h"

namespace ringcraft {

// How a fighter looks and is called.
struct FighterLook {
  std::string name;
  BodyModel body;
  Vec3 shorts{0.42f, 0.014f, 0.018f};  // linear RGB
  Vec3 gloves{0.42f, 0.014f, 0.018f};
  Vec3 skin{0.46f, 0.26f, 0.175f};
  std::shared_ptr<const Character> character =
      nullptr;  // shown in place of the mannequin; may be null
};

struct GlbSettings {
  float ring_half = 0;  // m: half the side of a ring of plain boxes (node `ring`); 0 is no ring
  bool root_motion = false;  // node `fighterN` moves over the ground, the hips relative to it
};

// One skinned mannequin per fighter (node `fighter0` ... holds the skeleton and extras with the
// capsules, node `fighter0_mesh` the mesh), canonical bone names, one animation, 60 Hz LINEAR,
// baked; events in animations[0].extras. Bytes of a .glb.
std::string fight_glb(const Timeline& timeline, const std::vector<FighterLook>& looks,
                      const GlbSettings& settings = {});

// One fighter's shown motion as a VRM animation (.vrma): glTF with the extension VRMC_vrm_animation
// 1.0, T-pose at rest, 60 Hz; plays on any VRM 1.0 character.
std::string fighter_vrma(const FighterLook& look, const FighterTrack& track);

// A header line, which counts the events, then one JSON object per event.
std::string events_jsonl(const Timeline& timeline, const std::vector<FighterLook>& looks,
                         const nlohmann::json& header);

// What a page is made of: page.html of the folder in RINGCRAFT_VIEWER, else of viewer/dist. To be
// asked for before long work whose page would have no template.
Result<std::string> page_template();

// One self-contained page that opens from file://: the GLB and the events are embedded.
Result<std::string> fight_html(const std::string& glb, const std::string& events,
                               const nlohmann::json& report);

}  // namespace ringcraft
