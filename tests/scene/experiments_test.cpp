// The paper's experiments on the default library. Its actions are 2.2 times as short as the paper's
// ("most longer than 1 second"), and so are the horizons: 3 s become 1.36 s, 1 s becomes 0.45 s.

#include <gtest/gtest.h>

#include "base/file.h"
#include "capture/library_builder.h"
#include "scene/study_bouts.h"

namespace ringcraft {
namespace {

double sum(const PairingResult& result, std::int64_t SideTally::*field) {
  double all = 0;
  for (const BoutTally& bout : result.bouts) {
    for (const SideTally& side : bout.side) all += static_cast<double>(side.*field);
  }
  return all;
}

TEST(Experiments, DeepFightersStepAndDefendMoreAreHitLessAndBeatShallowOnes) {
  const auto library = build_library(assets_folder() / "kickboxing" / "library.toml");
  ASSERT_TRUE(library) << library.error().what;
  const auto balanced = read_style(assets_folder() / "styles" / "balanced.toml");
  ASSERT_TRUE(balanced);
  std::vector<Pairing> pairings;
  for (const char* name : {"1.36v0.45", "0.45v0.45", "1.36v1.36"}) {
    pairings.push_back(*horizon_pairing(name, *balanced));
  }
  SceneFile scene;
  scene.fighters.resize(2);
  scene.planner.node_limit = 0;
  StudyRun run;
  run.threads = 2;
  const auto results = run_pairings(*library, scene, pairings, {6, 60, 6}, run);
  for (const BoutTally& bout : results[0].bouts) EXPECT_EQ(bout.winner, 0);
  const PairingResult &shallow = results[1], &deep = results[2];
  const auto defended = [](const PairingResult& result) {
    return sum(result, &SideTally::defenses) / sum(result, &SideTally::faced);
  };
  EXPECT_GT(sum(deep, &SideTally::steps), 1.5 * sum(shallow, &SideTally::steps));
  EXPECT_GT(defended(deep), 1.5 * defended(shallow));
  // Careful, not passive. Asked of 100 bouts: 0.6 times; six are fewer.
  EXPECT_GT(sum(deep, &SideTally::hits), 0);
  EXPECT_LT(sum(deep, &SideTally::hits), 0.75 * sum(shallow, &SideTally::hits));
}

}  // namespace
}  // namespace ringcraft
