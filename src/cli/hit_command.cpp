#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "capture/library_builder.h"
#include "cli/commands.h"
#include "cli/scene_inputs.h"
#include "io/outputs.h"
#include "scene/hit_map.h"
#include "scene/scene_file.h"

namespace ringcraft {

namespace {

const Vec3 kAttackerColour{0.02f, 0.06f, 0.3f};  // linear RGB

Result<Part> part_named(const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (name == name_of(part_at(i))) return part_at(i);
    known += (i ? ", " : "") + std::string(name_of(part_at(i)));
  }
  return usage_error("", "--part", fmt::format("no body part '{}'", name), "one of " + known);
}

// "x,y,z" in N s.
Result<Vec3> impulse_from(const std::string& text) {
  Vec3 impulse{};
  const char* at = text.c_str();
  int numbers = 0;
  for (; numbers < 3; ++numbers) {
    char* rest = nullptr;
    impulse[numbers] = std::strtof(at, &rest);
    if (rest == at) break;
    at = rest;
    if (numbers < 2 && *at++ != ',') break;
  }
  if (numbers < 3 || *at != '\0') {
    return usage_error("", "--impulse", fmt::format("'{}' is not three numbers", text),
                       "give X,Y,Z in N s along the fighter's left, up and fore, as in 0,0,-26");
  }
  if (!std::isfinite(impulse.x + impulse.y + impulse.z) || glm::length(impulse) > 2000) {
    return usage_error("", "--impulse", "not a finite impulse of at most 2000 N s",
                       "give X,Y,Z in N s");
  }
  return impulse;
}

// "action@seconds", seconds optional.
Result<std::pair<std::string, double>> pose_from(const std::string& text) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos) return std::pair{text, 0.0};
  try {
    std::size_t used = 0;
    const std::string number = text.substr(at + 1);
    const double seconds = std::stod(number, &used);
    if (used == number.size() && std::isfinite(seconds))
      return std::pair{text.substr(0, at), seconds};
  } catch (const std::exception&) {
  }
  return usage_error("", "--pose", fmt::format("'{}' is not ACTION@SECONDS", text),
                     "as in cross@0.2");
}

nlohmann::json vector_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

nlohmann::json numbers_of(const HitQuery& query, const HitAnswer& answer) {
  const ImpactOutcome& outcome = answer.outcome;
  const Blow& blow = answer.input.blow;
  nlohmann::json numbers = {{"response", name_of(outcome.response)},
                            {"action", answer.response},
                            {"steps", outcome.steps},
                            {"direction_rad", outcome.direction},
                            {"knockout", outcome.knockout},
                            {"head_spin_radps", outcome.head_spin},
                            {"head_spin_rad_s", outcome.head_spin},  // its name of before
                            {"margin_m", outcome.margin},
                            {"com_velocity_mps", vector_of(outcome.com_velocity)},
                            {"impulse_Ns", glm::length(blow.impulse)},
                            {"impulse", vector_of(blow.impulse)},
                            {"point", vector_of(blow.point)},
                            {"part", name_of(blow.part)},
                            {"tone", answer.input.tone},
                            {"pose", query.action},
                            {"pose_s", answer.at_s},
                            {"hit_s", seconds(answer.hit_tick)}};
  if (!query.strike.empty()) {
    numbers["strike"] = query.strike;
    numbers["distance_m"] = answer.distance;
    numbers["speed_mps"] = blow.speed;
    numbers["effective_mass_kg"] = blow.effective_mass;
    numbers["blocked"] = blow.blocked;
    numbers["hits"] = answer.hits;
  }
  return numbers;
}

std::string sentence_of(const HitQuery& query, const HitAnswer& answer) {
  const ImpactOutcome& outcome = answer.outcome;
  const Blow& blow = answer.input.blow;
  std::string text;
  if (!query.strike.empty()) {
    text =
        fmt::format("{} from {:.2f} m {} the {}: {:.1f} m/s, {:.1f} kg, {:.0f} N s; ", query.strike,
                    answer.distance, blow.blocked ? "is blocked by" : "meets", name_of(blow.part),
                    blow.speed, blow.effective_mass, glm::length(blow.impulse));
  }
  text += fmt::format("{} ({}), head {:.1f} rad/s, {:+.0f} cm beyond the base of support",
                      answer.response, name_of(outcome.response), outcome.head_spin,
                      outcome.margin * 100);
  if (answer.hits > 1) text += fmt::format("; the first of {} hits", answer.hits);
  return text;
}

