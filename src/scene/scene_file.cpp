#include "scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/document.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/schema.h"
#include "base/utf8.h"

namespace ringcraft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Roots closer than this at the start stand inside one another, m.
constexpr float kLeastDistance = 0.4f;

// A name without ending and folder is one of `folder` in the assets; anything else is a path.
bool is_bare(const std::string& name) {
  return name.find('/') == std::string::npos && fs::path(name).extension() != ".toml";
}

fs::path file_named(const std::string& name, const std::string& folder,
                    const fs::path& relative_to) {
  if (is_bare(name)) return assets_folder() / folder / (name + ".toml");
  return relative_to / name;
}

// The names that stand in a folder of the assets, sorted.
std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(assets_folder() / folder, failed)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string remedy_for_name(const std::string& name, const std::string& folder) {
  if (!is_bare(name)) return "check the path";
  const auto known = names_in(folder);
  if (known.empty()) return "set RINGCRAFT_ASSETS to ringcraft's folder assets";
  const std::string near = nearest_word(name, known);
  const std::string all = fmt::format("{}", fmt::join(known, ", "));
  return near.empty() ? "known names: " + all : "did you mean '" + near + "'? Known names: " + all;
}

// The file of a name that stands on a command line.
Result<fs::path> existing_file(const std::string& name, const std::string& folder,
                               const char* what) {
  const fs::path path = file_named(name, folder, "");
  std::error_code failed;
  if (fs::exists(path, failed)) return path;
  if (failed) return input_error(name, "", failed.message(), "check the path and its permissions");
  if (fs::is_regular_file(name, failed)) return fs::path(name);  // one without an ending
  return input_error(name, "", std::string("no such ") + what, remedy_for_name(name, folder));
}

