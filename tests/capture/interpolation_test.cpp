// Blends of real repetitions: of the library that the project holds, and of captures.

#include "motion/interpolation.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>

#include "base/file.h"
#include "base/random.h"
#include "capture/library_builder.h"
#include "capture/segment.h"
#include "mocap.h"

namespace ringcraft {
namespace {

// Errors over wanted outcomes between the repetitions of all families of one kind, m or rad.
struct Errors {
  std::vector<double> nearest, reached;
  double skate = 0, skate_of_repetitions = 0;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::map<Outcomes, Errors> errors_of(const std::vector<Action>& actions, int wanted_each) {
  const Skeleton skeleton = canonical_skeleton();
  const InterpolationSettings settings;
  std::map<Outcomes, Errors> errors;
  for (const Family& family : families(skeleton, actions, settings)) {
    const OutcomeTable table(skeleton, family.variants, family.kind, settings.outcomes);
    Random random(derived_seed(3, family.name.c_str()));
    Errors& of = errors[family.kind];
    for (int i = 0; i < wanted_each; ++i) {
      // Between two repetitions: a family of two spans no more than that.
      const auto count = static_cast<int>(family.members.size());
      const auto pick = [&] { return static_cast<std::size_t>(random.below(count)); };
      const Vec3 wanted = glm::mix(table.samples()[pick()].outcome, table.samples()[pick()].outcome,
                                   random.uniform(0.2f, 0.8f));
      const Reached reached = table.reach(wanted);
      of.nearest.push_back(static_cast<double>(table.nearest_variant(wanted)));
      of.reached.push_back(static_cast<double>(reached.error));
      if (!worse_than(skeleton, reached.action, family.variants, reached.weights, settings).empty())
        continue;
      of.skate = std::max(of.skate,
                          foot_skate_ratio(skeleton, reached.action.clip.frames, kTicksPerSecond));
    }
    for (const Variant& variant : family.variants)
      of.skate_of_repetitions =
          std::max(of.skate_of_repetitions,
                   foot_skate_ratio(skeleton, variant.action->clip.frames, kTicksPerSecond));
  }
  return errors;
}

TEST(Interpolation, OfTheProjectsLibraryComesNearerThanTheNearestRepetition) {
  const auto actions = collect_actions(assets_folder() / "kickboxing" / "library.toml");
  ASSERT_TRUE(actions) << to_string(actions.error());
  auto errors = errors_of(*actions, 20);
  ASSERT_EQ(errors.size(), 3u);
  // Half the width of a fist, and of the shin that meets a leg; for three repetitions the mean of
  // whose places no blend of them need pass through, the worst tenth is left out.
  EXPECT_LT(quantile(errors[Outcomes::blow].reached, 0.5), 0.04);
  // A step that is 3 cm off, and a turn that is 2 degrees off, nobody sees.
  EXPECT_LT(quantile(errors[Outcomes::step].reached, 0.9), 0.03);
  EXPECT_LT(quantile(errors[Outcomes::turn].reached, 0.9), static_cast<double>(radians(2)));
  for (const auto& [kind, of] : errors) {
    EXPECT_LT(quantile(of.reached, 0.5), 0.5 * quantile(of.nearest, 0.5)) << unit_of(kind);
    EXPECT_LE(of.skate, of.skate_of_repetitions + 0.005);
  }
}

TEST(Interpolation, OfCapturesComesNearerThanTheNearestRepetition) {
  const auto folder = testing::mocap_folder() / "cmu";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  FolderSettings settings;
  settings.mirrored = false;
  std::vector<Action> actions;
  for (const char* take : {"13_17.amc", "02_05.bvh", "16_15.bvh"}) {
    auto found = collect_folder_actions(folder / take, nullptr, settings);
    ASSERT_TRUE(found) << to_string(found.error());
    actions.insert(actions.end(), found->begin(), found->end());
  }
  auto errors = errors_of(actions, 20);
  ASSERT_TRUE(errors.contains(Outcomes::blow));
  EXPECT_LT(quantile(errors[Outcomes::blow].reached, 0.9), 0.04);
  for (const auto& [kind, of] : errors) {
    EXPECT_LT(quantile(of.reached, 0.5), 0.5 * quantile(of.nearest, 0.5)) << unit_of(kind);
    EXPECT_LE(of.skate, of.skate_of_repetitions + 0.005);
  }
}

TEST(Interpolation, AManifestIsBlendedWhereItIsAskedFor) {
  const auto manifest = assets_folder() / "kickboxing" / "library.toml";
  LibraryBuildSettings settings;
  settings.connect = false;
  const auto plain = build_library(manifest, settings);
  settings.interpolate = true;
  const auto blended = build_library(manifest, settings);
  ASSERT_TRUE(plain && blended);
  EXPECT_EQ(std::count_if(plain->actions().begin(), plain->actions().end(), is_blend), 0);
  const auto made = std::count_if(blended->actions().begin(), blended->actions().end(), is_blend);
  EXPECT_GE(made, 10);
  EXPECT_EQ(blended->actions().size(), plain->actions().size() + static_cast<std::size_t>(made));
  for (const ActionId from : blended->launchable())
    for (const ActionId to : blended->launchable())
      ASSERT_NE(blended->machine().path(from, to), nullptr);
}

}  // namespace
}  // namespace ringcraft