Result<HitQuery> query_from(const HitOptions& hit) {
  HitQuery query;
  const auto part = part_named(hit.part);
  if (!part) return tl::unexpected(part.error());
  query.part = *part;
  const auto impulse = impulse_from(hit.impulse);
  if (!impulse) return tl::unexpected(impulse.error());
  query.impulse = *impulse;
  const auto pose = pose_from(hit.pose);
  if (!pose) return tl::unexpected(pose.error());
  std::tie(query.action, query.at_s) = *pose;
  for (const std::string& sweep : hit.sweep) {
    if (hit.tone && sweep.starts_with("tone=")) {
      return usage_error("", "--tone", "--sweep goes over the tone, too", "give one of the two");
    }
  }
  query.tone = hit.tone.value_or(query.tone);
  const auto body = body_named(hit.body);
  if (!body) return tl::unexpected(body.error());
  query.body = *body;
  query.strike = hit.strike;
  const auto attacker = body_named(hit.attacker.empty() ? hit.body : hit.attacker);
  if (!attacker) return tl::unexpected(attacker.error());
  query.attacker = *attacker;
  if (hit.distance && !(*hit.distance >= 0 && *hit.distance <= 10)) {
    return usage_error("", "--distance", fmt::format("{} m is outside of 0 to 10 m", *hit.distance),
                       "give how far apart the two stand");
  }
  query.distance = hit.distance;
  return query;
}

int run_sweep(const MotionLibrary& library, const HitQuery& query, const HitOptions& hit,
              const CommonOptions& options, const std::filesystem::path& folder) {
  std::vector<SweepRange> ranges;
  for (const std::string& text : hit.sweep) {
    auto range = sweep_range(text);
    if (!range) return fail(range.error());
    ranges.push_back(std::move(*range));
  }
  SweepOptions settings;
  settings.threads = options.threads;
  settings.interrupted = &interrupted;
  if (!options.quiet) {
    settings.progress = [](std::size_t done, std::size_t all) {
      if (done % 100 == 0 || done == all) tell("\r{} of {} hits", done, all);
    };
  }
  const auto sweep = sweep_hits(library, query, std::move(ranges), settings);
  if (!sweep) return fail(sweep.error());
  if (!options.quiet) tell("\n");
  const std::string json = sweep_json(*sweep);
  const auto written = write_files(folder, {{"hit_sweep.csv", sweep_csv(*sweep)},
                                            {"hit_sweep.json", json + "\n"},
                                            {"hit_sweep.svg", sweep_svg(*sweep)}});
  if (!written) return fail(written.error());
  if (options.json) {
    fmt::print("{}\n", json);
  } else {
    const auto done = std::ranges::count_if(sweep->points, &SweepPoint::done);
    fmt::print("{} of {} hits; open {}\n", done, sweep->points.size(),
               (folder / "hit_sweep.svg").string());
  }
  return sweep->interrupted ? 130 : 0;
}

}  // namespace

int run_hit(const HitOptions& hit, const CommonOptions& options) {
  const auto query = query_from(hit);
  if (!query) return fail(query.error());
  std::vector<std::string> names = {"hit.glb", "hit.html", "events.jsonl", "hit.json"};
  if (!hit.sweep.empty()) names = {"hit_sweep.csv", "hit_sweep.json", "hit_sweep.svg"};
  std::vector<std::filesystem::path> inputs = files_of_library(hit.library);
  inputs.insert(inputs.end(), {hit.body, hit.attacker});
  const auto folder = output_folder(options, kHitFolder, names, inputs);
  if (!folder) return fail(folder.error());
  const auto library = library_for_blows(hit.library);
  if (!library) return fail(library.error());
  for (const auto& [option, name] :
       {std::pair("--pose", query->action), std::pair("--strike", query->strike)}) {
    if (name.empty() || library->find(name).valid()) continue;
    return fail({ErrorKind::usage, "", option,
                 fmt::format("no action '{}' in library {}", name, library->name()),
                 meant_action(*library, name) + "`ringcraft library inspect` lists them"});
  }
  if (!hit.sweep.empty()) return run_sweep(*library, *query, hit, options, *folder);
  if (const auto page = page_template(); !page) return fail(page.error());
  const auto answer = simulate_hit(*library, *query);
  if (!answer) return fail(answer.error());

  const nlohmann::json numbers = numbers_of(*query, *answer);
  std::vector<FighterLook> looks = {{query->body.name, answer->bodies[0]}};
  if (answer->bodies.size() > 1) {
    looks.push_back({query->attacker.name + " (attacker)", answer->bodies[1], kAttackerColour,
                     kAttackerColour});
  }
  const nlohmann::json header = {{"scene", "hit"}, {"version", RINGCRAFT_VERSION}};
  const std::string glb = fight_glb(answer->timeline, looks);
  const std::string events = events_jsonl(answer->timeline, looks, header);
  const auto page =
      fight_html(glb, events, {{"scene", "hit"}, {"duration_s", seconds(answer->timeline.end)}});
  if (!page) return fail(page.error());
  const auto written = write_files(*folder, {{"hit.glb", glb},
                                             {"hit.html", *page},
                                             {"events.jsonl", events},
                                             {"hit.json", json_text(numbers, 1) + "\n"}});
  if (!written) return fail(written.error());
  if (options.json) {
    fmt::print("{}\n", json_text(numbers, 1));
  } else {
    fmt::print("{}; open {}\n", sentence_of(*query, *answer), (*folder / "hit.html").string());
  }
  return 0;
}

}  // namespace ringcraft