// Linear from sRGB (IEC 61966-2-1).
float linear(int byte) {
  const float s = static_cast<float>(byte) / 255.0f;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

Vec3 colour_of(int rgb) {
  return {linear(rgb >> 16), linear((rgb >> 8) & 255), linear(rgb & 255)};
}

Vec3 colour_of(const json& value) {
  if (value.is_array())
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
  return colour_of(std::stoi(value.get<std::string>().substr(1), nullptr, 16));
}

// Of shorts and gloves where the scene names none, by team: sRGB, one for each of 16 fighters.
constexpr int kTeamColours[] = {0xb3191f, 0x1b3f94, 0x1e7a3c, 0xd0a012, 0x5b2a86, 0x14777c,
                                0xc4600f, 0x202226, 0xc04a86, 0xd9d9d4, 0x5a3a22, 0x7d9a1e,
                                0x4c93c9, 0x75757a, 0x6a0f22, 0x9a86c8};

// A checked scene document as a SceneFile.
class Reader {
 public:
  explicit Reader(const Document& document) : document_(document), value_(document.value) {}

  Result<SceneFile> read() {
    scene_.path = document_.path;
    scene_.files.push_back(scene_.path);
    const std::string stem = clean_name(document_.path.stem().string());
    const bool dots = stem.find_first_not_of('.') == std::string::npos;  // no name for a folder
    scene_.name = value_.value("name", dots ? "scene" : stem);
    scene_.duration = std::max<Tick>(1, ticks(value_["duration_s"].get<double>()));
    scene_.seed = value_.value("seed", scene_.seed);
    scene_.ring = value_.value("ring_m", scene_.ring);
    scene_.stance_switches = value_.value("stance_switches", false);
    scene_.feints = value_.value("feints", std::vector<std::string>{});
    scene_.feints_at = document_.place("/feints");
    read_planner();
    if (auto done = read_library(); !done) return tl::unexpected(done.error());
    for (std::size_t i = 0; i < value_["fighter"].size(); ++i) {
      if (auto done = read_fighter(i); !done) return tl::unexpected(done.error());
    }
    if (auto done = settle_placements(); !done) return tl::unexpected(done.error());
    json unseeded = value_;
    unseeded.erase("seed");
    scene_.settings = settings_.add(unseeded.dump()).digest();
    return std::move(scene_);
  }

 private:
  tl::unexpected<Error> fault(const std::string& pointer, std::string what, std::string remedy) {
    return usage_error(document_.path.string(), document_.place(pointer), std::move(what),
                       std::move(remedy));
  }

  // A path in the file is relative to the file, one of the command line to where that is given.
  fs::path base_of(const std::string& pointer) const {
    return document_.place(pointer) == "--set" ? fs::path() : document_.path.parent_path();
  }

  Result<void> must_exist(const std::string& pointer, const fs::path& path,
                          std::string remedy) const {
    std::error_code failed;
    if (fs::exists(path, failed)) return {};
    const std::string what = failed ? failed.message() : "no such file";
    return input_error(document_.path.string(), document_.place(pointer),
                       what + ": " + path.lexically_normal().string(), std::move(remedy));
  }

  // The file that the value at `pointer` names; it must be there, and is part of the settings.
  Result<fs::path> named_file(const std::string& pointer, const std::string& name,
                              const std::string& folder) {
    const fs::path path = file_named(name, folder, base_of(pointer));
    if (auto done = must_exist(pointer, path, remedy_for_name(name, folder)); !done) {
      return tl::unexpected(done.error());
    }
    const auto text = read_file(path);
    if (!text) return tl::unexpected(text.error());
    settings_.add(*text);
    return path;
  }

  Result<void> read_library() {
    const auto name = value_["library"].get<std::string>();
    const std::string place = document_.place("/library");
    const bool bare = name.find('/') == std::string::npos && fs::path(name).extension().empty();
    std::error_code failed;
    const bool here =
        place == "--set" && (fs::is_regular_file(name, failed) ||
                             fs::is_regular_file(fs::path(name) / "library.toml", failed));
    scene_.library = bare && !here ? assets_folder() / name : base_of("/library") / name;
    if (fs::is_directory(scene_.library, failed) || fs::is_regular_file(scene_.library, failed)) {
      return {};
    }
    return input_error(document_.path.string(), place,
                       "no such folder or library file: " + scene_.library.string(),
                       "name a motion library's folder under assets, as \"kickboxing\", or a file "
                       "that `ringcraft library build` wrote");
  }

  void read_planner() {
    PlanSettings& planner = scene_.planner;
    planner.ring_half_m = scene_.ring / 2.0;
    if (!value_.contains("planner")) return;
    const json& given = value_["planner"];
    planner.node_limit = given.value("node_limit", planner.node_limit);
    planner.hits_on_downed = given.value("hits_on_downed", planner.hits_on_downed);
    planner.replies = given.value("replies", planner.replies);
    if (!given.contains("prune")) return;
    const json& prune = given["prune"];
    planner.prune.unanswered_hit = prune.value("unanswered_hit", planner.prune.unanswered_hit);
    planner.prune.back_turned = prune.value("back_turned", planner.prune.back_turned);
    planner.prune.out_of_reach = prune.value("out_of_reach", planner.prune.out_of_reach);
    planner.prune.penetration = prune.value("penetration", planner.prune.penetration);
    planner.prune.penetration_m = prune.value("penetration_m", planner.prune.penetration_m);
  }

  Result<void> read_fighter(std::size_t i) {
    const json& given = value_["fighter"][i];
    const std::string at = fmt::format("/fighter/{}", i);
    SceneFighter fighter;
    fighter.name = given["name"].get<std::string>();
    for (const SceneFighter& other : scene_.fighters) {
      if (other.name == fighter.name) {
        return fault(at + "/name", "two fighters are called '" + fighter.name + "'",
                     "give each a name of its own");
      }
    }
    const auto body_file = named_file(at + "/body", given["body"].get<std::string>(), "bodies");
    if (!body_file) return tl::unexpected(body_file.error());
    const auto body = read_body(*body_file);
    if (!body) return tl::unexpected(body.error());
    scene_.files.push_back(*body_file);
    fighter.body = *body;
    const auto style_file = named_file(at + "/style", given["style"].get<std::string>(), "styles");
    if (!style_file) return tl::unexpected(style_file.error());
    const auto style = read_style(*style_file);
    if (!style) return tl::unexpected(style.error());
    scene_.files.push_back(*style_file);
    fighter.style = *style;
    fighter.style.horizon_s = given.value("horizon_s", fighter.style.horizon_s);
    fighter.team = team_of(given, i);
    if (given.value("stance", "orthodox") == "southpaw") fighter.stance = Stance::southpaw;
    fighter.placement.x = given["position"][0].get<float>();
    fighter.placement.z = given["position"][1].get<float>();
    fighter.health = static_cast<std::int32_t>(std::lround(given.value("health", 100.0) * 1000.0));
    if (given.contains("character")) {
      fighter.character =
          base_of(at + "/character") / fs::path(given["character"].get<std::string>());
      if (auto done = must_exist(at + "/character", fighter.character, "check the path"); !done) {
        return tl::unexpected(done.error());
      }
    }
    fighter.shorts = fighter.gloves = colour_of(team_colour(fighter.team));
    if (given.contains("shorts")) fighter.shorts = colour_of(given["shorts"]);
    if (given.contains("gloves")) fighter.gloves = colour_of(given["gloves"]);
    if (given.contains("skin")) fighter.skin = colour_of(given["skin"]);
    scene_.fighters.push_back(std::move(fighter));
    return {};
  }

  // The index of the first fighter of the same team; the own one without a team.
  int team_of(const json& given, std::size_t i) const {
    const json& all = value_["fighter"];
    std::size_t first = i;
    for (std::size_t other = 0; given.contains("team") && other < first; ++other) {
      if (all[other].value("team", "") == given["team"]) first = other;
    }
    return static_cast<int>(first);
  }

  // Teams take the colours in the order in which the scene names them. `team` is the index of its
  // first fighter.
  int team_colour(int team) const {
    int before = 0;
    for (int i = 0; i < team; ++i) {
      if (scene_.fighters[static_cast<std::size_t>(i)].team == i) ++before;
    }
    return kTeamColours[before];
  }

  Result<void> settle_placements() {
    std::vector<SceneFighter>& fighters = scene_.fighters;
    for (std::size_t i = 0; i < fighters.size(); ++i) {
      const std::string at = fmt::format("/fighter/{}", i);
      const Vec3 here = fighters[i].placement.position();
      if (std::max(std::abs(here.x), std::abs(here.z)) > scene_.ring / 2) {
        return fault(at + "/position", "'" + fighters[i].name + "' stands outside the ring",
                     fmt::format("keep x and z within {} m of the centre", scene_.ring / 2));
      }
      const SceneFighter* nearest = nullptr;
      for (std::size_t j = 0; j < fighters.size(); ++j) {
        const float distance = glm::distance(here, fighters[j].placement.position());
        if (j < i && distance < kLeastDistance) {
          return fault(at + "/position",
                       "'" + fighters[i].name + "' stands inside '" + fighters[j].name + "'",
                       fmt::format("leave at least {} m between them", kLeastDistance));
        }
        if (fighters[j].team == fighters[i].team) continue;
        if (!nearest || distance < glm::distance(here, nearest->placement.position())) {
          nearest = &fighters[j];
        }
      }
      if (nearest == nullptr) {
        return fault(at + "/team", "all fighters are of one team", "give one of them another team");
      }
      fighters[i].placement.yaw = yaw_of(nearest->placement.position() - here);
      const json& given = value_["fighter"][i];
      if (given.contains("yaw_deg")) {
        fighters[i].placement.yaw = wrapped_angle(radians(given["yaw_deg"].get<float>()));
      }
    }
    return {};
  }

  const Document& document_;
  const json& value_;
  Hasher settings_;
  SceneFile scene_;
};

}  // namespace

