#include "scene/tree_file.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "scene/bout.h"

namespace ringcraft {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kToldLines = 3;
constexpr std::array<const char*, kTerms> kTermNames{"location", "hit", "defense", "control"};

double points(std::int32_t thousandths) {
  return thousandths / 1000.0;
}

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

Json event_json(const SceneTree& of, const TreeEvent& one) {
  const Event& event = one.event;
  const bool evaded = event.type == EventType::miss;
  Json json{{"tick", event.tick},
            {"t", rounded(seconds(event.tick))},
            {"type", evaded ? "evaded" : std::string(name_of(event.type))},
            {"who", of.name(event.who)},
            {"whom", of.name(event.whom)},
            {"action", event.action},
            {"strike", std::string(name_of(event.strike))}};
  if (evaded) return json;
  json["part"] = event.part;
  json["damage"] = rounded(static_cast<double>(event.damage));
  json["response"] = one.cuts ? std::string(name_of(event.response)) : "goes_on";
  if (one.cuts && event.steps > 0) json["steps"] = event.steps;
  if (event.knockout) json["knockout"] = true;
  return json;
}

// The paper's three functions; F_fight is hits and defenses together.
Json terms_json(const SceneTree& of, const DuelTerms& terms) {
  Json json = Json::object();
  for (std::size_t i = 0; i < 2; ++i) {
    Json side = Json::object();
    std::int32_t credited = 0;
    for (std::size_t k = 0; k < kTerms; ++k) {
      side[kTermNames[k]] = rounded(terms[i][k].points);
      credited += terms[i][k].credited;
    }
    side["fight"] = rounded(terms[i][1].points + terms[i][2].points);
    side["credited"] = points(credited);
    json[of.name(i == 0 ? of.tree.fighter : of.tree.opponent)] = side;
  }
  return json;
}

Json reasons_json(const std::vector<Pruned>& reasons) {
  Json json = Json::array();
  for (const Pruned reason : reasons) json.push_back(std::string(name_of(reason)));
  return json;
}

Json edge_json(const SceneTree& of, const TreeEdge& edge) {
  Json json{{"who", of.name(edge.who)}, {"action", edge.action}, {"forced", edge.forced}};
  if (!edge.then.empty()) json["then"] = edge.then;
  json["start_tick"] = edge.start;
  json["end_tick"] = edge.end;
  if (edge.action_end < kNever) json["action_end_tick"] = edge.action_end;
  json["terms"] = terms_json(of, edge.terms);
  json["events"] = Json::array();
  for (const TreeEvent& one : edge.events) json["events"].push_back(event_json(of, one));
  if (!edge.kept.empty()) json["kept_in_spite_of"] = reasons_json(edge.kept);
  return json;
}

Json node_json(const SceneTree& of, std::size_t id) {
  const TreeNode& node = of.tree.nodes[id];
  Json json{{"id", id}};
  json["parent"] = node.parent < 0 ? Json() : Json(node.parent);
  json["tick"] = node.tick;
  json["t"] = rounded(seconds(node.tick));
  json["kind"] = std::string(name_of(node.kind));
  if (node.who.valid()) json["who"] = of.name(node.who);
  if (node.parent >= 0) json["edge"] = edge_json(of, node.edge);
  json["gained"] = points(node.gained);
  json["value"] = points(node.value);
  if (!node.exact) json["exact"] = false;
  json["expanded"] = node.expanded;
  json["principal"] = node.principal;
  if (node.chosen) json["chosen"] = true;
  json["children"] = node.children;
  Json pruned = Json::array();
  for (const TreePruned& one : node.pruned) {
    pruned.push_back({{"action", one.action}, {"reasons", reasons_json(one.reasons)}});
  }
  json["pruned"] = pruned;
  json["candidates_beyond"] = node.beyond;
  return json;
}

Json lines_json(const DecisionRecord& record) {
  Json lines = Json::array();
  for (const Line& line : record.lines) {
    lines.push_back({{"value", points(line.score)}, {"actions", line.actions}});
    if (line.at_most) lines.back()["at_most"] = true;
  }
  return lines;
}

std::string step_text(const SceneTree& of, const TreeNode& node, const std::string& gap) {
  const TreeEdge& edge = node.edge;
  std::string action = (edge.forced ? "*" : "") + edge.action;
  for (const std::string& next : edge.then) action += " > " + next;
  std::string text = fmt::format("  {:6.3f} s  {:<10} {:<28} {:5.3f} s ", seconds(edge.start),
                                 of.name(edge.who), action, seconds(edge.end - edge.start));
  for (const auto& side : edge.terms) {
    text += " |";
    for (const TermSum& term : side) text += fmt::format(" {:7.3f}", rounded(term.points) + 0.0);
  }
  text += fmt::format(" | {:8.3f}\n", points(node.gained));
  for (const TreeEvent& one : edge.events) {
    const Event& event = one.event;
    text += fmt::format("{}{:6.3f} s  {} ", gap, seconds(event.tick), of.name(event.whom));
    if (event.type == EventType::miss) {
      text += fmt::format("evades {}'s {}\n", of.name(event.who), event.action);
      continue;
    }
    text += fmt::format("{} {}'s {} with the {}: {:.3f} damage, {}\n",
                        event.type == EventType::block ? "blocks" : "takes", of.name(event.who),
                        event.action, event.part, event.damage,
                        event.knockout ? "knocked out"
                        : one.cuts     ? std::string(name_of(event.response))
                                       : "goes on");
  }
  return text;
}

Error outside(double at_s, const std::string& what, const std::string& remedy) {
  return {ErrorKind::usage, "", "--at", fmt::format("{:g} s is {}", at_s, what), remedy};
}

}  // namespace

