#pragma once
// The scene file: who fights whom, where, how long and with what. Everything it names is read and
// every placement is settled, so that the fight loop has nothing left to look up.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/placement.h"
#include "physics/body.h"
#include "planner/plan.h"

namespace ringcraft {

struct SceneFighter {
  std::string name;
  BodySpec body;
  Style style;                       // with the scene's horizon where it gives one
  int team = 0;                      // fighters of one team do not fight each other
  Stance stance = Stance::orthodox;  // at the start
  Placement placement;               // of the root at tick 0, world
  std::int32_t health = 100'000;     // thousandths of a point
  std::filesystem::path character;   // shown in place of the mannequin; empty for none
  Vec3 shorts{0.7f, 0.1f, 0.1f};     // linear RGB, as in FighterLook; else the team's own colour
  Vec3 gloves{0.7f, 0.1f, 0.1f};
  Vec3 skin{0.55f, 0.36f, 0.26f};
};

struct SceneFile {
  std::filesystem::path path;
  std::vector<std::filesystem::path> files;  // that were read: itself, bodies and styles
  std::string name;
  Tick duration = 0;
  std::uint64_t seed = 1;
  std::filesystem::path library;  // folder of the motion library
  float ring = 6.0f;              // side of the square ring, m
  std::vector<SceneFighter> fighters;
  PlanSettings planner;             // ring_half_m is set from `ring`
  bool stance_switches = false;     // fighters may change their stance
  std::vector<std::string> feints;  // attacks that fighters may feign (motion/feints.h)
  std::string feints_at;            // where the file says so, for messages: "line 12"

  // Hash of all the file says but the seed, with the bodies and styles it names. The library and
  // the characters count by their names.
  std::uint64_t settings = 0;

  // Whether the library must hold both stances (both_stances.h).
  bool needs_both_stances() const;
};

// Reads a scene: a path, or the bare name of a file in assets/scenes ("duel"). `sets` are
// assignments as set_value() takes them ("fighter.0.horizon_s=2"), done in order before the check.
Result<SceneFile> read_scene(const std::string& name_or_path,
                             const std::vector<std::string>& sets = {});

// Reads a body file (assets/schemas/body.schema.json).
Result<BodySpec> read_body(const std::filesystem::path& path);

// A body or a style by the bare name of a file in assets/bodies or assets/styles, or by a path.
Result<BodySpec> body_named(const std::string& name_or_path);
Result<Style> style_named(const std::string& name_or_path);

}  // namespace ringcraft