bool SceneFile::needs_both_stances() const {
  return stance_switches ||
         std::any_of(fighters.begin(), fighters.end(), [](const SceneFighter& fighter) {
           return fighter.stance == Stance::southpaw;
         });
}

Result<BodySpec> read_body(const fs::path& path) {
  const auto document = read_document(path, "body");
  if (!document) return tl::unexpected(document.error());
  const json& value = document->value;
  BodySpec body;
  body.name = value.value("name", clean_name(path.stem().string()));
  body.height = value["height_m"].get<float>();
  body.mass = value["mass_kg"].get<float>();
  body.sex = value.value("sex", "male") == "female" ? Sex::female : Sex::male;
  body.toughness = value.value("toughness", body.toughness);
  return body;
}

Result<BodySpec> body_named(const std::string& name_or_path) {
  return existing_file(name_or_path, "bodies", "body").and_then(read_body);
}

Result<Style> style_named(const std::string& name_or_path) {
  return existing_file(name_or_path, "styles", "style").and_then(read_style);
}

Result<SceneFile> read_scene(const std::string& name_or_path,
                             const std::vector<std::string>& sets) {
  const auto path = existing_file(name_or_path, "scenes", "scene");
  if (!path) return tl::unexpected(path.error());
  auto document = read_document(*path, "scene");
  if (!document) return tl::unexpected(document.error());
  for (const std::string& assignment : sets) {
    if (auto set = set_value(*document, assignment); !set) return tl::unexpected(set.error());
  }
  if (auto valid = checked(*document, "scene"); !valid) return tl::unexpected(valid.error());
  return Reader(*document).read();
}

}  // namespace ringcraft
