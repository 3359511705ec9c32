#include "io/events.h"

#include <cmath>

#include "io/outputs.h"

namespace ringcraft {

namespace {

using nlohmann::json;

json vector_json(Vec3 v, int decimals) {
  return json::array({rounded(v.x, decimals), rounded(v.y, decimals), rounded(v.z, decimals)});
}

void add_contact(json& object, const Event& event) {
  if (event.fall) {
    object["fall"] = true;
  } else {
    object["strike"] = name_of(event.strike);
  }
  object["part"] = event.part;
  object["point"] = vector_json(event.point, 4);
  object["impulse"] = vector_json(event.impulse, 3);
  object["impulse_Ns"] = rounded(glm::length(event.impulse), 3);
  object["speed_mps"] = rounded(event.speed, 3);
  object["effective_mass_kg"] = rounded(event.effective_mass, 3);
  object["head_spin_radps"] = rounded(event.head_spin, 3);
  object["damage"] = rounded(event.damage, 3);
  object["foreseen"] = event.foreseen;
}

void add_response(json& object, const Event& event) {
  object["response"] = name_of(event.response);
  object["steps"] = event.steps;
  object["direction_rad"] = rounded(event.direction, 4);
  object["knockout"] = event.knockout;
}

json line_json(const Line& line) {
  json moves = json::array();
  for (std::size_t i = 0; i < line.actions.size(); ++i) {
    const std::string& action = line.actions[i];
    const bool forced = action.starts_with('*');
    moves.push_back({{"who", i < line.actors.size() ? line.actors[i] : -1},
                     {"action", forced ? action.substr(1) : action},
                     {"forced", forced}});
  }
  json object = {{"score", rounded(line.score / 1000.0, 3)}, {"moves", std::move(moves)}};
  if (line.at_most) object["at_most"] = true;  // the score is an upper bound
  if (line.terms) {
    for (const LineTerms& of : *line.terms) {
      object["terms"].push_back({{"location", rounded(of.location / 1000.0, 3)},
                                 {"hit", rounded(of.hit / 1000.0, 3)},
                                 {"defense", rounded(of.defense / 1000.0, 3)},
                                 {"control", rounded(of.control / 1000.0, 3)}});
    }
  }
  return object;
}

void add_decision(json& object, const DecisionRecord& decision, bool with_lines) {
  object["nodes"] = decision.nodes;
  object["leaves"] = decision.leaves;
  object["forced_nodes"] = decision.forced_nodes;
  object["pruned"] = {{"unanswered_hit", decision.pruned_unanswered_hit},
                      {"back_turned", decision.pruned_back_turned},
                      {"penetration", decision.pruned_penetration},
                      {"candidates", decision.pruned_candidates}};
  object["chosen"] = decision.chosen;
  if (!with_lines) return;
  json lines = json::array();
  for (const Line& line : decision.lines) lines.push_back(line_json(line));
  object["lines"] = std::move(lines);
  json struck = json::array();
  for (const StruckOff& one : decision.struck_off) {
    struck.push_back({{"action", one.action}, {"rules", one.rules}});
  }
  object["struck_off"] = std::move(struck);
}

// The caller's fields over the writer's own; what is said of fighters is put together.
void add_header(json& first, const json& header) {
  for (const auto& [key, value] : header.items()) {
    if (key != "fighters" || !value.is_array()) {
      first[key] = value;
      continue;
    }
    json& fighters = first["fighters"];
    for (std::size_t i = 0; i < value.size() && i < fighters.size(); ++i) {
      if (value[i].is_object()) fighters[i].update(value[i]);
    }
  }
}

}  // namespace

double rounded(double value, int decimals) {
  if (!std::isfinite(value)) return 0;
  double unit = 1;
  for (int i = 0; i < decimals; ++i) unit *= 10;
  return std::round(value * unit) / unit + 0.0;
}

json event_json(const Event& event, bool with_lines) {
  json object = {{"t", rounded(seconds(event.tick), 4)},
                 {"tick", event.tick},
                 {"type", name_of(event.type)},
                 {"who", event.who.value},
                 {"action", event.action}};
  if (event.whom.valid()) object["whom"] = event.whom.value;
  switch (event.type) {
    case EventType::decision:
      add_decision(object, event.decision, with_lines);
      break;
    case EventType::strike:
    case EventType::miss:
      object["strike"] = name_of(event.strike);
      if (event.fatigue > 0) object["fatigue"] = rounded(event.fatigue, 4);
      break;
    case EventType::hit:
    case EventType::block:
      add_contact(object, event);
      add_response(object, event);
      if (event.fatigue > 0) object["fatigue"] = rounded(event.fatigue, 4);
      if (with_lines && !event.replay.empty()) object["replay"] = event.replay;
      break;
    case EventType::response:
    case EventType::knockdown:
      add_response(object, event);
      break;
    case EventType::getup:
      break;
  }
  return object;
}

std::string events_jsonl(const Timeline& timeline, const std::vector<FighterLook>& looks,
                         const json& header) {
  json first = {{"type", "header"},
                {"duration_s", rounded(seconds(timeline.end), 4)},
                {"ticks_per_second", kTicksPerSecond},
                {"events", timeline.events.size()},  // where fewer follow, the file is cut off
                {"fighters", json::array()}};
  for (const FighterLook& look : looks) {
    first["fighters"].push_back({{"name", look.name},
                                 {"height_m", rounded(look.body.spec.height, 3)},
                                 {"mass_kg", rounded(look.body.spec.mass, 2)}});
  }
  if (header.is_object()) add_header(first, header);
  // Names and actions come from files: what is no UTF-8 is replaced, never thrown at the caller.
  const auto line = [](const json& object) {
    return object.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
  };
  std::string text = line(first);
  for (const Event& event : timeline.events) text += line(event_json(event, true));
  return text;
}

}  // namespace ringcraft
