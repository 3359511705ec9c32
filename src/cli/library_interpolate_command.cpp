// `ringcraft library interpolate`: how near blends come to wanted outcomes, against the nearest
// repetition alone.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/quantile.h"
#include "base/random.h"
#include "base/utf8.h"
#include "capture/library_file.h"
#include "cli/commands.h"
#include "io/filmstrip.h"
#include "motion/quality.h"
#include "scene/blend_judge.h"

namespace ringcraft {

namespace {

// A place inside the hull of the repetitions' outcomes: a seeded mean of two to four of them.
Vec3 wanted_in(const OutcomeTable& table, Random& random) {
  const auto count = static_cast<int>(table.variants().size());
  Vec3 sum{};
  float weights = 0;
  for (int k = 0; k < 2 + random.below(3); ++k) {
    const float w = random.uniform(0.1f, 1);
    sum += table.samples()[static_cast<std::size_t>(random.below(count))].outcome * w;
    weights += w;
  }
  return sum / weights;
}

struct FamilyFigures {
  std::string name;
  Outcomes kind = Outcomes::blow;
  std::size_t members = 0, made = 0;
  float widest = 0;                                     // distance of two outcomes, m or rad
  std::vector<double> nearest, filled, first, reached;  // errors, one a wanted outcome
  double skate_of_variants = 0, skate = 0;              // worst, of those not refused
  std::map<std::string, int> refused;                   // by what

