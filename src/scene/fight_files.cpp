#include "scene/fight_files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "io/bvh_writer.h"
#include "io/report.h"

namespace ringcraft {

namespace {

constexpr std::size_t kMostExports = 16;  // fighters that a scene may have

std::vector<FighterLook> looks_of(const SceneFile& scene, const FightRecord& record,
                                  const FightExtras& extras) {
  std::vector<FighterLook> looks;
  for (std::size_t i = 0; i < scene.fighters.size(); ++i) {
    const SceneFighter& fighter = scene.fighters[i];
    looks.push_back({fighter.name, record.bodies[i], fighter.shorts, fighter.gloves, fighter.skin,
                     i < extras.characters.size() ? extras.characters[i] : nullptr});
  }
  return looks;
}

RunFacts facts_of(const SceneFile& scene, const FightRecord& record) {
  RunFacts facts;
  facts.scene = scene.name;
  facts.seed = scene.seed;
  for (std::size_t i = 0; i < scene.fighters.size(); ++i) {
    const Style& style = scene.fighters[i].style;
    const Condition condition = i < record.condition.size() ? record.condition[i] : Condition();
    facts.contestants.push_back(
        {style.name, style.horizon_s, condition.fatigue(), condition.injuries()});
  }
  facts.memo_hits = record.counts.memo_hits;
  facts.memo_misses = record.counts.memo_misses;
  facts.impulse_steps = record.counts.impulse_steps;
  facts.foreseen = record.counts.foreseen;
  facts.agreed_at_launch = record.counts.agreed_at_launch;
  facts.interrupted = record.interrupted;
  return facts;
}

nlohmann::json header_of(const SceneFile& scene) {
  nlohmann::json fighters = nlohmann::json::array();
  for (const SceneFighter& fighter : scene.fighters) {
    fighters.push_back({{"name", fighter.name},
                        {"style", fighter.style.name},
                        {"health", fighter.health / 1000.0}});
  }
  return {{"version", RINGCRAFT_VERSION},
          {"scene", scene.name},
          {"seed", scene.seed},
          {"ring_size", scene.ring},
          {"fighters", fighters}};
}

std::string text_of(const nlohmann::json& report, const std::filesystem::path& page) {
  int strikes = 0, landed = 0, knockdowns = 0;
  for (const auto& fighter : report.at("fighters")) {
    strikes += fighter.at("strikes").get<int>();
    landed += fighter.at("landed").get<int>();
    knockdowns += fighter.at("knockdowns").get<int>();
  }
  return fmt::format("{} strikes, {} landed, {} knockdowns; open {}", strikes, landed, knockdowns,
                     page.string());
}

}  // namespace

std::string fight_report(const SceneFile& scene, const MotionLibrary& library,
                         const FightRecord& record) {
  return json_text(
      report_json(record.timeline, looks_of(scene, record, {}), library, facts_of(scene, record)));
}

std::vector<std::string> fight_file_names(std::size_t fighters, const FightExtras& extras) {
  std::vector<std::string> names = {"fight.glb", "events.jsonl", "report.json", "timing.json",
                                    "fight.html"};
  for (std::size_t i = 0; i < fighters; ++i) {
    if (extras.bvh) names.push_back(fmt::format("fighter{}.bvh", i));
    if (extras.vrma) names.push_back(fmt::format("fighter{}.vrma", i));
  }
  return names;
}

Result<FightSummary> write_fight(const std::filesystem::path& folder, const SceneFile& scene,
                                 const MotionLibrary& library, const FightRecord& record,
                                 double wall_seconds, int threads, const FightExtras& extras) {
  const std::vector<FighterLook> looks = looks_of(scene, record, extras);
  const nlohmann::json report =
      report_json(record.timeline, looks, library, facts_of(scene, record));
  const std::string glb = fight_glb(record.timeline, looks, {scene.ring / 2, extras.root_motion});
  const std::string events = events_jsonl(record.timeline, looks, header_of(scene));
  const auto page = fight_html(glb, events, report);
  if (!page) return tl::unexpected(page.error());
  const ClockFacts clock{wall_seconds, threads, record.decision_ms, record.impulse_step_us};
  const std::string timing = timing_json(record.timeline, clock).dump(1) + "\n";
  const std::string report_text = json_text(report, 1) + "\n";
  std::vector<std::string> bytes = {glb, events, report_text, timing, *page};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const FighterTrack& track = record.timeline.tracks[i];
    if (extras.bvh) bytes.push_back(fighter_bvh(looks[i].body.skeleton, track, *extras.bvh));
    if (extras.vrma) bytes.push_back(fighter_vrma(looks[i], track));
  }
  const std::vector<std::string> names = fight_file_names(looks.size(), extras);
  NamedBytes files;
  for (std::size_t i = 0; i < names.size(); ++i) files.emplace_back(names[i], std::move(bytes[i]));
  if (const auto written = write_files(folder, files); !written)
    return tl::unexpected(written.error());
  return FightSummary{json_text(report, 1), text_of(report, folder / "fight.html")};
}

void remove_old_exports(const std::filesystem::path& folder, std::size_t fighters,
                        const FightExtras& extras,
                        const std::vector<std::filesystem::path>& inputs) {
  const std::vector<std::string> own = fight_file_names(fighters, extras);
  FightExtras all;
  all.bvh.emplace();
  all.vrma = true;
  const std::vector<std::string> names = fight_file_names(kMostExports, all);
  for (std::size_t i = fight_file_names(0, {}).size(); i < names.size(); ++i) {
    if (std::find(own.begin(), own.end(), names[i]) != own.end()) continue;
    if (!may_write(folder, {names[i]}, inputs)) continue;
    std::error_code stays;
    if (std::filesystem::is_regular_file(folder / names[i], stays))
      std::filesystem::remove(folder / names[i], stays);
  }
}

}  // namespace ringcraft