Result<SceneTree> tree_at(const MotionLibrary& library, const SceneFile& scene, double at_s,
                          std::size_t most_nodes, const FightOptions& options) {
  const double end = seconds(scene.duration);
  const std::string within = fmt::format("give a time from 0 to less than {:g} s", end);
  if (!std::isfinite(at_s)) return tl::unexpected(outside(at_s, "not a time", within));
  if (at_s < 0) return tl::unexpected(outside(at_s, "before the fight begins", within));
  if (at_s >= end) return tl::unexpected(outside(at_s, "beyond the scene's end", within));

  std::optional<Tick> last;  // at which a line was chosen
  Bout bout(library, scene, options);
  while (const auto fighter = run_to_decision(bout)) {
    const Plan plan = bout.decide(*fighter);
    const bool wanted = seconds(bout.state().now) >= at_s;
    if (!plan.record.lines.empty()) last = bout.state().now;
    if (!wanted || plan.record.lines.empty()) {
      bout.commit(*fighter, plan);
      continue;
    }
    SceneTree found;
    found.scene = scene.name;
    found.seed = scene.seed;
    found.asked_s = at_s;
    for (const SceneFighter& one : scene.fighters) found.names.push_back(one.name);
    found.style = scene.fighters[fighter->at()].style.name;
    found.leaf = scene.fighters[fighter->at()].style.leaf;
    found.planned = plan.record;
    found.tree = bout.tree(*fighter, plan, most_nodes);
    mark_chosen(found.tree, plan, library);
    return found;
  }
  if (!last) {
    return tl::unexpected(outside(at_s, "in a fight in which nobody decides",
                                  "give it more time, as in --set duration_s=10"));
  }
  const double at = std::floor(seconds(*last) * 1000) / 1000;  // not rounded beyond it
  return tl::unexpected(outside(at_s, fmt::format("after the last decision, at {:.3f} s", at),
                                fmt::format("give a time from 0 to {:.3f} s", at)));
}

std::string tree_json(const SceneTree& of) {
  const DecisionTree& tree = of.tree;
  std::uint64_t inexact = 0;
  for (const TreeNode& node : tree.nodes) inexact += node.exact ? 0 : 1;
  const Json head{
      {"version", RINGCRAFT_VERSION},
      {"scene", of.scene},
      {"seed", of.seed},
      {"asked_s", of.asked_s},
      {"tick", tree.start},
      {"t", rounded(seconds(tree.start))},
      {"fighter", of.name(tree.fighter)},
      {"opponent", of.name(tree.opponent)},
      {"style", of.style},
      {"leaf", of.leaf == LeafValue::paper ? "paper" : "weighted"},
      {"horizon_s", rounded(seconds(tree.horizon))},
      {"value", points(tree.nodes[0].value)},
      {"planner",
       {{"lines", lines_json(of.planned)},
        {"chosen", of.planned.chosen},
        {"nodes", of.planned.nodes},
        {"leaves", of.planned.leaves}}},
      {"left_out",
       {{"most_nodes", tree.most_nodes},
        {"nodes", tree.nodes.size()},
        {"unexpanded", tree.unexpanded},
        {"without_exact_value", inexact},
        {"complete", tree.complete()}}},
  };
  std::string text = json_text(head, 1);
  text.erase(text.rfind('}'));
  while (text.back() == '\n') text.pop_back();
  text += ",\n \"nodes\": [\n";
  for (std::size_t id = 0; id < tree.nodes.size(); ++id) {
    text += "  " + json_text(node_json(of, id)) + (id + 1 < tree.nodes.size() ? ",\n" : "\n");
  }
  return text + " ]\n}\n";
}

std::string tree_text(const SceneTree& of) {
  const DecisionTree& tree = of.tree;
  const TreeNode& root = tree.nodes[0];
  std::string text = fmt::format(
      "{} decides at {:.3f} s, looking {:.2f} s ahead; value {:.3f} points; {} nodes{}\n",
      of.name(tree.fighter), seconds(tree.start), seconds(tree.horizon), points(root.value),
      tree.nodes.size(),
      tree.complete() ? ", the whole tree"
                      : fmt::format(", {} not expanded further", tree.unexpanded));
  const std::string columns = fmt::format("{:61}| {:>31} | {:>31} |    so far\n{:61}", "",
                                          of.name(tree.fighter), of.name(tree.opponent), "");
  const std::string terms = fmt::format(" {:>7} {:>7} {:>7} {:>7}", "loc", "hit", "def", "ctl");
  text += columns + "|" + terms + " |" + terms + " |\n";
  for (std::size_t i = 0; i < std::min(kToldLines, root.children.size()); ++i) {
    const int first = root.children[i];
    const TreeNode& start = tree.nodes[static_cast<std::size_t>(first)];
    const std::vector<int> line = line_from(tree, first);
    const TreeNode& last = tree.nodes[static_cast<std::size_t>(line.back())];
    text += fmt::format("{}. {}: {:.3f} points{}{}\n", i + 1, start.edge.action,
                        points(start.value), start.chosen ? ", chosen" : "",
                        last.kind == TreeKind::terminal ? "" : ", not followed to the horizon");
    for (const int id : line) {
      text += step_text(of, tree.nodes[static_cast<std::size_t>(id)], "            ");
    }
  }
  return text;
}

}  // namespace ringcraft
