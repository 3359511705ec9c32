#include "scene/study_cost.h"

#include <gtest/gtest.h>

#include <set>

#include "fight/synthetic_fixture.h"
#include "scene/study_bouts.h"

namespace ringcraft {
namespace {

using StudyCostTest = SyntheticFixture;

std::set<Kind> kinds_of(const MotionLibrary& library) {
  std::set<Kind> kinds;
  for (const ActionId id : library.launchable()) kinds.insert(library.action(id).kind);
  return kinds;
}

TEST_F(StudyCostTest, ALibraryOfAnotherSizeKeepsItsKindsAndWhatIsNotChosen) {
  const auto had = static_cast<int>(library().launchable().size());
  const auto rest = library().actions().size() - library().launchable().size();
  for (const int wanted : {had / 2, had, 2 * had, 5 * had}) {
    const MotionLibrary sized = resized_library(library(), wanted);
    const auto there = static_cast<int>(sized.launchable().size());
    EXPECT_NEAR(there, wanted, static_cast<double>(kinds_of(library()).size())) << wanted;
    EXPECT_EQ(sized.actions().size() - sized.launchable().size(), rest) << wanted;
    EXPECT_EQ(kinds_of(sized), kinds_of(library())) << wanted;
    std::set<std::string> names;
    for (const Action& action : sized.actions()) names.insert(action.name);
    EXPECT_EQ(names.size(), sized.actions().size()) << wanted;
  }
}

TEST_F(StudyCostTest, EverySizeAndHorizonHasARowAndLongerHorizonsCostMore) {
  SceneFile scene;
  scene.fighters.resize(2);
  scene.planner.node_limit = 200;
  Style style;
  style.candidates = 4;
  scene = bout_scene(scene, *horizon_pairing("0.5v0.5", style), {1, 3, 4}, 0);
  CostStudy cost;
  cost.horizons_s = {0.5, 1};
  cost.choices = {6, 12};
  cost.decisions = 4;
  const Study study = cost_study(library(), scene, cost, {});
  ASSERT_EQ(study.table.rows.size(), 4u);
  ASSERT_EQ(study.timing.rows.size(), 4u);
  for (const std::size_t row : {0u, 2u}) {
    EXPECT_EQ(std::get<std::int64_t>(study.table.rows[row][2]), 4);
    EXPECT_LT(std::get<double>(study.table.rows[row][3]),
              std::get<double>(study.table.rows[row + 1][3]));
  }
  ASSERT_EQ(study.timing_charts.size(), 1u);
  EXPECT_EQ(study.timing_charts[0].series.size(), 2u);
}

}  // namespace
}  // namespace ringcraft
