#include "planner/style.h"

#include "base/document.h"
#include "base/utf8.h"

namespace ringcraft {

Result<Style> read_style(const std::filesystem::path& path) {
  const Result<Document> document = read_document(path, "style");
  if (!document) return tl::unexpected(document.error());
  const nlohmann::json& value = document->value;
  Style style;
  style.name = value.value("name", clean_name(path.stem().string()));
  const auto read = [&](const char* key, double& field) { field = value.value(key, field); };
  read("horizon_s", style.horizon_s);
  read("location_weight", style.location_weight);
  read("fight_weight", style.fight_weight);
  read("control_weight", style.control_weight);
  read("distance_m", style.distance_m);
  read("distance_sigma_m", style.distance_sigma_m);
  read("facing_weight", style.facing_weight);
  read("ropes_weight", style.ropes_weight);
  read("defense_share", style.defense_share);
  read("caution", style.caution);
  read("attack_bonus", style.attack_bonus);
  read("knockdown_bonus", style.knockdown_bonus);
  read("rarity_weight", style.rarity_weight);
  read("duration_weight", style.duration_weight);
  read("temperature", style.temperature);
  read("boredom_rate", style.boredom_rate);
  read("boredom_after_s", style.boredom_after_s);
  read("late_sight_s", style.late_sight_s);
  read("learning", style.learning);
  read("fatigue", style.fatigue);
  read("injury", style.injury);
  read("aim_error_deg", style.aim_error_deg);
  read("speed_error", style.speed_error);
  style.candidates = value.value("candidates", style.candidates);
  if (value.value("leaf", "weighted") == "paper") style.leaf = LeafValue::paper;
  if (value.contains("strikes")) {
    style.strikes = value["strikes"].get<std::map<std::string, double>>();
  }
  if (value.contains("liked")) style.liked = value["liked"].get<std::map<std::string, double>>();
  return style;
}

}  // namespace ringcraft