  void add(const FamilyFigures& other) {
    for (auto member : {&FamilyFigures::nearest, &FamilyFigures::filled, &FamilyFigures::first,
                        &FamilyFigures::reached})
      (this->*member).insert((this->*member).end(), (other.*member).begin(), (other.*member).end());
    members += other.members;
    made += other.made;
    widest = std::max(widest, other.widest);
    skate_of_variants = std::max(skate_of_variants, other.skate_of_variants);
    skate = std::max(skate, other.skate);
    for (const auto& [why, times] : other.refused) refused[why] += times;
  }
};

// A refusal with N in place of its figures: those of one kind are counted together.
std::string reason_of(const std::string& wrong) {
  static const std::regex figure("[0-9]+(\\.[0-9]+)?");
  return std::regex_replace(wrong, figure, "N");
}

FamilyFigures figures_of(const Skeleton& skeleton, const Family& family,
                         const std::vector<Action>& made, const InterpolationSettings& settings,
                         const Judge& judge, const InterpolateOptions& asked, std::uint64_t seed) {
  FamilyFigures figures;
  figures.name = family.name;
  figures.kind = family.kind;
  figures.members = family.members.size();
  const OutcomeTable table(skeleton, family.variants, family.kind, settings.outcomes);
  std::vector<Vec3> there;
  for (std::size_t i = 0; i < family.members.size(); ++i) {
    there.push_back(table.samples()[i].outcome);
    for (const Vec3& other : there)
      figures.widest = std::max(figures.widest, glm::distance(there.back(), other));
    figures.skate_of_variants = std::max(
        figures.skate_of_variants,
        foot_skate_ratio(skeleton, family.variants[i].action->clip.frames, kTicksPerSecond));
  }
  for (const Action& action : made) {
    if (!action.name.starts_with("blend_" + family.name + "_")) continue;
    if (action.name.find_first_not_of("0123456789", family.name.size() + 7) != std::string::npos)
      continue;
    ++figures.made;
    there.push_back(outcome_of(skeleton, action, family.kind));
  }
  Random random(derived_seed(seed, family.name.c_str()));
  for (int i = 0; i < asked.wanted; ++i) {
    const Vec3 wanted = wanted_in(table, random);
    const Reached reached = table.reach(wanted);
    std::string wrong =
        worse_than(skeleton, reached.action, family.variants, reached.weights, settings);
    if (wrong.empty()) wrong = judge(reached.action);
    if (wrong.empty()) {
      const double skate = foot_skate_ratio(skeleton, reached.action.clip.frames, kTicksPerSecond);
      figures.skate = std::max(figures.skate, skate);
    } else {
      ++figures.refused[reason_of(wrong)];
    }
    float filled = glm::distance(there.front(), wanted);
    for (const Vec3& outcome : there) filled = std::min(filled, glm::distance(outcome, wanted));
    figures.nearest.push_back(static_cast<double>(table.nearest_variant(wanted)));
    figures.filled.push_back(static_cast<double>(filled));
    figures.first.push_back(static_cast<double>(reached.first_error));
    figures.reached.push_back(static_cast<double>(reached.error));
  }
  return figures;
}

void print_row(const FamilyFigures& f) {
  const bool turn = f.kind == Outcomes::turn;
  const double scale = turn ? static_cast<double>(degrees(1.0f)) : 100;
  const auto two = [&](const std::vector<double>& values) {
    return fmt::format("{:.1f} / {:.1f}", scale * quantile(values, 0.5),
                       scale * quantile(values, 0.9));
  };
  int refused = 0;
  for (const auto& [why, times] : f.refused) refused += times;
  fmt::print("{:<34}{:>4}{:>5}{:>8.0f}{:>4}{:>14}{:>14}{:>14}{:>14}{:>8.3f}{:>7.3f}{:>8.0f} %\n",
             f.name, f.members, f.made, scale * static_cast<double>(f.widest), turn ? "deg" : "cm",
             two(f.nearest), two(f.filled), two(f.first), two(f.reached), f.skate_of_variants,
             f.skate, 100.0 * refused / std::max<double>(1, static_cast<double>(f.reached.size())));
}

nlohmann::json json_of(const FamilyFigures& f) {
  const auto spread = [](const std::vector<double>& values) {
    return nlohmann::json{{"median", quantile(values, 0.5)}, {"90", quantile(values, 0.9)}};
  };
  return {{"family", f.name},
          {"unit", unit_of(f.kind)},
          {"members", f.members},
          {"made", f.made},
          {"widest", f.widest},
          {"wanted", f.reached.size()},
          {"nearest_repetition", spread(f.nearest)},
          {"nearest_with_made", spread(f.filled)},
          {"looked_up", spread(f.first)},
          {"reached", spread(f.reached)},
          {"foot_skate_of_repetitions", f.skate_of_variants},
          {"foot_skate", f.skate},
          {"refused", f.refused}};
}

}  // namespace

int run_library_interpolate(const std::string& name, const InterpolateOptions& asked,
                            const CommonOptions& options) {
  if (!options.out.empty()) {
    const auto folder = output_folder(options, {}, {"blends.svg"}, {name});
    if (!folder) return fail(folder.error());
  }
  const auto library = load_library(name);
  if (!library) return fail(library.error());
  // What was made before is made again.
  std::vector<Action> actions = library->actions();
  std::erase_if(actions, is_blend);
  const Skeleton& skeleton = library->skeleton();
  const InterpolationSettings settings;
  const Judge judge = joint_limit_judge();
  std::vector<std::string> notes;
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<Action> made = [&] {
    const EndAtSignal nothing_to_keep;
    return interpolated(skeleton, actions, settings, judge, notes);
  }();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::map<Outcomes, FamilyFigures> all;
  nlohmann::json rows = nlohmann::json::array();
  if (!options.json)
    fmt::print("{:<34}{:>4}{:>5}{:>12}{:>14}{:>14}{:>14}{:>14}{:>8}{:>7}{:>10}\n", "family", "of",
               "made", "apart", "nearest", "with made", "looked up", "reached", "skate", "",
               "refused");
  for (const Family& family : families(skeleton, actions, settings)) {
    if (interrupted) return 130;
    const FamilyFigures figures = figures_of(skeleton, family, made, settings, judge, asked,
                                             options.seed.value_or(asked.seed));
    if (options.json) {
      rows.push_back(json_of(figures));
    } else {
      print_row(figures);
    }
    FamilyFigures& sum = all[family.kind];
    sum.kind = family.kind;
    sum.name = family.kind == Outcomes::blow   ? "all blows"
               : family.kind == Outcomes::step ? "all steps"
                                               : "all turns";
    sum.add(figures);
  }
  if (options.json) {
    fmt::print("{}\n", json_text(nlohmann::json{{"families", rows}, {"notes", notes}}, 1));
  } else {
    for (const auto& [kind, sum] : all) {
      print_row(sum);
      for (const auto& [why, times] : sum.refused) fmt::print("  refused {}: {}\n", times, why);
    }
    if (options.verbose > 0)
      for (const std::string& note : notes) fmt::print("{}\n", note);
    fmt::print("{} blends made of {} actions\n", made.size(), actions.size());
    if (!options.quiet) tell("made in {:.1f} s\n", took.count());
  }
  if (options.out.empty()) return 0;
  const auto written = write_files(options.out, {{"blends.svg", filmstrip_svg(skeleton, made)}});
  if (!written) return fail(written.error());
  return 0;
}

}  // namespace ringcraft
