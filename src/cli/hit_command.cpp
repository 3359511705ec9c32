#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "io/outputs.h"
#include "scene/scene_file.h"
#include "scene/single_hit.h"

namespace ringcraft {

namespace {

Result<Part> part_named(const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    if (name == name_of(part_at(i))) return part_at(i);
    known += (i ? ", " : "") + std::string(name_of(part_at(i)));
  }
  return usage_error("", "--part", fmt::format("no body part '{}'", name), "one of " + known);
}

Result<Vec3> impulse_from(const std::vector<float>& numbers) {
  const Vec3 impulse{numbers[0], numbers[1], numbers[2]};
  if (!std::isfinite(impulse.x + impulse.y + impulse.z) || glm::length(impulse) > 2000) {
    return usage_error("", "--impulse", "not a finite impulse of at most 2000 N s",
                       "give x,y,z in N s, the fighter's left, up and fore");
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

nlohmann::json numbers_of(const HitAnswer& answer) {
  const ImpactOutcome& outcome = answer.outcome;
  return {{"response", name_of(outcome.response)},
          {"action", answer.response},
          {"steps", outcome.steps},
          {"direction_rad", outcome.direction},
          {"knockout", outcome.knockout},
          {"head_spin_rad_s", outcome.head_spin},
          {"margin_m", outcome.margin},
          {"com_velocity_mps",
           {outcome.com_velocity.x, outcome.com_velocity.y, outcome.com_velocity.z}},
          {"impulse_Ns", glm::length(answer.input.blow.impulse)},
          {"part", name_of(answer.input.blow.part)},
          {"hit_s", seconds(answer.hit_tick)}};
}

}  // namespace

int run_hit(const HitOptions& hit, const CommonOptions& options) {
  HitQuery query;
  const auto part = part_named(hit.part);
  if (!part) return fail(part.error());
  query.part = *part;
  const auto impulse = impulse_from(hit.impulse);
  if (!impulse) return fail(impulse.error());
  query.impulse = *impulse;
  const auto pose = pose_from(hit.pose);
  if (!pose) return fail(pose.error());
  std::tie(query.action, query.at_s) = *pose;
  query.tone = hit.tone;
  const auto body = read_body(assets_folder() / "bodies" / (hit.body + ".toml"));
  if (!body) return fail(body.error());
  query.body = *body;
  const auto library = load_library(hit.library);
  if (!library) return fail(library.error());
  const auto answer = simulate_hit(*library, query);
  if (!answer) return fail(answer.error());

  const nlohmann::json numbers = numbers_of(*answer);
  const std::filesystem::path folder = options.out.empty() ? "out/hit" : options.out;
  if (const auto made = make_output_folder(folder); !made) return fail(made.error());
  const std::vector<FighterLook> looks = {{query.body.name, answer->body}};
  const std::string glb = fight_glb(answer->timeline, looks);
  const std::string events = events_jsonl(answer->timeline, looks, {{"scene", "hit"}});
  const auto page =
      fight_html(glb, events, {{"scene", "hit"}, {"duration_s", seconds(answer->timeline.end)}});
  if (!page) return fail(page.error());
  for (const auto& [name, bytes] : {std::pair<const char*, const std::string&>{"hit.glb", glb},
                                    {"hit.html", *page},
                                    {"hit.json", numbers.dump(1) + "\n"}}) {
    if (const auto written = write_file(folder / name, bytes); !written)
      return fail(written.error());
  }
  if (options.json) {
    fmt::print("{}\n", numbers.dump(1));
  } else {
    fmt::print("{} ({}), head {:.1f} rad/s, {:+.0f} cm beyond the base of support; open {}\n",
               answer->response, name_of(answer->outcome.response), answer->outcome.head_spin,
               answer->outcome.margin * 100, (folder / "hit.html").string());
  }
  return 0;
}

}  // namespace ringcraft
